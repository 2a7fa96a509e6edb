//! The tape: what the world answered during an input, so that the input can be evaluated again
//! without the physics.
//!
//! A session that is resumed evaluates its inputs again. What takes long in that is the world, not
//! the language. So while a session is kept, everything that the language learns from the world is
//! recorded: replies to requests, ends of motions, the time that passed, and the state of the world
//! where a snapshot is taken. When an input is played, its forms are evaluated as ever, but the
//! answers come from the tape, and the world stands still: it is *stale* until the state at the end
//! of an input is loaded.
//!
//! Invariants:
//! - Nobody learns anything from a stale world. Every access to the physical state goes through
//!   [`Tape::note_read`] or [`Tape::note_change`], and on a stale world that ends the playing.
//! - An answer is played only to the request that it was given to: kinds, arguments and times are
//!   compared. The first difference ends the playing.
//! - What cannot be recorded exactly spoils the input: it is evaluated with the physics, from the
//!   state before it.

mod data;
mod effects;
mod entry;
mod frame;
mod part;
mod request;

use std::cell::Cell;
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use serde::Serialize;

use lisp::value::Value;

pub use data::{Data, Name, RaiseData};
pub(crate) use effects::Mark;
pub use entry::{Answer, Done, Entry};
pub use frame::Frame;
pub use part::Part;
pub use request::checksum;

/// Most bytes of answers during one input; an input with more is spoilt.
const MOST_BYTES: usize = 1 << 26;

/// What is done with the world's answers.
#[derive(Default)]
enum Mode {
    /// Nothing.
    #[default]
    Off,
    /// They are written down.
    Recording(Vec<u8>),
    /// They are read.
    Playing {
        entries: Vec<u8>,
        at: usize,
        /// Set when the playing has failed, so that the evaluation stops.
        stop: Arc<AtomicBool>,
    },
}

/// The tape of a session, and how the world stands to it.
#[derive(Default)]
pub struct Tape {
    mode: Mode,
    /// Whether anything has looked at the physical state, or changed it, since the last mark.
    is_touched: Cell<bool>,
    /// Whether the state has changed since the last frame was taken or loaded.
    is_changed: bool,
    /// Whether the state is an old one, because answers have been played since.
    is_stale: bool,
    /// Whether that has happened during this input.
    has_moved: bool,
    /// Whether the playing has failed.
    is_broken: Cell<bool>,
    /// Whether something cannot be repeated from the tape.
    is_spoilt: bool,
    /// Whether something had an effect that no answer repeats.
    has_lasting_effect: Cell<bool>,
    /// Whether a call is being recorded.
    is_open: bool,
    /// The state at the last frame, if that was recorded.
    last: Option<Rc<Frame>>,
    /// Frames taken during this input.
    taken: Vec<Rc<Frame>>,
    /// Frames of an earlier session, by number.
    known: BTreeMap<u64, Rc<Frame>>,
    /// The number of the next frame.
    next: u64,
    /// Motions that are under way on the tape, and what they are about.
    motions: Vec<(u64, Value)>,
    /// How motions have ended, until that is reported.
    ended: Vec<(u64, Option<Done>)>,
    /// The number of motions begun so far, as far as answers have told it.
    begun: u64,
}

impl Tape {
    /// Has the world always answered itself, without anything being written down?
    pub(crate) fn is_off(&self) -> bool {
        matches!(self.mode, Mode::Off) && !self.is_stale && self.last.is_none() && self.begun == 0
    }

    /// Something looks at the physical state.
    pub(crate) fn note_read(&self) {
        self.is_touched.set(true);
        if self.is_stale {
            self.fail();
        }
    }

    /// Something changes the physical state.
    pub(crate) fn note_change(&mut self) {
        self.note_read();
        self.is_changed = true;
    }

    /// An operation that the tape answers for by itself changes the physical state.
    pub(crate) fn note_change_apart(&mut self) {
        self.is_changed = true;
    }

    /// A call that the tape does not answer for has looked at the physical state, or has an effect
    /// on values that outlast it: the present input cannot be played.
    pub(crate) fn note_lasting_effect(&self) {
        self.has_lasting_effect.set(true);
    }

    /// Begins to watch accesses.
    pub fn watch(&self) {
        self.is_touched.set(false);
    }

    /// Whether there have been accesses since.
    pub(crate) fn is_touched(&self) -> bool {
        self.is_touched.get()
    }

    /// Whether the physical state is an old one.
    pub(crate) fn is_stale(&self) -> bool {
        self.is_stale
    }

    /// Whether answers are recorded.
    pub(crate) fn is_recording(&self) -> bool {
        matches!(self.mode, Mode::Recording(_))
    }

    /// Whether answers are played.
    pub(crate) fn is_playing(&self) -> bool {
        matches!(self.mode, Mode::Playing { .. })
    }

    /// The playing has failed: the evaluation stops, and its result counts for nothing.
    pub fn fail(&self) {
        if let Mode::Playing { stop, .. } = &self.mode {
            self.is_broken.set(true);
            stop.store(true, Ordering::Relaxed);
        }
    }

    /// The present input cannot be played.
    pub(crate) fn spoil(&mut self) {
        self.is_spoilt = true;
        if let Mode::Recording(entries) = &mut self.mode {
            *entries = Vec::new();
        }
    }

    /// Writes an answer down. One that is part of another answer cannot be told from that one.
    pub fn put(&mut self, entry: &Entry) {
        if self.is_open {
            self.spoil();
        }
        if self.is_spoilt {
            return;
        }
        if let Mode::Recording(entries) = &mut self.mode {
            let written = postcard::to_extend(entry, std::mem::take(entries));
            match written {
                Ok(more) if more.len() <= MOST_BYTES => *entries = more,
                _ => self.spoil(),
            }
        }
    }

    /// The call that is being recorded has ended with that answer; without one, the input is
    /// spoilt.
    pub fn close(&mut self, entry: Option<Entry>) {
        self.is_open = false;
        match entry {
            Some(entry) => self.put(&entry),
            None => self.spoil(),
        }
    }

    /// A call begins to be recorded. One that was left before its end has left no answer.
    pub fn open(&mut self) {
        if std::mem::replace(&mut self.is_open, true) {
            self.spoil();
        }
        self.watch();
    }

    /// The next answer; `None` if there is none, which ends the playing.
    pub fn next(&mut self) -> Option<Entry> {
        if self.is_broken.get() {
            self.fail();
            return None;
        }
        let Mode::Playing { entries, at, .. } = &mut self.mode else {
            return None;
        };
        let rest = entries.get(*at..).unwrap_or_default();
        match postcard::take_from_bytes(rest) {
            Ok((entry, left)) => {
                *at = entries.len() - left.len();
                Some(entry)
            }
            Err(_) => {
                self.fail();
                None
            }
        }
    }

    /// An answer was played that the world has not given: it is stale from here on.
    pub(crate) fn make_stale(&mut self) {
        self.is_stale = true;
        self.has_moved = true;
        self.last = None;
    }

    /// The world is in the state of that frame.
    pub(crate) fn has_loaded(&mut self, frame: Rc<Frame>) {
        self.is_stale = false;
        self.is_changed = false;
        self.next = self.next.max(frame.number + 1);
        self.last = Some(frame);
    }

    /// The frame of the present state, if it has one.
    pub fn present(&self) -> Option<Rc<Frame>> {
        self.last.clone().filter(|_| !self.is_changed)
    }

    /// Takes a frame of a state with that hash.
    pub fn take(&mut self, hash: u64, state: &impl Serialize) -> Option<Rc<Frame>> {
        let frame = Rc::new(Frame::of(self.next, hash, state)?);
        self.next += 1;
        self.taken.push(Rc::clone(&frame));
        Some(frame)
    }

    /// The frame is that of the present state.
    pub(crate) fn is_at(&mut self, frame: &Rc<Frame>) {
        self.last = Some(Rc::clone(frame));
        self.is_changed = false;
    }

    /// A frame of the earlier session.
    pub fn frame(&self, number: u64) -> Option<Rc<Frame>> {
        self.known.get(&number).cloned()
    }

    /// Makes frames of an earlier session known.
    pub(crate) fn know(&mut self, frames: Vec<Rc<Frame>>) {
        for frame in frames {
            self.next = self.next.max(frame.number + 1);
            self.known.insert(frame.number, frame);
        }
    }

    /// The number of motions begun so far, as far as answers have told it.
    pub fn begun(&self) -> u64 {
        self.begun
    }

    /// An answer says how many motions have begun so far.
    pub(crate) fn set_begun(&mut self, begun: u64) {
        self.begun = begun;
    }

    /// A motion is under way on the tape.
    pub(crate) fn begin_motion(&mut self, ticket: u64, subject: Value) {
        self.motions.push((ticket, subject));
    }

    /// A motion on the tape has ended or is cancelled; returns what it was about.
    pub(crate) fn end_motion(&mut self, ticket: u64) -> Option<Value> {
        let at = self.motions.iter().position(|(t, _)| *t == ticket)?;
        Some(self.motions.remove(at).1)
    }

    /// Notes how a motion has ended; `None` if that cannot be written down.
    pub(crate) fn note_end(&mut self, ticket: u64, done: Option<Done>) {
        if self.is_recording() {
            self.ended.push((ticket, done));
        }
    }

    /// How the motions have ended that were noted; `None` if one cannot be written down.
    pub(crate) fn take_ended(&mut self) -> Option<Vec<(u64, Done)>> {
        let ended = std::mem::take(&mut self.ended);
        ended
            .into_iter()
            .map(|(ticket, done)| Some((ticket, done?)))
            .collect()
    }

    /// Records the next input.
    pub fn record(&mut self) {
        self.begin(Mode::Recording(Vec::new()));
    }

    /// Plays the next input; `stop` ends its evaluation if that fails. Returns false if the part is
    /// damaged.
    pub fn play(&mut self, part: &Part, stop: Arc<AtomicBool>) -> bool {
        let Some(entries) = part.entries() else {
            return false;
        };
        let at = 0;
        self.begin(Mode::Playing { entries, at, stop });
        true
    }

    /// Neither records nor plays.
    pub fn stop(&mut self) {
        self.begin(Mode::Off);
    }

    fn begin(&mut self, mode: Mode) {
        self.mode = mode;
        self.is_broken.set(false);
        self.is_spoilt = false;
        self.has_lasting_effect.set(false);
        self.is_open = false;
        self.has_moved = false;
        self.taken.clear();
        self.ended.clear();
    }

    /// Whether the input was played from the first to the last answer.
    pub fn was_played(&self) -> bool {
        match &self.mode {
            Mode::Playing { entries, at, .. } => !self.is_broken.get() && *at == entries.len(),
            _ => false,
        }
    }

    /// Whether the input that is played goes on after the last answer, without having moved the
    /// world: it was interrupted, which it was not when it was recorded.
    pub(crate) fn is_beyond_end_unmoved(&self) -> bool {
        match &self.mode {
            Mode::Playing { entries, at, .. } => *at == entries.len() && !self.has_moved,
            _ => false,
        }
    }

    /// Whether the world would have moved during this input.
    pub fn has_moved(&self) -> bool {
        self.has_moved
    }

    /// Whether the playing has failed.
    pub fn has_failed(&self) -> bool {
        match &self.mode {
            Mode::Playing { .. } => self.is_broken.get(),
            _ => false,
        }
    }

    /// The part of the tape for the input that has just ended; `end` is the frame of the state in
    /// which it left the world at rest, and `needed` are those that snapshots refer to.
    pub fn finish(&mut self, end: Option<u64>, needed: Vec<u64>) -> Option<Part> {
        let Mode::Recording(entries) = &mut self.mode else {
            return None;
        };
        let entries = std::mem::take(entries);
        let is_whole = !self.is_spoilt && !self.is_open && !self.has_lasting_effect.get();
        Some(Part::new(
            is_whole.then_some(entries.as_slice()),
            std::mem::take(&mut self.taken),
            end,
            needed,
        ))
    }
}
