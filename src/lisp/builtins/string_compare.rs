//! Comparison of strings, with and without case.

use std::cmp::Ordering;
use std::rc::Rc;

use super::characters::upcase;
use super::keywords;
use super::strings::designated;
use crate::builtin::{Builtin, pure};
use crate::image::Image;
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::{Bounds, Sequence};
use crate::value::string::LispString;

type Outcome = Result<Value, Box<Raise>>;

/// How two parts of texts compare, and the index in the first text where they differ.
fn compare(image: &Image, args: &[Value], fold: bool) -> Result<(Ordering, usize), Box<Raise>> {
    if let ([Value::Str(a), Value::Str(b)], false) = (args, fold)
        && a.borrow().as_str() == b.borrow().as_str()
    {
        return Ok((Ordering::Equal, a.len()));
    }
    let [start1, end1, start2, end2] = keywords::parse(
        image,
        &args[2..],
        [
            known::K_START1,
            known::K_END1,
            known::K_START2,
            known::K_END2,
        ],
    )?;
    let (from, first) = part(image, &args[0], start1.as_ref(), end1.as_ref())?;
    let (_, second) = part(image, &args[1], start2.as_ref(), end2.as_ref())?;
    let case = |c: char| if fold { upcase(c) } else { c };
    let mut index = from;
    let mut others = second.chars();
    for a in first.chars() {
        let ordering = match others.next() {
            Some(b) => case(a).cmp(&case(b)),
            None => Ordering::Greater,
        };
        if ordering != Ordering::Equal {
            return Ok((ordering, index));
        }
        index += 1;
    }
    let ordering = match others.next() {
        Some(_) => Ordering::Less,
        None => Ordering::Equal,
    };
    Ok((ordering, index))
}

fn part(
    image: &Image,
    designator: &Value,
    start: Option<&Value>,
    end: Option<&Value>,
) -> Result<(usize, String), Box<Raise>> {
    let text = designated(image, designator)?;
    if start.is_none() && end.is_none() {
        return Ok((0, text));
    }
    let string = Rc::new(LispString::new(text));
    let bounds = Bounds::new(&Sequence::Str(string.clone()), start, end)?;
    Ok((bounds.start, string.slice(bounds.start, bounds.end)))
}

macro_rules! comparisons {
    ($($function:ident $name:literal $fold:literal $ordering:ident => $result:expr, $doc:literal $example:literal;)*) => {
        $(fn $function(image: &mut Image, args: &[Value]) -> Outcome {
            let ($ordering, index) = compare(image, args, $fold)?;
            let holds = $result;
            Ok(if holds { index.into() } else { Value::NIL })
        })*
        /// Comparisons of strings that return the index where they differ.
        pub(crate) static TABLE: &[Builtin] = &[
            pure("STRING=", LAMBDA_LIST, "Are two texts the same?", &["(string= 'foo \"FOO\") => T", "(string= \"foo\" \"foobar\" :end2 3) => T"], string_eq),
            pure("STRING-EQUAL", LAMBDA_LIST, "Are two texts the same, whatever their case?", &["(string-equal \"foo\" \"FOO\") => T"], string_equal),
            $(pure($name, LAMBDA_LIST, $doc, &[$example], $function),)*
        ];
    };
}

const LAMBDA_LIST: &str = "string-1 string-2 &key start1 end1 start2 end2";

fn string_eq(image: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::bool(compare(image, args, false)?.0.is_eq()))
}

fn string_equal(image: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::bool(compare(image, args, true)?.0.is_eq()))
}

comparisons! {
    string_ne "STRING/=" false o => o.is_ne(), "The index where two texts differ, or `NIL`." "(string/= \"abc\" \"abd\") => 2";
    string_lt "STRING<" false o => o.is_lt(), "The index where the first text differs if it comes before the second, or `NIL`." "(string< \"abc\" \"abd\") => 2";
    string_gt "STRING>" false o => o.is_gt(), "The index where the first text differs if it comes after the second, or `NIL`." "(string> \"b\" \"a\") => 0";
    string_le "STRING<=" false o => o.is_le(), "The index where the texts differ, or the length, unless the first comes after the second." "(string<= \"a\" \"a\") => 1";
    string_ge "STRING>=" false o => o.is_ge(), "The index where the texts differ, or the length, unless the first comes before the second." "(string>= \"b\" \"a\") => 0";
    string_not_equal "STRING-NOT-EQUAL" true o => o.is_ne(), "Like `string/=`, whatever the case." "(string-not-equal \"a\" \"A\") => NIL";
    string_lessp "STRING-LESSP" true o => o.is_lt(), "Like `string<`, whatever the case." "(string-lessp \"ABC\" \"abd\") => 2";
    string_greaterp "STRING-GREATERP" true o => o.is_gt(), "Like `string>`, whatever the case." "(string-greaterp \"b\" \"A\") => 0";
    string_not_greaterp "STRING-NOT-GREATERP" true o => o.is_le(), "Like `string<=`, whatever the case." "(string-not-greaterp \"a\" \"A\") => 1";
    string_not_lessp "STRING-NOT-LESSP" true o => o.is_ge(), "Like `string>=`, whatever the case." "(string-not-lessp \"a\" \"A\") => 1";
}
