//! Writes messages to a file.

use std::collections::BTreeMap;
use std::io::{Seek, Write};
use std::sync::Arc;

use mcap::records::MessageHeader;
use serde::Serialize;

use super::RecordingError;
use super::channel::Channel;
use super::message::{
    Axes, CameraCalibration, CompressedImage, FrameTransform, FrameTransforms, Held, JointState,
    JointStates, Log, PathMessage, PoseMessage, SceneEntityDeletion, SceneUpdate, Shown, Stop,
    Task, Time,
};
use super::shapes::{MAP, entity, frame_of, lines, tidy};
use crate::perception::camera::Camera;
use crate::picture::{Scene, render};
use crate::spatial::Pose;
use crate::watch::base64::base64;
use crate::watch::{Frame, Kind, Node, Placed, TaskId, TaskNews, WatchEvent};
use crate::world::World;

/// The library named in the file's header.
const LIBRARY: &str = concat!("planwright ", env!("CARGO_PKG_VERSION"));

/// Writes a recording.
pub(crate) struct RecordingWriter<W: Write + Seek> {
    writer: mcap::Writer<W>,
    ids: Vec<(Channel, u16)>,
    nodes: Vec<Arc<Node>>,
    joints: Vec<String>,
    /// Objects and other things that were shown last.
    objects: Vec<u32>,
    shown: Shown,
    /// An incomplete line of output.
    line: String,
    sequence: u32,
    has_begun: bool,
}

impl<W: Write + Seek> RecordingWriter<W> {
    /// Starts a recording. `joints` are the names of the joints in every frame.
    pub(crate) fn new(to: W, joints: Vec<String>) -> Result<Self, RecordingError> {
        let options = mcap::WriteOptions::new().compression(None).library(LIBRARY);
        let mut writer = options.create(to)?;
        let mut ids = Vec::new();
        for channel in Channel::ALL {
            let (name, text) = channel.schema();
            let mut text = text;
            if let Some(map) = text.as_object_mut() {
                map.insert("title".to_owned(), name.into());
            }
            let schema = writer.add_schema(name, "jsonschema", text.to_string().as_bytes())?;
            let id = writer.add_channel(schema, channel.topic(), "json", &BTreeMap::new())?;
            ids.push((channel, id));
        }
        Ok(Self {
            writer,
            ids,
            nodes: Vec::new(),
            joints,
            objects: Vec::new(),
            shown: Shown::default(),
            line: String::new(),
            sequence: 0,
            has_begun: false,
        })
    }

    /// Writes a frame; `nodes` are the new nodes.
    pub(crate) fn frame(
        &mut self,
        nodes: Vec<Arc<Node>>,
        frame: &Frame,
    ) -> Result<(), RecordingError> {
        self.nodes.extend(nodes);
        let time = frame.time;
        if !self.has_begun {
            self.has_begun = true;
            let still = self.nodes.iter().filter_map(|n| n.still.as_ref());
            let still = self.transforms(time, still);
            self.write(Channel::Still, time, &still)?;
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
        let transforms = self.transforms(time, frame.placed.iter());
        self.write(Channel::Transforms, time, &transforms)?;
        let joints = self.joints.iter().zip(frame.joints.iter());
        let joints = joints.map(|(name, position)| JointState {
            name: name.clone(),
            position: (position * 1e6).round() / 1e6,
        });
        let states = JointStates {
            timestamp: Time::new(time),
            joints: joints.collect(),
        };
        self.write(Channel::Joints, time, &states)
    }

    fn transforms<'a>(
        &self,
        time: f64,
        placed: impl Iterator<Item = &'a Placed>,
    ) -> FrameTransforms {
        let transforms = placed.filter_map(|placed| {
            Some(FrameTransform {
                timestamp: Time::new(time),
                parent_frame_id: MAP.to_owned(),
                child_frame_id: self.frame_id(placed.node)?,
                translation: placed.at.map(tidy).into(),
                rotation: placed.turn.map(|v| (v * 1e6).round() / 1e6).into(),
            })
        });
        FrameTransforms {
            transforms: transforms.collect(),
        }
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
        self.objects = here;
        self.write(Channel::Objects, frame.time, &update)
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
                    })
                })
                .collect(),
            touching: (frame.touching.iter())
                .filter_map(|[a, b]| Some([frame_id(*a)?, frame_id(*b)?]))
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
        let update = SceneUpdate {
            deletions: vec![all_deleted(frame.time)],
            entities: lines(frame, frame_id),
        };
        self.shown = shown;
        self.shown.timestamp = Time::new(frame.time);
        let shown = self.shown.clone();
        self.write(Channel::Overlay, frame.time, &update)?;
        self.write(Channel::Shown, frame.time, &shown)
    }

    /// Writes what the robot's camera sees in the world.
    pub(crate) fn picture(&mut self, time: f64, world: &World) -> Result<(), RecordingError> {
        let description = world.models().description.camera();
        let pose: Pose = world.link_pose(description.frame);
        let camera = Camera::new(description, pose);
        let mut png = Vec::new();
        render(&Scene::of(world), &camera).write_png(&mut png)?;
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
    pub(crate) fn event(&mut self, time: f64, what: &WatchEvent) -> Result<(), RecordingError> {
        match what {
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
        // A log message is `[(TAG …) LEVEL] seconds: text`; everything else was printed.
        let parts = line.strip_prefix("[(").and_then(|rest| {
            let (tags, rest) = rest.split_once(") ")?;
            let (level, rest) = rest.split_once("] ")?;
            let (_, text) = rest.split_once(": ")?;
            let levels = ["DEBUG", "INFO", "WARN", "ERROR"];
            let level = (1..).zip(levels).find(|(_, name)| *name == level)?.0;
            Some((tags, level, text))
        });
        match parts {
            Some((tags, level, text)) => self.log_at(time, level, tags, text),
            None if line.trim().is_empty() => Ok(()),
            None => self.log_at(time, 0, "", line),
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
        let task = Task {
            timestamp: Time::new(time),
            id: news.id.text(),
            parent: news.parent.map(TaskId::text).unwrap_or_default(),
            name: news.name.clone(),
            state: news.state.name().to_owned(),
            failure: news.failure.clone(),
        };
        self.write(Channel::Tasks, time, &task)
    }

    fn write(
        &mut self,
        channel: Channel,
        time: f64,
        message: &impl Serialize,
    ) -> Result<(), RecordingError> {
        let data = serde_json::to_vec(message)?;
        let Some((_, id)) = self.ids.iter().find(|(known, _)| *known == channel) else {
            return Ok(());
        };
        let nanoseconds = Time::nanoseconds(time);
        let header = MessageHeader {
            channel_id: *id,
            sequence: self.sequence,
            log_time: nanoseconds,
            publish_time: nanoseconds,
        };
        self.sequence = self.sequence.wrapping_add(1);
        self.writer.write_to_known_channel(&header, &data)?;
        Ok(())
    }

    /// Ends the file.
    pub(crate) fn finish(mut self) -> Result<(), RecordingError> {
        let line = std::mem::take(&mut self.line);
        if !line.is_empty() {
            let time = self.shown.timestamp;
            self.log(f64::from(time.sec), &line)?;
        }
        self.writer.finish()?;
        self.writer.into_inner().flush()?;
        Ok(())
    }

    fn node(&self, id: u32) -> Option<&Node> {
        self.nodes.get(id as usize).map(AsRef::as_ref)
    }

    fn frame_id(&self, id: u32) -> Option<String> {
        self.node(id).map(frame_of)
    }
}

fn all_deleted(time: f64) -> SceneEntityDeletion {
    SceneEntityDeletion {
        timestamp: Time::new(time),
        kind: 1,
        id: String::new(),
    }
}
