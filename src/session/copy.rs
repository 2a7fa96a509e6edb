//! A copy of a session that has nothing to do: it goes on as the original would, and neither notices
//! what happens in the other.

use super::console::Evaluator;
use super::{Audience, Session, assist};
use lisp::value::release::FreesAll;

impl Session {
    /// A copy, made in a small part of the time that a new session takes to get as far. Programs that run many
    /// worlds load their file once and copy the session for each world.
    ///
    /// # Errors
    ///
    /// What there cannot be a copy of: tasks, an open file, a live view, a robot that moves.
    pub fn copied(&self) -> Result<Session, &'static str> {
        let Some(scheduler) = self.evaluator.scheduler.copied() else {
            return Err("tasks");
        };
        if !self.evaluator.console.is_unused() {
            return Err("an evaluation that has stopped");
        }
        let audience = Audience::new(&self.options);
        let (image, host) = self
            .evaluator
            .image
            .copied(|copier| self.evaluator.host.copied(copier, audience))?;
        Ok(Session {
            options: self.options.clone(),
            evaluator: Evaluator::new(image, scheduler, host),
            checked: self.checked.clone(),
            told_names: assist::ToldNames::default(),
            ended_at: None,
            _rest: FreesAll,
        })
    }
}
