//! The session's side of the dialogue with the prompt.

use std::rc::Rc;

use super::Session;
use super::dialogue::{Completions, Converse, Repeat};
use lisp::image::input::Source;

impl Repeat for Session {
    fn set_interactive(&mut self, is_interactive: bool) {
        self.evaluator.console.is_interactive = is_interactive;
        self.evaluator.scheduler.set_stops_in_place(is_interactive);
        self.evaluator
            .host
            .person
            .snapshots
            .keep_snapshots_of_motions(is_interactive);
    }

    fn interrupted_at(&self) -> Option<u64> {
        self.evaluator.image.polls().seen_at()
    }

    fn interrupt_next_at(&mut self, at: u64) {
        self.evaluator.console.interrupt_next = Some(at);
    }
}

impl Converse for Session {
    fn level(&self) -> usize {
        self.evaluator.console.level()
    }

    fn answer_to_interrupt(&self) -> Option<&'static str> {
        self.evaluator.console.answer_to_interrupt()
    }

    fn take_draft(&mut self) -> Option<String> {
        self.evaluator.console.take_draft()
    }

    fn completions(&self, text: &str, at: usize) -> Completions {
        self.assistant().complete(text, at)
    }

    fn hint(&self, text: &str, at: usize) -> Option<String> {
        self.assistant().hint_at(text, at)
    }

    fn is_designator_type(&self, name: &str) -> bool {
        self.assistant().is_type_name(name)
    }

    fn set_source(&mut self, source: Option<Rc<Source>>) {
        self.evaluator.image.input.set_source(source);
    }

    fn world_hash(&self) -> u64 {
        self.evaluator.host.simulation.world().hash()
    }

    fn last_ending(&self) -> &str {
        &self.evaluator.console.last_ending
    }

    fn take_loaded(&self) -> Vec<(Rc<str>, Rc<str>)> {
        self.evaluator.image.sources.take_loaded()
    }

    fn set_hurried(&mut self, is_hurried: bool) {
        self.evaluator.host.audience.set_hurried(is_hurried);
    }

    fn finish(&mut self) -> Result<(), String> {
        self.end_recording().map_err(|error| error.to_string())
    }
}
