//! Records what happens in a session.

use std::io::Write;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};

use super::RecordingError;
use super::write::RecordingWriter;
use crate::watch::{Cause, Follower, Frame, FrameBuilder, Node, Observation, WatchEvent};
use robotics::world::{CollisionHit, World};

/// Simulated time (s) between two frames, and between two camera pictures.
const BETWEEN_FRAMES: f64 = 1.0 / 30.0;
const BETWEEN_PICTURES: f64 = 1.0;

/// Less than the duration (s) of a world step.
const EPSILON: f64 = 1e-4;

/// Number of items that may wait to be written: the session waits when there are more, so that
/// nothing is lost.
const MAX_WAITING: usize = 64;

/// Records what happens in a session until it is dropped. A separate thread produces texts and
/// pictures.
pub struct Recorder {
    frame_builder: FrameBuilder,
    known: usize,
    last: f64,
    last_picture: f64,
    to: Option<SyncSender<Item>>,
    thread: Option<JoinHandle<()>>,
}

/// The result of a recording, which is complete once the recorder is dropped.
#[derive(Clone, Default)]
pub struct RecordingResult(Arc<Mutex<Option<RecordingError>>>);

impl RecordingResult {
    /// The error, if there was one; only the first call returns it.
    pub fn take(&self) -> Option<RecordingError> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    fn fail(&self, error: RecordingError) {
        let mut place = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        place.get_or_insert(error);
    }
}

enum Item {
    Frame(Vec<Arc<Node>>, Box<Frame>),
    Picture(f64, Box<World>),
    WatchEvent(f64, WatchEvent),
}

impl Recorder {
    /// Starts a recording that goes into a file.
    pub fn new(
        file: impl Write + Send + 'static,
        world: &World,
    ) -> Result<(Self, RecordingResult), RecordingError> {
        let frame_builder = FrameBuilder::new(world);
        let names = frame_builder.joint_names(world);
        let writer = RecordingWriter::new(file, names)?;
        let (to, from) = sync_channel(MAX_WAITING);
        let result = RecordingResult::default();
        let shared_result = result.clone();
        let thread = thread::Builder::new()
            .name("recording".to_owned())
            .spawn(move || {
                if let Err(error) = write(writer, &from) {
                    shared_result.fail(error);
                    // Drain the channel, so that the sender does not wait for ever.
                    from.iter().for_each(drop);
                }
            })?;
        let recorder = Self {
            frame_builder,
            known: 0,
            last: f64::NEG_INFINITY,
            last_picture: f64::NEG_INFINITY,
            to: Some(to),
            thread: Some(thread),
        };
        Ok((recorder, result))
    }

    fn send(&self, item: Item) {
        if let Some(to) = &self.to {
            // A writer that has ended has reported why.
            let _ = to.send(item);
        }
    }
}

fn write<W: Write>(
    mut writer: RecordingWriter<W>,
    from: &Receiver<Item>,
) -> Result<(), RecordingError> {
    for item in from {
        match item {
            Item::Frame(nodes, frame) => writer.frame(nodes, &frame)?,
            Item::Picture(time, world) => writer.picture(time, &world)?,
            Item::WatchEvent(time, event) => writer.event(time, &event)?,
        }
    }
    writer.finish()
}

impl Follower for Recorder {
    fn see(&mut self, observation: &Observation<'_>, cause: Cause) {
        let is_due = observation.time >= self.last + BETWEEN_FRAMES - EPSILON;
        // Edits are recorded when the evaluation has ended, or at the next step.
        let is_wanted = match cause {
            Cause::Step => is_due,
            Cause::Rest => true,
            Cause::Edit | Cause::Wait => false,
        };
        if !is_wanted {
            return;
        }
        self.last = observation.time;
        let frame = Box::new(self.frame_builder.build(observation));
        let nodes = self.frame_builder.nodes();
        let fresh = nodes.get(self.known..).unwrap_or_default().to_vec();
        self.known = nodes.len();
        self.send(Item::Frame(fresh, frame));
        if observation.time >= self.last_picture + BETWEEN_PICTURES - EPSILON {
            self.last_picture = observation.time;
            self.send(Item::Picture(
                observation.time,
                Box::new(observation.world.clone()),
            ));
        }
    }

    fn hear(&mut self, time: f64, event: &WatchEvent) {
        self.send(Item::WatchEvent(time, event.clone()));
    }

    fn collide(&mut self, time: f64, hit: &CollisionHit) {
        self.frame_builder.collide(time, hit);
    }
}

impl Drop for Recorder {
    fn drop(&mut self) {
        drop(self.to.take());
        if let Some(thread) = self.thread.take() {
            // Any error is in the result.
            drop(thread.join());
        }
    }
}
