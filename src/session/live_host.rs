//! The simulation as the scheduler's host, with output told as it comes.

use std::any::Any;

use super::simulation::Simulation;
use crate::dialogue::Event;
use crate::lisp::image::Image;
use crate::plan::{Advance, Host, Reply, TaskId, Ticket};

/// A simulation, and whom to tell what is printed meanwhile.
pub(super) struct LiveHost<'a> {
    pub simulation: &'a mut Simulation,
    pub sink: &'a mut dyn FnMut(Event),
}

/// Tells what was written to standard output.
pub(super) fn flush(image: &mut Image, sink: &mut dyn FnMut(Event)) {
    let text = image.output.take();
    if !text.is_empty() {
        sink(Event::Output(text));
    }
}

impl Host for LiveHost<'_> {
    fn request(&mut self, image: &mut Image, task: TaskId, request: Box<dyn Any>) -> Reply {
        let reply = self.simulation.request(image, task, request);
        for picture in self.simulation.take_pictures() {
            flush(image, self.sink);
            (self.sink)(Event::Picture(picture));
        }
        reply
    }

    fn advance(&mut self, image: &mut Image, now: f64, until: Option<f64>) -> Advance {
        flush(image, self.sink);
        self.simulation.advance(image, now, until)
    }

    fn idle(&mut self, image: &mut Image, now: f64, until: f64) -> f64 {
        flush(image, self.sink);
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
