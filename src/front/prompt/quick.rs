//! Resuming a session from its tape: as far as the tape goes, the world's answers come from there.
//!
//! The state that results is that of the session that was not interrupted: the language has done
//! the same, since it was told the same, and the state of the world is the recorded one, whose hash
//! is compared with the journal's. Whatever does not fit ends the attempt.

use std::io::{self, Write};
use std::path::Path;
use std::rc::Rc;

use super::journal::{
    End, Lineage, Recorded, Stretch, Taped, fingerprint, matched, read, stretches,
};
use super::keeper::Keeper;
use super::resume::{Progress, evaluate_again};
use session::dialogue::Converse;
use session::dialogue::screen::input_name;
use session::tape::Frame;

/// What came of playing a tape.
pub(super) enum Played {
    /// There is nothing to play.
    None,
    /// The session is resumed. If the world is not the same since an input that had to be evaluated
    /// with the physics, the number of that input.
    Whole(Option<usize>),
    /// The user interrupted the input with that index there, and the session stands in the middle
    /// of it.
    Stopped(usize, u64),
    /// The user interrupted the input with that index, but the state in the middle of it is not
    /// known.
    Lost(usize),
    /// The tape does not fit.
    Failed,
}

/// A tape and the session that it belongs to.
pub(super) struct Quick {
    /// What is on the tape of each input that is not left out.
    taped: Vec<Option<Taped>>,
    frames: Vec<Rc<Frame>>,
}

/// The inputs that are evaluated, with their indices.
fn evaluated(inputs: &[Recorded]) -> impl Iterator<Item = (usize, &Recorded)> {
    let all = inputs.iter().enumerate();
    all.filter(|(_, input)| input.end != End::Skipped)
}

/// The lineage after each input.
fn lineages(inputs: &[Recorded]) -> Vec<Lineage> {
    let mut lineage = Lineage::default();
    evaluated(inputs)
        .map(|(_, input)| {
            lineage = lineage.after_recorded(input);
            lineage
        })
        .collect()
}

impl Quick {
    /// The tape beside the journal.
    pub(super) fn new(evaluator: &dyn Converse, journal: &Path, inputs: &[Recorded]) -> Quick {
        let (taped, frames) = read(journal, fingerprint(evaluator.fingerprint()));
        let mut taped = matched(taped, &lineages(inputs));
        // An input whose end is not known has not left the state that the tape tells.
        for (taped, (_, input)) in taped.iter_mut().zip(evaluated(inputs)) {
            if input.end == End::Unknown {
                *taped = None;
            }
        }
        Quick { taped, frames }
    }

    /// Evaluates the inputs; `first` is the number of the input before them.
    pub(super) fn run(
        &mut self,
        evaluator: &mut dyn Converse,
        keeper: &mut Keeper,
        inputs: &[Recorded],
        first: usize,
        progress: &mut Progress<impl Write>,
    ) -> io::Result<Played> {
        let inputs: Vec<(usize, &Recorded)> = evaluated(inputs).collect();
        let mut taped = self.taped.clone();
        taped.truncate(inputs.len());
        let ends = taped.iter().map(|taped| {
            let is_playable = taped.as_ref().is_some_and(Taped::is_playable);
            (is_playable, taped.as_ref().and_then(|taped| taped.end))
        });
        let stretches = stretches(ends);
        if !stretches.iter().any(|stretch| stretch.end.is_some()) {
            return Ok(Played::None);
        }
        evaluator.know_frames(self.frames.clone());
        let mut run = Run {
            evaluator,
            keeper,
            inputs: &inputs,
            first,
            taped,
            frames: self.frames.clone(),
            lineages: Vec::new(),
            differs: None,
            stale_at: None,
        };
        run.lineages = {
            let recorded: Vec<Recorded> = inputs.iter().map(|(_, i)| (*i).clone()).collect();
            lineages(&recorded)
        };
        for stretch in &stretches {
            let ended = match stretch.end {
                Some(end) if run.differs.is_none() => run.play(stretch, end, progress)?,
                _ => run.evaluate(stretch, progress)?,
            };
            if let Some(ended) = ended {
                return Ok(ended);
            }
        }
        if !run.settle() {
            return Ok(Played::Failed);
        }
        let differs = run.differs;
        let (taped, frames) = (run.taped, run.frames);
        let lineage = run.lineages.last().copied().unwrap_or_default();
        let taped: Vec<Taped> = taped.into_iter().flatten().collect();
        keeper.begin_tape(evaluator, taped, frames, lineage);
        Ok(Played::Whole(differs))
    }
}

/// A resume under way.
struct Run<'a> {
    evaluator: &'a mut dyn Converse,
    keeper: &'a mut Keeper,
    inputs: &'a [(usize, &'a Recorded)],
    first: usize,
    taped: Vec<Option<Taped>>,
    frames: Vec<Rc<Frame>>,
    lineages: Vec<Lineage>,
    differs: Option<usize>,
    /// The place among the inputs of the one after which the world stands, while it is stale.
    stale_at: Option<(usize, u64)>,
}

impl Run<'_> {
    /// Plays a stretch. Returns how the resume ends, if it does.
    fn play(
        &mut self,
        stretch: &Stretch,
        end: u64,
        progress: &mut Progress<impl Write>,
    ) -> io::Result<Option<Played>> {
        for place in stretch.inputs.clone() {
            let Some((at, input)) = self.inputs.get(place).copied() else {
                continue;
            };
            let part = self.taped.get(place).and_then(Option::as_ref);
            let part = part.and_then(Taped::part);
            if !part.is_some_and(|part| self.evaluator.play_next(&part)) {
                return Ok(Some(Played::Failed));
            }
            self.keeper.about_to_play(at + 1);
            let name = input_name(self.first + at + 1);
            let interrupted_at = evaluate_again(self.evaluator, &name, input, at, progress)?;
            if self.evaluator.has_failed() {
                return Ok(Some(Played::Failed));
            }
            if interrupted_at != input.interrupted_at {
                return Ok(Some(self.interrupted(place, at, interrupted_at)));
            }
            if !self.evaluator.was_played() {
                return Ok(Some(Played::Failed));
            }
            self.keeper.played(input);
        }
        self.stale_at = stretch.inputs.end.checked_sub(1).map(|last| (last, end));
        Ok(None)
    }

    /// The user has interrupted the input at that place, with that index. As long as it has not
    /// changed the world, its state is that before the input.
    fn interrupted(&mut self, place: usize, at: usize, interrupted_at: Option<u64>) -> Played {
        let Some(interrupted_at) = interrupted_at else {
            return Played::Failed;
        };
        if self.evaluator.has_moved() {
            return Played::Lost(at);
        }
        if let Some(before) = place.checked_sub(1) {
            let before_it = self.taped.get(before).and_then(Option::as_ref);
            match before_it.and_then(|taped| taped.end) {
                Some(end) => self.stale_at = Some((before, end)),
                None => return Played::Lost(at),
            }
        }
        match self.settle() {
            true => Played::Stopped(at, interrupted_at),
            false => Played::Failed,
        }
    }

    /// Evaluates a stretch with the physics, and records it again.
    fn evaluate(
        &mut self,
        stretch: &Stretch,
        progress: &mut Progress<impl Write>,
    ) -> io::Result<Option<Played>> {
        if !self.settle() {
            return Ok(Some(Played::Failed));
        }
        for place in stretch.inputs.clone() {
            let Some((at, input)) = self.inputs.get(place).copied() else {
                continue;
            };
            self.evaluator.record_next(true);
            self.keeper.about_to_play(at + 1);
            let name = input_name(self.first + at + 1);
            let interrupted_at = evaluate_again(self.evaluator, &name, input, at, progress)?;
            if let Some(place) = interrupted_at
                && interrupted_at != input.interrupted_at
            {
                return Ok(Some(Played::Stopped(at, place)));
            }
            let hash = self.evaluator.world_hash();
            self.keeper.played(input);
            if matches!(input.end, End::Ended(Some(recorded)) if recorded != hash) {
                self.differs.get_or_insert(at + 1);
            }
            let part = self.evaluator.recorded();
            let (Some(taped), Some(lineage)) =
                (self.taped.get_mut(place), self.lineages.get(place))
            else {
                continue;
            };
            *taped = part.map(|part| {
                self.frames.extend(part.frames.iter().cloned());
                Taped::of(*lineage, part)
            });
        }
        Ok(None)
    }

    /// Puts the world into the state after the last input that was played. Returns false if that
    /// is not the state that the journal tells.
    fn settle(&mut self) -> bool {
        let Some((place, frame)) = self.stale_at.take() else {
            return true;
        };
        let recorded = self.inputs.get(place).map(|(_, input)| input.end);
        let hash = self.evaluator.settle(frame);
        match recorded {
            Some(End::Ended(Some(recorded))) => hash == Some(recorded),
            _ => hash.is_some(),
        }
    }
}
