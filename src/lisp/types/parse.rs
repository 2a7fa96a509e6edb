//! Reading type specifiers.

use std::rc::Rc;

use super::complex_numbers;
use super::emptiness::is_subtype;
use super::specifier::{Answers, Bound, RealKind, Stop, Type};
use super::subtype::Verdict;
use crate::image::Image;
use crate::object::near_class::{defined_classes, nearest};
use crate::types::sequence_types;
use crate::value::Value;
use crate::value::class::ClassKind;
use crate::value::element_type::ElementType;
use crate::value::known;
use crate::value::number::{Rounding, add, divide, rational, sub};
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// How deeply specifiers may be nested, expansions of `deftype` included.
const MAX_DEPTH: usize = 200;

/// More dimensions than an array has.
const MAX_DIMENSIONS: usize = 129;
/// Largest fixnum plus one, as in SBCL on 64-bit machines.
const FIXNUM_LIMIT: i64 = 1 << 62;

/// Reads a specifier.
pub fn parse(image: &Image, specifier: &Value, answers: &mut Answers) -> Result<Type, Stop> {
    Parser {
        image,
        answers,
        depth: 0,
    }
    .parse(specifier)
}

struct Parser<'a> {
    image: &'a Image,
    answers: &'a mut Answers,
    depth: usize,
}

impl Parser<'_> {
    fn parse(&mut self, specifier: &Value) -> Result<Type, Stop> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(Raise::simple("The type specifier is nested too deeply.").into());
        }
        let result = self.parse_nested(specifier);
        self.depth -= 1;
        result
    }

    fn parse_nested(&mut self, specifier: &Value) -> Result<Type, Stop> {
        match specifier {
            Value::Symbol(name, ..) => match self.named(*name, &[])? {
                Some(found) => Ok(found),
                None => Err(unknown(self.image, specifier)),
            },
            Value::Class(class) => {
                // Another class may have the name meanwhile.
                let named = self.image.class(class.name);
                if named.is_some_and(|named| Rc::ptr_eq(named, class))
                    && let Some(found) = self.named(class.name, &[])?
                {
                    return Ok(found);
                }
                Ok(Type::Class(class.clone()))
            }
            Value::Cons(_) => {
                let items = specifier.list_to_vec().unwrap_or_default();
                match items.split_first() {
                    Some((Value::Symbol(name, ..), args)) => match self.named(*name, args)? {
                        Some(found) => Ok(found),
                        None => Err(unknown(self.image, specifier)),
                    },
                    _ => Err(unknown(self.image, specifier)),
                }
            }
            _ => Err(unknown(self.image, specifier)),
        }
    }

    /// The type of a name with arguments; none if there is no such type.
    fn named(&mut self, name: Sym, args: &[Value]) -> Result<Option<Type>, Stop> {
        if let Some(expander) = self.image.types.get(&name) {
            let function = Value::Function(expander.clone());
            let expansion = self
                .answers
                .ask(&function, vec![Value::list(args.to_vec())])?;
            return self.parse(&expansion).map(Some);
        }
        if let Some(combined) = self.combination(name, args)? {
            return Ok(Some(combined));
        }
        if let Some(number) = self.number(name, args)? {
            return Ok(Some(number));
        }
        if let Some(array) = self.array(name, args)? {
            return Ok(Some(array));
        }
        Ok(simple(name).or_else(|| {
            let is_base_char = name == known::BASE_CHAR;
            let name = if is_base_char { known::CHARACTER } else { name };
            let class = self.image.class(name)?;
            class.is_defined.get().then(|| Type::Class(class.clone()))
        }))
    }

    fn combination(&mut self, name: Sym, args: &[Value]) -> Result<Option<Type>, Stop> {
        let found = match (name, args) {
            (known::AND, []) => Type::Any,
            (known::AND, _) => Type::And(self.parse_all(args)?),
            (known::OR, []) => Type::Nothing,
            (known::OR, _) => Type::Or(self.parse_all(args)?),
            (known::NOT, [of]) => Type::Not(Box::new(self.parse(of)?)),
            (known::MEMBER, _) => Type::Member(args.to_vec()),
            (known::EQL, [value]) => Type::Member(vec![value.clone()]),
            (known::SATISFIES, [function]) => {
                if function.as_symbol().is_none() {
                    return Err(Raise::simple(format!(
                        "{} is not the name of a predicate: (SATISFIES name) was expected.",
                        crate::object::text(self.image, function)
                    ))
                    .into());
                }
                Type::Satisfies(function.clone())
            }
            (known::CONS, [] | [_] | [_, _]) => {
                let half = |parser: &mut Self, arg: Option<&Value>| match arg {
                    Some(arg) if !is_star(arg) => parser.parse(arg),
                    _ => Ok(Type::Any),
                };
                let car = half(self, args.first())?;
                let cdr = half(self, args.get(1))?;
                Type::Cons(Box::new(car), Box::new(cdr))
            }
            (known::FUNCTION, [_, ..]) => {
                return self.named(known::FUNCTION, &[]);
            }
            (known::VALUES, [first, ..]) => self.parse(first)?,
            _ => return Ok(None),
        };
        Ok(Some(found))
    }

    fn parse_all(&mut self, specifiers: &[Value]) -> Result<Vec<Type>, Stop> {
        specifiers.iter().map(|s| self.parse(s)).collect()
    }

    fn number(&mut self, name: Sym, args: &[Value]) -> Result<Option<Type>, Stop> {
        use RealKind::{Double, Integer, Ratio, Single};
        let range = |kinds: &[RealKind]| real_range(self.image, kinds, args);
        let found = match (name, args) {
            (known::INTEGER, _) => range(&[Integer])?,
            (known::RATIONAL, _) => range(&[Integer, Ratio])?,
            (known::REAL, _) => range(&[Integer, Ratio, Single, Double])?,
            (known::FLOAT, _) => range(&[Single, Double])?,
            (known::SINGLE_FLOAT | known::SHORT_FLOAT, _) => range(&[Single])?,
            (known::DOUBLE_FLOAT | known::LONG_FLOAT, _) => range(&[Double])?,
            (known::RATIO, []) => range(&[Ratio])?,
            (known::NUMBER, []) => Type::Or(vec![
                range(&[Integer, Ratio, Single, Double])?,
                complex_numbers::of_parts(&complex_numbers::all_reals()),
            ]),
            (known::COMPLEX, []) => complex_numbers::of_parts(&complex_numbers::all_reals()),
            (known::COMPLEX, [part]) if is_star(part) => {
                complex_numbers::of_parts(&complex_numbers::all_reals())
            }
            (known::COMPLEX, [part]) => {
                let of = self.parse(part)?;
                complex_numbers::check_parts(self.image, &of, part)?;
                complex_numbers::of_parts(&of)
            }
            (known::FIXNUM, []) => integers(Some(-FIXNUM_LIMIT), Some(FIXNUM_LIMIT - 1)),
            (known::BIGNUM, []) => Type::Or(vec![
                integers(None, Some(-FIXNUM_LIMIT - 1)),
                integers(Some(FIXNUM_LIMIT), None),
            ]),
            (known::BIT, []) => integers(Some(0), Some(1)),
            (known::MOD, [Value::Int(n)]) => integers(Some(0), Some(n - 1)),
            (known::UNSIGNED_BYTE, []) => integers(Some(0), None),
            (known::UNSIGNED_BYTE, [bits]) if is_star(bits) => integers(Some(0), None),
            (known::UNSIGNED_BYTE, [Value::Int(bits)]) if *bits > 0 => real(
                Integer,
                Bound::Inclusive(Value::Int(0)),
                Bound::Exclusive(power_of_two(*bits)),
            )?,
            (known::SIGNED_BYTE, []) => integers(None, None),
            (known::SIGNED_BYTE, [bits]) if is_star(bits) => integers(None, None),
            (known::SIGNED_BYTE, [Value::Int(bits)]) if *bits > 0 => real(
                Integer,
                Bound::Inclusive(negated(power_of_two(bits - 1))),
                Bound::Exclusive(power_of_two(bits - 1)),
            )?,
            _ => return Ok(None),
        };
        Ok(Some(found))
    }

    fn element_type(&mut self, specifier: &Value) -> Result<ElementType, Stop> {
        let known = expanded(self.image, specifier, self.answers)?;
        let upgraded = sequence_types::upgraded(&known);
        // Only what nothing is known of is looked at more closely.
        if upgraded != ElementType::T {
            return Ok(upgraded);
        }
        let parsed = self.parse(&known)?;
        match parsed {
            Type::Member(_) | Type::Or(_) | Type::And(_) | Type::Real(..) => {
                self.smallest_element_type(&parsed)
            }
            Type::Nothing => Ok(ElementType::Nil),
            _ => Ok(upgraded),
        }
    }

    /// The smallest element type that contains a type.
    fn smallest_element_type(&mut self, of: &Type) -> Result<ElementType, Stop> {
        for element in ElementType::specialized() {
            let whole = self.parse(&element.specifier())?;
            if is_subtype(self.image, of, &whole) == Verdict::Yes {
                return Ok(element);
            }
        }
        Ok(ElementType::T)
    }

    fn array(&mut self, name: Sym, args: &[Value]) -> Result<Option<Type>, Stop> {
        let (simple, element) = match name {
            known::ARRAY | known::VECTOR => (false, None),
            known::SIMPLE_ARRAY => (true, None),
            known::SIMPLE_VECTOR => (true, Some(ElementType::T)),
            known::STRING => (false, Some(ElementType::Character)),
            known::SIMPLE_STRING => (true, Some(ElementType::Character)),
            known::BASE_STRING => (false, Some(ElementType::Character)),
            known::SIMPLE_BASE_STRING => (true, Some(ElementType::Character)),
            known::BIT_VECTOR => (false, Some(ElementType::Bit)),
            known::SIMPLE_BIT_VECTOR => (true, Some(ElementType::Bit)),
            _ => return Ok(None),
        };
        let has_element = matches!(name, known::ARRAY | known::SIMPLE_ARRAY | known::VECTOR);
        let (element, size) = match (has_element, args) {
            (true, [of, rest @ ..]) if !is_star(of) => {
                let element = self.element_type(of)?;
                (Some(element), rest.first())
            }
            (true, [_, rest @ ..]) => (None, rest.first()),
            (true, []) => (None, None),
            (false, rest) => (element, rest.first()),
        };
        let dimensions = if matches!(name, known::ARRAY | known::SIMPLE_ARRAY) {
            dimensions(self.image, size)?
        } else {
            Some(vec![dimension(self.image, size)?])
        };
        Ok(Some(Type::Array {
            simple,
            element,
            dimensions,
        }))
    }
}

/// Types without arguments that are neither numbers nor arrays nor plain classes.
fn simple(name: Sym) -> Option<Type> {
    let pair = || Type::Cons(Box::new(Type::Any), Box::new(Type::Any));
    let list = || Type::Or(vec![pair(), Type::Member(vec![Value::NIL])]);
    Some(match name {
        known::T => Type::Any,
        known::NIL => Type::Nothing,
        known::NULL => Type::Member(vec![Value::NIL]),
        known::BOOLEAN => Type::Member(vec![Value::T, Value::NIL]),
        known::LIST => list(),
        known::ATOM => Type::Not(Box::new(pair())),
        known::SEQUENCE => Type::Or(vec![
            list(),
            Type::Array {
                simple: false,
                element: None,
                dimensions: Some(vec![None]),
            },
        ]),
        known::STANDARD_CHAR => Type::StandardCharacters,
        // All characters are base characters.
        known::EXTENDED_CHAR => Type::Nothing,
        known::COMPILED_FUNCTION => Type::CompiledFunction,
        _ => return None,
    })
}

pub(super) fn is_star(value: &Value) -> bool {
    value.as_symbol() == Some(known::TIMES)
}

/// What a specifier stands for whose name `deftype` has defined; else the specifier itself.
pub(crate) fn expanded(
    image: &Image,
    specifier: &Value,
    answers: &mut Answers,
) -> Result<Value, Stop> {
    let mut specifier = specifier.clone();
    for _ in 0..MAX_DEPTH {
        let (name, args) = match &specifier {
            Value::Cons(list) => (list.car().as_symbol(), list.cdr()),
            other => (other.as_symbol(), Value::NIL),
        };
        let Some(name) = name else { break };
        if args.is_nil()
            && let Some(known) = image.type_names.get(&name)
        {
            specifier = known.clone();
            continue;
        }
        let Some(expander) = image.types.get(&name) else {
            break;
        };
        specifier = answers.ask(&Value::Function(expander.clone()), vec![args])?;
    }
    Ok(specifier)
}

/// The actual element type of an array that is made for elements of a type; fails if there is no
/// such type.
pub(crate) fn element_type(
    image: &Image,
    specifier: &Value,
    answers: &mut Answers,
) -> Result<ElementType, Stop> {
    Parser {
        image,
        answers,
        depth: 0,
    }
    .element_type(specifier)
}

fn integers(low: Option<i64>, high: Option<i64>) -> Type {
    let bound = |n: Option<i64>| n.map_or(Bound::None, |n| Bound::Inclusive(Value::Int(n)));
    Type::Real(RealKind::Integer, bound(low), bound(high))
}

fn power_of_two(exponent: i64) -> Value {
    match u32::try_from(exponent) {
        Ok(exponent) if exponent < 63 => Value::Int(1 << exponent),
        Ok(exponent) => {
            let one = num_bigint::BigInt::from(1);
            Value::Big(Rc::new(one << exponent.min(1 << 20)))
        }
        Err(_) => Value::Int(0),
    }
}

fn negated(value: Value) -> Value {
    match value {
        Value::Int(n) => Value::Int(-n),
        Value::Big(n) => Value::Big(Rc::new(-n.as_ref())),
        other => other,
    }
}

fn real_range(image: &Image, kinds: &[RealKind], args: &[Value]) -> Result<Type, Stop> {
    let low = bound(image, args.first())?;
    let high = bound(image, args.get(1))?;
    let mut types: Vec<Type> = kinds
        .iter()
        .map(|kind| real(*kind, low.clone(), high.clone()))
        .collect::<Result<_, _>>()?;
    Ok(match types.pop() {
        Some(only) if types.is_empty() => only,
        Some(last) => {
            types.push(last);
            Type::Or(types)
        }
        None => Type::Nothing,
    })
}

/// The reals of one representation between two bounds. Ranges of integers begin and end at integers
/// that they contain; no ratio is an integer.
fn real(kind: RealKind, low: Bound, high: Bound) -> Result<Type, Stop> {
    let one = Value::Int(1);
    let (low, high) = match kind {
        RealKind::Integer => (
            match low {
                Bound::Inclusive(n) if is_finite(&n) => {
                    Bound::Inclusive(divide(&n, &one, Rounding::Ceiling)?.0)
                }
                Bound::Exclusive(n) if is_finite(&n) => {
                    Bound::Inclusive(add(&divide(&n, &one, Rounding::Floor)?.0, &one)?)
                }
                other => other,
            },
            match high {
                Bound::Inclusive(n) if is_finite(&n) => {
                    Bound::Inclusive(divide(&n, &one, Rounding::Floor)?.0)
                }
                Bound::Exclusive(n) if is_finite(&n) => {
                    Bound::Inclusive(sub(&divide(&n, &one, Rounding::Ceiling)?.0, &one)?)
                }
                other => other,
            },
        ),
        RealKind::Ratio => (without_integer(low)?, without_integer(high)?),
        _ => (low, high),
    };
    Ok(Type::Real(kind, low, high))
}

fn is_finite(number: &Value) -> bool {
    match number {
        Value::Single(x) => x.is_finite(),
        Value::Double(x) => x.is_finite(),
        _ => true,
    }
}

fn without_integer(bound: Bound) -> Result<Bound, Stop> {
    let exact = |n: Value| -> Result<Value, Box<Raise>> {
        if is_finite(&n) { rational(&n) } else { Ok(n) }
    };
    Ok(match bound {
        Bound::Inclusive(n) => match exact(n)? {
            n @ (Value::Int(_) | Value::Big(_)) => Bound::Exclusive(n),
            n => Bound::Inclusive(n),
        },
        Bound::Exclusive(n) => Bound::Exclusive(exact(n)?),
        Bound::None => Bound::None,
    })
}

fn bound(image: &Image, arg: Option<&Value>) -> Result<Bound, Stop> {
    let is_real = crate::value::number::is_real;
    match arg {
        None => Ok(Bound::None),
        Some(star) if is_star(star) => Ok(Bound::None),
        Some(number) if is_real(number) => Ok(Bound::Inclusive(number.clone())),
        Some(other) => match other.list_to_vec().as_deref() {
            Some([number]) if is_real(number) => Ok(Bound::Exclusive(number.clone())),
            _ => Err(Raise::simple(format!(
                "{} is not a bound of a range: it must be a number, a list of a number, or *.",
                crate::object::text(image, other)
            ))
            .into()),
        },
    }
}

fn dimension(image: &Image, size: Option<&Value>) -> Result<Option<usize>, Stop> {
    match size {
        None => Ok(None),
        Some(star) if is_star(star) => Ok(None),
        Some(Value::Int(n)) if *n >= 0 => Ok(usize::try_from(*n).ok()),
        Some(other) => Err(Raise::simple(format!(
            "{} is not a size of an array: it must be a natural number or *.",
            crate::object::text(image, other)
        ))
        .into()),
    }
}

fn dimensions(image: &Image, sizes: Option<&Value>) -> Result<Option<Vec<Option<usize>>>, Stop> {
    match sizes {
        None => Ok(None),
        Some(star) if is_star(star) => Ok(None),
        Some(Value::Int(rank)) => Ok(usize::try_from(*rank)
            .ok()
            .map(|r| vec![None; r.min(MAX_DIMENSIONS)])),
        Some(list) => {
            let sizes = list.iter_list();
            let all: Result<Vec<Option<usize>>, Stop> =
                sizes.map(|size| dimension(image, Some(&size))).collect();
            all.map(Some)
        }
    }
}

fn unknown(image: &Image, specifier: &Value) -> Stop {
    let text = |value: &Value| crate::object::text(image, value);
    let mut report = format!("unknown type specifier: {}", text(specifier));
    let name = match specifier {
        Value::Cons(list) => list.car().as_symbol(),
        other => other.as_symbol(),
    };
    if let Some(near) = name.and_then(|name| near_type(image, name)) {
        report.push_str(&format!(". Did you mean {}?", text(&near.into())));
    }
    Stop::UnknownType(Raise::simple(report))
}

/// Names of types that are neither classes nor defined by `deftype`.
const PLAIN_TYPES: &[Sym] = &[
    known::UNSIGNED_BYTE,
    known::SIGNED_BYTE,
    known::MOD,
    known::SHORT_FLOAT,
    known::LONG_FLOAT,
    known::STANDARD_CHAR,
    known::BASE_CHAR,
    known::EXTENDED_CHAR,
    known::BASE_STRING,
    known::SIMPLE_BASE_STRING,
    known::BOOLEAN,
    known::ATOM,
    known::MEMBER,
    known::SATISFIES,
];

/// Is it the name of a type, or of a kind of types?
pub fn is_type_name(image: &Image, name: Sym) -> bool {
    let defined = image
        .class(name)
        .is_some_and(|class| class.is_defined.get());
    defined
        || image.types.contains_key(&name)
        || PLAIN_TYPES.contains(&name)
        || !matches!(
            parse(image, &name.into(), &mut Answers::default()),
            Err(Stop::UnknownType(_))
        )
}

/// The name of a type that is nearest to one that is none.
pub fn near_type(image: &Image, name: Sym) -> Option<Sym> {
    let names = image.types.keys().chain(PLAIN_TYPES).copied();
    nearest(image, name, names.chain(defined_classes(image)))
}

/// Is the symbol the name of a class that types alone describe?
pub(crate) fn is_plain_class(image: &Image, name: Sym) -> bool {
    image
        .class(name)
        .is_some_and(|class| class.kind != ClassKind::Builtin)
        && !image.types.contains_key(&name)
}
