//! Strings: case, trimming, characters, making.

use std::rc::Rc;

use super::array_index;
use super::characters::{downcase, upcase};
use super::keywords;
use super::lists::size;
use crate::builtin::{Builtin, pure};
use crate::image::Image;
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::{Bounds, Sequence, character, index};
use crate::value::string::LispString;

type Outcome = Result<Value, Box<Raise>>;

/// The text that a string designator denotes: a string, a symbol's name or a character.
pub(crate) fn designated(image: &Image, value: &Value) -> Result<String, Box<Raise>> {
    match value {
        Value::Str(s) => Ok(s.text()),
        Value::Symbol(s, ..) => Ok(image.name(*s).to_owned()),
        Value::Char(c) => Ok(c.to_string()),
        _ => Err(Raise::type_error(
            value,
            Value::list([
                known::OR.into(),
                known::STRING.into(),
                known::SYMBOL.into(),
                known::CHARACTER.into(),
            ]),
        )),
    }
}

/// A value as a string.
pub fn string(value: &Value) -> Result<&Rc<LispString>, Box<Raise>> {
    match value {
        Value::Str(s) => Ok(s),
        _ => Err(Raise::type_error(value, known::STRING)),
    }
}

fn to_string(image: &mut Image, args: &[Value]) -> Outcome {
    match &args[0] {
        Value::Str(_) => Ok(args[0].clone()),
        other => designated(image, other).map(Value::string),
    }
}

fn stringp(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::bool(matches!(args[0], Value::Str(_))))
}

fn simple_string_p(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::bool(
        matches!(&args[0], Value::Str(s) if s.is_simple()),
    ))
}

fn make_string(image: &mut Image, args: &[Value]) -> Outcome {
    let [element, _] = keywords::parse(
        image,
        &args[1..],
        [known::K_INITIAL_ELEMENT, known::K_ELEMENT_TYPE],
    )?;
    let element = element.map_or(Ok('\0'), |e| character(&e))?;
    let count = size(&args[0])?;
    Ok(Value::string(element.to_string().repeat(count)))
}

fn char_at(_: &mut Image, args: &[Value]) -> Outcome {
    let string = string(&args[0])?;
    match string.element(index(&args[1])?) {
        Some(c) => Ok(Value::Char(c)),
        None => Err(array_index::invalid(&args[0], &args[1], string.capacity())),
    }
}

fn set_char_at(_: &mut Image, args: &[Value]) -> Outcome {
    let string = string(&args[1])?;
    let c = character(&args[0])?;
    if string.set_element(index(&args[2])?, c) {
        Ok(args[0].clone())
    } else {
        Err(array_index::invalid(&args[1], &args[2], string.capacity()))
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

/// Changes the case of a part of a text; the arguments are the designator and bounds.
fn with_case(image: &Image, args: &[Value], case: Case, in_place: bool) -> Outcome {
    let [start, end] = keywords::parse(image, &args[1..], [known::K_START, known::K_END])?;
    let target = match &args[0] {
        Value::Str(s) => s.clone(),
        other if in_place => return Err(Raise::type_error(other, known::STRING)),
        other => Rc::new(LispString::new(designated(image, other)?)),
    };
    let sequence = Sequence::Str(target.clone());
    let bounds = Bounds::new(&sequence, start.as_ref(), end.as_ref())?;
    let changed = case.of(&target.slice(bounds.start, bounds.end));
    if in_place {
        target.overwrite(bounds.start, &changed);
        return Ok(args[0].clone());
    }
    let before = target.slice(0, Some(bounds.start));
    let after = bounds
        .end
        .map_or_else(String::new, |end| target.slice(end, None));
    Ok(Value::string(format!("{before}{changed}{after}")))
}

fn string_upcase(image: &mut Image, args: &[Value]) -> Outcome {
    with_case(image, args, Case::Up, false)
}

fn string_downcase(image: &mut Image, args: &[Value]) -> Outcome {
    with_case(image, args, Case::Down, false)
}

fn string_capitalize(image: &mut Image, args: &[Value]) -> Outcome {
    with_case(image, args, Case::Capitalized, false)
}

fn nstring_upcase(image: &mut Image, args: &[Value]) -> Outcome {
    with_case(image, args, Case::Up, true)
}

fn nstring_downcase(image: &mut Image, args: &[Value]) -> Outcome {
    with_case(image, args, Case::Down, true)
}

fn nstring_capitalize(image: &mut Image, args: &[Value]) -> Outcome {
    with_case(image, args, Case::Capitalized, true)
}

fn trim(image: &Image, args: &[Value], left: bool, right: bool) -> Outcome {
    let bag = Sequence::of(&args[0])?.all()?;
    let in_bag = |c: char| bag.iter().any(|v| matches!(v, Value::Char(b) if *b == c));
    let text = designated(image, &args[1])?;
    let mut rest = text.as_str();
    if left {
        rest = rest.trim_start_matches(in_bag);
    }
    if right {
        rest = rest.trim_end_matches(in_bag);
    }
    Ok(Value::string(rest))
}

fn string_trim(image: &mut Image, args: &[Value]) -> Outcome {
    trim(image, args, true, true)
}

fn string_left_trim(image: &mut Image, args: &[Value]) -> Outcome {
    trim(image, args, true, false)
}

fn string_right_trim(image: &mut Image, args: &[Value]) -> Outcome {
    trim(image, args, false, true)
}

/// Strings.
pub static TABLE: &[Builtin] = &[
    pure(
        "STRINGP",
        "object",
        "Is the object a string?",
        &["(stringp \"a\") => T"],
        stringp,
    ),
    pure(
        "SIMPLE-STRING-P",
        "object",
        "Is the object a string without a fill pointer?",
        &["(simple-string-p \"a\") => T"],
        simple_string_p,
    ),
    pure(
        "STRING",
        "designator",
        "The string that a string, a symbol or a character means.",
        &["(string 'foo) => \"FOO\""],
        to_string,
    ),
    pure(
        "MAKE-STRING",
        "size &key initial-element element-type",
        "A string of equal characters.",
        &["(make-string 3 :initial-element #\\a) => \"aaa\""],
        make_string,
    ),
    pure(
        "CHAR",
        "string index",
        "The character of a string at an index from 0.",
        &["(char \"abc\" 1) => #\\b"],
        char_at,
    ),
    pure(
        "SCHAR",
        "string index",
        "The character of a string at an index from 0.",
        &["(schar \"abc\" 1) => #\\b"],
        char_at,
    ),
    pure(
        "STRING-UPCASE",
        "string &key start end",
        "The text in upper case.",
        &["(string-upcase \"abc\" :start 1) => \"aBC\""],
        string_upcase,
    ),
    pure(
        "STRING-DOWNCASE",
        "string &key start end",
        "The text in lower case.",
        &["(string-downcase 'left-side) => \"left-side\""],
        string_downcase,
    ),
    pure(
        "STRING-CAPITALIZE",
        "string &key start end",
        "The text with each word capitalized.",
        &["(string-capitalize \"hello world\") => \"Hello World\""],
        string_capitalize,
    ),
    pure(
        "NSTRING-UPCASE",
        "string &key start end",
        "Changes a string to upper case.",
        &["(nstring-upcase (copy-seq \"abc\")) => \"ABC\""],
        nstring_upcase,
    ),
    pure(
        "NSTRING-DOWNCASE",
        "string &key start end",
        "Changes a string to lower case.",
        &["(nstring-downcase (copy-seq \"ABC\")) => \"abc\""],
        nstring_downcase,
    ),
    pure(
        "NSTRING-CAPITALIZE",
        "string &key start end",
        "Capitalizes each word of a string.",
        &["(nstring-capitalize (copy-seq \"a bc\")) => \"A Bc\""],
        nstring_capitalize,
    ),
    pure(
        "STRING-TRIM",
        "characters string",
        "The text without certain characters at both ends.",
        &["(string-trim \" \" \"  a b \") => \"a b\""],
        string_trim,
    ),
    pure(
        "STRING-LEFT-TRIM",
        "characters string",
        "The text without certain characters at its start.",
        &["(string-left-trim \"x\" \"xxhixx\") => \"hixx\""],
        string_left_trim,
    ),
    pure(
        "STRING-RIGHT-TRIM",
        "characters string",
        "The text without certain characters at its end.",
        &["(string-right-trim \"x\" \"xxhixx\") => \"xxhi\""],
        string_right_trim,
    ),
];

/// Places for `setf`; the new value is the first argument.
pub static SETTERS: &[Builtin] = &[
    pure(
        "CHAR",
        "value string index",
        "Replaces a character of a string.",
        &[],
        set_char_at,
    ),
    pure(
        "SCHAR",
        "value string index",
        "Replaces a character of a string.",
        &[],
        set_char_at,
    ),
];
