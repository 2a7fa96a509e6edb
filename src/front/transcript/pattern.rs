//! Wildcards in expected lines.

/// Stands for any number of lines.
const ANY_LINES: &str = "...";
/// Stands for any text within a line.
const ANY_TEXT: &str = "[..]";

/// Whether this expected line stands for any number of lines.
pub(crate) fn is_any_lines(expected: &str) -> bool {
    expected.trim() == ANY_LINES
}

/// Whether the expected line matches the actual one.
pub(crate) fn line_matches(expected: &str, actual: &str) -> bool {
    let expected = expected.trim_end();
    let actual = actual.trim_end();
    let Some((head, rest)) = expected.split_once(ANY_TEXT) else {
        return expected == actual;
    };
    let Some(mut open) = actual.strip_prefix(head) else {
        return false;
    };
    // Text between two wildcards can be matched where it is first found.
    let mut parts = rest.split(ANY_TEXT).peekable();
    while let Some(part) = parts.next() {
        if parts.peek().is_none() {
            return open.ends_with(part);
        }
        let Some((_, after)) = open.split_once(part) else {
            return false;
        };
        open = after;
    }
    true
}

#[cfg(test)]
mod tests {
    use crate::transcript::pattern::*;

    #[test]
    fn without_wildcards_lines_are_compared_but_for_blanks_at_the_end() {
        assert!(line_matches("a b ", "a b"));
        assert!(line_matches("a b", "a b  "));
        assert!(!line_matches("a b", " a b"));
        assert!(!line_matches("a", "A"));
    }

    #[test]
    fn a_wildcard_stands_for_any_text() {
        assert!(line_matches("#<[..]ERROR[..]>.", "#<TYPE-ERROR {1}>."));
        assert!(line_matches("#<[..]ERROR[..]>.", "#<ERROR>."));
        assert!(line_matches("[..]", ""));
        assert!(line_matches("a[..]", "a"));
        assert!(line_matches("[..]b[..]b", "abab"));
        assert!(!line_matches("#<[..]ERROR[..]>.", "#<WARNING>."));
        assert!(!line_matches("a[..]a", "a"));
        assert!(!line_matches("[..]b[..]b", "ab"));
    }
}
