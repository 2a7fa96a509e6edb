//! Finds the transcripts in Markdown.

use std::ops::Range;

/// The lines (from zero) inside each fenced block whose first word is `session`.
///
/// An unclosed block extends to the end, as in CommonMark.
pub(crate) fn session_blocks(lines: &[String]) -> Vec<Range<usize>> {
    let mut blocks = Vec::new();
    let mut open: Option<(Fence<'_>, usize)> = None;
    for (number, line) in lines.iter().enumerate() {
        let fence = Fence::parse(line);
        match (&open, fence) {
            (None, Some(fence)) => open = Some((fence, number + 1)),
            (Some((opening, first)), Some(fence)) if fence.closes(opening) => {
                if opening.is_session() {
                    blocks.push(*first..number);
                }
                open = None;
            }
            _ => {}
        }
    }
    if let Some((opening, first)) = open
        && opening.is_session()
    {
        blocks.push(first..lines.len());
    }
    blocks
}

/// A line of at least three backticks or tildes, and the text after them.
struct Fence<'a> {
    mark: char,
    length: usize,
    info: &'a str,
}

impl<'a> Fence<'a> {
    fn parse(line: &'a str) -> Option<Self> {
        let text = line.trim_start_matches(' ');
        if line.len() - text.len() > 3 {
            return None;
        }
        let mark = text.chars().next().filter(|c| matches!(c, '`' | '~'))?;
        let info = text.trim_start_matches(mark);
        let length = text.len() - info.len();
        let info = info.trim();
        (length >= 3 && !(mark == '`' && info.contains('`'))).then_some(Fence {
            mark,
            length,
            info,
        })
    }

    fn closes(&self, opening: &Fence<'_>) -> bool {
        self.mark == opening.mark && self.length >= opening.length && self.info.is_empty()
    }

    fn is_session(&self) -> bool {
        self.info.split_whitespace().next() == Some("session")
    }
}

#[cfg(test)]
mod tests {
    use crate::transcript::markdown::*;

    fn blocks(text: &str) -> Vec<(usize, usize)> {
        let lines: Vec<String> = text.lines().map(str::to_owned).collect();
        session_blocks(&lines)
            .into_iter()
            .map(|block| (block.start, block.end))
            .collect()
    }

    #[test]
    fn only_blocks_marked_session_count() {
        assert_eq!(
            blocks("a\n```session\nb\nc\n```\n```lisp\nd\n```\n"),
            [(2, 4)]
        );
        assert_eq!(blocks("```\n```session\n```\n"), []);
        assert_eq!(
            blocks("``` session x\na\n```\n~~~session\nb\n~~~\n"),
            [(1, 2), (4, 5)]
        );
    }

    #[test]
    fn a_longer_fence_may_hold_a_shorter_one() {
        assert_eq!(blocks("````session\n```\n````\n"), [(1, 2)]);
    }

    #[test]
    fn an_open_block_goes_to_the_end() {
        assert_eq!(blocks("```session\na\nb\n"), [(1, 3)]);
    }

    #[test]
    fn an_indented_code_line_is_no_fence() {
        assert_eq!(blocks("    ```session\na\n"), []);
    }
}
