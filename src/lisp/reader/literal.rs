//! Values of tokens and of finished `#` forms: strings, characters, radix numbers, bit
//! vectors, vectors, arrays and structures.

use crate::value::element_type::ElementType;
use std::rc::Rc;

use super::char_name::char_named;
use super::error::ReadErrorKind;
use super::numeric::parse_rational;
use super::readtable::LetterCase;
use super::symbol;
use crate::image::Image;
use crate::value::Value;
use crate::value::array::{Array, Vector};
use crate::value::class::{ClassKind, Instance};
use crate::value::known;
use crate::value::number;

/// Longest vector that `#n(` fills up.
const MAX_FILL: usize = 1 << 24;

/// Maximum number of dimensions of an array.
const MAX_RANK: u32 = 128;

/// A string from the text between its quotation marks.
pub(crate) fn string(body: &str) -> Value {
    if !body.contains('\\') {
        return Value::string(body);
    }
    let mut text = String::with_capacity(body.len());
    let mut chars = body.chars();
    while let Some(c) = chars.next() {
        text.extend(if c == '\\' { chars.next() } else { Some(c) });
    }
    Value::string(text)
}

/// A character from the text after `#\`.
pub(crate) fn character(name: &str) -> Result<Value, ReadErrorKind> {
    let mut chars = name.chars();
    match (chars.next(), chars.next()) {
        (Some(c), None) => Ok(Value::Char(c)),
        _ => char_named(name)
            .map(Value::Char)
            .ok_or_else(|| ReadErrorKind::UnknownCharacter(name.to_owned())),
    }
}

/// The value of `#x…`, `#b…`, `#o…`, `#nr…`, `#*…` and `#:…`.
pub(crate) fn prefixed(
    image: &mut Image,
    argument: Option<u32>,
    letter: char,
    body: &str,
) -> Result<Value, ReadErrorKind> {
    let radix = match letter {
        'X' => 16,
        'O' => 8,
        'B' => 2,
        'R' => match argument {
            Some(radix @ 2..=36) => radix,
            _ => {
                return Err(ReadErrorKind::DispatchArgument {
                    letter,
                    reason: "a radix from 2 to 36",
                });
            }
        },
        '*' => return bits(argument, body),
        _ => return uninterned(image, body),
    };
    match parse_rational(body, radix) {
        Some(number) => number,
        None => Err(ReadErrorKind::NotRational {
            letter,
            token: body.to_owned(),
            radix,
        }),
    }
}

fn uninterned(image: &mut Image, body: &str) -> Result<Value, ReadErrorKind> {
    let name = symbol::split(body, LetterCase::current(image))?;
    if name.package.is_some() {
        return Err(ReadErrorKind::TooManyColons {
            token: format!("#:{body}"),
        });
    }
    Ok(image.symbols.make_passing(name.name.into()))
}

fn bits(length: Option<u32>, body: &str) -> Result<Value, ReadErrorKind> {
    let bad = || ReadErrorKind::BadBits(format!("#*{body}"));
    let items = body
        .chars()
        .map(|c| match c {
            '0' => Ok(Value::Int(0)),
            '1' => Ok(Value::Int(1)),
            _ => Err(bad()),
        })
        .collect::<Result<Vec<Value>, _>>()?;
    let items = fill(items, length)?;
    Ok(Value::Vector(Rc::new(Vector::of_type(
        ElementType::Bit,
        items,
    ))))
}

/// A vector; if a length is given, the last element is repeated to reach it.
pub(crate) fn vector(
    items: Vec<Value>,
    length: Option<u32>,
    is_skipped: bool,
) -> Result<Value, ReadErrorKind> {
    if is_skipped {
        return Ok(Value::NIL);
    }
    fill(items, length).map(Value::vector)
}

fn fill(mut items: Vec<Value>, length: Option<u32>) -> Result<Vec<Value>, ReadErrorKind> {
    let Some(length) = length else {
        return Ok(items);
    };
    let length = length as usize;
    if items.len() > length {
        return Err(ReadErrorKind::VectorTooLong {
            given: items.len(),
            length,
        });
    }
    if length > MAX_FILL {
        return Err(ReadErrorKind::VectorTooLarge { length });
    }
    match items.last().cloned() {
        Some(last) => items.resize(length, last),
        None if length > 0 => return Err(ReadErrorKind::VectorEmpty(length)),
        None => {}
    }
    Ok(items)
}

/// The elements of a list, vector or string.
pub(super) fn elements(sequence: &Value) -> Option<Vec<Value>> {
    match sequence {
        Value::Vector(vector) => Some(vector.to_vec()),
        Value::Str(string) => Some(string.borrow().chars().map(Value::Char).collect()),
        // Read as a row, a backquoted form would leave its commas outside any backquote.
        list => match list.car_or_nil().as_symbol() {
            Some(known::QUASIQUOTE | known::UNQUOTE | known::UNQUOTE_SPLICING) => None,
            _ => list.list_to_vec(),
        },
    }
}

/// An array of a rank from nested sequences.
pub(crate) fn array(contents: &Value, rank: u32) -> Result<Value, ReadErrorKind> {
    let not_rectangular = || ReadErrorKind::NotRectangular { rank };
    if rank > MAX_RANK {
        return Err(not_rectangular());
    }
    if rank == 1 {
        return elements(contents)
            .map(Value::vector)
            .ok_or_else(not_rectangular);
    }
    let mut dimensions = Vec::new();
    let mut level = vec![contents.clone()];
    for _ in 0..rank {
        let rows = level
            .iter()
            .map(elements)
            .collect::<Option<Vec<_>>>()
            .ok_or_else(not_rectangular)?;
        let width = rows.first().map_or(0, Vec::len);
        if rows.iter().any(|row| row.len() != width) {
            return Err(not_rectangular());
        }
        dimensions.push(width);
        level = rows.into_iter().flatten().collect();
    }
    Ok(Value::Array(Rc::new(Array::new(
        ElementType::T,
        dimensions,
        level,
    ))))
}

/// The result of reading `#S(…)`.
pub(crate) enum Structure {
    /// The structure itself.
    Made(Value),
    /// A call of its constructor: some slots take their initial values.
    ToEvaluate(Value),
}

/// A structure from its name and slots.
pub(crate) fn structure(image: &mut Image, contents: &Value) -> Result<Structure, ReadErrorKind> {
    let bad = |reason: String| ReadErrorKind::BadStructure(reason);
    let parts = contents
        .list_to_vec()
        .ok_or_else(|| bad("a list of a name and slots is needed".to_owned()))?;
    let Some((Value::Symbol(name, ..), slots)) = parts.split_first() else {
        return Err(bad("the name of a structure is needed first".to_owned()));
    };
    let class = image
        .class(*name)
        .filter(|class| class.kind == ClassKind::Structure)
        .cloned()
        .ok_or_else(|| {
            bad(format!(
                "{} is not a defined structure type.",
                image.name(*name)
            ))
        })?;
    let mut slots = slot_values(image, slots)?;
    let others = slots
        .iter()
        .position(|(name, _)| name == "ALLOW-OTHER-KEYS");
    let allows_others = others.is_some_and(|index| slots.remove(index).1.is_true());
    let instance = Instance::new(class.clone());
    for (slot, value) in &slots {
        let index = class
            .slots
            .borrow()
            .iter()
            .position(|s| image.name(s.name) == slot);
        match index {
            Some(index) => {
                if let Some(place) = instance.slots.borrow_mut().get_mut(index) {
                    *place = value.clone();
                }
            }
            None if allows_others => {}
            None => return Err(bad(format!("{slot} is no slot of {}", image.name(*name)))),
        }
    }
    let is_whole = !instance.slots.borrow().iter().any(Value::is_unbound);
    if is_whole {
        return Ok(Structure::Made(Value::Instance(Rc::new(instance))));
    }
    let constructor = format!("MAKE-{}", image.name(*name));
    let package = image
        .symbol(*name)
        .package
        .unwrap_or_else(|| image.current_package());
    let constructor = image.intern(package, &constructor);
    let mut call = vec![Value::symbol(constructor)];
    if allows_others {
        call.extend([image.keyword("ALLOW-OTHER-KEYS").into(), Value::T]);
    }
    for (slot, value) in slots {
        call.push(image.keyword(&slot).into());
        call.push(Value::list([known::QUOTE.into(), value]));
    }
    Ok(Structure::ToEvaluate(Value::list(call)))
}

/// The names and values of slots after `#S`, as arguments of a constructor are understood: names are
/// string designators, the first of several values counts, and `allow-other-keys` is no slot. It lets
/// values of slots that do not exist be left out.
fn slot_values(image: &Image, slots: &[Value]) -> Result<Vec<(String, Value)>, ReadErrorKind> {
    let mut found: Vec<(String, Value)> = Vec::new();
    for pair in slots.chunks(2) {
        let (name, value) = match pair {
            [Value::Symbol(name, ..), value] => (image.name(*name).to_owned(), value),
            [Value::Char(c), value] => (c.to_string(), value),
            [Value::Str(name), value] => (name.text(), value),
            _ => {
                let reason = "slots are pairs of a name and a value".to_owned();
                return Err(ReadErrorKind::BadStructure(reason));
            }
        };
        if found.iter().all(|(other, _)| *other != name) {
            found.push((name, value.clone()));
        }
    }
    Ok(found)
}

/// A complex number from the list of its parts.
pub(crate) fn complex(parts: &Value) -> Result<Value, ReadErrorKind> {
    const SHAPE: ReadErrorKind = ReadErrorKind::BadComplex("a list of two real numbers is needed");
    match parts.list_to_vec().as_deref() {
        Some([re, im]) => number::complex(re, im).map_err(|_| SHAPE),
        _ => Err(SHAPE),
    }
}
