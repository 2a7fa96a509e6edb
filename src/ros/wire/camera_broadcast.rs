//! Sends what the robot's camera sees, while somebody listens.
//!
//! The session leaves the bodies that are to be drawn; a thread of its own draws and sends them. So a picture costs the
//! session no more than the list of bodies, and nothing in it depends on who looks.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::background::Background;
use super::broadcast::{Remark, now};
use super::node::{Node, NodeError, TopicQos, TopicWriter};
use crate::message;
use robotics::perception::Camera;
use robotics::world::{Models, World};
use view::picture::{Looks, Scene, render};
use view::watch::Cause;

/// Real time between two pictures.
const PERIOD: Duration = Duration::from_millis(200);
/// Maximum width (pixels) of a picture.
const MAX_WIDTH: usize = 320;

/// What a camera has before it.
struct Shot {
    scene: Scene,
    camera: Camera,
}

/// The newest of them, and whether somebody wants it.
#[derive(Clone, Default)]
struct Newest {
    shot: Arc<Mutex<Option<Arc<Shot>>>>,
    is_wanted: Arc<AtomicBool>,
}

/// The pictures of a session that are sent. Ends when it is dropped.
pub(super) struct CameraBroadcast {
    _sending: Background,
}

/// Leaves what the camera has before it.
pub(super) struct CameraFollow {
    looks: Looks,
    newest: Newest,
    left: Option<Instant>,
}

impl CameraBroadcast {
    /// Begins to send pictures, once there is something to be seen.
    pub(super) fn start(
        node: &mut Node,
        models: &Models,
        remark: Remark,
    ) -> Result<(Self, CameraFollow), NodeError> {
        let newest = Newest::default();
        let qos = TopicQos::best_effort(5);
        let sending = Sending {
            frame: models
                .robot
                .link(models.description.camera().frame)
                .name
                .clone(),
            image: node.writer("/camera/image", "sensor_msgs/msg/Image", qos)?,
            info: node.writer("/camera/camera_info", "sensor_msgs/msg/CameraInfo", qos)?,
            newest: newest.clone(),
            remark,
            remarked: Vec::new(),
        };
        let broadcast = Self {
            _sending: Background::start(node, "camera", |stopped| sending.run(stopped))?,
        };
        let follow = CameraFollow {
            looks: Looks::of(models),
            newest,
            left: None,
        };
        Ok((broadcast, follow))
    }
}

impl CameraFollow {
    /// Sees the world, and leaves what the camera has before it: now and then while somebody looks, else when something
    /// has ended.
    pub(super) fn see(&mut self, world: &World, cause: Cause) {
        let is_due = self.left.is_none_or(|left| left.elapsed() >= PERIOD);
        let is_wanted = self.newest.is_wanted.load(Ordering::Relaxed) && is_due;
        if cause == Cause::Step && !is_wanted && self.left.is_some() {
            return;
        }
        self.left = Some(Instant::now());
        let through = world.models().description.camera();
        let native = Camera::new(through, world.link_pose(through.frame));
        let width = native.width.min(MAX_WIDTH);
        let shot = Shot {
            scene: self.looks.scene(world),
            camera: Camera {
                width,
                height: width * native.height / native.width.max(1),
                ..native
            },
        };
        let newest = &self.newest.shot;
        *newest.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::new(shot));
    }
}

/// What the thread has.
struct Sending {
    frame: String,
    image: TopicWriter,
    info: TopicWriter,
    newest: Newest,
    remark: Remark,
    remarked: Vec<String>,
}

impl Sending {
    fn run(mut self, stopped: &Receiver<()>) {
        loop {
            let begin = Instant::now();
            let [image, info] = [&self.image, &self.info].map(TopicWriter::listeners);
            self.newest.is_wanted.store(image > 0, Ordering::Relaxed);
            if image > 0 || info > 0 {
                self.send(image > 0);
            }
            self.remark();
            match stopped.recv_timeout(PERIOD.saturating_sub(begin.elapsed())) {
                Err(RecvTimeoutError::Timeout) => {}
                Ok(()) | Err(RecvTimeoutError::Disconnected) => return,
            }
        }
    }

    fn send(&self, draws: bool) {
        let newest = self.newest.shot.lock();
        let Some(shot) = newest.unwrap_or_else(PoisonError::into_inner).clone() else {
            return;
        };
        let stamp = now();
        // What cannot be sent is lost, as on a network; the next one comes soon.
        drop(
            self.info
                .send(&message::camera_info(stamp, &self.frame, &shot.camera)),
        );
        if draws {
            let picture = render(&shot.scene, &shot.camera);
            drop(
                self.image
                    .send(&message::image(stamp, &self.frame, &picture)),
            );
        }
    }

    /// Tells of those who listen in vain.
    fn remark(&mut self) {
        for topic in [&self.image, &self.info] {
            let name = topic.topic().to_owned();
            if let Some(policy) = topic.mismatch()
                && !self.remarked.contains(&name)
            {
                self.remark.of_listener(&name, &policy);
                self.remarked.push(name);
            }
        }
    }
}
