//! Reading a recording back.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use indexmap::IndexMap;
use mcap::MessageStream;
use mcap::read::Options;
use serde::de::DeserializeOwned;

use super::RecordingError;
use super::channel::Channel;
use super::decompress::decompressed;
use super::message::{FrameTransform, FrameTransforms, Log, SceneUpdate, Shown, Task};
use super::shapes::{frame_of, node, path_name};
use crate::watch::live::History;
use crate::watch::{
    Frame, Halt, HaltKind, Hit, Hold, Kind, Node, Path, Placed, TaskId, TaskNews, TaskState,
    WatchEvent,
};

/// What was read from a recording.
#[derive(Debug, PartialEq)]
pub(crate) struct Recording {
    /// Number of frames.
    pub(crate) frames: usize,
    /// Number of news items.
    pub(crate) news: usize,
    /// Whether the file ends abruptly, as when the session was killed.
    pub(crate) is_cut_off: bool,
}

/// Reads a file's bytes into a history. Messages that are not ours are skipped.
///
/// Damage that makes the library for MCAP files panic is an error, too.
pub(crate) fn read_recording(bytes: &[u8], to: &History) -> Result<Recording, RecordingError> {
    let read = AssertUnwindSafe(|| read_messages(&decompressed(bytes)?, to));
    catch_unwind(read).unwrap_or_else(|payload| {
        let text = payload.downcast_ref::<String>().map(String::as_str);
        let text = text.or_else(|| payload.downcast_ref::<&str>().copied());
        let text = text.unwrap_or("no reason is given");
        Err(RecordingError::Reader(text.to_owned()))
    })
}

fn read_messages(bytes: &[u8], to: &History) -> Result<Recording, RecordingError> {
    let mut reader = Reader {
        to,
        nodes: Vec::new(),
        frame_ids: IndexMap::new(),
        still: IndexMap::new(),
        objects: IndexMap::new(),
        shown: Frame::default(),
        frames: 0,
        news: 0,
    };
    let mut is_cut_off = false;
    for message in MessageStream::new_with_options(bytes, Options::IgnoreEndMagic.into())? {
        match message {
            Ok(message) => reader.take(&message)?,
            // A session that was killed left an incomplete message at the end.
            Err(_) if reader.frames > 0 => {
                is_cut_off = true;
                break;
            }
            Err(error) => return Err(error.into()),
        }
    }
    if reader.frames == 0 {
        return Err(RecordingError::Foreign);
    }
    Ok(Recording {
        frames: reader.frames,
        news: reader.news,
        is_cut_off,
    })
}

struct Reader<'a> {
    to: &'a History,
    nodes: Vec<Arc<Node>>,
    /// Nodes by their frame IDs, for those that are in the world.
    frame_ids: IndexMap<String, u32>,
    /// Poses of the frames that cannot move.
    still: IndexMap<String, Placed>,
    /// Nodes of objects by the writer's numbers.
    objects: IndexMap<String, u32>,
    /// What is currently shown besides bodies.
    shown: Frame,
    frames: usize,
    news: usize,
}

impl Reader<'_> {
    fn take(&mut self, message: &mcap::Message<'_>) -> Result<(), RecordingError> {
        let Some(channel) = Channel::of_topic(&message.channel.topic) else {
            return Ok(());
        };
        if message.channel.message_encoding != "json" {
            return Ok(());
        }
        let time = message.log_time as f64 * 1e-9;
        let data = &message.data;
        match channel {
            Channel::Transforms => self.transforms(time, &parsed(data)?),
            Channel::Still => {
                let message: FrameTransforms = parsed(data)?;
                let placed = message.transforms.iter().filter_map(|transform| {
                    let frame_id = transform.child_frame_id.clone();
                    Some((frame_id, placed(transform, 0)?))
                });
                self.still.extend(placed);
            }
            Channel::Furnishing | Channel::Objects => {
                let update: SceneUpdate = parsed(data)?;
                self.scene(channel, &update);
            }
            Channel::Shown => {
                let shown: Shown = parsed(data)?;
                self.shown(&shown);
            }
            Channel::Log => {
                let log: Log = parsed(data)?;
                let level = ["", "DEBUG", "INFO", "WARN", "ERROR"].get(usize::from(log.level));
                let event = match (HaltKind::named(&log.name), level) {
                    (Some(kind), _) => WatchEvent::Halted(Halt::new(kind, log.message)),
                    (None, Some(&level)) if !level.is_empty() => WatchEvent::Output(format!(
                        "[({}) {level}] {time:.3}: {}\n",
                        log.name, log.message
                    )),
                    _ => WatchEvent::Output(format!("{}\n", log.message)),
                };
                self.add_news(time, &event);
            }
            Channel::Tasks => {
                let task: Task = parsed(data)?;
                if let Some(news) = news(task) {
                    self.add_news(time, &WatchEvent::Task(news));
                }
            }
            Channel::Joints | Channel::Picture | Channel::Calibration | Channel::Overlay => {}
        }
        Ok(())
    }

    fn add_news(&mut self, time: f64, event: &WatchEvent) {
        self.to.add_news(time, event);
        self.news += 1;
    }

    fn transforms(&mut self, time: f64, message: &FrameTransforms) {
        let mut placed: Vec<Placed> = Vec::new();
        for transform in &message.transforms {
            let frame_id = &transform.child_frame_id;
            let known = self.frame_ids.get(frame_id).copied();
            let id = match known {
                Some(id) => id,
                // A bare frame, such as the camera's.
                None if !frame_id.starts_with("object/") => self.add_frame(frame_id),
                None => continue,
            };
            placed.extend(self::placed(transform, id));
        }
        placed.sort_by_key(|p| p.node);
        placed.dedup_by_key(|p| p.node);
        let frame = Frame {
            time,
            placed,
            ..self.shown.clone()
        };
        self.frames += 1;
        self.to.publish(&self.nodes, Arc::new(frame), true);
    }

    fn scene(&mut self, channel: Channel, update: &SceneUpdate) {
        if channel == Channel::Objects {
            self.frame_ids
                .retain(|frame_id, _| !frame_id.starts_with("object/"));
        }
        for entity in &update.entities {
            let is_object = channel == Channel::Objects;
            let known = self.objects.get(&entity.id).copied().filter(|_| is_object);
            let id = match known {
                Some(id) => id,
                None => {
                    let id = self.next_id();
                    let still = self.still.get(&entity.frame_id);
                    let still = still.map(|place| Placed { node: id, ..*place });
                    let Some(node) = node(entity, id, still) else {
                        continue;
                    };
                    if is_object != (node.kind == Kind::Object) {
                        continue;
                    }
                    let id = self.add(node);
                    if is_object {
                        self.objects.insert(entity.id.clone(), id);
                    }
                    id
                }
            };
            self.frame_ids.insert(entity.frame_id.clone(), id);
        }
    }

    fn shown(&mut self, shown: &Shown) {
        let node = |frame_id: &String| self.frame_ids.get(frame_id).copied();
        let now = Frame {
            holds: (shown.held.iter())
                .filter_map(|held| {
                    Some(Hold {
                        object: node(&held.object)?,
                        link: held.link.as_str().into(),
                    })
                })
                .collect(),
            touching: (shown.touching.iter())
                .filter_map(|[a, b]| Some([node(a)?, node(b)?]))
                .collect(),
            hits: (shown.stops.iter())
                .map(|stop| Hit {
                    nodes: stop.frames.iter().filter_map(node).collect(),
                    at: stop.position.into(),
                })
                .collect(),
            axes: shown.axes.first().map(|axes| {
                let place = Placed {
                    node: 0,
                    at: axes.pose.position.into(),
                    turn: axes.pose.orientation.into(),
                };
                (place, axes.length)
            }),
            paths: (shown.paths.iter())
                .filter_map(|path| {
                    Some(Path {
                        what: path_name(&path.what)?,
                        frame: node(&path.frame_id),
                        points: path.points.iter().map(|p| (*p).into()).collect(),
                    })
                })
                .collect(),
            ..Frame::default()
        };
        self.shown = now;
    }

    fn add_frame(&mut self, frame_id: &str) -> u32 {
        let id = self.add(Node {
            id: self.next_id(),
            name: frame_id.to_owned(),
            kind: Kind::Robot,
            type_name: String::new(),
            parent: None,
            still: None,
            mesh: Arc::default(),
        });
        self.frame_ids.insert(frame_id.to_owned(), id);
        id
    }

    fn next_id(&self) -> u32 {
        u32::try_from(self.nodes.len()).unwrap_or(u32::MAX)
    }

    fn add(&mut self, node: Node) -> u32 {
        let id = node.id;
        debug_assert!(!frame_of(&node).is_empty());
        self.nodes.push(Arc::new(node));
        id
    }
}

/// The pose that a transform gives to the node, if it is valid.
fn placed(transform: &FrameTransform, node: u32) -> Option<Placed> {
    let at: [f32; 3] = transform.translation.into();
    let turn: [f32; 4] = transform.rotation.into();
    let is_finite = at.iter().chain(&turn).all(|n| n.is_finite());
    is_finite.then_some(Placed { node, at, turn })
}

fn parsed<T: DeserializeOwned>(data: &[u8]) -> Result<T, RecordingError> {
    Ok(serde_json::from_slice(data)?)
}

fn news(task: Task) -> Option<TaskNews> {
    Some(TaskNews {
        id: TaskId::of_text(&task.id)?,
        parent: TaskId::of_text(&task.parent),
        name: task.name,
        state: TaskState::named(&task.state)?,
        failure: task.failure,
        result: String::new(),
        about: None,
    })
}
