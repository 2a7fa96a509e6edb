//! Names of characters, as used by `#\Newline` and `char-name`.

use super::ascii_name::ascii_named;

/// Names of the control characters and of space and delete, the printed one first.
const NAMES: &[(u32, &[&str])] = &[
    (0, &["Nul", "Null"]),
    (1, &["Soh"]),
    (2, &["Stx"]),
    (3, &["Etx"]),
    (4, &["Eot"]),
    (5, &["Enq"]),
    (6, &["Ack"]),
    (7, &["Bel", "Bell"]),
    (8, &["Backspace", "Bs"]),
    (9, &["Tab", "Ht"]),
    (10, &["Newline", "Linefeed", "Lf", "Nl"]),
    (11, &["Vt"]),
    (12, &["Page", "Form", "Formfeed", "Ff", "Np"]),
    (13, &["Return", "Cr"]),
    (14, &["So"]),
    (15, &["Si"]),
    (16, &["Dle"]),
    (17, &["Dc1"]),
    (18, &["Dc2"]),
    (19, &["Dc3"]),
    (20, &["Dc4"]),
    (21, &["Nak"]),
    (22, &["Syn"]),
    (23, &["Etb"]),
    (24, &["Can"]),
    (25, &["Em"]),
    (26, &["Sub"]),
    (27, &["Esc", "Escape", "Altmode", "Alt"]),
    (28, &["Fs"]),
    (29, &["Gs"]),
    (30, &["Rs"]),
    (31, &["Us"]),
    (32, &["Space", "Sp"]),
    (127, &["Rubout", "Delete", "Del"]),
    (133, &["Nel"]),
    (160, &["No-break_space", "Nbsp"]),
];

/// Unicode names of the characters from U+00A1 to U+00FF, in order.
const LATIN_1: &[&str] = &[
    "INVERTED_EXCLAMATION_MARK",
    "CENT_SIGN",
    "POUND_SIGN",
    "CURRENCY_SIGN",
    "YEN_SIGN",
    "BROKEN_BAR",
    "SECTION_SIGN",
    "DIAERESIS",
    "COPYRIGHT_SIGN",
    "FEMININE_ORDINAL_INDICATOR",
    "LEFT-POINTING_DOUBLE_ANGLE_QUOTATION_MARK",
    "NOT_SIGN",
    "SOFT_HYPHEN",
    "REGISTERED_SIGN",
    "MACRON",
    "DEGREE_SIGN",
    "PLUS-MINUS_SIGN",
    "SUPERSCRIPT_TWO",
    "SUPERSCRIPT_THREE",
    "ACUTE_ACCENT",
    "MICRO_SIGN",
    "PILCROW_SIGN",
    "MIDDLE_DOT",
    "CEDILLA",
    "SUPERSCRIPT_ONE",
    "MASCULINE_ORDINAL_INDICATOR",
    "RIGHT-POINTING_DOUBLE_ANGLE_QUOTATION_MARK",
    "VULGAR_FRACTION_ONE_QUARTER",
    "VULGAR_FRACTION_ONE_HALF",
    "VULGAR_FRACTION_THREE_QUARTERS",
    "INVERTED_QUESTION_MARK",
    "LATIN_CAPITAL_LETTER_A_WITH_GRAVE",
    "LATIN_CAPITAL_LETTER_A_WITH_ACUTE",
    "LATIN_CAPITAL_LETTER_A_WITH_CIRCUMFLEX",
    "LATIN_CAPITAL_LETTER_A_WITH_TILDE",
    "LATIN_CAPITAL_LETTER_A_WITH_DIAERESIS",
    "LATIN_CAPITAL_LETTER_A_WITH_RING_ABOVE",
    "LATIN_CAPITAL_LETTER_AE",
    "LATIN_CAPITAL_LETTER_C_WITH_CEDILLA",
    "LATIN_CAPITAL_LETTER_E_WITH_GRAVE",
    "LATIN_CAPITAL_LETTER_E_WITH_ACUTE",
    "LATIN_CAPITAL_LETTER_E_WITH_CIRCUMFLEX",
    "LATIN_CAPITAL_LETTER_E_WITH_DIAERESIS",
    "LATIN_CAPITAL_LETTER_I_WITH_GRAVE",
    "LATIN_CAPITAL_LETTER_I_WITH_ACUTE",
    "LATIN_CAPITAL_LETTER_I_WITH_CIRCUMFLEX",
    "LATIN_CAPITAL_LETTER_I_WITH_DIAERESIS",
    "LATIN_CAPITAL_LETTER_ETH",
    "LATIN_CAPITAL_LETTER_N_WITH_TILDE",
    "LATIN_CAPITAL_LETTER_O_WITH_GRAVE",
    "LATIN_CAPITAL_LETTER_O_WITH_ACUTE",
    "LATIN_CAPITAL_LETTER_O_WITH_CIRCUMFLEX",
    "LATIN_CAPITAL_LETTER_O_WITH_TILDE",
    "LATIN_CAPITAL_LETTER_O_WITH_DIAERESIS",
    "MULTIPLICATION_SIGN",
    "LATIN_CAPITAL_LETTER_O_WITH_STROKE",
    "LATIN_CAPITAL_LETTER_U_WITH_GRAVE",
    "LATIN_CAPITAL_LETTER_U_WITH_ACUTE",
    "LATIN_CAPITAL_LETTER_U_WITH_CIRCUMFLEX",
    "LATIN_CAPITAL_LETTER_U_WITH_DIAERESIS",
    "LATIN_CAPITAL_LETTER_Y_WITH_ACUTE",
    "LATIN_CAPITAL_LETTER_THORN",
    "LATIN_SMALL_LETTER_SHARP_S",
    "LATIN_SMALL_LETTER_A_WITH_GRAVE",
    "LATIN_SMALL_LETTER_A_WITH_ACUTE",
    "LATIN_SMALL_LETTER_A_WITH_CIRCUMFLEX",
    "LATIN_SMALL_LETTER_A_WITH_TILDE",
    "LATIN_SMALL_LETTER_A_WITH_DIAERESIS",
    "LATIN_SMALL_LETTER_A_WITH_RING_ABOVE",
    "LATIN_SMALL_LETTER_AE",
    "LATIN_SMALL_LETTER_C_WITH_CEDILLA",
    "LATIN_SMALL_LETTER_E_WITH_GRAVE",
    "LATIN_SMALL_LETTER_E_WITH_ACUTE",
    "LATIN_SMALL_LETTER_E_WITH_CIRCUMFLEX",
    "LATIN_SMALL_LETTER_E_WITH_DIAERESIS",
    "LATIN_SMALL_LETTER_I_WITH_GRAVE",
    "LATIN_SMALL_LETTER_I_WITH_ACUTE",
    "LATIN_SMALL_LETTER_I_WITH_CIRCUMFLEX",
    "LATIN_SMALL_LETTER_I_WITH_DIAERESIS",
    "LATIN_SMALL_LETTER_ETH",
    "LATIN_SMALL_LETTER_N_WITH_TILDE",
    "LATIN_SMALL_LETTER_O_WITH_GRAVE",
    "LATIN_SMALL_LETTER_O_WITH_ACUTE",
    "LATIN_SMALL_LETTER_O_WITH_CIRCUMFLEX",
    "LATIN_SMALL_LETTER_O_WITH_TILDE",
    "LATIN_SMALL_LETTER_O_WITH_DIAERESIS",
    "DIVISION_SIGN",
    "LATIN_SMALL_LETTER_O_WITH_STROKE",
    "LATIN_SMALL_LETTER_U_WITH_GRAVE",
    "LATIN_SMALL_LETTER_U_WITH_ACUTE",
    "LATIN_SMALL_LETTER_U_WITH_CIRCUMFLEX",
    "LATIN_SMALL_LETTER_U_WITH_DIAERESIS",
    "LATIN_SMALL_LETTER_Y_WITH_ACUTE",
    "LATIN_SMALL_LETTER_THORN",
    "LATIN_SMALL_LETTER_Y_WITH_DIAERESIS",
];

/// The first character of the [`LATIN_1`] table.
const LATIN_1_START: u32 = 0xA1;

/// Unicode names of the Greek letters from U+03B1 on, without `GREEK SMALL LETTER`; the
/// capital letters stand 32 places before them.
const GREEK: &[&str] = &[
    "ALPHA",
    "BETA",
    "GAMMA",
    "DELTA",
    "EPSILON",
    "ZETA",
    "ETA",
    "THETA",
    "IOTA",
    "KAPPA",
    "LAMDA",
    "MU",
    "NU",
    "XI",
    "OMICRON",
    "PI",
    "RHO",
    "FINAL_SIGMA",
    "SIGMA",
    "TAU",
    "UPSILON",
    "PHI",
    "CHI",
    "PSI",
    "OMEGA",
];

const SMALL_ALPHA: u32 = 0x3B1;
const CAPITAL_ALPHA: u32 = 0x391;

/// The name of a character that has one.
pub(crate) fn char_name(c: char) -> Option<String> {
    let code = u32::from(c);
    if let Some((_, names)) = NAMES.iter().find(|(known, _)| *known == code) {
        return names.first().map(|name| (*name).to_owned());
    }
    let at = |table: &[&str], start: u32| -> Option<String> {
        let index = usize::try_from(code.checked_sub(start)?).ok()?;
        table.get(index).map(|name| (*name).to_owned())
    };
    if let Some(name) = at(LATIN_1, LATIN_1_START) {
        return Some(name);
    }
    if let Some(name) = at(GREEK, SMALL_ALPHA) {
        return Some(format!("GREEK_SMALL_LETTER_{name}"));
    }
    if let Some(name) = at(GREEK, CAPITAL_ALPHA).filter(|name| name != "FINAL_SIGMA") {
        return Some(format!("GREEK_CAPITAL_LETTER_{name}"));
    }
    (c.is_control()).then(|| format!("U{code:X}"))
}

/// The character with this name of more than one character, whatever the case of its letters.
pub(crate) fn char_named(name: &str) -> Option<char> {
    let is_name = |known: &&str| known.eq_ignore_ascii_case(name);
    if let Some((code, _)) = NAMES.iter().find(|(_, names)| names.iter().any(is_name)) {
        return char::from_u32(*code);
    }
    if let Some(index) = LATIN_1.iter().position(is_name) {
        return char::from_u32(LATIN_1_START + u32::try_from(index).ok()?);
    }
    let upper = name.to_ascii_uppercase();
    for (prefix, start) in [
        ("GREEK_SMALL_LETTER_", SMALL_ALPHA),
        ("GREEK_CAPITAL_LETTER_", CAPITAL_ALPHA),
    ] {
        if let Some(letter) = upper.strip_prefix(prefix)
            && let Some(index) = GREEK.iter().position(|n| *n == letter)
        {
            return char::from_u32(start + u32::try_from(index).ok()?);
        }
    }
    if let Some(c) = ascii_named(name) {
        return Some(c);
    }
    let hex = upper
        .strip_prefix("U+")
        .or_else(|| upper.strip_prefix('U'))?;
    char::from_u32(u32::from_str_radix(hex, 16).ok()?)
}

#[cfg(test)]
mod tests {
    use crate::reader::char_name::*;

    #[test]
    fn names_read_back() {
        for c in (0..0x400).filter_map(char::from_u32) {
            if let Some(name) = char_name(c) {
                assert_eq!(char_named(&name), Some(c), "{name}");
            }
        }
        assert_eq!(
            char_name('é').as_deref(),
            Some("LATIN_SMALL_LETTER_E_WITH_ACUTE")
        );
        assert_eq!(char_named("space"), Some(' '));
        assert_eq!(char_named("U+41"), Some('A'));
        assert_eq!(char_named("NoSuchCharName"), None);
    }
}
