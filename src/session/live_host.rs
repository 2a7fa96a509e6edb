//! The simulation as the scheduler's host, with output told as it comes.

use std::any::Any;

use super::simulation::Simulation;
use crate::dialogue::Event;
use crate::lisp::image::Image;
use crate::plan::{Advance, Host, Reply, TaskId, Ticket};
use crate::viewer::watch::Happening;

/// A simulation, and whom to tell what is printed meanwhile.
pub(super) struct LiveHost<'a> {
    pub simulation: &'a mut Simulation,
    pub sink: &'a mut dyn FnMut(Event),
}

/// Tells what was written to standard output, and what became of tasks.
pub(super) fn flush(image: &mut Image, simulation: &mut Simulation, sink: &mut dyn FnMut(Event)) {
    simulation.tell_tasks(image);
    let text = image.output.take();
    if !text.is_empty() {
        let told = Happening::Output(text.clone());
        simulation.tell(&told);
        sink(Event::Output(text));
    }
}

impl Host for LiveHost<'_> {
    fn request(&mut self, image: &mut Image, task: TaskId, request: Box<dyn Any>) -> Reply {
        self.simulation.request(image, task, request)
    }

    fn advance(&mut self, image: &mut Image, now: f64, until: Option<f64>) -> Advance {
        flush(image, self.simulation, self.sink);
        self.simulation.advance(image, now, until)
    }

    fn idle(&mut self, image: &mut Image, now: f64, until: f64) -> f64 {
        flush(image, self.simulation, self.sink);
        self.simulation.idle(image, now, until)
    }

    fn cancel(&mut self, image: &mut Image, ticket: Ticket) {
        self.simulation.cancel(image, ticket);
    }

    fn pause(&mut self, image: &mut Image, ticket: Ticket) {
        self.simulation.pause(image, ticket);
    }

    fn wake(&mut self, image: &mut Image, ticket: Ticket) {
        self.simulation.wake(image, ticket);
    }
}
