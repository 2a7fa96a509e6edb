//! Shows events as they appear at the prompt.
//!
//! Values are on lines of their own: if the program's output left the cursor in the middle
//! of a line, that line is ended first.
//!
//! What is reported of conditions and names never drives a terminal. Output and values are the
//! program's own: only a terminal shows their control characters instead of obeying them.

use std::borrow::Cow;
use std::io::{self, Write};
use std::ops::Range;

use crate::dialogue::evaluate::{Abort, Event, Stop};
use lisp::source::Location;
use lisp::visible::visible;
use view::picture::{Image, InlinePictures};

/// Turns events into text.
#[derive(Clone)]
pub struct Screen<W> {
    to: W,
    at_line_start: bool,
    /// Whether values of forms are shown.
    echo: bool,
    source_name: String,
    source_has_lines: bool,
    is_detailed: bool,
    /// Whether progress is shown, on a line that is erased afterwards.
    is_terminal: bool,
    /// Whether there is such a line now.
    has_progress: bool,
    pictures: Option<InlinePictures>,
    is_colored: bool,
    /// Whether control characters of output and values are shown.
    is_cautious: bool,
}

impl<W: Write> Screen<W> {
    /// A screen that writes to `to`, the cursor being at the start of a line.
    pub fn new(to: W) -> Self {
        Screen {
            to,
            at_line_start: true,
            echo: true,
            source_name: String::new(),
            source_has_lines: false,
            is_detailed: false,
            is_terminal: false,
            has_progress: false,
            pictures: None,
            is_colored: false,
            is_cautious: false,
        }
    }

    /// Sets whether values have a colour, by which they can be told from output.
    pub fn set_colored(&mut self, is_colored: bool) {
        self.is_colored = is_colored;
    }

    /// Sets whether it writes to a terminal: it then shows the progress of motions, and takes
    /// into account that an interrupt leaves a `^C` there. It is cautious, too.
    pub fn set_terminal(&mut self, is_terminal: bool) {
        self.is_terminal = is_terminal;
        self.is_cautious = is_terminal;
    }

    /// Sets whether control characters of output and values are shown, so that they do not drive a
    /// terminal.
    pub fn set_cautious(&mut self, is_cautious: bool) {
        self.is_cautious = is_cautious;
    }

    /// Sets whether the actions around a condition are shown.
    pub fn set_detailed(&mut self, is_detailed: bool) {
        self.is_detailed = is_detailed;
    }

    /// Sets how pictures are shown, if at all.
    pub fn set_pictures(&mut self, pictures: Option<InlinePictures>) {
        self.pictures = pictures;
    }

    /// Sets whether the values of forms are shown.
    pub fn set_echo(&mut self, echo: bool) {
        self.echo = echo;
    }

    /// Sets the input that the next events belong to; the cursor is at the start of a line.
    ///
    /// An aborted evaluation shows its place if that is in another file or if the input has
    /// several lines.
    pub fn begin_input(&mut self, source_name: &str, text: &str) {
        source_name.clone_into(&mut self.source_name);
        self.source_has_lines = text.trim_end().contains('\n');
    }

    /// Shows an event.
    pub fn show(&mut self, event: &Event) -> io::Result<()> {
        if let Event::Progress(line) = event {
            return self.progress(line);
        }
        self.end_progress()?;
        match event {
            Event::Output(text) | Event::ErrorOutput(text) => {
                let text = self.own(text);
                self.write(&text)
            }
            Event::Values(values) if self.echo => self.values(values),
            Event::Values(_) => Ok(()),
            Event::Picture(picture) => self.picture(picture),
            Event::Aborted(abort) => self.aborted(abort),
            Event::Stopped(stop) => self.stopped(stop),
            Event::Left(condition) => self.left(condition),
            Event::Progress(_) => Ok(()),
        }
    }

    /// Shows a line of progress in place of the last one, unless the cursor is in the middle
    /// of a line.
    fn progress(&mut self, line: &str) -> io::Result<()> {
        if !self.is_terminal || !self.at_line_start {
            return Ok(());
        }
        self.has_progress = true;
        write!(self.to, "\r\x1b[2K{}", visible(line))
    }

    fn end_progress(&mut self) -> io::Result<()> {
        if !std::mem::take(&mut self.has_progress) {
            return Ok(());
        }
        self.to.write_all(b"\r\x1b[2K")
    }

    /// Ends the current line, if it is not empty.
    pub fn fresh_line(&mut self) -> io::Result<()> {
        self.end_progress()?;
        if self.at_line_start {
            Ok(())
        } else {
            self.write("\n")
        }
    }

    /// Flushes what has been written so far.
    pub fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }

    /// The underlying writer.
    pub fn written(&self) -> &W {
        &self.to
    }

    /// Takes what has been written to memory.
    pub fn take_written(&mut self) -> W
    where
        W: Default,
    {
        std::mem::take(&mut self.to)
    }

    /// Returns the underlying writer.
    pub fn into_inner(self) -> W {
        self.to
    }

    fn write(&mut self, text: &str) -> io::Result<()> {
        if !text.is_empty() {
            self.at_line_start = text.ends_with('\n');
        }
        self.to.write_all(text.as_bytes())
    }

    fn line(&mut self, text: &str) -> io::Result<()> {
        self.fresh_line()?;
        self.write(text)?;
        self.write("\n")
    }

    /// Writes a line of a report.
    fn told_line(&mut self, text: &str) -> io::Result<()> {
        self.line(&visible(text))
    }

    /// What belongs to the program itself, as it is to be written.
    fn own<'t>(&self, text: &'t str) -> Cow<'t, str> {
        match self.is_cautious {
            true => visible(text),
            false => Cow::Borrowed(text),
        }
    }

    fn values(&mut self, values: &[String]) -> io::Result<()> {
        if values.is_empty() {
            return self.line("; No value");
        }
        let mut values = values.iter().enumerate();
        values.try_for_each(|(number, value)| self.value(number, value))
    }

    /// Shows a value; on a terminal, no more than the beginning of a very long one.
    fn value(&mut self, number: usize, value: &str) -> io::Result<()> {
        let cut = value.char_indices().nth(MAX_VALUE_LENGTH);
        let Some((end, _)) = cut.filter(|_| self.is_terminal) else {
            return self.colored_line(value);
        };
        let (shown, rest) = value.split_at(end);
        self.colored_line(&format!("{shown} …"))?;
        let more = rest.chars().count();
        self.line(&format!(
            "; … and {more} more characters; (print (nth {number} /)) shows all."
        ))
    }

    /// Writes lines in the colour of values.
    fn colored_line(&mut self, text: &str) -> io::Result<()> {
        if !self.is_colored {
            let text = self.own(text);
            return self.line(&text);
        }
        let text = self.own(text);
        text.split('\n')
            .try_for_each(|line| self.line(&format!("{VALUE_COLOR}{line}{RESET}")))
    }

    fn picture(&mut self, picture: &Image) -> io::Result<()> {
        let Some(show) = self.pictures else {
            return Ok(());
        };
        self.fresh_line()?;
        self.to.write_all(&show.encoded(picture))?;
        self.write("\n")
    }

    fn aborted(&mut self, abort: &Abort) -> io::Result<()> {
        self.report(abort)?;
        self.left(&abort.condition)
    }

    fn left(&mut self, condition: &str) -> io::Result<()> {
        self.told_line(&format!("; Evaluation aborted on {condition}."))
    }

    fn stopped(&mut self, stop: &Stop) -> io::Result<()> {
        if self.is_terminal && stop.abort.condition == INTERRUPT {
            self.at_line_start = false;
        }
        self.report_of(&stop.abort, true)?;
        let width = stop.choices.len().saturating_sub(1).to_string().len();
        // The last ones lead out.
        let left_out = FIRST_CHOICES..stop.choices.len().saturating_sub(LAST_CHOICES);
        for (number, choice) in stop.choices.iter().enumerate() {
            if stop.folded.contains(&number) {
                if number == stop.folded.start {
                    let (range, below) = (&stop.folded, stop.level.saturating_sub(1));
                    self.line(&folded(range, width, below))?;
                }
            } else if !left_out.contains(&number) {
                self.told_line(&format!(" {number:>width$}: {choice}"))?;
            } else if number == left_out.start {
                let more = left_out.len();
                self.line(&format!(" {:>width$}  and {more} more", "…"))?;
            }
        }
        if stop.remark.is_empty() {
            return Ok(());
        }
        self.line(stop.remark)
    }

    fn report(&mut self, abort: &Abort) -> io::Result<()> {
        self.report_of(abort, false)
    }

    fn report_of(&mut self, abort: &Abort, names_class: bool) -> io::Result<()> {
        let report = abort.report.trim_end();
        if !report.is_empty() {
            self.told_line(report)?;
        }
        if names_class && !abort.class.is_empty() {
            self.told_line(&format!("   [Condition of type {}]", abort.class))?;
        }
        if let Some(hint) = &abort.hint {
            self.told_line(&format!("; {hint}"))?;
        }
        if let Some(place) = self.place(abort) {
            self.told_line(&place)?;
        }
        if self.is_detailed {
            for action in abort.performing() {
                for line in action.lines() {
                    self.told_line(&format!("; {line}"))?;
                }
            }
        }
        Ok(())
    }

    /// The place to show, if any; if it is in a built-in plan, also the place in the user's own
    /// text.
    fn place(&self, abort: &Abort) -> Option<String> {
        let place = abort.place.as_ref()?;
        let user = abort.user_place.as_ref();
        let told: Vec<String> = std::iter::once(place)
            .chain(user)
            .filter_map(|place| self.told(place))
            .collect();
        (!told.is_empty()).then(|| format!("; at {}", told.join(", from ")))
    }

    /// A place in words: inputs have no name that the user knows, and in an input of one line
    /// a place is of no use.
    fn told(&self, place: &Location) -> Option<String> {
        if *place.name == *self.source_name {
            self.source_has_lines
                .then(|| format!("line {}, column {}", place.line, place.column))
        } else {
            (!is_input_name(&place.name)).then(|| place.to_string())
        }
    }
}

/// Red, as in SLIME.
const VALUE_COLOR: &str = "\x1b[31m";
const RESET: &str = "\x1b[0m";

/// How much of a value a terminal shows, in characters.
const MAX_VALUE_LENGTH: usize = 8000;

/// The line in place of choices that the level below offers, too.
fn folded(range: &Range<usize>, width: usize, below: usize) -> String {
    let first = range.start;
    if range.len() == 1 {
        return format!(" {first:>width$}: as at level {below}; :r shows it.");
    }
    let last = range.end - 1;
    format!(" {first:>width$} to {last}: as at level {below}; :r shows them.")
}

/// An interrupt as printed.
pub const INTERRUPT: &str = "#<INTERACTIVE-INTERRUPT>";

const INPUT_NAME: &str = "prompt[";
/// How many choices are shown, of those that stand first and of those that stand last.
const FIRST_CHOICES: usize = 20;
const LAST_CHOICES: usize = 10;

/// The name of the `number`th input at a prompt, as the source of places.
pub fn input_name(number: usize) -> String {
    format!("{INPUT_NAME}{number}]")
}

/// Whether this names an input at a prompt.
pub fn is_input_name(source_name: &str) -> bool {
    source_name.starts_with(INPUT_NAME)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lisp::source::Location;

    fn shown(events: &[Event]) -> String {
        shown_for("x", events)
    }

    fn shown_for(text: &str, events: &[Event]) -> String {
        let mut screen = Screen::new(Vec::new());
        screen.begin_input(&input_name(1), text);
        for event in events {
            screen.show(event).unwrap();
        }
        String::from_utf8(screen.into_inner()).unwrap()
    }

    fn output(text: &str) -> Event {
        Event::Output(text.to_owned())
    }

    fn values(values: &[&str]) -> Event {
        Event::Values(values.iter().map(|&v| v.to_owned()).collect())
    }

    #[test]
    fn a_terminal_shows_the_beginning_of_a_long_value() {
        let long = "é".repeat(MAX_VALUE_LENGTH + 5);
        let mut screen = Screen::new(Vec::new());
        screen.set_terminal(true);
        screen.show(&values(&["1", &long])).unwrap();
        let text = String::from_utf8(screen.into_inner()).unwrap();
        assert!(text.starts_with("1\né"), "{text}");
        let end = "é …\n; … and 5 more characters; (print (nth 1 /)) shows all.\n";
        assert!(text.ends_with(end), "{text}");
        assert_eq!(shown(&[values(&[&long])]), format!("{long}\n"));
    }

    fn aborted(name: &str) -> Event {
        Event::Aborted(Box::new(Abort {
            report: "The variable B is unbound.".to_owned(),
            condition: "#<UNBOUND-VARIABLE B>".to_owned(),
            place: Some(Location {
                name: name.into(),
                line: 2,
                column: 3,
                line_text: "  b".to_owned(),
                width: 1,
            }),
            ..Abort::default()
        }))
    }

    #[test]
    fn what_is_reported_does_not_drive_a_terminal() {
        let Event::Aborted(mut abort) = aborted("\x1b]0;x\x07.plan") else {
            panic!("it is aborted");
        };
        abort.report = "no \x1b[2J".to_owned();
        abort.condition = "#<\x1b>".to_owned();
        assert_eq!(
            shown(&[Event::Aborted(abort)]),
            "no ^[[2J\n; at ^[]0;x^G.plan:2:3\n; Evaluation aborted on #<^[>.\n"
        );
        let own = [output("\x1b[1ma\n"), values(&["\"\x1b\""])];
        assert_eq!(shown(&own), "\x1b[1ma\n\"\x1b\"\n");
        let mut screen = Screen::new(Vec::new());
        screen.set_cautious(true);
        own.iter().for_each(|event| screen.show(event).unwrap());
        assert_eq!(screen.into_inner(), b"^[[1ma\n\"^[\"\n");
    }

    #[test]
    fn each_value_has_a_line() {
        assert_eq!(shown(&[values(&["1", "2"]), values(&["3"])]), "1\n2\n3\n");
    }

    #[test]
    fn values_have_a_colour_if_wanted() {
        let mut screen = Screen::new(Vec::new());
        screen.set_colored(true);
        screen.show(&output("a\n")).unwrap();
        screen.show(&values(&["1\n2"])).unwrap();
        let text = String::from_utf8(screen.into_inner()).unwrap();
        assert_eq!(text, "a\n\x1b[31m1\x1b[0m\n\x1b[31m2\x1b[0m\n");
    }

    #[test]
    fn no_value_is_told() {
        assert_eq!(shown(&[values(&[])]), "; No value\n");
    }

    #[test]
    fn values_begin_on_a_fresh_line() {
        assert_eq!(shown(&[output("\n1 "), values(&["1"])]), "\n1 \n1\n");
        assert_eq!(shown(&[output("line\n"), values(&["NIL"])]), "line\nNIL\n");
        assert_eq!(
            shown(&[output("x\n"), output(""), values(&["NIL"])]),
            "x\nNIL\n"
        );
    }

    #[test]
    fn an_aborted_evaluation_shows_its_report_and_condition() {
        assert_eq!(
            shown(&[output("x"), aborted("prompt[1]")]),
            "x\nThe variable B is unbound.\n; Evaluation aborted on #<UNBOUND-VARIABLE B>.\n"
        );
    }

    #[test]
    fn the_place_is_told_where_it_helps() {
        let place = |text, name| {
            let shown = shown_for(text, &[aborted(name)]);
            shown.lines().nth(1).unwrap().to_owned()
        };
        assert_eq!(place("(list\n  b)", "prompt[1]"), "; at line 2, column 3");
        assert_eq!(place("(f)", "kitchen.plan"), "; at kitchen.plan:2:3");
        let untold = "; Evaluation aborted on #<UNBOUND-VARIABLE B>.";
        assert_eq!(place("(f)", "prompt[1]"), untold);
        assert_eq!(place("(list\n  b)", "prompt[7]"), untold);
    }

    #[test]
    fn without_echo_only_values_are_left_out() {
        let mut screen = Screen::new(Vec::new());
        screen.set_echo(false);
        screen.show(&values(&["1"])).unwrap();
        screen.show(&output("a\n")).unwrap();
        assert_eq!(screen.into_inner(), b"a\n");
    }
}
