//! Unicode names of the printing characters of ASCII, as `char-name` tells them.

/// The name of a printing character of ASCII.
pub(crate) fn ascii_name(c: char) -> Option<String> {
    let index = usize::try_from(u32::from(c)).ok()?.checked_sub(33)?;
    let name = ASCII.get(index).map(|name| (*name).to_owned());
    name.or_else(|| letter_name(c))
}

/// The printing character of ASCII with a name, whatever the case of its letters.
pub(crate) fn ascii_named(name: &str) -> Option<char> {
    ('!'..='~').find(|c| ascii_name(*c).is_some_and(|known| known.eq_ignore_ascii_case(name)))
}

/// Unicode names of the printing ASCII characters that are not letters, from `!` on.
const ASCII: &[&str] = &[
    "EXCLAMATION_MARK",
    "QUOTATION_MARK",
    "NUMBER_SIGN",
    "DOLLAR_SIGN",
    "PERCENT_SIGN",
    "AMPERSAND",
    "APOSTROPHE",
    "LEFT_PARENTHESIS",
    "RIGHT_PARENTHESIS",
    "ASTERISK",
    "PLUS_SIGN",
    "COMMA",
    "HYPHEN-MINUS",
    "FULL_STOP",
    "SOLIDUS",
    "DIGIT_ZERO",
    "DIGIT_ONE",
    "DIGIT_TWO",
    "DIGIT_THREE",
    "DIGIT_FOUR",
    "DIGIT_FIVE",
    "DIGIT_SIX",
    "DIGIT_SEVEN",
    "DIGIT_EIGHT",
    "DIGIT_NINE",
    "COLON",
    "SEMICOLON",
    "LESS-THAN_SIGN",
    "EQUALS_SIGN",
    "GREATER-THAN_SIGN",
    "QUESTION_MARK",
    "COMMERCIAL_AT",
];

fn letter_name(c: char) -> Option<String> {
    let rest = match c {
        'A'..='Z' => return Some(format!("LATIN_CAPITAL_LETTER_{c}")),
        'a'..='z' => return Some(format!("LATIN_SMALL_LETTER_{}", c.to_ascii_uppercase())),
        '[' => "LEFT_SQUARE_BRACKET",
        '\\' => "REVERSE_SOLIDUS",
        ']' => "RIGHT_SQUARE_BRACKET",
        '^' => "CIRCUMFLEX_ACCENT",
        '_' => "LOW_LINE",
        '`' => "GRAVE_ACCENT",
        '{' => "LEFT_CURLY_BRACKET",
        '|' => "VERTICAL_LINE",
        '}' => "RIGHT_CURLY_BRACKET",
        '~' => "TILDE",
        _ => return None,
    };
    Some(rest.to_owned())
}
