//! What the printer writes, the reader reads back; whatever is written, the reader does
//! not panic.

use crate::Image;
use crate::print;
use crate::reader::{Completeness, Lexer, Reader, TokenKind, is_complete};
use crate::value::Value;
use crate::value::equality;
use crate::value::known;
use crate::value::number;
use num_bigint::BigInt;
use proptest::prelude::*;

/// A value to make in an image; symbols need one.
#[derive(Clone, Debug)]
enum Datum {
    Symbol(String),
    Keyword(String),
    Integer(i64),
    Big(Vec<u32>, bool),
    Ratio(i64, i64),
    Single(f32),
    Double(f64),
    Char(char),
    Text(String),
    List(Vec<Datum>, Option<Box<Datum>>),
    Vector(Vec<Datum>),
    Quoted(Box<Datum>),
}

fn build(image: &mut Image, datum: &Datum) -> Value {
    match datum {
        Datum::Symbol(name) => image.intern(image.current_package(), name).into(),
        Datum::Keyword(name) => image.keyword(name).into(),
        Datum::Integer(n) => Value::Int(*n),
        Datum::Big(digits, negative) => {
            let n = BigInt::from_slice(num_bigint::Sign::Plus, digits);
            number::from_big(if *negative { -n } else { n })
        }
        Datum::Ratio(n, d) => {
            number::ratio(BigInt::from(*n), BigInt::from(*d)).unwrap_or(Value::Int(*n))
        }
        Datum::Single(x) => Value::Single(*x),
        Datum::Double(x) => Value::Double(*x),
        Datum::Char(c) => Value::Char(*c),
        Datum::Text(text) => Value::string(text.clone()),
        Datum::List(items, tail) => {
            let items: Vec<Value> = items.iter().map(|d| build(image, d)).collect();
            let tail = match tail {
                Some(tail) if !items.is_empty() => build(image, tail),
                _ => Value::NIL,
            };
            Value::list_with_tail(items, tail)
        }
        Datum::Vector(items) => Value::vector(items.iter().map(|d| build(image, d)).collect()),
        Datum::Quoted(inner) => {
            let inner = build(image, inner);
            Value::list([known::QUOTE.into(), inner])
        }
    }
}

fn datum() -> impl Strategy<Value = Datum> {
    let leaf = prop_oneof![
        "\\PC{0,8}".prop_map(Datum::Symbol),
        "[-+.0-9A-Fe/^_:#|a-d]{0,6}".prop_map(Datum::Symbol),
        "[A-Z-]{1,6}".prop_map(Datum::Keyword),
        any::<i64>().prop_map(Datum::Integer),
        (prop::collection::vec(any::<u32>(), 0..6), any::<bool>())
            .prop_map(|(digits, negative)| Datum::Big(digits, negative)),
        (any::<i64>(), any::<i64>()).prop_map(|(n, d)| Datum::Ratio(n, d)),
        any::<u32>()
            .prop_map(f32::from_bits)
            .prop_filter("finite", |x| x.is_finite())
            .prop_map(Datum::Single),
        any::<u64>()
            .prop_map(f64::from_bits)
            .prop_filter("finite", |x| x.is_finite())
            .prop_map(Datum::Double),
        any::<char>().prop_map(Datum::Char),
        any::<String>().prop_map(Datum::Text),
    ];
    leaf.prop_recursive(5, 60, 8, |inner| {
        prop_oneof![
            (
                prop::collection::vec(inner.clone(), 0..8),
                prop::option::of(inner.clone().prop_map(Box::new))
            )
                .prop_map(|(items, tail)| Datum::List(items, tail)),
            prop::collection::vec(inner.clone(), 0..8).prop_map(Datum::Vector),
            inner.prop_map(|d| Datum::Quoted(Box::new(d))),
        ]
    })
}

fn read(image: &mut Image, text: &str) -> Value {
    let mut reader = Reader::of_text(text);
    let form = reader.next_form(image);
    let (value, _) = form
        .unwrap_or_else(|error| panic!("{error}: {text}"))
        .unwrap_or_else(|| panic!("nothing read: {text}"));
    assert!(
        matches!(reader.next_form(image), Ok(None)),
        "more than one form: {text}"
    );
    value
}

fn variables(image: &mut Image, pretty: bool, double_default: bool) {
    image.set_special(known::V_PRINT_PRETTY, Value::bool(pretty));
    let format = if double_default {
        known::DOUBLE_FLOAT
    } else {
        known::SINGLE_FLOAT
    };
    image.set_special(known::V_READ_DEFAULT_FLOAT_FORMAT, format.into());
}

/// A piece of text that means something to the reader.
fn token() -> impl Strategy<Value = String> {
    prop_oneof![
        prop::sample::select(vec![
            "(", ")", "'", "`", ",", ",@", ",.", "#'", "#(", "#2A(", "#+", "#-", "#.", "#x", "#3r",
            "#*", "#:", "#\\", "#|", "|#", "|", "\\", "\"", ";", "\n", " ", ".", "..", "a", ":",
            "::", "cl:car", "1", "1.5", "-", "d0", "#1=", "#1#", "#S(", "#c", "#p", "#<", "#",
            "nil", "“",
        ])
        .prop_map(str::to_owned),
        "\\PC{0,3}",
    ]
}

#[test]
fn names_with_typographic_quotation_marks_are_printed_between_bars() {
    let mut image = Image::new();
    for text in ["|A‘|", "|’|", "|“B”|", "|„|"] {
        let value = read(&mut image, text);
        assert_eq!(print::to_string(&image, &value, true), text);
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 400,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn printed_values_read_back(datum in datum(), pretty: bool, double_default: bool) {
        let mut image = Image::new();
        variables(&mut image, pretty, double_default);
        let value = build(&mut image, &datum);
        let text = print::to_string(&image, &value, true);
        let again = read(&mut image, &text);
        prop_assert_eq!(print::to_string(&image, &again, true), text.clone());
        prop_assert!(same(&value, &again), "{}", text);
        prop_assert_eq!(is_complete(&text), Completeness::Complete);
    }

    #[test]
    fn no_text_makes_the_reader_panic(text in any::<String>()) {
        read_to_the_end(&text);
    }

    #[test]
    fn no_tokens_make_the_reader_panic(tokens in prop::collection::vec(token(), 0..30)) {
        read_to_the_end(&tokens.concat());
    }

    #[test]
    fn a_text_is_incomplete_just_when_reading_it_meets_its_end(
        tokens in prop::collection::vec(token(), 0..12)
    ) {
        let text = tokens.concat();
        // Whether a form follows a feature expression depends on the features.
        let has_features = Lexer::new(&text)
            .any(|token| matches!(token.kind, TokenKind::Dispatch { letter: '+' | '-', .. }));
        prop_assume!(!has_features);
        let mut image = Image::new();
        let mut reader = Reader::of_text(text.as_str());
        let mut ends_inside = false;
        let mut is_wrong = false;
        loop {
            match reader.next_form(&mut image) {
                Ok(Some(_)) => {}
                Ok(None) => break,
                Err(error) => {
                    ends_inside = error.is_end_of_file();
                    is_wrong = !ends_inside;
                    break;
                }
            }
        }
        // Wrong text is neither; the reader tells what is wrong with it.
        if !is_wrong {
            let expected = matches!(is_complete(&text), Completeness::Incomplete { .. });
            prop_assert_eq!(ends_inside, expected, "{}", text);
        }
    }
}

/// Do both have the same parts? Floats by their bits.
fn same(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Vector(x), Value::Vector(y)) => {
            let (x, y) = (x.to_vec(), y.to_vec());
            x.len() == y.len() && x.iter().zip(&y).all(|(a, b)| same(a, b))
        }
        (Value::Cons(x), Value::Cons(y)) => same(&x.car(), &y.car()) && same(&x.cdr(), &y.cdr()),
        _ => equality::equal(a, b),
    }
}

fn read_to_the_end(text: &str) {
    let mut image = Image::new();
    let source = image.sources.add("text", text);
    let mut reader = Reader::new(&image, source);
    let _ = is_complete(text);
    // Each step moves on, so there are no more steps than bytes.
    for _ in 0..=text.len() + 1 {
        if let Ok(None) = reader.next_form(&mut image) {
            return;
        }
    }
    panic!("the reader does not reach the end of {text:?}");
}
