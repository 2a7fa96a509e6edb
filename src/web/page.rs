//! A session as a page sees it: requests come in, messages go out.

use std::cell::RefCell;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use defect::caught;
use lisp::guard::heap::HeapLimit;
use lisp::visible::visible;
use serde_json::{Value, json};
use session::dialogue::screen::input_name;
use session::dialogue::{
    Converse, Evaluate, Event, Outcome, Repeat, Screen, Severity, Stop, is_whole,
};
use session::outside::Outside;
use session::sweeping::SweepFile;
use session::{Session, SessionOptions};
use view::watch::live::{Updates, embedded_page};

use crate::files::MemoryFiles;
use crate::request::Request;
use crate::sweeping::Sweep;

/// The file of the page in which is kept what has been done of lessons; the page does not list it.
const LESSONS: &str = ".lessons";

/// Where messages go.
pub trait Outbox {
    /// Sends a JSON text.
    fn text(&self, text: &str);

    /// Sends bytes, with a word that says what they are.
    fn bytes(&self, what: &str, bytes: &[u8]);
}

/// A session as a page sees it. While an input is evaluated, it answers what needs no session.
pub struct Page {
    outbox: Box<dyn Outbox>,
    outside: Outside,
    files: MemoryFiles,
    session: RefCell<Option<Open>>,
    /// What the live view shows; apart, since it is read while the session works.
    updates: RefCell<Option<Updates>>,
    interrupt: RefCell<Arc<AtomicBool>>,
    sweep: RefCell<Option<Sweep>>,
    /// How much memory a session may use.
    heap: Option<HeapLimit>,
}

/// An open session.
struct Open {
    session: Session,
    /// Number of inputs so far.
    inputs: usize,
}

impl Page {
    /// A page without a session, which has files and a clock.
    pub fn new(outbox: Box<dyn Outbox>, outside: Outside, files: MemoryFiles) -> Page {
        Page {
            outbox,
            outside,
            files,
            session: RefCell::new(None),
            updates: RefCell::new(None),
            interrupt: RefCell::default(),
            sweep: RefCell::new(None),
            heap: None,
        }
    }

    /// The same, with a limit to the memory that a session may use.
    pub fn with_heap(mut self, heap: HeapLimit) -> Page {
        self.heap = Some(heap);
        self
    }

    /// Interrupts the input that is evaluated.
    pub fn interrupt(&self) {
        self.interrupt.borrow().store(true, Ordering::Relaxed);
    }

    /// Sends what is new in the live view.
    pub fn show_news(&self) {
        let Ok(mut updates) = self.updates.try_borrow_mut() else {
            return;
        };
        let Some(updates) = updates.as_mut() else {
            return;
        };
        let messages = updates.unread();
        if messages.is_empty() {
            return;
        }
        let items: Vec<String> = messages
            .into_iter()
            .map(|(name, data)| format!("[\"{name}\",{data}]"))
            .collect();
        self.outbox
            .text(&format!("{{\"news\":[{}]}}", items.join(",")));
    }

    /// Answers a request, a JSON text.
    pub fn hear(&self, request: &str) {
        match serde_json::from_str(request) {
            Ok(request) => self.answer(request),
            Err(error) => self.fail(&format!("a request is malformed: {error}")),
        }
    }

    fn answer(&self, request: Request) {
        match request {
            Request::Open { seed, files } => {
                for (name, text) in files {
                    self.files.put(&name, text.into_bytes());
                }
                self.open(seed);
            }
            Request::File { name, text } => match text {
                Some(text) => self.files.put(&name, text.into_bytes()),
                None => self.files.delete(&name),
            },
            Request::Sweep {
                file,
                text,
                name,
                seed,
                number,
            } => {
                let file = SweepFile { name: file, text };
                match Sweep::open(&self.outside, file, name.as_deref(), seed) {
                    Ok((sweep, known)) => {
                        self.sweep.replace(Some(sweep));
                        self.send(&json!({"sweep": known, "number": number}));
                    }
                    Err(why) => self.send(&json!({"mistake": why, "number": number})),
                }
            }
            Request::World { world, number } => self.with_sweep(|sweep| {
                let record = sweep.run(world);
                let is_success = record.is_success();
                self.send(&json!({
                    "line": record.line(),
                    "success": is_success,
                    "number": number,
                }));
            }),
            Request::Summary { lines, number } => {
                self.with_sweep(|sweep| match sweep.summary(&lines) {
                    Ok(summary) => self.send(&json!({"summary": summary, "number": number})),
                    Err(why) => self.send(&json!({"mistake": why, "number": number})),
                });
            }
            Request::Meshes(first) => self.with_updates(|updates| {
                self.outbox.bytes("meshes", &updates.meshes(first));
            }),
            Request::Past { from, to, number } => self.with_updates(|updates| {
                let past = updates.past(from, to);
                self.outbox
                    .text(&format!("{{\"past\":{past},\"number\":{number}}}"));
            }),
            Request::Enter { text, number } => {
                self.send(&json!({"whole": is_whole(&text), "number": number}));
            }
            Request::ViewPage { script, number } => {
                self.send(&json!({"page": embedded_page(&script), "number": number}));
            }
            Request::Pace(wanted) => {
                self.with_updates(|updates| {
                    // The page knows what it may ask for.
                    let _ = updates.change_pace(&wanted);
                });
                self.show_news();
            }
            Request::Evaluate {
                text,
                file,
                interrupted_at,
                again,
            } => self.with_session(|open| {
                open.session.set_hurried(again);
                if let Some(at) = interrupted_at {
                    open.session.interrupt_next_at(at);
                }
                self.evaluate(open, &text, file.as_deref());
            }),
            Request::Complete { text, at, number } => self.with_session(|open| {
                let found = open.session.completions(&text, byte_at(&text, at));
                let candidates: Vec<Value> = found
                    .candidates
                    .iter()
                    .map(|candidate| json!([candidate.text, candidate.doc]))
                    .collect();
                let start = units(text.get(..found.start).unwrap_or_default());
                self.send(&json!({"completions": candidates, "start": start, "number": number}));
            }),
            Request::Hint { text, at, number } => self.with_session(|open| {
                let hint = open.session.hint(&text, byte_at(&text, at));
                self.send(&json!({"hint": hint, "number": number}));
            }),
            Request::Check { name, text } => self.with_session(|open| {
                let found = open.session.check(&name, &text);
                let findings: Vec<Value> = found
                    .iter()
                    .map(|finding| {
                        json!({
                            "line": finding.place.as_ref().map(|place| place.line),
                            "column": finding.place.as_ref().map(|place| place.column),
                            "message": finding.message,
                            "mistake": finding.severity == Severity::Error,
                        })
                    })
                    .collect();
                self.send(&json!({"findings": findings, "name": name}));
            }),
        }
    }

    /// Begins a session; an earlier one ends.
    fn open(&self, seed: u64) {
        self.updates.replace(None);
        self.session.replace(None);
        let options = SessionOptions {
            seed,
            heap: self.heap,
            outside: self.outside.clone(),
            ..SessionOptions::default()
        };
        let mut session = match Session::new(&options) {
            Ok(session) => session,
            Err(error) => return self.fail(&error.to_string()),
        };
        session.set_interactive(true);
        session.remember_lessons(Path::new(LESSONS), "page");
        self.interrupt.replace(session.interrupt_handle());
        self.updates.replace(Some(session.updates()));
        self.send(
            &json!({"open": {"prompt": session.prompt(), "version": env!("CARGO_PKG_VERSION")}}),
        );
        self.session.replace(Some(Open { session, inputs: 0 }));
        self.show_news();
    }

    fn evaluate(&self, open: &mut Open, text: &str, file: Option<&str>) {
        let session = &mut open.session;
        let name = match file {
            Some(file) => file.to_owned(),
            None => {
                open.inputs += 1;
                input_name(open.inputs)
            }
        };
        let mut screen = Screen::new(Vec::new());
        screen.set_detailed(true);
        screen.set_cautious(true);
        screen.set_echo(file.is_none());
        screen.begin_input(&name, text);
        let mut shown = Shown {
            outbox: &*self.outbox,
            screen,
        };
        let outcome = caught(|| session.evaluate(&name, text, &mut |event| shown.show(&event)));
        shown.end();
        let outcome = match outcome {
            Ok(outcome) => outcome,
            Err(defect) => {
                let text = format!(
                    "This is a defect of planwright: {defect}.\nThe session goes on, but what it has done may be incomplete.\n"
                );
                self.send(&json!({"text": text, "kind": "error"}));
                Outcome::Aborted
            }
        };
        session.set_hurried(false);
        self.show_news();
        let (outcome, status) = match outcome {
            Outcome::Finished => ("finished", None),
            Outcome::Aborted => ("aborted", None),
            Outcome::Stopped => ("stopped", None),
            Outcome::Quit(status) => ("quit", Some(status)),
        };
        self.send(&json!({"done": {
            "outcome": outcome,
            "status": status,
            "prompt": session.prompt(),
            "level": session.level(),
            "ending": session.last_ending(),
            "interruptedAt": session.interrupted_at(),
            "draft": session.take_draft(),
            "hash": format!("{:016x}", session.world_hash()),
        }}));
    }

    fn with_session(&self, work: impl FnOnce(&mut Open)) {
        match self.session.try_borrow_mut() {
            Ok(mut session) => match session.as_mut() {
                Some(open) => work(open),
                None => self.fail("there is no session"),
            },
            Err(_) => self.fail("the session is at work"),
        }
    }

    fn with_sweep(&self, work: impl FnOnce(&mut Sweep)) {
        match self.sweep.borrow_mut().as_mut() {
            Some(sweep) => work(sweep),
            None => self.fail("no sweep has been asked for"),
        }
    }

    fn with_updates(&self, work: impl FnOnce(&Updates)) {
        if let Ok(updates) = self.updates.try_borrow()
            && let Some(updates) = updates.as_ref()
        {
            work(updates);
        }
    }

    fn send(&self, message: &Value) {
        self.outbox.text(&message.to_string());
    }

    fn fail(&self, why: &str) {
        self.send(&json!({ "failed": why }));
    }
}

/// What a session says, on its way to the page.
struct Shown<'p> {
    outbox: &'p dyn Outbox,
    screen: Screen<Vec<u8>>,
}

impl Shown<'_> {
    fn show(&mut self, event: &Event) {
        match event {
            Event::Picture(picture) => {
                if let Ok(png) = picture.to_png() {
                    self.outbox.bytes("picture", &png);
                }
                return;
            }
            Event::Progress(line) => {
                let message = json!({"progress": visible(line)});
                return self.outbox.text(&message.to_string());
            }
            _ => {}
        }
        // A vector can be written to.
        let _ = self.screen.show(event);
        let kind = match event {
            Event::Values(_) => "values",
            Event::Aborted(_) | Event::Stopped(_) => "error",
            _ => "output",
        };
        self.send(kind);
        if let Event::Stopped(stop) = event {
            self.outbox.text(&stopped(stop).to_string());
        }
    }

    /// Ends the last line.
    fn end(&mut self) {
        let _ = self.screen.fresh_line();
        self.send("output");
    }

    /// Sends what has been written.
    fn send(&mut self, kind: &str) {
        let written = self.screen.take_written();
        if !written.is_empty() {
            let message = json!({"text": String::from_utf8_lossy(&written), "kind": kind});
            self.outbox.text(&message.to_string());
        }
    }
}

/// A stop, with its restarts.
fn stopped(stop: &Stop) -> Value {
    let choices: Vec<_> = stop.choices.iter().map(|choice| visible(choice)).collect();
    json!({"stopped": {
        "level": stop.level,
        "class": stop.abort.class,
        "report": visible(&stop.abort.report),
        "choices": choices,
        "folded": [stop.folded.start, stop.folded.end],
    }})
}

/// The byte at a place that is counted in UTF-16 units, as pages count.
fn byte_at(text: &str, units: usize) -> usize {
    let mut left = units;
    for (at, character) in text.char_indices() {
        if left == 0 {
            return at;
        }
        left = left.saturating_sub(character.len_utf16());
    }
    text.len()
}

/// The length of a text in UTF-16 units.
fn units(text: &str) -> usize {
    text.chars().map(char::len_utf16).sum()
}

#[cfg(test)]
mod tests;
