//! Strings: case, trimming, characters, making.

use crate::builtins::lists::Size;
use std::rc::Rc;

use super::array_index;
use super::characters::{downcase, upcase};
use crate::builtin::Builtin;
use crate::image::Image;
pub(crate) use crate::typed::designated;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::{Bounds, Sequence, character, index};
use crate::value::string::LispString;

type Outcome = Result<Value, Box<Raise>>;

/// A value as a string.
pub fn string(value: &Value) -> Result<&Rc<LispString>, Box<Raise>> {
    match value {
        Value::Str(s) => Ok(s),
        _ => Err(Raise::type_error(value, known::STRING)),
    }
}

/// The string that a string, a symbol or a character means.
///
/// `(string 'foo)` => `"FOO"`
#[builtin("STRING")]
fn to_string(image: &mut Image, designator: &Value) -> Outcome {
    match designator {
        Value::Str(_) => Ok(designator.clone()),
        other => designated(image, other).map(Value::string),
    }
}

/// Is the object a string?
///
/// `(stringp "a")` => `T`
#[builtin]
fn stringp(object: &Value) -> bool {
    matches!(object, Value::Str(_))
}

/// Is the object a string without a fill pointer?
///
/// `(simple-string-p "a")` => `T`
#[builtin]
fn simple_string_p(object: &Value) -> bool {
    matches!(object, Value::Str(s) if s.is_simple())
}

/// A string of equal characters.
///
/// `(make-string 3 :initial-element #\a)` => `"aaa"`
#[builtin]
fn make_string(
    size: Size,
    #[key] initial_element: Option<Value>,
    #[key] _element_type: Option<&Value>,
) -> Outcome {
    let initial_element = initial_element.map_or(Ok('\0'), |e| character(&e))?;
    let count = size.0;
    Ok(Value::string(initial_element.to_string().repeat(count)))
}

/// The character of a string at an index from 0.
///
/// `(char "abc" 1)` => `#\b`
#[builtin("CHAR", "string index")]
fn char_at(string_value: &Value, index_value: &Value) -> Outcome {
    let string = string(string_value)?;
    match string.element(index(index_value)?) {
        Some(c) => Ok(Value::Char(c)),
        None => Err(array_index::invalid(
            string_value,
            index_value,
            string.capacity(),
        )),
    }
}

/// Replaces a character of a string.
#[builtin("CHAR", "value string index")]
fn set_char_at(value: &Value, string_value: &Value, index_value: &Value) -> Outcome {
    let string = string(string_value)?;
    let c = character(value)?;
    if string.set_element(index(index_value)?, c) {
        Ok(value.clone())
    } else {
        Err(array_index::invalid(
            string_value,
            index_value,
            string.capacity(),
        ))
    }
}

/// How letters change.
#[derive(Clone, Copy)]
enum Case {
    Up,
    Down,
    Capitalized,
}

impl Case {
    fn of(self, text: &str) -> String {
        let mut in_word = false;
        text.chars()
            .map(|c| {
                let first = !in_word;
                in_word = c.is_alphanumeric();
                match self {
                    Case::Up => upcase(c),
                    Case::Down => downcase(c),
                    Case::Capitalized if first => upcase(c),
                    Case::Capitalized => downcase(c),
                }
            })
            .collect()
    }
}

/// Changes the case of a part of the text that a designator means.
fn with_case(
    image: &Image,
    designator: &Value,
    start: Option<&Value>,
    end: Option<&Value>,
    case: Case,
    in_place: bool,
) -> Outcome {
    let target = match designator {
        Value::Str(s) => s.clone(),
        other if in_place => return Err(Raise::type_error(other, known::STRING)),
        other => Rc::new(LispString::new(designated(image, other)?)),
    };
    let sequence = Sequence::Str(target.clone());
    let bounds = Bounds::new(&sequence, start, end)?;
    let changed = case.of(&target.slice(bounds.start, bounds.end));
    if in_place {
        target.overwrite(bounds.start, &changed);
        return Ok(designator.clone());
    }
    let before = target.slice(0, Some(bounds.start));
    let after = bounds
        .end
        .map_or_else(String::new, |end| target.slice(end, None));
    Ok(Value::string(format!("{before}{changed}{after}")))
}

/// The text in upper case.
///
/// `(string-upcase "abc" :start 1)` => `"aBC"`
#[builtin]
fn string_upcase(
    image: &mut Image,
    string: &Value,
    #[key] start: Option<&Value>,
    #[key] end: Option<&Value>,
) -> Outcome {
    with_case(image, string, start, end, Case::Up, false)
}

/// The text in lower case.
///
/// `(string-downcase 'left-side)` => `"left-side"`
#[builtin]
fn string_downcase(
    image: &mut Image,
    string: &Value,
    #[key] start: Option<&Value>,
    #[key] end: Option<&Value>,
) -> Outcome {
    with_case(image, string, start, end, Case::Down, false)
}

/// The text with each word capitalized.
///
/// `(string-capitalize "hello world")` => `"Hello World"`
#[builtin]
fn string_capitalize(
    image: &mut Image,
    string: &Value,
    #[key] start: Option<&Value>,
    #[key] end: Option<&Value>,
) -> Outcome {
    with_case(image, string, start, end, Case::Capitalized, false)
}

/// Changes a string to upper case.
///
/// `(nstring-upcase (copy-seq "abc"))` => `"ABC"`
#[builtin]
fn nstring_upcase(
    image: &mut Image,
    string: &Value,
    #[key] start: Option<&Value>,
    #[key] end: Option<&Value>,
) -> Outcome {
    with_case(image, string, start, end, Case::Up, true)
}

/// Changes a string to lower case.
///
/// `(nstring-downcase (copy-seq "ABC"))` => `"abc"`
#[builtin]
fn nstring_downcase(
    image: &mut Image,
    string: &Value,
    #[key] start: Option<&Value>,
    #[key] end: Option<&Value>,
) -> Outcome {
    with_case(image, string, start, end, Case::Down, true)
}

/// Capitalizes each word of a string.
///
/// `(nstring-capitalize (copy-seq "a bc"))` => `"A Bc"`
#[builtin]
fn nstring_capitalize(
    image: &mut Image,
    string: &Value,
    #[key] start: Option<&Value>,
    #[key] end: Option<&Value>,
) -> Outcome {
    with_case(image, string, start, end, Case::Capitalized, true)
}

fn trim(bag: &Sequence, text: &str, left: bool, right: bool) -> Outcome {
    let bag = bag.all()?;
    let in_bag = |c: char| bag.iter().any(|v| matches!(v, Value::Char(b) if *b == c));
    let mut rest = text;
    if left {
        rest = rest.trim_start_matches(in_bag);
    }
    if right {
        rest = rest.trim_end_matches(in_bag);
    }
    Ok(Value::string(rest))
}

/// The text without certain characters at both ends.
///
/// `(string-trim " " "  a b ")` => `"a b"`
#[builtin]
fn string_trim(characters: Sequence, string: String) -> Outcome {
    trim(&characters, &string, true, true)
}

/// The text without certain characters at its start.
///
/// `(string-left-trim "x" "xxhixx")` => `"hixx"`
#[builtin]
fn string_left_trim(characters: Sequence, string: String) -> Outcome {
    trim(&characters, &string, true, false)
}

/// The text without certain characters at its end.
///
/// `(string-right-trim "x" "xxhixx")` => `"xxhi"`
#[builtin]
fn string_right_trim(characters: Sequence, string: String) -> Outcome {
    trim(&characters, &string, false, true)
}

/// The character of a string at an index from 0.
///
/// `(schar "abc" 1)` => `#\b`
#[builtin]
fn schar(string: &Value, index: &Value) -> Outcome {
    char_at(string, index)
}

/// Replaces a character of a string.
#[builtin("SCHAR")]
fn set_schar(value: &Value, string: &Value, index: &Value) -> Outcome {
    set_char_at(value, string, index)
}

/// Strings.
pub(crate) static TABLE: &[Builtin] = builtins![
    stringp,
    simple_string_p,
    to_string,
    make_string,
    char_at,
    schar,
    string_upcase,
    string_downcase,
    string_capitalize,
    nstring_upcase,
    nstring_downcase,
    nstring_capitalize,
    string_trim,
    string_left_trim,
    string_right_trim,
];

/// Places for `setf`; the new value is the first argument.
pub(crate) static SETTERS: &[Builtin] = builtins![set_char_at, set_schar,];
