//! Lines that begin with a prompt, such as `PP-TUT> (park-arms)`.

/// A line that begins with a prompt.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct PromptLine<'a> {
    /// The name before the `>`.
    pub(crate) name: &'a str,
    /// What follows the prompt.
    pub(crate) input: &'a str,
}

/// Splits off the prompt of a line, if there is one: an upper-case name, `>`, and a space
/// or the end of the line.
pub(crate) fn prompt_line(line: &str) -> Option<PromptLine<'_>> {
    let (name, rest) = line.split_once('>')?;
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
    Some(PromptLine { name, input })
}

#[cfg(test)]
mod tests {
    use crate::session::dialogue::prompt_line::*;

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
