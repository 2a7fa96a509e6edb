//! A lesson under way at the prompt: after each input, what has happened is looked at.

use super::evaluator::Evaluator;
use crate::deeds::{Deed, Deeds};
use crate::dialogue::Event;
use crate::live_host::LiveHost;
use cram::Evaluation;
use lisp::value::Value;

impl Evaluator {
    /// Looks at what an input has brought about, if a lesson is under way. `left_by` is the class of the
    /// condition that has left it.
    pub(super) fn look_at_lesson(&mut self, left_by: Option<&str>, sink: &mut dyn FnMut(Event)) {
        if self.console.level() > 0 || self.host.person.quit.is_some() {
            return;
        }
        let deeds = Deeds::of(&mut self.image);
        if deeds.witness().is_none() {
            return;
        }
        deeds.note(Deed::Ended(left_by.map(str::to_owned)));
        let package = self.image.packages.find("PLANWRIGHT");
        let look = package.map(|package| self.image.intern(package, "%LOOK-AFTER-FORM"));
        let Some(look) = look else {
            return;
        };
        let mut host = LiveHost::new(&mut self.host, sink, false);
        let evaluation =
            self.scheduler
                .apply(&mut self.image, &mut host, Value::from(look), Vec::new());
        if !matches!(evaluation, Evaluation::Values(_)) {
            // What a lesson asks about may end in a condition: then nothing is said.
            self.abort(sink);
        }
        self.flush(sink);
    }
}
