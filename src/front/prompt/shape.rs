//! The lambda list or keys of the form being typed, as shown behind the cursor.

use rustyline::hint::Hint;

/// What precedes each line of a hint.
const MARK: &str = "  ; ";

/// The lambda list or keys of the form being typed.
pub(crate) struct Shape(String);

impl Shape {
    /// The hint behind text that ends at a column of a terminal with so many columns. It continues
    /// on further lines, between words.
    pub(super) fn new(hint: &str, column: usize, columns: usize) -> Shape {
        // Terminals differ in what they do behind the last column.
        let room = columns.saturating_sub(1 + MARK.len()).max(1);
        let mut left = columns.saturating_sub(1 + MARK.len() + column % columns.max(1));
        let mut shown = MARK.to_owned();
        let mut is_first = true;
        for word in hint.split(' ') {
            let width = word.chars().count();
            let needed = width + usize::from(!is_first);
            if needed > left && left < room {
                shown.truncate(shown.trim_end().len());
                if is_first {
                    shown.clear();
                }
                shown.push('\n');
                shown.push_str(MARK);
                left = room;
                is_first = true;
            }
            if !is_first {
                shown.push(' ');
            }
            shown.push_str(word);
            left = left.saturating_sub(width + usize::from(!is_first));
            is_first = false;
        }
        Shape(shown)
    }
}

impl Hint for Shape {
    fn display(&self) -> &str {
        &self.0
    }

    fn completion(&self) -> Option<&str> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(hint: &str, column: usize, columns: usize) -> String {
        Shape::new(hint, column, columns).0
    }

    #[test]
    fn a_hint_that_fits_is_on_the_line() {
        assert_eq!(shown("(f a b)", 10, 40), "  ; (f a b)");
    }

    #[test]
    fn a_long_hint_goes_on_between_words() {
        assert_eq!(
            shown("(perform designator &optional more)", 10, 40),
            "  ; (perform designator\n  ; &optional more)"
        );
    }

    #[test]
    fn no_line_is_longer_than_the_terminal() {
        let hint = "(a action (type picking-up) (object *object*) (arm left or right) [(grasp g)])";
        for columns in 30..90 {
            for column in 0..100 {
                let shown = shown(hint, column, columns);
                let mut used = column % columns;
                for line in shown.split('\n') {
                    assert!(used + line.chars().count() < columns, "{columns} {column}");
                    used = 0;
                }
                let words: Vec<&str> = shown.split_whitespace().filter(|w| *w != ";").collect();
                assert_eq!(words.join(" "), hint);
            }
        }
    }

    #[test]
    fn a_word_longer_than_the_terminal_is_left_whole() {
        assert_eq!(shown("abcdefghijkl", 3, 8), "\n  ; abcdefghijkl");
    }
}
