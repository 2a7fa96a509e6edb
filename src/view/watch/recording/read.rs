//! Reading a recording back.

use std::sync::Arc;

use defect::caught;
use indexmap::IndexMap;
use mcap::read::Options;
use mcap::{McapError, MessageStream};
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::RecordingError;
use super::channel::Channel;
use super::decompress::decompressed;
use super::message::{FrameTransform, FrameTransforms, JointStates, Log, SceneUpdate, Shown, Task};
use super::protobuf::decoded;
use super::shapes::{MAP, frame_of, node, path_name};
use crate::watch::live::History;
use crate::watch::{
    About, Frame, Halt, HaltKind, Hit, Hold, Kind, Node, Path, Placed, Press, TaskId, TaskNews,
    TaskState, WatchEvent,
};

/// What was read from a recording.
#[derive(Debug, PartialEq)]
pub struct Recording {
    /// Number of frames.
    pub frames: usize,
    /// Number of news items.
    pub news: usize,
    /// Whether the file ends abruptly, as when the session was killed.
    pub is_cut_off: bool,
}

/// Reads a file's bytes into a history. Messages that are not ours are skipped.
///
/// Damage that makes the library for MCAP files panic is an error, too.
pub fn read_recording(bytes: &[u8], to: &History) -> Result<Recording, RecordingError> {
    caught(|| read_messages(&decompressed(bytes)?, to))?
}

fn read_messages(bytes: &[u8], to: &History) -> Result<Recording, RecordingError> {
    let mut reader = Reader {
        to,
        nodes: Vec::new(),
        frame_ids: IndexMap::new(),
        still: IndexMap::new(),
        objects: IndexMap::new(),
        poses: IndexMap::new(),
        joints: IndexMap::new(),
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
            // Whole chunks have been unpacked before.
            Err(McapError::UnsupportedCompression(_)) => return Err(RecordingError::CutOff),
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

/// Maximum number of frames that carry each other.
const MAX_CARRIERS: usize = 64;

struct Reader<'a> {
    to: &'a History,
    nodes: Vec<Arc<Node>>,
    /// Nodes by their frame IDs, for those that are in the world.
    frame_ids: IndexMap<String, u32>,
    /// Poses of the frames that cannot move.
    still: IndexMap<String, Placed>,
    /// Nodes of objects by the writer's numbers.
    objects: IndexMap<String, u32>,
    /// Poses of the nodes that can move, each as seen from the node that carries it.
    poses: IndexMap<u32, (Option<u32>, Placed)>,
    /// Positions of the joints, in the order in which they were named first.
    joints: IndexMap<String, f64>,
    /// What is currently shown besides bodies.
    shown: Frame,
    frames: usize,
    news: usize,
}

/// The data of a message; `None` if it is encoded in a way that recordings of ours do not use.
pub(super) fn data_of(
    channel: Channel,
    encoding: &str,
    data: &[u8],
) -> Result<Option<Value>, RecordingError> {
    Ok(match encoding {
        "json" => Some(serde_json::from_slice(data)?),
        "protobuf" => {
            let data = decoded(channel.schema(), data);
            Some(data.ok_or(RecordingError::Malformed {
                topic: channel.topic(),
            })?)
        }
        _ => None,
    })
}

impl Reader<'_> {
    fn take(&mut self, message: &mcap::Message<'_>) -> Result<(), RecordingError> {
        let Some(channel) = Channel::of_topic(&message.channel.topic) else {
            return Ok(());
        };
        let encoding = &message.channel.message_encoding;
        let Some(data) = data_of(channel, encoding, &message.data)? else {
            return Ok(());
        };
        let time = message.log_time as f64 * 1e-9;
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
                    (None, Some(&level)) if !log.name.is_empty() && !level.is_empty() => {
                        WatchEvent::Output(format!(
                            "[({}) {level}] {time:.3}: {}\n",
                            log.name, log.message
                        ))
                    }
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
            Channel::Joints => {
                let states: JointStates = parsed(data)?;
                let states = states.joints.into_iter();
                self.joints
                    .extend(states.map(|state| (state.name, state.position)));
            }
            Channel::Picture
            | Channel::Calibration
            | Channel::Overlay
            | Channel::Contacts
            | Channel::Markers => {}
        }
        Ok(())
    }

    fn add_news(&mut self, time: f64, event: &WatchEvent) {
        self.to.add_news(time, event);
        self.news += 1;
    }

    fn transforms(&mut self, time: f64, message: &FrameTransforms) {
        for transform in &message.transforms {
            let Some(id) = self.frame(&transform.child_frame_id) else {
                continue;
            };
            let parent = match transform.parent_frame_id.as_str() {
                MAP => None,
                carrier => self.frame(carrier),
            };
            let Some(pose) = placed(transform, id) else {
                continue;
            };
            // What carries a node is told with the nodes, which are published with the first frame.
            if let Some(node) = self.nodes.get_mut(id as usize).and_then(Arc::get_mut) {
                node.parent = parent;
            }
            self.poses.insert(id, (parent, pose));
        }
        let known: Vec<u32> = self.frame_ids.values().copied().collect();
        let mut placed: Vec<Placed> = known.iter().filter_map(|id| self.in_map(*id)).collect();
        placed.sort_by_key(|p| p.node);
        placed.dedup_by_key(|p| p.node);
        let frame = Frame {
            time,
            placed,
            joints: self.joints.values().copied().collect(),
            ..self.shown.clone()
        };
        self.frames += 1;
        self.to.publish(&self.nodes, Arc::new(frame), true);
    }

    /// The node of a frame; a bare frame, such as the camera's, becomes one.
    fn frame(&mut self, frame_id: &str) -> Option<u32> {
        let known = self.frame_ids.get(frame_id).copied();
        match known {
            None if !frame_id.starts_with("object/") => Some(self.add_frame(frame_id)),
            known => known,
        }
    }

    /// The pose of a node in the map.
    fn in_map(&self, id: u32) -> Option<Placed> {
        let (mut parent, mut placed) = *self.poses.get(&id)?;
        // Damage may have made a circle.
        for _ in 0..MAX_CARRIERS {
            let Some(carrier) = parent else {
                return Some(placed);
            };
            let (next, pose) = self.poses.get(&carrier)?;
            placed = placed.carried_by(pose);
            parent = *next;
        }
        None
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
                        force: held.force,
                    })
                })
                .collect(),
            presses: (shown.touching.iter())
                .filter_map(|touching| {
                    Some(Press {
                        body: node(&touching.link),
                        object: node(&touching.object)?,
                        at: touching.position.into(),
                        force: touching.force.into(),
                    })
                })
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
            shapes: Arc::default(),
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

pub(super) fn parsed<T: DeserializeOwned>(data: Value) -> Result<T, RecordingError> {
    Ok(serde_json::from_value(data)?)
}

fn news(task: Task) -> Option<TaskNews> {
    let parameters = task.parameters.into_iter();
    let keys: Vec<_> = parameters.map(|pair| (pair.key, pair.value)).collect();
    let is_told = !keys.is_empty() || !task.place.is_empty();
    let about = is_told.then(|| {
        About {
            keys,
            place: task.place,
            line: task.line,
            module: task.module,
        }
        .into()
    });
    Some(TaskNews {
        id: TaskId::of_text(&task.id)?,
        parent: TaskId::of_text(&task.parent),
        name: task.name,
        state: TaskState::named(&task.state)?,
        failure: task.failure,
        class: task.class,
        result: task.result,
        about,
    })
}
