//! Text that somebody else wrote, as a report shows it: what would drive a terminal is seen instead.

use std::borrow::Cow;
use std::fmt::Write;

/// The text with control characters in caret notation: `^[` for escape, `^?` for delete. Lines and tabs
/// stay. Those beyond ASCII, and the ones that turn the direction of writing, appear as `<U+202E>`.
///
/// Whatever planwright reports of files, names and failures goes through this, so that no file drives
/// the terminal of who looks at it. It must not be applied to text that has colours of its own already.
pub fn visible(text: &str) -> Cow<'_, str> {
    if !text.contains(is_hidden) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 8);
    for c in text.chars() {
        match c {
            c if !is_hidden(c) => shown.push(c),
            '\0'..='\x1f' | '\x7f' => {
                shown.push('^');
                // The code of the letter differs in this bit: 1 is A, 27 is [, 127 is ?.
                shown.extend(u8::try_from(c).map(|code| char::from(code ^ 0x40)));
            }
            // Writing to a string does not fail.
            _ => drop(write!(shown, "<U+{:04X}>", u32::from(c))),
        }
    }
    Cow::Owned(shown)
}

/// Whether a character does something other than to be seen.
fn is_hidden(c: char) -> bool {
    match c {
        '\n' | '\t' => false,
        '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => true,
        c => c.is_control(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_drives_a_terminal_is_seen() {
        let text = "a\x1b[2J\x07\0\r\n\tb\x7f é\u{9b}31m\u{202e}x";
        assert_eq!(visible(text), "a^[[2J^G^@^M\n\tb^? é<U+009B>31m<U+202E>x");
        for c in (0..0x2070).filter_map(char::from_u32) {
            let text = c.to_string();
            let shown = visible(&text);
            let is_plain = |c: char| !c.is_control() || matches!(c, '\n' | '\t');
            assert!(shown.chars().all(is_plain), "{c:?}");
            assert_eq!(visible(&shown), shown);
        }
        assert!(matches!(visible("^[ plain ü\n"), Cow::Borrowed(_)));
    }
}
