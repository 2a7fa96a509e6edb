//! Writes messages to a file.

use std::collections::BTreeSet;
use std::io::Write;
use std::sync::Arc;

use indexmap::IndexMap;
use serde::Serialize;

use super::RecordingError;
use super::attachment;
use super::channel::Channel;
use super::contacts::contacts;
use super::description;
use super::episode::{EpisodeBuilder, Wanted};
use super::markers::Markers;
use super::mcap_file::McapFile;
use super::message::{
    Axes, CameraCalibration, CompressedImage, FrameTransform, FrameTransforms, Held, JointState,
    JointStates, KeyValuePair, Log, PathMessage, PoseMessage, SceneEntityDeletion, SceneUpdate,
    Shown, Stop, Task, Time, Touching,
};
use super::messages::{Message, seconds};
use super::protobuf::{descriptors, encoded};
use super::shapes::{MAP, entity, frame_of, lines, tidy};
use crate::picture::{Scene, render};
use crate::watch::base64::base64;
use crate::watch::{Frame, Kind, Node, Placed, TaskId, TaskNews, WatchEvent};
use robotics::perception::camera::Camera;
use robotics::world::World;
use spatial::Pose;

/// The level of what a program has printed: INFO, since some viewers take 0 for nothing. It has no name.
const PRINTED: u8 = 2;
/// The encoding of all messages but descriptions.
const PROTOBUF: &str = "protobuf";
/// The library named in the file's header.
const LIBRARY: &str = concat!("planwright ", env!("CARGO_PKG_VERSION"));

/// Time (s) after which all poses and joints are written again, not only what has changed: who
/// begins to read in the middle of the file then knows everything.
const ALL_AGAIN: f64 = 2.0;

/// Up to how many bytes what can be asked is kept, to be attached to the end: many hours. Of a longer recording it is
/// read from the messages.
const MAX_EPISODE: usize = 32 << 20;

/// Writes a recording.
pub(crate) struct RecordingWriter<W: Write> {
    file: McapFile<W>,
    ids: Vec<(Channel, u16)>,
    /// What can be asked of the recording, as long as that is not too much.
    episode: Option<EpisodeBuilder>,
    /// The channels of descriptions.
    descriptions: Vec<(Kind, u16)>,
    /// The objects that have been described, and in how many messages.
    described: (BTreeSet<u32>, u32),
    markers: Markers,
    /// Poses that were written last, in the frames of what carries the nodes.
    poses: IndexMap<u32, Placed>,
    /// Positions and velocities of joints that were written last.
    moved: Vec<(f64, f64)>,
    /// When everything was written last, and the time and positions of the last frame.
    last_all: f64,
    last: Option<(f64, Arc<[f64]>)>,
    last_picture: Vec<u8>,
    nodes: Vec<Arc<Node>>,
    joints: Vec<String>,
    /// Objects and other things that were shown last.
    objects: Vec<u32>,
    shown: Shown,
    /// An incomplete line of output.
    line: String,
    has_begun: bool,
}

impl<W: Write> RecordingWriter<W> {
    /// Starts a recording. `joints` are the names of the joints in every frame.
    pub(super) fn new(to: W, joints: Vec<String>) -> Result<Self, RecordingError> {
        let mut file = McapFile::begin(to, LIBRARY)?;
        let mut ids = Vec::new();
        let mut schemas: IndexMap<&str, u16> = IndexMap::new();
        for channel in Channel::ALL {
            let kind = channel.schema();
            let schema = match schemas.get(kind.name) {
                Some(known) => *known,
                None => file.add_schema(kind.name, PROTOBUF, &descriptors(kind))?,
            };
            schemas.insert(kind.name, schema);
            ids.push((
                channel,
                file.add_channel(schema, channel.topic(), PROTOBUF)?,
            ));
        }
        let definition = description::DEFINITION.as_bytes();
        let schema = file.add_schema(description::MESSAGE, "ros2msg", definition)?;
        let mut descriptions = Vec::new();
        for kind in Kind::ALL {
            let channel = file.add_channel(schema, description::topic(kind), "cdr")?;
            descriptions.push((kind, channel));
        }
        Ok(Self {
            file,
            ids,
            episode: Some(EpisodeBuilder::new(Wanted::ALL)),
            descriptions,
            described: Default::default(),
            markers: Markers::default(),
            poses: IndexMap::new(),
            moved: Vec::new(),
            last_all: f64::NEG_INFINITY,
            last: None,
            last_picture: Vec::new(),
            nodes: Vec::new(),
            joints,
            objects: Vec::new(),
            shown: Shown::default(),
            line: String::new(),
            has_begun: false,
        })
    }

    /// Writes a frame; `nodes` are the new nodes.
    pub(super) fn frame(
        &mut self,
        nodes: Vec<Arc<Node>>,
        frame: &Frame,
    ) -> Result<(), RecordingError> {
        self.nodes.extend(nodes);
        let time = frame.time;
        if !self.has_begun {
            self.has_begun = true;
            let still = self.nodes.iter().filter_map(|n| n.still.as_ref());
            let still = still.filter_map(|p| self.transform(time, p, MAP.to_owned()));
            let transforms = still.collect();
            self.write(Channel::Still, time, &FrameTransforms { transforms })?;
            for (kind, name) in [(Kind::Robot, "robot"), (Kind::Furniture, "kitchen")] {
                let nodes = self.nodes.iter().filter(|node| node.kind == kind);
                let text = description::description(name, nodes.map(AsRef::as_ref));
                self.describe(time, kind, text)?;
            }
            let fixed = self.nodes.iter().filter(|n| n.kind != Kind::Object);
            let seen = fixed.filter(|n| !n.mesh.triangles.is_empty());
            let entities = seen.map(|node| entity(node, time)).collect();
            let deletions = Vec::new();
            self.write(
                Channel::Furnishing,
                time,
                &SceneUpdate {
                    deletions,
                    entities,
                },
            )?;
        }
        self.write_objects(frame)?;
        self.write_shown(frame)?;
        let has_all = time >= self.last_all + ALL_AGAIN || time < self.last_all;
        if has_all {
            self.last_all = time;
        }
        self.write_joints(frame, has_all)?;
        self.write_poses(frame, has_all)
    }

    /// Writes the poses that have changed, each in the frame of what carries the node.
    fn write_poses(&mut self, frame: &Frame, has_all: bool) -> Result<(), RecordingError> {
        let at = |id: u32| {
            let place = frame.placed.binary_search_by_key(&id, |p| p.node).ok()?;
            frame.placed.get(place)
        };
        let mut transforms = Vec::new();
        for placed in &frame.placed {
            let parent = self.node(placed.node).and_then(|node| node.parent);
            let carrier = parent.and_then(|id| Some((id, at(id)?)));
            let own = match carrier {
                Some((_, carrier)) => placed.seen_from(carrier),
                None => *placed,
            };
            let own = Placed {
                at: own.at.map(tidy),
                turn: own.turn.map(tidy),
                ..own
            };
            // That of the robot's root is always written: it makes a frame of a message in which
            // nothing has moved, and some readers do not expect a message without transforms.
            let is_root = self
                .node(placed.node)
                .is_some_and(|n| n.kind == Kind::Robot)
                && carrier.is_none();
            if !has_all && !is_root && self.poses.get(&placed.node) == Some(&own) {
                continue;
            }
            self.poses.insert(placed.node, own);
            let parent = carrier.and_then(|(id, _)| self.frame_id(id));
            let parent = parent.unwrap_or_else(|| MAP.to_owned());
            transforms.extend(self.transform(frame.time, &own, parent));
        }
        // What is not in the world any more is written when it is again.
        self.poses.retain(|id, _| at(*id).is_some());
        self.write(
            Channel::Transforms,
            frame.time,
            &FrameTransforms { transforms },
        )
    }

    fn transform(&self, time: f64, placed: &Placed, parent: String) -> Option<FrameTransform> {
        Some(FrameTransform {
            timestamp: Time::new(time),
            parent_frame_id: parent,
            child_frame_id: self.frame_id(placed.node)?,
            translation: placed.at.map(tidy).into(),
            rotation: placed.turn.map(tidy).into(),
        })
    }

    /// Writes positions and velocities of the joints of which one has changed.
    fn write_joints(&mut self, frame: &Frame, has_all: bool) -> Result<(), RecordingError> {
        let rounded = |value: f64| (value * 1e6).round() / 1e6;
        let last = self.last.take();
        let velocity = |i: usize, position: f64| {
            let (time, joints) = last.as_ref()?;
            let passed = frame.time - time;
            let before = joints.get(i).filter(|_| passed > 1e-6)?;
            Some((position - before) / passed)
        };
        let positions = frame.joints.iter().enumerate();
        let now: Vec<(f64, f64)> = positions
            .map(|(i, p)| (rounded(*p), rounded(velocity(i, *p).unwrap_or(0.0))))
            .collect();
        let joints = self.joints.iter().zip(&now).enumerate();
        let changed = joints.filter(|(i, (_, state))| has_all || self.moved.get(*i) != Some(state));
        let states = JointStates {
            timestamp: Time::new(frame.time),
            joints: changed
                .map(|(_, (name, (position, velocity)))| JointState {
                    name: name.clone(),
                    position: *position,
                    velocity: *velocity,
                })
                .collect(),
        };
        self.moved = now;
        self.last = Some((frame.time, Arc::clone(&frame.joints)));
        if states.joints.is_empty() {
            return Ok(());
        }
        self.write(Channel::Joints, frame.time, &states)
    }

    fn write_objects(&mut self, frame: &Frame) -> Result<(), RecordingError> {
        let is_object = |id: &u32| self.node(*id).is_some_and(|node| node.kind == Kind::Object);
        let here: Vec<u32> = frame
            .placed
            .iter()
            .map(|p| p.node)
            .filter(is_object)
            .collect();
        if here == self.objects {
            return Ok(());
        }
        let nodes = here.iter().filter_map(|id| self.node(*id));
        let update = SceneUpdate {
            deletions: vec![all_deleted(frame.time)],
            entities: nodes.map(|node| entity(node, frame.time)).collect(),
        };
        self.write(Channel::Objects, frame.time, &update)?;
        let (described, messages) = &mut self.described;
        let new = here.iter().filter(|id| described.insert(**id));
        let new: Vec<u32> = new.copied().collect();
        self.objects = here;
        if new.is_empty() {
            return Ok(());
        }
        *messages += 1;
        let name = match *messages {
            1 => "objects".to_owned(),
            number => format!("objects {number}"),
        };
        let nodes = new.iter().filter_map(|id| self.node(*id));
        let text = description::description(&name, nodes);
        self.describe(frame.time, Kind::Object, text)
    }

    /// Writes a description of nodes of a kind, if there is one.
    fn describe(
        &mut self,
        time: f64,
        kind: Kind,
        text: Option<String>,
    ) -> Result<(), RecordingError> {
        let channel = self.descriptions.iter().find(|(known, _)| *known == kind);
        if let (Some((_, channel)), Some(text)) = (channel, text) {
            let data = description::message(&text);
            self.file.add(*channel, Time::nanoseconds(time), &data)?;
        }
        Ok(())
    }

    fn write_shown(&mut self, frame: &Frame) -> Result<(), RecordingError> {
        let frame_id = |id: u32| self.frame_id(id);
        let shown = Shown {
            timestamp: self.shown.timestamp,
            held: (frame.holds.iter())
                .filter_map(|hold| {
                    Some(Held {
                        object: frame_id(hold.object)?,
                        link: hold.link.to_string(),
                        force: hold.force,
                    })
                })
                .collect(),
            touching: (frame.presses.iter())
                .filter_map(|press| {
                    Some(Touching {
                        link: press.body.and_then(frame_id).unwrap_or_default(),
                        object: frame_id(press.object)?,
                        position: press.at.into(),
                        force: press.force.into(),
                    })
                })
                .collect(),
            stops: (frame.hits.iter())
                .map(|hit| Stop {
                    frames: hit.nodes.iter().filter_map(|id| frame_id(*id)).collect(),
                    position: hit.at.into(),
                })
                .collect(),
            axes: (frame.axes.iter())
                .map(|(place, length)| Axes {
                    pose: PoseMessage {
                        position: place.at.into(),
                        orientation: place.turn.into(),
                    },
                    length: *length,
                })
                .collect(),
            paths: (frame.paths.iter())
                .map(|path| PathMessage {
                    what: path.what.to_owned(),
                    frame_id: path
                        .frame
                        .and_then(frame_id)
                        .unwrap_or_else(|| MAP.to_owned()),
                    points: path.points.iter().map(|p| (*p).into()).collect(),
                })
                .collect(),
        };
        if shown == self.shown {
            return Ok(());
        }
        let update = |entities| SceneUpdate {
            deletions: vec![all_deleted(frame.time)],
            entities,
        };
        let before = std::mem::replace(&mut self.shown, shown);
        self.shown.timestamp = Time::new(frame.time);
        let shown = self.shown.clone();
        if before.touching != shown.touching {
            let arrows = update(vec![contacts(frame)]);
            self.write(Channel::Contacts, frame.time, &arrows)?;
        }
        let drawn = |shown: &Shown| (shown.stops.clone(), shown.axes.clone(), shown.paths.clone());
        if drawn(&before) != drawn(&shown) {
            let lines = update(lines(frame, |id| self.frame_id(id)));
            self.write(Channel::Overlay, frame.time, &lines)?;
        }
        self.write(Channel::Shown, frame.time, &shown)
    }

    /// Writes what the robot's camera sees in the world.
    pub(super) fn picture(&mut self, time: f64, world: &World) -> Result<(), RecordingError> {
        let description = world.models().description.camera();
        let pose: Pose = world.link_pose(description.frame);
        let camera = Camera::new(description, pose);
        let mut png = Vec::new();
        render(&Scene::of(world), &camera).write_png(&mut png)?;
        if png == self.last_picture {
            return Ok(());
        }
        self.last_picture.clone_from(&png);
        let frame_id = world.models().robot.link(description.frame).name.clone();
        let image = CompressedImage {
            timestamp: Time::new(time),
            frame_id: frame_id.clone(),
            data: base64(&png),
            format: "png".to_owned(),
        };
        let (f, x, y) = (
            camera.focal_length(),
            camera.width as f64 / 2.0,
            camera.height as f64 / 2.0,
        );
        let calibration = CameraCalibration {
            timestamp: Time::new(time),
            frame_id,
            width: u32::try_from(camera.width).unwrap_or(u32::MAX),
            height: u32::try_from(camera.height).unwrap_or(u32::MAX),
            distortion_model: "plumb_bob".to_owned(),
            D: vec![0.0; 5],
            K: [f, 0.0, x, 0.0, f, y, 0.0, 0.0, 1.0],
            R: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
            P: [f, 0.0, x, 0.0, 0.0, f, y, 0.0, 0.0, 0.0, 1.0, 0.0],
        };
        self.write(Channel::Picture, time, &image)?;
        self.write(Channel::Calibration, time, &calibration)
    }

    /// Writes an event.
    pub(super) fn event(&mut self, time: f64, what: &WatchEvent) -> Result<(), RecordingError> {
        match what {
            // A message of the log comes by itself, with all its lines.
            WatchEvent::Output(text) if self.line.is_empty() && logged(text).is_some() => {
                self.log(time, text.trim_end_matches('\n'))
            }
            WatchEvent::Output(text) => {
                self.line.push_str(text);
                let text = std::mem::take(&mut self.line);
                let mut lines = text.split_inclusive('\n').peekable();
                while let Some(line) = lines.next() {
                    if lines.peek().is_none() && !line.ends_with('\n') {
                        line.clone_into(&mut self.line);
                    } else {
                        self.log(time, line.trim_end_matches('\n'))?;
                    }
                }
                Ok(())
            }
            WatchEvent::Halted(halt) => self.log_at(time, 4, halt.kind.name(), &halt.report),
            WatchEvent::Resumed => Ok(()),
            WatchEvent::Task(news) => self.task(time, news),
        }
    }

    fn log(&mut self, time: f64, line: &str) -> Result<(), RecordingError> {
        match logged(line) {
            Some((tags, level, text)) => self.log_at(time, level, tags, text),
            None if line.trim().is_empty() => Ok(()),
            None => self.log_at(time, PRINTED, "", line),
        }
    }

    fn log_at(
        &mut self,
        time: f64,
        level: u8,
        name: &str,
        text: &str,
    ) -> Result<(), RecordingError> {
        let log = Log {
            timestamp: Time::new(time),
            level,
            message: text.to_owned(),
            name: name.to_owned(),
            file: String::new(),
            line: 0,
        };
        self.write(Channel::Log, time, &log)
    }

    fn task(&mut self, time: f64, news: &TaskNews) -> Result<(), RecordingError> {
        let root = |node: &&Arc<Node>| node.kind == Kind::Robot && node.parent.is_none();
        let carrier = self.nodes.iter().find(root);
        let carrier = carrier.map_or_else(|| MAP.to_owned(), |node| frame_of(node));
        let update = self.markers.hear(time, news, &carrier);
        if let Some(update) = update {
            self.write(Channel::Markers, time, &update)?;
        }
        let about = news.about.as_deref().cloned().unwrap_or_default();
        let parameters = about.keys.into_iter();
        let task = Task {
            timestamp: Time::new(time),
            id: news.id.text(),
            parent: news.parent.map(TaskId::text).unwrap_or_default(),
            name: news.name.clone(),
            state: news.state.name().to_owned(),
            failure: news.failure.clone(),
            class: news.class.clone(),
            result: news.result.clone(),
            parameters: parameters
                .map(|(key, value)| KeyValuePair { key, value })
                .collect(),
            place: about.place,
            line: about.line,
            module: about.module,
        };
        self.write(Channel::Tasks, time, &task)
    }

    fn write(
        &mut self,
        channel: Channel,
        time: f64,
        message: &impl Serialize,
    ) -> Result<(), RecordingError> {
        let data = encoded(channel.schema(), &serde_json::to_value(message)?);
        let Some((_, id)) = self.ids.iter().find(|(known, _)| *known == channel) else {
            return Ok(());
        };
        let nanoseconds = Time::nanoseconds(time);
        self.file.add(*id, nanoseconds, &data)?;
        if Wanted::ALL.needs(channel)
            && let Some(episode) = &mut self.episode
        {
            episode.take(&Message {
                channel,
                encoding: PROTOBUF,
                time: seconds(nanoseconds),
                data: &data,
            })?;
            if episode.bytes() > MAX_EPISODE {
                self.episode = None;
            }
        }
        Ok(())
    }

    /// Ends the file.
    pub(super) fn finish(mut self) -> Result<(), RecordingError> {
        let line = std::mem::take(&mut self.line);
        if !line.is_empty() {
            let time = self.shown.timestamp;
            self.log(f64::from(time.sec), &line)?;
        }
        if let Some(episode) = self.episode.take() {
            attachment::write(&mut self.file, &episode.relations())?;
        }
        self.file.finish()?;
        Ok(())
    }

    fn node(&self, id: u32) -> Option<&Node> {
        self.nodes.get(id as usize).map(AsRef::as_ref)
    }

    fn frame_id(&self, id: u32) -> Option<String> {
        self.node(id).map(frame_of)
    }
}

pub(super) fn all_deleted(time: f64) -> SceneEntityDeletion {
    SceneEntityDeletion {
        timestamp: Time::new(time),
        kind: 1,
        id: String::new(),
    }
}

/// The tags, the level and the text of a log message, `[(TAG …) LEVEL] seconds: text`; everything else was printed.
fn logged(text: &str) -> Option<(&str, u8, &str)> {
    let rest = text.strip_prefix("[(")?;
    let (tags, rest) = rest.split_once(") ")?;
    let (level, rest) = rest.split_once("] ")?;
    let (_, text) = rest.split_once(": ")?;
    let levels = ["DEBUG", "INFO", "WARN", "ERROR"];
    let level = (1..).zip(levels).find(|(_, name)| *name == level)?.0;
    Some((tags, level, text))
}
