//! What to write instead, as data, so that a program can do it: read off messages, which all ask `did you
//! mean NAME?`, or found out from the text where only parentheses or quotes are missing.

use super::tokens;
use crate::dialogue::{Abort, Suggestion};
use closest_name::closest_name;
use lisp::image::Image;
use lisp::reader::{Completeness, Lexer, ReadError, ReadErrorKind, TokenKind, is_complete};
use lisp::source::Place;

/// How messages ask, without the first letter.
const ASKS: &str = "id you mean ";

/// The name that a message asks about, as it is written there.
fn asked(message: &str) -> Option<&str> {
    let (_, rest) = message.split_once(ASKS)?;
    let rest = rest.strip_prefix("the keyword ").unwrap_or(rest);
    let word = rest.split(char::is_whitespace).next()?;
    let word = word.strip_suffix('?').unwrap_or(word);
    (!word.is_empty()).then_some(word)
}

/// A proposed name in the way in which the wrong one is written.
fn written(wrong: &str, meant: &str) -> Option<String> {
    let is_text = wrong.starts_with('"');
    let is_token = is_text || !wrong.contains(|c: char| c.is_whitespace() || "()".contains(c));
    if wrong.is_empty() || !is_token || is_text && wrong.contains('\n') {
        return None;
    }
    if meant.starts_with('"') {
        return Some(meant.to_owned());
    }
    let is_lower = is_text || !wrong.contains(char::is_uppercase);
    let meant = match is_lower {
        true => meant.to_lowercase(),
        false => meant.to_owned(),
    };
    Some(match wrong.starts_with(':') && !meant.contains(':') {
        true => format!(":{meant}"),
        false => meant,
    })
}

/// What a message proposes to write in place of the text of a place.
pub(super) fn proposed(image: &Image, place: Place, message: &str) -> Option<Suggestion> {
    let wrong = image.sources.text(place)?;
    let replacement = written(wrong, asked(message)?)?;
    let at = image.sources.locate(place)?;
    Some(Suggestion {
        line: at.line,
        column: at.column,
        wrong: wrong.to_owned(),
        replacement,
    })
}

/// The bytes of a form that a message about it is concerned with: those of the last word before the question, or of the
/// one after `by`, that is a token of the form and like the name that is asked about.
fn concerned(form: &str, message: &str) -> Option<std::ops::Range<usize>> {
    let meant = bare(asked(message)?);
    let (before, after) = message.split_once(ASKS)?;
    let by = after.split_once(" by ").map(|(_, by)| by);
    let words = by.unwrap_or(before);
    let words = words.rsplit(|c: char| c.is_whitespace() || "();,".contains(c));
    let mut words = words.map(bare).filter(|word| !word.is_empty());
    words.find_map(|word| {
        closest_name(word, [meant])?;
        tokens::find(form, &word.to_uppercase())
    })
}

/// A name without its package and what stands around it in a sentence.
fn bare(word: &str) -> &str {
    let word = word.trim_matches(['"', '.', ':', '\'', '?']);
    word.rsplit(':').next().unwrap_or(word)
}

/// What the report of a failure, or the hint about it, proposes for a text that was evaluated under a name.
pub fn suggested(name: &str, text: &str, abort: &Abort) -> Option<Suggestion> {
    let hint = abort
        .hint
        .iter()
        .map(|hint| format!("{} {hint}", abort.report));
    let message = std::iter::once(abort.report.clone()).chain(hint);
    let message = message
        .into_iter()
        .find(|message| asked(message).is_some())?;
    let meant = asked(&message)?;
    let place = abort.main_place().filter(|place| &*place.name == name)?;
    let start = offset_of(text, place.line, place.column)?;
    let rest = text.get(start..)?;
    let form = rest.get(..length_of_form(rest))?;
    let found = concerned(form, &message).map(|range| range.start + start..range.end + start);
    let range = found.or_else(|| concerned(text, &message))?;
    let wrong = text.get(range.clone())?;
    let replacement = match abort.report.starts_with("Package ") {
        true => in_package(wrong, meant)?,
        false => written(wrong, meant)?,
    };
    Some(at(text, range.start, wrong, replacement))
}

/// A name with another package.
fn in_package(wrong: &str, package: &str) -> Option<String> {
    let (_, name) = wrong.split_once(':')?;
    let package = written("x", package)?;
    Some(format!("{package}:{name}"))
}

/// What would make a text readable that is not.
pub(super) fn of_unreadable(text: &str, error: &ReadError) -> Option<Suggestion> {
    let wrong = || text.get(error.start..error.end);
    match &error.kind {
        ReadErrorKind::EndOfFile {
            what: Some("a string"),
            opened_at,
            ..
        } => closed_string(text, *opened_at),
        ReadErrorKind::EndOfFile { opened_at, .. } => closed_lists(text, *opened_at),
        ReadErrorKind::UnmatchedClose => Some(at(text, error.start, ")", String::new())),
        ReadErrorKind::NoPackage {
            nearest: Some(near),
            ..
        } => {
            let replacement = in_package(wrong()?, near)?;
            Some(at(text, error.start, wrong()?, replacement))
        }
        ReadErrorKind::NoSymbol {
            nearest: Some(near),
            ..
        } => {
            let replacement = written(wrong()?, near)?;
            Some(at(text, error.start, wrong()?, replacement))
        }
        ReadErrorKind::DecimalComma { instead, .. } | ReadErrorKind::Dash { instead, .. } => {
            Some(at(text, error.start, wrong()?, instead.clone()))
        }
        _ => None,
    }
}

/// The parentheses that a form lacks. It ends where the next one begins in the first column, or with the text.
fn closed_lists(text: &str, opened_at: usize) -> Option<Suggestion> {
    // The outermost form in which that is.
    let start = text
        .get(..opened_at)?
        .rfind("\n(")
        .map_or(0, |newline| newline + 1);
    let rest = text.get(start..)?;
    let next = rest.match_indices("\n(").map(|(newline, _)| newline);
    let ends = next.chain([rest.len()]);
    ends.map(|end| rest.get(..end).unwrap_or(rest))
        .find_map(|form| match is_complete(form) {
            Completeness::Incomplete { depth, .. } if depth > 0 => {
                let tokens = Lexer::new(form).filter(|token| !is_comment(token.kind));
                let last = tokens.last()?;
                let end = last.is_closed.then_some(start + last.end)?;
                Some(at(text, end, "", ")".repeat(depth)))
            }
            _ => None,
        })
}

/// The quote that a string lacks: on its first line, before the parentheses there. Only if that makes the
/// text whole.
fn closed_string(text: &str, opened_at: usize) -> Option<Suggestion> {
    let line = text.get(opened_at..)?.lines().next()?;
    let end = opened_at + line.trim_end().trim_end_matches(')').len();
    let (before, after) = text.split_at_checked(end)?;
    let is_whole = is_complete(&format!("{before}\"{after}")) == Completeness::Complete;
    is_whole.then(|| at(text, end, "", "\"".to_owned()))
}

fn is_comment(kind: TokenKind) -> bool {
    matches!(kind, TokenKind::LineComment | TokenKind::BlockComment)
}

/// Number of bytes of the form with which a text begins.
fn length_of_form(text: &str) -> usize {
    let mut depth = 0_usize;
    for token in Lexer::new(text) {
        match token.kind {
            TokenKind::Open | TokenKind::Dispatch { letter: '(', .. } => depth += 1,
            TokenKind::Close => depth = depth.saturating_sub(1),
            TokenKind::Quote | TokenKind::Backquote | TokenKind::Dispatch { .. } => continue,
            _ => {}
        }
        if depth == 0 {
            return token.end;
        }
    }
    text.len()
}

/// The byte at a line and a column.
fn offset_of(text: &str, line: usize, column: usize) -> Option<usize> {
    let ends = text.match_indices('\n').map(|(end, _)| end + 1);
    let start = std::iter::once(0).chain(ends).nth(line.checked_sub(1)?)?;
    let chars = text.get(start..)?.char_indices().map(|(at, _)| at);
    let rest = chars.chain([text.len() - start]);
    rest.take(column).last().map(|at| start + at)
}

/// A suggestion for a byte of a text.
fn at(text: &str, byte: usize, wrong: &str, replacement: String) -> Suggestion {
    let before = text.get(..byte).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    Suggestion {
        line: before.matches('\n').count() + 1,
        column: before.get(line_start..).unwrap_or_default().chars().count() + 1,
        wrong: wrong.to_owned(),
        replacement,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_that_a_message_asks_about_is_found() {
        for (message, expected) in [
            ("There is no arm RIHGT; did you mean RIGHT?", Some("RIGHT")),
            (
                "The variable X is unbound; did you mean the keyword :LEFT?",
                Some(":LEFT"),
            ),
            (
                "not the name BOTTLE; did you mean ?BOTTLE?",
                Some("?BOTTLE"),
            ),
            (
                "There is no frame \"maap\"; did you mean \"map\"?",
                Some("\"map\""),
            ),
            (
                "Did you mean cpl:retry? After (in-package :pp-tut), it needs no prefix.",
                Some("cpl:retry"),
            ),
            ("F takes 2 arguments, but is called with 1.", None),
        ] {
            assert_eq!(asked(message), expected, "{message}");
        }
    }

    #[test]
    fn names_are_written_as_the_wrong_ones_are() {
        for (wrong, meant, expected) in [
            ("rihgt", "RIGHT", Some("right")),
            ("RIHGT", "RIGHT", Some("RIGHT")),
            (":rihgt", "RIGHT", Some(":right")),
            ("\"maap\"", "\"map\"", Some("\"map\"")),
            ("\"left\"", "LEFT", Some("left")),
            ("right", ":RIGHT", Some(":right")),
            ("(going 1)", "GOING", None),
            ("", "GOING", None),
        ] {
            assert_eq!(written(wrong, meant).as_deref(), expected, "{wrong}");
        }
    }

    #[test]
    fn a_message_is_about_a_name_like_the_one_that_it_asks_about() {
        for (form, message, expected) in [
            (
                "(f :botle)",
                "no mesh for object type :BOTLE; did you mean :BOTTLE?",
                Some(":botle"),
            ),
            (
                "(f 'botle)",
                "There is no object named BOTLE; did you mean BOTTLE?",
                Some("botle"),
            ),
            (
                "(pkg:lenght x)",
                "The function PKG::LENGHT is undefined. Did you mean LENGTH?",
                Some("pkg:lenght"),
            ),
            (
                "(a motion (type moving-torso) (joint-angel 1))",
                "The motion MOVING-TORSO needs (joint-angle …): the height (m); did you mean JOINT-ANGLE by JOINT-ANGEL?",
                Some("joint-angel"),
            ),
            (
                "(f moving-torso)",
                "MOVING-TORSO needs more; did you mean JOINT-ANGLE?",
                None,
            ),
            (
                "(f the object)",
                "There is no object; did you mean the keyword :OBJECTS?",
                Some("object"),
            ),
            (
                "(f ?height)",
                "not the name HIGHT; did you mean ?HEIGHT?",
                None,
            ),
        ] {
            let found = concerned(form, message).and_then(|range| form.get(range));
            assert_eq!(found, expected, "{message}");
        }
    }

    #[test]
    fn missing_parentheses_are_put_before_the_next_form() {
        let found = |text: &str| {
            let mut opened = 0;
            if let Completeness::Incomplete { opened_at, .. } = is_complete(text) {
                opened = opened_at;
            }
            let found = closed_lists(text, opened)?;
            Some((found.line, found.column, found.replacement))
        };
        assert_eq!(found("(a (b"), Some((1, 6, "))".to_owned())));
        assert_eq!(found("(a (b) ; c)\n"), Some((1, 7, ")".to_owned())));
        assert_eq!(
            found("(a)\n(b\n  (c) ; d\n\n(e)\n"),
            Some((3, 6, ")".to_owned()))
        );
        // A string that begins a line with a parenthesis is no form.
        assert_eq!(found("(a \"\n(b\" c\n"), Some((2, 6, ")".to_owned())));
    }

    #[test]
    fn a_string_is_closed_where_that_makes_the_text_whole() {
        let found = closed_string("(print \"a b)\n", 7);
        assert_eq!(found.map(|s| (s.line, s.column)), Some((1, 12)));
        assert_eq!(closed_string("(print \"a b) (c\n", 7), None);
    }

    #[test]
    fn places_are_bytes_of_a_text() {
        let text = "äb\ncd";
        assert_eq!(offset_of(text, 1, 2), Some(2));
        assert_eq!(offset_of(text, 2, 1), Some(4));
        assert_eq!(offset_of(text, 2, 3), Some(6));
        assert_eq!(offset_of(text, 3, 1), None);
        assert_eq!(length_of_form("(a (b) \")\") c"), 11);
        assert_eq!(length_of_form("'(a) b"), 4);
    }
}
