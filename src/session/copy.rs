//! A copy of a session that has nothing to do: it goes on as the original would, and neither notices
//! what happens in the other.

use super::objects::Objects;
use super::{Audience, Session, assist, console};
use lisp::value::release::FreesAll;

impl Session {
    /// A copy, made in a small part of the time that a new session takes to get as far. Programs that run many
    /// worlds load their file once and copy the session for each world.
    ///
    /// # Errors
    ///
    /// What there cannot be a copy of: tasks, an open file, a live view, a robot that moves.
    pub fn copied(&self) -> Result<Session, &'static str> {
        let Some(scheduler) = self.scheduler.copied() else {
            return Err("tasks");
        };
        if !self.console.is_unused() {
            return Err("an evaluation that has stopped");
        }
        let audience = Audience::new(self.options.realtime, self.options.view_port);
        let (mut image, host) = self
            .image
            .copied(|copier| self.host.copied(copier, audience))?;
        Ok(Session {
            options: self.options.clone(),
            scheduler,
            host,
            checked: self.checked.clone(),
            console: console::Console::default(),
            told_names: assist::ToldNames::default(),
            objects: Objects::of(&mut image),
            image,
            failed_with: None,
            _rest: FreesAll,
        })
    }
}
