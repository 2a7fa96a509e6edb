//! Where objects and the robot were in a recording, at moments: when something was performed or touched, and every two
//! seconds. A row tells of a moment at which something was elsewhere than at the one before.

use indexmap::IndexMap;
use spatial::trig;

use super::RecordingError;
use super::channel::Channel;
use super::episode::object_name;
use super::message::{FrameTransforms, Shown};
use super::messages::Message;
use super::read::{data_of, parsed};
use super::rows::{self, Datum, Rows};
use super::shapes::MAP;
use super::told::Objects;
use super::wire::{Content, field};
use crate::watch::{GRAIN, MAP_OF_LOCATION};

/// The time (s) after which there is a moment in any case.
const INTERVAL: f64 = 2.0;

/// Position (m) and orientation (a quaternion) in the map.
type Pose = [f64; 7];

/// What is known of an object.
#[derive(Default)]
struct Object {
    type_name: String,
    pose: Option<Pose>,
    /// What carries it, and the link that holds it.
    on: Option<String>,
    in_hand: Option<String>,
    /// What its last row says, in mm and thousandths.
    last: Option<([i64; 7], Option<String>, Option<String>)>,
}

/// What has been read so far.
#[derive(Default)]
pub(super) struct Places {
    /// By their frames.
    objects: IndexMap<String, Object>,
    /// The frame of the robot's root, and where it is.
    robot: Option<Pose>,
    last_robot: Option<[i64; 7]>,
    last_moment: Option<f64>,
    /// Is the next frame a moment?
    is_due: bool,
    object_rows: Vec<Vec<Datum>>,
    robot_rows: Vec<Vec<Datum>>,
}

fn rounded(pose: &Pose) -> [i64; 7] {
    pose.map(|x| (x * 1000.0).round() as i64)
}

impl Places {
    /// Something has happened: the next frame is a moment.
    pub(super) fn note(&mut self) {
        self.is_due = true;
    }

    /// The objects that there are from now on.
    pub(super) fn objects(&mut self, update: &Objects) {
        let mut before = std::mem::take(&mut self.objects);
        for entity in &update.entities {
            let mut pairs = entity.metadata.iter();
            let type_name = pairs.find(|pair| pair.key == "type");
            let type_name = type_name.map_or("", |pair| pair.value.as_str());
            if type_name == MAP_OF_LOCATION || type_name == GRAIN {
                continue;
            }
            let mut object = before.shift_remove(&entity.frame_id).unwrap_or_default();
            object.type_name = type_name.to_lowercase();
            self.objects.insert(entity.frame_id.clone(), object);
        }
        self.is_due = true;
    }

    /// What holds and carries objects.
    pub(super) fn shown(&mut self, shown: &Shown) {
        for (frame, object) in &mut self.objects {
            let holder = shown.held.iter().find(|held| held.object == *frame);
            object.in_hand = holder.map(|held| held.link.clone());
            let below = shown.touching.iter().filter(|touch| {
                touch.object == *frame && touch.force.z > 0.0 && object.in_hand.is_none()
            });
            let below = below.max_by(|a, b| a.force.z.total_cmp(&b.force.z));
            object.on = below.map(|touch| match touch.link.as_str() {
                "" => "floor".to_owned(),
                link => link.strip_prefix("kitchen/").unwrap_or(link).to_owned(),
            });
        }
        self.is_due = true;
    }

    /// A frame: the poses that have changed.
    pub(super) fn transforms(&mut self, message: &Message<'_>) -> Result<(), RecordingError> {
        match message.encoding {
            "protobuf" => {
                self.of_protobuf(message.data)
                    .ok_or(RecordingError::Malformed {
                        topic: Channel::Transforms.topic(),
                    })?;
            }
            encoding => {
                let Some(data) = data_of(Channel::Transforms, encoding, message.data)? else {
                    return Ok(());
                };
                let all: FrameTransforms = parsed(data)?;
                for one in &all.transforms {
                    let (at, turn) = (&one.translation, &one.rotation);
                    let pose = [at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w];
                    let pose = pose.map(f64::from);
                    self.place(&one.parent_frame_id, &one.child_frame_id, pose);
                }
            }
        }
        let is_late = self
            .last_moment
            .is_none_or(|last| message.time >= last + INTERVAL || message.time < last);
        if self.is_due || is_late {
            self.moment(message.time);
        }
        Ok(())
    }

    /// Reads the same without making values of what is not needed: most transforms are those of links.
    fn of_protobuf(&mut self, mut rest: &[u8]) -> Option<()> {
        while !rest.is_empty() {
            let (number, content, after) = field(rest)?;
            rest = after;
            let (1, Content::Bytes(mut transform)) = (number, content) else {
                continue;
            };
            let (mut parent, mut child) = (&[][..], &[][..]);
            let (mut translation, mut rotation) = (&[][..], &[][..]);
            while !transform.is_empty() {
                let (number, content, after) = field(transform)?;
                transform = after;
                match (number, content) {
                    (2, Content::Bytes(bytes)) => parent = bytes,
                    (3, Content::Bytes(bytes)) => child = bytes,
                    (4, Content::Bytes(bytes)) => translation = bytes,
                    (5, Content::Bytes(bytes)) => rotation = bytes,
                    _ => {}
                }
            }
            if parent != MAP.as_bytes() {
                continue;
            }
            let [x, y, z, _] = doubles(translation)?;
            let [qx, qy, qz, qw] = doubles(rotation)?;
            let child = std::str::from_utf8(child).ok()?;
            self.place(MAP, child, [x, y, z, qx, qy, qz, qw]);
        }
        Some(())
    }

    /// Something is at a pose now. The robot's root and objects are placed in the map.
    fn place(&mut self, parent: &str, child: &str, pose: Pose) {
        if parent != MAP {
            return;
        }
        match self.objects.get_mut(child) {
            Some(object) => object.pose = Some(pose),
            None if child.contains('/') => {}
            None => self.robot = Some(pose),
        }
    }

    fn moment(&mut self, time: f64) {
        self.is_due = false;
        self.last_moment = Some(time);
        for (frame, object) in &mut self.objects {
            let Some(pose) = object.pose else {
                continue;
            };
            let state = (rounded(&pose), object.on.clone(), object.in_hand.clone());
            if object.last.as_ref() == Some(&state) {
                continue;
            }
            let mut row = vec![
                time.into(),
                object_name(frame).into(),
                object.type_name.as_str().into(),
            ];
            row.extend(pose.map(Datum::from));
            row.extend([object.on.clone().into(), object.in_hand.clone().into()]);
            self.object_rows.push(row);
            object.last = Some(state);
        }
        if let Some(pose) = self.robot
            && self.last_robot != Some(rounded(&pose))
        {
            self.last_robot = Some(rounded(&pose));
            let [x, y, _, _, _, qz, qw] = pose;
            let yaw = trig::wrap(2.0 * trig::atan2(qz, qw));
            let row = [time, x, y, yaw].map(Datum::from);
            self.robot_rows.push(row.to_vec());
        }
    }

    /// How many rows there are.
    pub(super) fn len(&self) -> usize {
        self.object_rows.len() + self.robot_rows.len()
    }

    /// The relations that have rows.
    pub(super) fn relations(self) -> impl Iterator<Item = (&'static str, Rows)> {
        let relations = [
            rows::of("object", self.object_rows),
            rows::of("robot", self.robot_rows),
        ];
        let relations = relations.into_iter();
        relations.filter(|(_, rows)| !rows.rows.is_empty())
    }
}

/// The first four fields of a message of numbers; what is not said is 0.
fn doubles(mut rest: &[u8]) -> Option<[f64; 4]> {
    let mut found = [0.0; 4];
    while !rest.is_empty() {
        let (number, content, after) = field(rest)?;
        rest = after;
        let at = usize::try_from(number).ok()?.checked_sub(1)?;
        if let (Some(place), Content::Fixed64(bytes)) = (found.get_mut(at), content) {
            *place = f64::from_le_bytes(bytes);
        }
    }
    Some(found)
}
