//! Characters: codes, names, case, digits, comparison.

use crate::builtin::Builtin;
use crate::image::Image;
use crate::reader::ascii_name::ascii_name;
use crate::reader::char_name::{char_name as special_name, char_named};
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;

type Outcome = Result<Value, Box<Raise>>;

/// The name of a character.
fn name_of(c: char) -> String {
    special_name(c)
        .or_else(|| ascii_name(c))
        .unwrap_or_else(|| format!("U{:X}", u32::from(c)))
}

/// The upper-case form, where that is one character.
pub(crate) fn upcase(c: char) -> char {
    let mut upper = c.to_uppercase();
    match (upper.next(), upper.next()) {
        // A letter has an upper case only if that one's lower case is the letter itself.
        (Some(u), None) if single_lower(u) == Some(c) => u,
        _ => c,
    }
}

/// The lower-case form, where that is one character.
pub fn downcase(c: char) -> char {
    match single_lower(c) {
        Some(l) if l.to_uppercase().eq([c]) => l,
        _ => c,
    }
}

fn single_lower(c: char) -> Option<char> {
    let mut lower = c.to_lowercase();
    match (lower.next(), lower.next()) {
        (Some(l), None) => Some(l),
        _ => None,
    }
}

/// The weight of a character as a digit.
pub(crate) fn digit_weight(c: char, radix: u32) -> Option<u32> {
    c.to_digit(radix)
}

fn radix(value: Option<&Value>) -> Result<u32, Box<Raise>> {
    match value {
        None => Ok(10),
        Some(Value::Int(n @ 2..=36)) => Ok(u32::try_from(*n).unwrap_or(10)),
        Some(other) => Err(Raise::type_error(
            other,
            Value::list([known::INTEGER.into(), Value::Int(2), Value::Int(36)]),
        )),
    }
}

/// The character that a designator denotes: a character, or a string or symbol of length one.
fn designated(image: &Image, value: &Value) -> Result<char, Box<Raise>> {
    let only = |text: &str| {
        let mut chars = text.chars();
        chars.next().filter(|_| chars.next().is_none())
    };
    let c = match value {
        Value::Char(c) => Some(*c),
        Value::Str(s) => only(&s.borrow()),
        Value::Symbol(s, ..) => only(image.name(*s)),
        _ => None,
    };
    c.ok_or_else(|| Raise::type_error(value, known::CHARACTER))
}

/// The character that a character, or a string or symbol of one character, means.
///
/// `(character "a")` => `#\a`
#[builtin("CHARACTER")]
fn to_character(image: &mut Image, designator: &Value) -> Outcome {
    designated(image, designator).map(Value::Char)
}

/// The code of a character.
///
/// `(char-code #\A)` => `65`
#[builtin]
fn char_code(character: char) -> Outcome {
    Ok(Value::Int(i64::from(u32::from(character))))
}

/// The character of a code.
///
/// `(code-char 65)` => `#\A`
#[builtin]
fn code_char(code: usize) -> Outcome {
    let c = u32::try_from(code).ok().and_then(char::from_u32);
    Ok(c.map_or(Value::NIL, Value::Char))
}

/// The name of a character.
///
/// `(char-name #\Newline)` => `"Newline"`
#[builtin]
fn char_name(character: char) -> Outcome {
    Ok(Value::string(name_of(character)))
}

/// The character of a name, or `NIL`.
///
/// `(name-char "newline")` => `#\Newline`
#[builtin]
fn name_char(name: String) -> Outcome {
    Ok(char_named(&name).map_or(Value::NIL, Value::Char))
}

/// The upper-case form of a character.
///
/// `(char-upcase #\a)` => `#\A`
#[builtin]
fn char_upcase(character: char) -> Outcome {
    Ok(Value::Char(upcase(character)))
}

/// The lower-case form of a character.
///
/// `(char-downcase #\A)` => `#\a`
#[builtin]
fn char_downcase(character: char) -> Outcome {
    Ok(Value::Char(downcase(character)))
}

/// Is the object a character?
///
/// `(characterp #\a)` => `T`
#[builtin]
fn characterp(object: &Value) -> bool {
    matches!(object, Value::Char(_))
}

/// Is the character a letter?
///
/// `(alpha-char-p #\a)` => `T`
#[builtin]
fn alpha_char_p(character: char) -> bool {
    character.is_alphabetic()
}

/// Is the character a letter or digit?
///
/// `(alphanumericp #\_)` => `NIL`
#[builtin]
fn alphanumericp(character: char) -> bool {
    character.is_alphanumeric()
}

/// Is the character an upper-case letter?
///
/// `(upper-case-p #\A)` => `T`
#[builtin]
fn upper_case_p(character: char) -> bool {
    downcase(character) != character
}

/// Is the character a lower-case letter?
///
/// `(lower-case-p #\A)` => `NIL`
#[builtin]
fn lower_case_p(character: char) -> bool {
    upcase(character) != character
}

/// Has the character forms in both cases?
///
/// `(both-case-p #\1)` => `NIL`
#[builtin]
fn both_case_p(character: char) -> bool {
    upcase(character) != character || downcase(character) != character
}

/// Is a character one that prints as itself?
pub(crate) fn is_graphic(c: char) -> bool {
    !c.is_control()
}

/// Does the character print as itself?
///
/// `(graphic-char-p #\Newline)` => `NIL`
#[builtin]
fn graphic_char_p(character: char) -> bool {
    is_graphic(character)
}

/// Is the character one of the 96 standard ones?
///
/// `(standard-char-p #\a)` => `T`
#[builtin]
fn standard_char_p(character: char) -> bool {
    character == '\n' || matches!(character, ' '..='~')
}

/// The weight of a digit in a radix (10), or `NIL`.
///
/// `(digit-char-p #\7)` => `7`
/// `(digit-char-p #\f 16)` => `15`
#[builtin(_, "character &optional radix")]
fn digit_char_p(character: char, radix_value: Option<&Value>) -> Outcome {
    let weight = digit_weight(character, radix(radix_value)?);
    Ok(weight.map_or(Value::NIL, |w| Value::Int(i64::from(w))))
}

/// The digit of a weight in a radix (10), or `NIL`.
///
/// `(digit-char 7)` => `#\7`
/// `(digit-char 11 16)` => `#\B`
#[builtin(_, "weight &optional radix")]
fn digit_char(weight: usize, radix_value: Option<&Value>) -> Outcome {
    let digit = u32::try_from(weight)
        .ok()
        .and_then(|w| char::from_digit(w, radix(radix_value).ok()?));
    radix(radix_value)?;
    Ok(digit.map_or(Value::NIL, |c| Value::Char(c.to_ascii_uppercase())))
}

/// Compares each character with the next, or each with each other for `/=`.
fn compare(
    mut chars: Vec<char>,
    fold: bool,
    all_pairs: bool,
    holds: impl Fn(char, char) -> bool,
) -> bool {
    if fold {
        chars.iter_mut().for_each(|c| *c = upcase(*c));
    }
    if all_pairs {
        chars
            .iter()
            .enumerate()
            .all(|(i, a)| chars.iter().skip(i + 1).all(|b| holds(*a, *b)))
    } else {
        chars.is_sorted_by(|a, b| holds(*a, *b))
    }
}

macro_rules! comparisons {
    ($($function:ident $name:literal $fold:literal $all_pairs:literal $op:tt $doc:literal $example:literal;)*) => {
        $(
            #[doc = $doc]
            #[doc = ""]
            #[doc = $example]
            #[builtin($name, "character &rest more")]
            fn $function(characters: Vec<char>) -> bool {
                compare(characters, $fold, $all_pairs, |a, b| a $op b)
            }
        )*
        /// Comparison of characters.
        pub(crate) static COMPARISONS: &[Builtin] = builtins![$($function),*];
    };
}

comparisons! {
    char_eq "CHAR=" false false == "Are all characters the same?" "`(char= #\\a #\\a)` => `T`";
    char_ne "CHAR/=" false true != "Are all characters different?" "`(char/= #\\a #\\b #\\a)` => `NIL`";
    char_lt "CHAR<" false false < "Do the characters ascend?" "`(char< #\\a #\\b)` => `T`";
    char_gt "CHAR>" false false > "Do the characters descend?" "`(char> #\\b #\\a)` => `T`";
    char_le "CHAR<=" false false <= "Does no character come before its neighbour to the left?" "`(char<= #\\a #\\a #\\b)` => `T`";
    char_ge "CHAR>=" false false >= "Does no character come after its neighbour to the left?" "`(char>= #\\b #\\a #\\a)` => `T`";
    char_equal "CHAR-EQUAL" true false == "Are all characters the same, whatever their case?" "`(char-equal #\\a #\\A)` => `T`";
    char_not_equal "CHAR-NOT-EQUAL" true true != "Are all characters different, whatever their case?" "`(char-not-equal #\\a #\\A)` => `NIL`";
    char_lessp "CHAR-LESSP" true false < "Like `char<`, whatever the case." "`(char-lessp #\\a #\\B)` => `T`";
    char_greaterp "CHAR-GREATERP" true false > "Like `char>`, whatever the case." "`(char-greaterp #\\a #\\B)` => `NIL`";
    char_not_greaterp "CHAR-NOT-GREATERP" true false <= "Like `char<=`, whatever the case." "`(char-not-greaterp #\\a #\\A)` => `T`";
    char_not_lessp "CHAR-NOT-LESSP" true false >= "Like `char>=`, whatever the case." "`(char-not-lessp #\\a #\\A)` => `T`";
}

/// The code of a character.
///
/// `(char-int #\A)` => `65`
#[builtin]
fn char_int(character: char) -> Outcome {
    char_code(character)
}

/// Characters.
pub(crate) static TABLE: &[Builtin] = builtins![
    characterp,
    to_character,
    char_code,
    char_int,
    code_char,
    char_name,
    name_char,
    char_upcase,
    char_downcase,
    alpha_char_p,
    alphanumericp,
    upper_case_p,
    lower_case_p,
    both_case_p,
    graphic_char_p,
    standard_char_p,
    digit_char_p,
    digit_char,
];
