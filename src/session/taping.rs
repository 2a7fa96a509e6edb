//! Recording the session on a tape, and playing it.

use std::rc::Rc;
use std::sync::Arc;

use super::Session;
use super::dialogue::Taping;
use super::tape::{Frame, Part};
use view::watch::Cause;

impl Taping for Session {
    fn fingerprint(&self) -> u32 {
        let options = &self.options;
        let mut sum = crc32fast::Hasher::new();
        sum.update(&options.seed.to_le_bytes());
        sum.update(&[options.log_level as u8]);
        let files = [
            &options.robot,
            &options.robot_description,
            &options.world,
            &options.world_description,
        ];
        if let Some(noise) = &options.noise {
            sum.update(&[3]);
            sum.update(noise.as_bytes());
        }
        for (number, file) in [0, 1, 2, 4_u8].into_iter().zip(files) {
            if let Some((name, text)) = file {
                for part in [&[number], name.as_bytes(), text.as_bytes()] {
                    sum.update(&part.len().to_le_bytes());
                    sum.update(part);
                }
            }
        }
        sum.finalize()
    }

    fn record_next(&mut self, on: bool) {
        let tape = &mut self.host.simulation.tape;
        if on {
            tape.record();
            // What is filmed and recorded has to be seen, whenever it happens.
            if self.host.audience.writes_files() {
                tape.spoil();
            }
        } else {
            tape.stop();
        }
    }

    fn play_next(&mut self, part: &Part) -> bool {
        let stop = Arc::clone(self.image.interrupt());
        !self.host.audience.writes_files() && self.host.simulation.tape.play(part, stop)
    }

    fn recorded(&mut self) -> Option<Part> {
        let simulation = &mut self.host.simulation;
        if !simulation.tape.is_recording() {
            return None;
        }
        if self.host.audience.writes_files() {
            simulation.tape.spoil();
        }
        let rests = self.console.level() == 0 && simulation.shown().jobs.is_idle();
        let end = match rests {
            true => simulation.frame(&self.image).map(|frame| frame.number),
            false => None,
        };
        // A snapshot that is not on the tape cannot come back from it.
        let needed = self.host.person.snapshots.frames();
        let end = end.filter(|_| needed.is_some());
        let mut needed = needed.unwrap_or_default();
        needed.extend(simulation.last_failure_frame());
        simulation.tape.finish(end, needed)
    }

    fn was_played(&self) -> bool {
        self.host.simulation.tape.was_played()
    }

    fn has_failed(&self) -> bool {
        self.host.simulation.tape.has_failed()
    }

    fn has_moved(&self) -> bool {
        self.host.simulation.tape.has_moved()
    }

    fn know_frames(&mut self, frames: Vec<Rc<Frame>>) {
        self.host.simulation.tape.know(frames);
    }

    fn settle(&mut self, frame: u64) -> Option<u64> {
        // All snapshots have to be there, too.
        self.host.person.snapshots.frames()?;
        let simulation = &mut self.host.simulation;
        let frame = simulation.tape.frame(frame)?;
        simulation.tape.stop();
        if !simulation.load(&mut self.image, &frame) {
            return None;
        }
        self.host.audience.show(simulation, Cause::Edit);
        Some(frame.hash)
    }

    fn begin_anew(&mut self) -> bool {
        // A tape that does not fit has set it; an interrupt from now on is heard.
        let flag = Arc::clone(self.image.interrupt());
        flag.store(false, std::sync::atomic::Ordering::Relaxed);
        let Ok(mut fresh) = Session::new(&self.options) else {
            return false;
        };
        let Some(limits) = Rc::get_mut(&mut fresh.image.limits) else {
            return false;
        };
        limits.polls.use_flag(flag);
        std::mem::swap(&mut fresh.host.audience, &mut self.host.audience);
        fresh.host.person.can_serve = self.host.person.can_serve;
        *self = fresh;
        self.host.audience.show(&self.host.simulation, Cause::Edit);
        true
    }
}
