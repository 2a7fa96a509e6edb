//! Sends what a session looks like, in real time, to whoever listens.
//!
//! The session only leaves its newest state; a thread of its own sends it at a steady rate. So the session
//! never waits for the network, and nothing in it depends on who listens.

use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use super::background::Background;
use super::camera_broadcast::{CameraBroadcast, CameraFollow};
use super::node::{Node, NodeError, TopicQos, TopicWriter};
use crate::message;
use crate::scene_state::{SceneModel, SceneState};
use crate::value::Value;
use robotics::world::{CollisionHit, Models};
use view::watch::{Cause, Follower, Observation, WatchEvent};

/// Real time between two messages of a topic that is always sent: sixty in a second.
const PERIOD: Duration = Duration::from_nanos(1_000_000_000 / 60);

/// Minimum real time between two states that the session leaves.
const BETWEEN_STATES: Duration = Duration::from_millis(8);

/// Minimum real time between two messages with all markers.
const BETWEEN_MARKERS: Duration = Duration::from_millis(100);

/// Real time between two looks for those who listen in vain.
const BETWEEN_LOOKS: Duration = Duration::from_millis(200);

/// A robot whose state is older than this (real time) does not move.
const STILL: Duration = Duration::from_millis(100);

/// The newest state of a session, which every thread may ask for.
#[derive(Clone)]
pub struct Newest(Arc<Mutex<(Arc<SceneState>, Instant)>>);

impl Newest {
    /// The state.
    pub fn state(&self) -> Arc<SceneState> {
        self.get().0
    }

    /// The state with the real time at which the session left it.
    fn get(&self) -> (Arc<SceneState>, Instant) {
        self.0
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone()
    }

    fn set(&self, state: SceneState) {
        let mut newest = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        *newest = (Arc::new(state), Instant::now());
    }
}

/// Tells a person what is remarkable.
#[derive(Clone)]
pub(super) struct Remark(Arc<Mutex<dyn Fn(String) + Send>>);

impl Remark {
    /// Somebody listens to a topic who asks for more than it offers, by a policy of quality of service.
    pub(super) fn of_listener(&self, topic: &str, policy: &str) {
        let tell = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        tell(format!(
            "somebody listens to {topic} in vain: the listener asks for more than is offered by \
             quality of service ({policy})"
        ));
    }
}

/// A session that is sent. Ends when it is dropped.
pub struct Broadcast {
    model: Arc<SceneModel>,
    newest: Newest,
    _camera: CameraBroadcast,
    _sending: Background,
}

/// The follower that leaves the states of a session to be sent.
pub struct Follow {
    model: Arc<SceneModel>,
    newest: Newest,
    left: Option<Instant>,
    camera: CameraFollow,
}

impl Broadcast {
    /// Begins to send a session with these models. `description` is the robot's URDF; `remark` is told, once for each
    /// topic, if somebody listens in vain.
    pub fn start(
        node: &mut Node,
        models: &Models,
        description: &str,
        remark: impl Fn(String) + Send + 'static,
    ) -> Result<(Self, Follow), NodeError> {
        let model = Arc::new(SceneModel::new(models));
        let newest = Newest(Arc::new(Mutex::new((Arc::default(), Instant::now()))));
        let topics = Topics::open(node)?;
        topics.description.send(&message::text(description))?;
        topics
            .still_frames
            .send(&message::still_frames(now(), &model))?;
        let remark = Remark(Arc::new(Mutex::new(remark)));
        let (camera, camera_follow) = CameraBroadcast::start(node, models, remark.clone())?;
        let sender = Sending {
            model: Arc::clone(&model),
            newest: newest.clone(),
            topics,
            markers: Markers::default(),
            remark,
            remarked: Vec::new(),
            looked: Instant::now(),
        };
        let broadcast = Self {
            model: Arc::clone(&model),
            newest: newest.clone(),
            _camera: camera,
            _sending: Background::start(node, "ros2", |stopped| sender.run(stopped))?,
        };
        let follow = Follow {
            model,
            newest,
            left: None,
            camera: camera_follow,
        };
        Ok((broadcast, follow))
    }

    /// What never changes.
    pub fn model(&self) -> &Arc<SceneModel> {
        &self.model
    }

    /// What the session is like.
    pub fn newest(&self) -> &Newest {
        &self.newest
    }
}

impl Follower for Follow {
    fn see(&mut self, observation: &Observation<'_>, cause: Cause) {
        self.camera.see(observation.world, cause);
        let now = Instant::now();
        let is_new = |left: Instant| now.duration_since(left) >= BETWEEN_STATES;
        if self.left.is_some_and(|left| !is_new(left)) && cause == Cause::Step {
            return;
        }
        self.left = Some(now);
        let before = self.newest.state();
        let state = self
            .model
            .state(observation.time, observation.world, &before);
        self.newest.set(state);
    }

    fn hear(&mut self, _time: f64, _event: &WatchEvent) {}

    fn collide(&mut self, _time: f64, _hit: &CollisionHit) {}
}

/// The topics of a session.
struct Topics {
    description: TopicWriter,
    still_frames: TopicWriter,
    frames: TopicWriter,
    joints: TopicWriter,
    furniture_joints: TopicWriter,
    clock: TopicWriter,
    objects: TopicWriter,
    furniture: TopicWriter,
}

impl Topics {
    fn open(node: &mut Node) -> Result<Self, NodeError> {
        let text = "std_msgs/msg/String";
        let (tf, joints) = ("tf2_msgs/msg/TFMessage", "sensor_msgs/msg/JointState");
        let markers = "visualization_msgs/msg/MarkerArray";
        let mut open = |name, kind, qos| node.writer(name, kind, qos);
        Ok(Self {
            description: open("/robot_description", text, TopicQos::latched())?,
            still_frames: open("/tf_static", tf, TopicQos::latched())?,
            frames: open("/tf", tf, TopicQos::volatile(100))?,
            joints: open("/joint_states", joints, TopicQos::volatile(10))?,
            furniture_joints: open("/kitchen/joint_states", joints, TopicQos::volatile(10))?,
            clock: open(
                "/clock",
                "rosgraph_msgs/msg/Clock",
                TopicQos::best_effort(1),
            )?,
            objects: open("/objects", markers, TopicQos::latched())?,
            furniture: open("/kitchen/furniture", markers, TopicQos::latched())?,
        })
    }
}

impl Topics {
    fn all(&self) -> [&TopicWriter; 8] {
        [
            &self.description,
            &self.still_frames,
            &self.frames,
            &self.joints,
            &self.furniture_joints,
            &self.clock,
            &self.objects,
            &self.furniture,
        ]
    }
}

/// Which markers were sent last, and when.
#[derive(Default)]
struct Markers {
    shown: Option<Arc<SceneState>>,
    at: Option<Instant>,
}

/// What the thread has.
struct Sending {
    model: Arc<SceneModel>,
    newest: Newest,
    topics: Topics,
    markers: Markers,
    remark: Remark,
    /// The topics of which has been told that somebody listens in vain.
    remarked: Vec<String>,
    looked: Instant,
}

impl Sending {
    fn run(mut self, stopped: &Receiver<()>) {
        let mut next = Instant::now();
        loop {
            self.send();
            self.look_for_mismatches();
            next += PERIOD;
            let now = Instant::now();
            // What was missed by far is not made up for.
            if now.saturating_duration_since(next) > 6 * PERIOD {
                next = now;
            }
            match stopped.recv_timeout(next.saturating_duration_since(now)) {
                Err(RecvTimeoutError::Timeout) => {}
                Ok(()) | Err(RecvTimeoutError::Disconnected) => return,
            }
        }
    }

    fn send(&mut self) {
        let (state, left) = self.newest.get();
        if state.positions.len() != self.model.joints.len() {
            // The session has not left any state yet.
            return;
        }
        let (stamp, model, topics) = (now(), &self.model, &self.topics);
        let moves = left.elapsed() < STILL;
        let joints = message::joint_states(
            stamp,
            &model.joints,
            &state.positions,
            state.velocities.as_deref().filter(|_| moves),
        );
        let furniture = message::joint_states(
            stamp,
            &model.furniture_joints,
            &state.furniture_positions,
            None,
        );
        self.write(&topics.clock, &message::clock(stamp));
        self.write(
            &topics.frames,
            &message::moving_frames(stamp, model, &state),
        );
        self.write(&topics.joints, &joints);
        self.write(&topics.furniture_joints, &furniture);
        self.send_markers(stamp, &state);
    }

    /// Tells of those who listen in vain.
    fn look_for_mismatches(&mut self) {
        if self.looked.elapsed() < BETWEEN_LOOKS {
            return;
        }
        self.looked = Instant::now();
        for topic in self.topics.all() {
            let Some(policy) = topic.mismatch() else {
                continue;
            };
            if self.remarked.iter().any(|known| known == topic.topic()) {
                continue;
            }
            let name = topic.topic();
            self.remark.of_listener(name, &policy);
            self.remarked.push(name.to_owned());
        }
    }

    fn send_markers(&mut self, stamp: Duration, state: &Arc<SceneState>) {
        let now = Instant::now();
        let is_early = |at: Instant| now.duration_since(at) < BETWEEN_MARKERS;
        if self.markers.at.is_some_and(is_early) {
            return;
        }
        let shown = self.markers.shown.as_deref();
        if shown.is_none_or(|shown| shown.objects != state.objects) {
            let objects = message::object_markers(stamp, &self.model, state);
            self.write(&self.topics.objects, &objects);
            self.markers.at = Some(now);
        }
        if shown.is_none_or(|shown| shown.furniture != state.furniture) {
            let furniture = message::furniture_markers(stamp, &self.model, state);
            self.write(&self.topics.furniture, &furniture);
            self.markers.at = Some(now);
        }
        self.markers.shown = Some(Arc::clone(state));
    }

    fn write(&self, topic: &TopicWriter, value: &Value) {
        // What cannot be sent is lost, as on a network; the next message comes soon.
        drop(topic.send(value));
    }
}

/// Real time since 1970, which stamps all messages.
pub(super) fn now() -> Duration {
    let now = SystemTime::now().duration_since(UNIX_EPOCH);
    now.unwrap_or_default()
}
