//! Lines that begin with a prompt, such as `PP-TUT> (park-arms)`.

/// A line that begins with a prompt.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct PromptLine<'a> {
    /// The name before the `>`.
    pub name: &'a str,
    /// What the prompt says about a stopped evaluation, such as `1]`; empty at the top level.
    pub state: &'a str,
    /// What follows the prompt.
    pub input: &'a str,
}

/// Splits off the prompt of a line, if there is one: an upper-case name, perhaps the state of a
/// stopped evaluation, `>`, and a space or the end of the line.
pub fn prompt_line(line: &str) -> Option<PromptLine<'_>> {
    let (prompt, rest) = line.split_once('>')?;
    let (name, state) = prompt.split_once(' ').unwrap_or((prompt, ""));
    if !is_state(state) && prompt != name {
        return None;
    }
    let mut characters = name.chars();
    let is_name = characters.next().is_some_and(char::is_uppercase)
        && characters.all(|c| c.is_uppercase() || c.is_numeric() || "-+*/.:_%&=?!".contains(c));
    if !is_name {
        return None;
    }
    let input = match rest.strip_prefix(' ') {
        Some(input) => input,
        None if rest.trim_end().is_empty() => "",
        None => return None,
    };
    Some(PromptLine { name, state, input })
}

/// Whether a prompt shows this when an evaluation is stopped: the level or `stopped`, and then
/// what it asks for, if that is neither a command nor a form.
fn is_state(state: &str) -> bool {
    let mut words = state.split(' ');
    let is_level = |word: &str| {
        let number = word.strip_suffix(']');
        word == "stopped" || number.is_some_and(|n| n.parse::<usize>().is_ok())
    };
    let is_request = |word: &str| matches!(word, "value" | "form" | "inspect");
    match (words.next(), words.next(), words.next()) {
        (Some(word), None, None) => is_level(word) || is_request(word),
        (Some(level), Some(request), None) => is_level(level) && is_request(request),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use crate::dialogue::prompt_line::*;

    fn input(line: &str) -> Option<&str> {
        prompt_line(line).map(|found| found.input)
    }

    #[test]
    fn an_upper_case_name_and_a_blank_make_a_prompt() {
        assert_eq!(input("CL-USER> (+ 1 2)"), Some("(+ 1 2)"));
        assert_eq!(input("PP-TUT>   x"), Some("  x"));
        assert_eq!(prompt_line("R2D2> x").map(|p| p.name), Some("R2D2"));
    }

    #[test]
    fn an_empty_prompt_needs_no_blank() {
        assert_eq!(input("PP-TUT>"), Some(""));
        assert_eq!(input("PP-TUT> "), Some(""));
    }

    #[test]
    fn a_prompt_tells_that_an_evaluation_is_stopped() {
        let state = |line| prompt_line(line).map(|found| found.state);
        assert_eq!(state("A> x"), Some(""));
        assert_eq!(state("A 2]> :bt"), Some("2]"));
        assert_eq!(state("A 1] value> 7"), Some("1] value"));
        assert_eq!(state("A stopped> 0"), Some("stopped"));
        assert_eq!(state("A inspect> q"), Some("inspect"));
        assert_eq!(input("A 2]> :bt"), Some(":bt"));
        for line in ["A b> c", "A 1]2> c", "A > c", "A 1] 2]> c", "A  > c"] {
            assert_eq!(prompt_line(line), None, "{line}");
        }
    }

    #[test]
    fn other_lines_have_no_prompt() {
        for line in [
            "",
            "> 1",
            "pp-tut> 1",
            "A>B",
            "A B> 1",
            " A> 1",
            "(> 1 2)",
            "#<A> 1",
            "1> 2",
        ] {
            assert_eq!(prompt_line(line), None, "{line}");
        }
    }
}
