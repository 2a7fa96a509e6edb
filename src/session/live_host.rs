//! The scheduler's host, with output reported as it is produced.

use std::sync::Arc;
use std::time::Duration;

use super::dialogue::Event;
use super::host::SimulationHost;
use super::host::call::HostCall;
use cram::designator::MotionRequest;
use cram::{Advance, Host, Reply, TaskId, Ticket};
use lisp::image::Image;
use view::watch::WatchEvent;

/// The host, and the sink for what is printed meanwhile.
pub(super) struct LiveHost<'a> {
    host: &'a mut SimulationHost,
    sink: &'a mut dyn FnMut(Event),
    tells_progress: bool,
}

impl<'a> LiveHost<'a> {
    pub(crate) fn new(
        host: &'a mut SimulationHost,
        sink: &'a mut dyn FnMut(Event),
        tells_progress: bool,
    ) -> LiveHost<'a> {
        LiveHost {
            host,
            sink,
            tells_progress,
        }
    }

    /// Reports the pictures that have been made.
    fn tell_pictures(&mut self, image: &mut Image) {
        for picture in self.host.audience.take_pictures() {
            flush(image, self.host, self.sink);
            (self.sink)(Event::Picture(picture));
        }
    }
}

/// How long a motion runs before its progress is reported, and the interval between reports.
const FIRST_PROGRESS: Duration = Duration::from_millis(150);
const BETWEEN_PROGRESS: Duration = Duration::from_millis(100);

/// Reports what was written to standard output, and changes in the states of tasks.
pub(super) fn flush(image: &mut Image, host: &mut SimulationHost, sink: &mut dyn FnMut(Event)) {
    host.audience.tell_tasks(image);
    let is_apart = image.output.has_errors_apart();
    let pieces = image.output.take_pieces();
    for (piece, _) in &pieces {
        let told = WatchEvent::Output(piece.clone());
        host.audience.tell(host.simulation.now(), &told);
    }
    let mut pieces = pieces.into_iter().peekable();
    while let Some((mut text, is_error)) = pieces.next() {
        let goes_on = |next: &(String, bool)| next.1 == is_error || !is_apart;
        while let Some((more, _)) = pieces.next_if(goes_on) {
            text.push_str(&more);
        }
        sink(match is_error && is_apart {
            true => Event::ErrorOutput(text),
            false => Event::Output(text),
        });
    }
}

impl Host for LiveHost<'_> {
    type Call = HostCall;

    fn call(&mut self, image: &mut Image, task: TaskId, call: HostCall) -> Reply {
        let reply = self.host.call(image, task, call);
        self.host.check_bounds();
        self.tell_pictures(image);
        reply
    }

    fn perform(&mut self, image: &mut Image, task: TaskId, motion: MotionRequest) -> Reply {
        let reply = self.host.perform(image, task, motion);
        self.host.check_bounds();
        self.tell_pictures(image);
        reply
    }

    fn advance(&mut self, image: &mut Image, now: f64, until: Option<f64>) -> Advance {
        flush(image, self.host, self.sink);
        let until = self.host.bounds.until(now, until);
        if !self.tells_progress {
            let check = &mut SimulationHost::check_bounds;
            return self.host.advance_watched(image, now, until, check);
        }
        let clock = Arc::clone(&self.host.audience.outside().clock);
        let begin = clock.now();
        let mut reported = begin;
        let sink = &mut *self.sink;
        let what = image.output.instead().map(str::to_owned);
        self.host.advance_watched(image, now, until, &mut |host| {
            host.check_bounds();
            // Real time determines what is shown, never what happens.
            let now = clock.now();
            let is_long = now.saturating_sub(begin) > FIRST_PROGRESS;
            if is_long && now.saturating_sub(reported) > BETWEEN_PROGRESS {
                reported = now;
                sink(Event::Progress(host.progress(what.as_deref())));
            }
        })
    }

    fn idle(&mut self, image: &mut Image, now: f64, until: f64) -> f64 {
        flush(image, self.host, self.sink);
        let until = self.host.bounds.until(now, Some(until)).unwrap_or(until);
        let reached = self.host.idle(image, now, until);
        self.host.check_bounds();
        reached
    }

    fn show_output(&mut self, image: &mut Image) {
        flush(image, self.host, self.sink);
    }

    fn cancel(&mut self, image: &mut Image, ticket: Ticket) {
        self.host.cancel(image, ticket);
    }

    fn stand_still(&mut self, image: &mut Image, now: f64) -> Advance {
        flush(image, self.host, self.sink);
        let advance = self.host.stand_still(image, now);
        self.host.check_bounds();
        advance
    }

    fn pause(&mut self, image: &mut Image, ticket: Ticket) {
        self.host.pause(image, ticket);
    }

    fn wake(&mut self, image: &mut Image, ticket: Ticket) {
        self.host.wake(image, ticket);
    }
}
