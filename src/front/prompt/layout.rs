//! Where a text stands on a terminal of some width: what the line editor assumes, too.

use unicode_segmentation::UnicodeSegmentation;
use unicode_width::UnicodeWidthChar;

/// Distance of tab stops in columns.
pub(super) const TAB_STOP: usize = 8;

/// A row and a column, from zero.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(super) struct Position {
    pub(super) row: usize,
    pub(super) column: usize,
}

impl Position {
    /// The position behind a text that begins here.
    pub(super) fn after(self, text: &str, columns: usize) -> Position {
        let mut at = self;
        for cluster in text.graphemes(true) {
            at.advance(cluster, columns);
        }
        if at.column == columns {
            at = Position {
                row: at.row + 1,
                column: 0,
            };
        }
        at
    }

    fn advance(&mut self, cluster: &str, columns: usize) {
        if cluster == "\n" {
            *self = Position {
                row: self.row + 1,
                column: 0,
            };
            return;
        }
        let width = match cluster {
            "\t" => TAB_STOP - self.column % TAB_STOP,
            _ => cluster.chars().map(|c| c.width().unwrap_or(0)).sum(),
        };
        self.column += width;
        if self.column > columns {
            self.row += 1;
            self.column = width;
        }
    }
}

/// A text as it can be shown: blanks in place of tabs, nothing in place of other control characters;
/// and where a byte of it is then. It takes as much room as the line editor assumes, whereas terminals
/// do not continue a tab on the next row.
pub(super) fn shown(text: &str, byte: usize, first: usize, columns: usize) -> (String, usize) {
    let mut at = Position {
        row: 0,
        column: first,
    };
    let mut shown = String::with_capacity(text.len());
    let mut shown_byte = None;
    for (start, cluster) in text.grapheme_indices(true) {
        if start >= byte {
            shown_byte.get_or_insert(shown.len());
        }
        let before = at;
        at.advance(cluster, columns);
        if cluster == "\t" {
            let left = match at.row == before.row {
                true => 0,
                false => columns.saturating_sub(before.column),
            };
            let width = at.column
                - if left == 0 && at.row == before.row {
                    before.column
                } else {
                    0
                };
            shown.extend(std::iter::repeat_n(' ', left + width));
        } else if cluster == "\n" || !cluster.chars().all(char::is_control) {
            shown.push_str(cluster);
        }
    }
    let shown_byte = shown_byte.unwrap_or(shown.len());
    (shown, shown_byte)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(text: &str, columns: usize) -> (usize, usize) {
        let at = Position::default().after(text, columns);
        (at.row, at.column)
    }

    #[test]
    fn text_wraps_at_the_last_column() {
        assert_eq!(after("abc", 4), (0, 3));
        assert_eq!(after("abcd", 4), (1, 0));
        assert_eq!(after("abcde", 4), (1, 1));
        assert_eq!(after("ab\ncde", 4), (1, 3));
    }

    #[test]
    fn wide_characters_do_not_stand_on_two_rows() {
        assert_eq!(after("日本", 4), (1, 0));
        assert_eq!(after("a日本", 4), (1, 2));
        assert_eq!(after("e\u{301}x", 4), (0, 2));
    }

    #[test]
    fn tabs_are_shown_as_the_blanks_that_are_assumed() {
        for columns in [9, 13, 20, 40] {
            for text in [
                "\ta",
                "(a\tb\tc)",
                "日\t本\t",
                "abcdefg\th",
                "\t\t\t",
                "a\n\tb",
            ] {
                let (blanks, _) = shown(text, 0, 3, columns);
                assert!(!blanks.contains('\t'));
                let begin = Position { row: 0, column: 3 };
                assert_eq!(
                    begin.after(&blanks, columns),
                    begin.after(text, columns),
                    "{text:?} {columns}"
                );
            }
        }
    }

    #[test]
    fn control_characters_are_not_sent_to_the_terminal() {
        assert_eq!(
            shown("a\u{1b}[31mb\u{7}\n", 7, 0, 80),
            ("a[31mb\n".to_owned(), 6)
        );
        assert_eq!(shown("\tx", 1, 0, 80), ("        x".to_owned(), 8));
    }
}
