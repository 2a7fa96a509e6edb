//! Going on after a defect: a panic in the middle of an input.

use super::evaluator::Evaluator;
use crate::dialogue::{Abort, Event, Outcome};
use defect::Defect;
use view::watch::Cause;

/// What people are asked to do.
const REQUEST: &str = "This is a defect of planwright, not of your program. The world is as it was \
                       before the form; variables are as the form left them. You can go on. Please \
                       report the defect together with the file that (save-transcript \
                       \"defect.transcript\") writes.";

/// The condition as it is shown.
pub(crate) const CONDITION: &str = "#<DEFECT>";

impl Evaluator {
    /// Makes the session usable again after a panic: the world is taken back to before the last
    /// form at top level; its tasks, and all that was stopped, are given up.
    pub(crate) fn recover(&mut self, defect: &Defect, sink: &mut dyn FnMut(Event)) -> Outcome {
        self.scheduler.give_up(&mut self.image);
        self.console.give_up();
        self.image.nesting = 0;
        self.image.output.set_shown(true);
        self.image.output.mute(None);
        let simulation = &mut self.host.simulation;
        self.host.person.snapshots.go_back_to_form(simulation);
        simulation.give_robot_up();
        self.flush(sink);
        let report = format!("planwright failed: {defect}.\n{REQUEST}");
        self.host.audience.show(&self.host.simulation, Cause::Rest);
        sink(Event::Aborted(Box::new(Abort {
            report,
            condition: CONDITION.to_owned(),
            ..Abort::default()
        })));
        self.image.output.begin_line();
        Outcome::Aborted
    }
}
