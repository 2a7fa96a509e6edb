//! The inputs and outputs of a session, so that it can be written as a transcript.

use std::borrow::Cow;
use std::cell::RefCell;
use std::rc::Rc;

use lz4_flex::block::{compress_prepend_size, decompress_size_prepended};

use super::dialogue::prompt_line::prompt_line;
use super::dialogue::repeat::with_interrupt;
use super::dialogue::{Event, Outcome, Screen};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::image::extension::Extension;
use lisp::typed::{self, builtin, builtins};
use lisp::value::copy::Copier;
use lisp::value::raise::Raise;
use lisp::value::string::LispString;

/// The inputs of a session with their outputs.
#[derive(Default)]
pub(super) struct Record(RefCell<Vec<Entry>>);

#[derive(Clone)]
struct Entry {
    /// What the prompt showed, with the state of a stopped evaluation.
    prompt: String,
    input: String,
    output: Output,
    interrupted_at: Option<u64>,
    /// Whether it asked to end the session; if the session went on, it had no effect.
    quits: bool,
}

/// What was shown after an input.
#[derive(Clone)]
enum Output {
    /// More may follow.
    Open(Screen<Vec<u8>>),
    /// All of it, packed: a long session shows much.
    Packed(Vec<u8>),
}

impl Output {
    fn pack(&mut self) {
        if let Output::Open(screen) = self {
            *self = Output::Packed(compress_prepend_size(screen.written()));
        }
    }

    fn text(&self) -> String {
        let bytes: Cow<'_, [u8]> = match self {
            Output::Open(screen) => screen.written().into(),
            Output::Packed(bytes) => decompress_size_prepended(bytes).unwrap_or_default().into(),
        };
        String::from_utf8_lossy(&bytes).into_owned()
    }
}

impl Extension for Record {
    fn copied(self: Rc<Self>, _: &mut Copier) -> Rc<dyn Extension> {
        Rc::new(Record(self.0.clone()))
    }
}

impl Record {
    /// Call when an input is about to be evaluated.
    pub(crate) fn begin(&self, prompt: String, source_name: &str, input: &str) {
        let mut screen = Screen::new(Vec::new());
        screen.begin_input(source_name, input);
        let mut entries = self.0.borrow_mut();
        if let Some(before) = entries.last_mut() {
            before.output.pack();
        }
        entries.push(Entry {
            prompt,
            input: input.to_owned(),
            output: Output::Open(screen),
            interrupted_at: None,
            quits: false,
        });
    }

    /// Records an event.
    pub(crate) fn note(&self, event: &Event) {
        if let Some(entry) = self.0.borrow_mut().last_mut()
            && let Output::Open(screen) = &mut entry.output
        {
            // Writing to memory does not fail.
            let _ = screen.show(event);
        }
    }

    /// Call when the input has been evaluated.
    pub(crate) fn end(&self, outcome: Outcome, interrupted_at: Option<u64>) {
        if let Some(entry) = self.0.borrow_mut().last_mut() {
            entry.interrupted_at = interrupted_at;
            entry.quits = matches!(outcome, Outcome::Quit(_));
        }
    }

    /// The transcript of all entries but the last, which is still being evaluated.
    fn transcript(&self) -> String {
        let entries = self.0.borrow();
        let Some((last, earlier)) = entries.split_last() else {
            return String::new();
        };
        let mut text: String = earlier
            .iter()
            .filter(|entry| !entry.quits)
            .map(Entry::text)
            .collect();
        let is_stopped = prompt_line(&format!("{}>", last.prompt))
            .is_some_and(|prompt| !prompt.state.is_empty());
        if is_stopped {
            // A replay stops where the next prompt shows that the evaluation stopped.
            text.push_str(&format!("{}>\n", last.prompt));
        }
        text
    }
}

impl Entry {
    /// The entry in a transcript.
    fn text(&self) -> String {
        let input = self.input.trim_end();
        let input = match self.interrupted_at {
            Some(at) => Cow::Owned(with_interrupt(input, at)),
            None => Cow::Borrowed(input),
        };
        let mut text = format!("{}> {input}\n", self.prompt);
        for line in self.output.text().lines() {
            text.push_str(&comparable(line));
            text.push('\n');
        }
        text.push('\n');
        text
    }
}

/// A line of output with wildcards in place of what no replay repeats: real time and the
/// address of the live view. A line that looks like a prompt must not be taken for one.
fn comparable(line: &str) -> Cow<'_, str> {
    if let Some(prompt) = prompt_line(line) {
        let rest = line.get(prompt.name.len()..).unwrap_or_default();
        return format!("{ANYTHING}{rest}").into();
    }
    if let Some((simulated, real)) = line.split_once(" s simulated, ")
        && simulated.starts_with("; ")
        && real.ends_with(" s real")
    {
        return format!("{simulated} s simulated, {ANYTHING} s real").into();
    }
    if let Some((before, address)) = line.split_once(LOCAL_ADDRESS) {
        let end = address.find(['"', ' ']).unwrap_or(address.len());
        let after = address.get(end..).unwrap_or_default();
        return format!("{before}{LOCAL_ADDRESS}{ANYTHING}{after}").into();
    }
    line.into()
}

/// The wildcard for any text within a line.
const ANYTHING: &str = "[..]";

/// What addresses of the live view begin with.
const LOCAL_ADDRESS: &str = "http://127.0.0.1:";

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = builtins![save_transcript];

/// Writes the inputs at the prompt and their output as a transcript, which planwright replay can compare.
/// Returns the number of inputs.
#[builtin]
fn save_transcript(image: &Image, file: &Rc<LispString>) -> Result<usize, Box<Raise>> {
    let path = file.text();
    let record = image.extension::<Record>();
    let (text, count) = record.map_or_else(Default::default, |record| {
        let count = record.0.borrow().len().saturating_sub(1);
        (record.transcript(), count)
    });
    let written = image.files.write(&path, text.as_bytes());
    written.map_err(|error| Raise::simple(format!("{path} cannot be written: {error}.")))?;
    Ok(count)
}
