//! Resuming without the physics: the parts of a tape, one for each input.

use std::rc::Rc;

use crate::tape::{Frame, Part};

/// An evaluator that can record what its world answers, and evaluate inputs again with these
/// answers.
pub trait Taping {
    /// A checksum of everything besides the inputs that decides what happens in the session.
    fn fingerprint(&self) -> u32;

    /// Records the next input; or, if it is not `on`, records nothing.
    fn record_next(&mut self, on: bool);

    /// Plays the next input from a part of a tape. Returns false if that is damaged.
    fn play_next(&mut self, part: &Part) -> bool;

    /// The part of the tape for the last input, if that was recorded.
    fn recorded(&mut self) -> Option<Part>;

    /// Whether the last input was played from the first to the last answer.
    fn was_played(&self) -> bool;

    /// Whether the tape did not fit the last input, which therefore has to be evaluated otherwise.
    fn has_failed(&self) -> bool;

    /// Whether the last input, as far as it was played, has changed the world.
    fn has_moved(&self) -> bool;

    /// Makes the frames of a tape known.
    fn know_frames(&mut self, frames: Vec<Rc<Frame>>);

    /// Puts the world into the state of a frame, with that number, in which inputs that were
    /// played have left it. Returns its hash, or `None` if that is not possible.
    fn settle(&mut self, frame: u64) -> Option<u64>;

    /// Begins the session anew. Returns false if that is not possible.
    fn begin_anew(&mut self) -> bool;
}
