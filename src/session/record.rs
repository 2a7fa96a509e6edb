//! The inputs and outputs of a session, so that it can be written as a transcript.

use std::cell::RefCell;

use super::dialogue::{Event, Screen};
use crate::lisp::builtin::{Builtin, pure};
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;

/// The inputs of a session with their outputs.
#[derive(Default)]
pub(super) struct Record(RefCell<Vec<Entry>>);

struct Entry {
    prompt: String,
    input: String,
    screen: Screen<Vec<u8>>,
    /// Whether the evaluation has stopped; a replay goes no further.
    is_over: bool,
}

impl Record {
    /// Call when an input at the top level is about to be evaluated.
    pub(crate) fn begin(&self, prompt: String, source_name: &str, input: &str) {
        let mut screen = Screen::new(Vec::new());
        screen.begin_input(source_name, input);
        self.0.borrow_mut().push(Entry {
            prompt,
            input: input.to_owned(),
            screen,
            is_over: false,
        });
    }

    /// Records an event. Where a user decides how to continue after a condition, a replay
    /// aborts, so that is what is recorded.
    pub(crate) fn note(&self, event: &Event) {
        let mut entries = self.0.borrow_mut();
        let Some(entry) = entries.last_mut().filter(|entry| !entry.is_over) else {
            return;
        };
        // Writing to memory does not fail.
        let _ = match event {
            Event::Stopped(stop) => {
                entry.is_over = true;
                let aborted = Event::Aborted(Box::new(stop.abort.clone()));
                entry.screen.show(&aborted)
            }
            other => entry.screen.show(other),
        };
    }

    /// The transcript of all entries but the last, which is still being evaluated.
    fn transcript(&self) -> String {
        let entries = self.0.borrow();
        let mut text = String::new();
        let count = entries.len().saturating_sub(1);
        for entry in entries.iter().take(count) {
            text.push_str(&format!("{}> {}\n", entry.prompt, entry.input.trim_end()));
            let output = String::from_utf8_lossy(entry.screen.written());
            text.push_str(&output);
            if !output.is_empty() && !output.ends_with('\n') {
                text.push('\n');
            }
            text.push('\n');
        }
        text
    }
}

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = &[pure(
    "SAVE-TRANSCRIPT",
    "file",
    "Writes the inputs at the prompt and their output as a transcript, which planwright replay can compare. Returns the number of inputs.",
    &[],
    save_transcript,
)];

fn save_transcript(image: &mut Image, args: &[Value]) -> Result<Value, Box<Raise>> {
    let Some(path) = args[0].as_text() else {
        return Err(Raise::type_error(&args[0], known::STRING));
    };
    let record = image.extension::<Record>();
    let (text, count) = record.map_or_else(Default::default, |record| {
        let count = record.0.borrow().len().saturating_sub(1);
        (record.transcript(), count)
    });
    std::fs::write(&path, text)
        .map_err(|error| Raise::simple(format!("{path} cannot be written: {error}.")))?;
    Ok(Value::from(count))
}
