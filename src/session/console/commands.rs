//! Debugger commands: what can be typed while an evaluation is stopped.

/// An input while an evaluation is stopped at a condition.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Command<'a> {
    /// Return to the top level.
    Abort,
    /// Return to the previous level.
    AbortLevel,
    /// Invoke the restart `continue`.
    Continue,
    /// Make the choice with that number, with the form for its value, if given.
    Choose(usize, &'a str),
    /// Show this many frames, or all.
    Backtrace(Option<usize>),
    /// Select that frame.
    Frame(usize),
    /// Select the next outer frame.
    Up,
    /// Select the next inner frame.
    Down,
    /// Show the variables of the frame.
    Locals,
    /// Show again why the evaluation has stopped.
    Again,
    /// Show that with all choices.
    Choices,
    /// Show the tasks.
    Tasks,
    /// Evaluate the form again.
    Retry,
    /// Edit the form and evaluate it again.
    Edit,
    /// Return the value of a form from the frame.
    Return(&'a str),
    /// Call what the frame has called once more.
    Restart,
    /// What can be typed.
    Help,
    /// Evaluate forms in the frame.
    Evaluate(&'a str),
    /// A malformed command.
    Wrong(&'static str),
}

/// Help text on what can be typed.
pub(super) const HELP: &str = "\
N          chooses the restart of that number; N FORM gives it a value
q          aborts: back to the top          a        aborts this level only
:bt [N]    the frames, innermost first      :frame N selects a frame
:up :down  the frame further out, in        :locals  the variables of the frame
:tasks     the tasks
:r         all restarts                     c        continues, where that is possible
:retry     evaluates the form again         :edit    lets you change the last form
:return F  returns the value of form F from the frame
:restart   calls what the frame has called again, in its newest definition
:eval F    evaluates forms, also those that look like commands
Anything else is evaluated in the selected frame.
";

impl<'a> Command<'a> {
    pub(super) fn of(text: &'a str) -> Command<'a> {
        if let Some(forms) = text.strip_prefix(":eval ") {
            return Command::Evaluate(forms);
        }
        let text = text.trim();
        let (word, rest) = match text.split_once(char::is_whitespace) {
            Some((word, rest)) => (word, rest.trim()),
            None => (text, ""),
        };
        let is_number = !word.is_empty() && word.bytes().all(|b| b.is_ascii_digit());
        if is_number {
            return match word.parse() {
                Ok(number) => Command::Choose(number, rest),
                Err(_) => Command::Wrong("; There is no such restart."),
            };
        }
        let number = || rest.parse::<usize>().ok();
        match (word.to_lowercase().as_str(), rest.is_empty()) {
            ("", true) => Command::Again,
            (":r" | ":restarts", true) => Command::Choices,
            ("q" | ":q" | "quit" | ":quit" | "exit" | ":exit" | ":abort", true) => Command::Abort,
            ("a" | ":a", true) => Command::AbortLevel,
            ("c" | ":c" | ":continue", true) => Command::Continue,
            (":bt" | ":backtrace", true) => Command::Backtrace(None),
            (":bt" | ":backtrace", false) => match number() {
                Some(count) => Command::Backtrace(Some(count)),
                None => Command::Wrong("; :bt takes a number of frames."),
            },
            (":f" | ":frame", _) => match number() {
                Some(number) => Command::Frame(number),
                None => Command::Wrong("; :frame takes the number of a frame; :bt tells them."),
            },
            (":up", true) => Command::Up,
            (":down", true) => Command::Down,
            (":l" | ":locals", true) => Command::Locals,
            (":tasks", true) => Command::Tasks,
            (":retry", true) => Command::Retry,
            (":e" | ":edit", true) => Command::Edit,
            (":return", false) => Command::Return(rest),
            (":restart", true) => Command::Restart,
            (":return", true) => Command::Wrong("; :return takes a form."),
            ("help" | ":h" | ":help" | "?", true) => Command::Help,
            _ => Command::Evaluate(text),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_are_told_from_forms() {
        assert_eq!(Command::of(" 2 "), Command::Choose(2, ""));
        assert_eq!(Command::of("2 (list 1)"), Command::Choose(2, "(list 1)"));
        assert_eq!(Command::of("q"), Command::Abort);
        assert_eq!(Command::of("(q)"), Command::Evaluate("(q)"));
        assert_eq!(Command::of(":frame 3"), Command::Frame(3));
        assert_eq!(Command::of(":bt"), Command::Backtrace(None));
        assert_eq!(Command::of("?object"), Command::Evaluate("?object"));
        assert_eq!(Command::of(":return (f)"), Command::Return("(f)"));
        assert_eq!(Command::of(":restart"), Command::Restart);
        assert_eq!(Command::of(":eval q"), Command::Evaluate("q"));
        assert_eq!(Command::of(":eval  2 "), Command::Evaluate(" 2 "));
        assert_eq!(Command::of(":keyword"), Command::Evaluate(":keyword"));
    }

    #[test]
    fn a_number_too_large_is_no_panic() {
        assert!(matches!(
            Command::of("99999999999999999999999"),
            Command::Wrong(_)
        ));
    }
}
