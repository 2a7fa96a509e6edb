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

/// Bytes of text from which on it is packed together: inputs of a session are much like earlier ones, but only what
/// is in the same block is found by the packer.
const BLOCK_BYTES: usize = 64 << 10;

/// The inputs of a session with their outputs.
#[derive(Default)]
pub(super) struct Record(RefCell<Inputs>);

#[derive(Clone, Default)]
struct Inputs {
    /// The transcript of all but the last, packed where there is much of it.
    blocks: Vec<Vec<u8>>,
    /// The part of it that is not packed.
    text: String,
    /// How many there are.
    count: usize,
    last: Option<Entry>,
}

#[derive(Clone)]
struct Entry {
    /// What the prompt showed, with the state of a stopped evaluation.
    prompt: String,
    input: String,
    output: Screen<Vec<u8>>,
    interrupted_at: Option<u64>,
    /// Whether it asked to end the session; if the session went on, it had no effect.
    quits: bool,
}

impl Extension for Record {
    fn copied(self: Rc<Self>, _: &mut Copier) -> Rc<dyn Extension> {
        Rc::new(Record(self.0.clone()))
    }
}

impl Inputs {
    /// The last one has ended.
    fn close(&mut self) {
        if let Some(entry) = self.last.take().filter(|entry| !entry.quits) {
            self.text.push_str(&entry.text());
        }
        if self.text.len() > BLOCK_BYTES {
            let mut block = compress_prepend_size(self.text.as_bytes());
            block.shrink_to_fit();
            self.blocks.push(block);
            self.text = String::new();
        }
    }

    /// The transcript of all but the last.
    fn text(&self) -> String {
        let mut bytes = Vec::new();
        for block in &self.blocks {
            bytes.extend(decompress_size_prepended(block).unwrap_or_default());
        }
        bytes.extend_from_slice(self.text.as_bytes());
        // Each block ends where an input does.
        String::from_utf8_lossy(&bytes).into_owned()
    }
}

impl Record {
    /// Call when an input is about to be evaluated.
    pub(crate) fn begin(&self, prompt: String, source_name: &str, input: &str) {
        let mut output = Screen::new(Vec::new());
        output.begin_input(source_name, input);
        let mut inputs = self.0.borrow_mut();
        inputs.close();
        inputs.count += 1;
        inputs.last = Some(Entry {
            prompt,
            input: input.to_owned(),
            output,
            interrupted_at: None,
            quits: false,
        });
    }

    /// Records an event.
    pub(crate) fn note(&self, event: &Event) {
        if let Some(entry) = &mut self.0.borrow_mut().last {
            // Writing to memory does not fail.
            let _ = entry.output.show(event);
        }
    }

    /// Call when the input has been evaluated.
    pub(crate) fn end(&self, outcome: Outcome, interrupted_at: Option<u64>) {
        if let Some(entry) = &mut self.0.borrow_mut().last {
            entry.interrupted_at = interrupted_at;
            entry.quits = matches!(outcome, Outcome::Quit(_));
        }
    }

    /// The transcript of all inputs but the last, which is still being evaluated, and how many these are.
    fn transcript(&self) -> (String, usize) {
        let inputs = self.0.borrow();
        let mut text = inputs.text();
        if let Some(last) = &inputs.last {
            let is_stopped = prompt_line(&format!("{}>", last.prompt))
                .is_some_and(|prompt| !prompt.state.is_empty());
            if is_stopped {
                // A replay stops where the next prompt shows that the evaluation stopped.
                text.push_str(&format!("{}>\n", last.prompt));
            }
        }
        (text, inputs.count.saturating_sub(1))
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
        for line in String::from_utf8_lossy(self.output.written()).lines() {
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
    let (text, count) = record.map_or_else(Default::default, |record| record.transcript());
    let written = image.files.write(&path, text.as_bytes());
    written.map_err(|error| Raise::simple(format!("{path} cannot be written: {error}.")))?;
    Ok(count)
}
