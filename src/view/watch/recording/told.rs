//! What the messages say that relations are made of, read without what else is in them: most of a message that tells
//! which objects there are is their shapes.

use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::RecordingError;
use super::channel::Channel;
use super::message::{Held, KeyValuePair, Log, Shown, Task, Time, Touching, Vector3};
use super::read::{data_of, parsed};
use super::wire::{Content, field};

/// Reads a message; `None` if it is encoded in a way that recordings of ours do not use.
pub(super) fn told<T: Told>(
    channel: Channel,
    encoding: &str,
    data: &[u8],
) -> Result<Option<T>, RecordingError> {
    if encoding == "protobuf" {
        let read = T::of_protobuf(data);
        return read.map(Some).ok_or(RecordingError::Malformed {
            topic: channel.topic(),
        });
    }
    // The JSON of earlier versions.
    let data = data_of(channel, encoding, data)?;
    data.map(parsed).transpose()
}

/// What is read of a message.
pub(super) trait Told: DeserializeOwned {
    /// Reads a message in Protobuf; `None` if it is malformed.
    fn of_protobuf(bytes: &[u8]) -> Option<Self>;
}

/// Which objects there are.
#[derive(Debug, Default, Deserialize, PartialEq)]
pub(super) struct Objects {
    pub(super) entities: Vec<ObjectEntity>,
}

/// An object.
#[derive(Debug, Default, Deserialize, PartialEq)]
pub(super) struct ObjectEntity {
    pub(super) frame_id: String,
    pub(super) metadata: Vec<KeyValuePair>,
}

/// Hands the fields of a message to a function, which returns `None` for one that is malformed.
fn fields<'a>(
    mut bytes: &'a [u8],
    mut take: impl FnMut(u64, Content<'a>) -> Option<()>,
) -> Option<()> {
    while !bytes.is_empty() {
        let (number, content, rest) = field(bytes)?;
        bytes = rest;
        take(number, content)?;
    }
    Some(())
}

fn bytes_of(content: Content<'_>) -> Option<&[u8]> {
    match content {
        Content::Bytes(bytes) => Some(bytes),
        _ => None,
    }
}

fn text_of(content: Content<'_>) -> Option<String> {
    Some(std::str::from_utf8(bytes_of(content)?).ok()?.to_owned())
}

/// Times are those of the recording.
fn no_time() -> Time {
    Time::default()
}

fn pair(bytes: &[u8]) -> Option<KeyValuePair> {
    let mut pair = KeyValuePair {
        key: String::new(),
        value: String::new(),
    };
    fields(bytes, |number, content| {
        match number {
            1 => pair.key = text_of(content)?,
            2 => pair.value = text_of(content)?,
            _ => {}
        }
        Some(())
    })?;
    Some(pair)
}

fn vector(bytes: &[u8]) -> Option<Vector3> {
    let mut vector = Vector3::default();
    fields(bytes, |number, content| {
        let part = match number {
            1 => &mut vector.x,
            2 => &mut vector.y,
            3 => &mut vector.z,
            _ => return Some(()),
        };
        let Content::Fixed64(bytes) = content else {
            return None;
        };
        *part = Some(f64::from_le_bytes(bytes)).filter(|x| x.is_finite())? as f32;
        Some(())
    })?;
    Some(vector)
}

impl Told for Objects {
    fn of_protobuf(bytes: &[u8]) -> Option<Self> {
        let mut all = Self::default();
        fields(bytes, |number, content| {
            if number != 2 {
                return Some(());
            }
            let mut object = ObjectEntity::default();
            fields(bytes_of(content)?, |number, content| {
                match number {
                    2 => object.frame_id = text_of(content)?,
                    6 => object.metadata.push(pair(bytes_of(content)?)?),
                    _ => {}
                }
                Some(())
            })?;
            all.entities.push(object);
            Some(())
        })?;
        Some(all)
    }
}

impl Told for Shown {
    fn of_protobuf(bytes: &[u8]) -> Option<Self> {
        let mut all = Self::default();
        fields(bytes, |number, content| {
            match number {
                2 => all.held.push(held(bytes_of(content)?)?),
                3 => all.touching.push(touching(bytes_of(content)?)?),
                _ => {}
            }
            Some(())
        })?;
        Some(all)
    }
}

fn held(bytes: &[u8]) -> Option<Held> {
    let mut held = Held {
        object: String::new(),
        link: String::new(),
        force: 0.0,
    };
    fields(bytes, |number, content| {
        match number {
            1 => held.object = text_of(content)?,
            2 => held.link = text_of(content)?,
            _ => {}
        }
        Some(())
    })?;
    Some(held)
}

fn touching(bytes: &[u8]) -> Option<Touching> {
    let mut touching = Touching {
        link: String::new(),
        object: String::new(),
        position: Vector3::default(),
        force: Vector3::default(),
    };
    fields(bytes, |number, content| {
        match number {
            1 => touching.link = text_of(content)?,
            2 => touching.object = text_of(content)?,
            4 => touching.force = vector(bytes_of(content)?)?,
            _ => {}
        }
        Some(())
    })?;
    Some(touching)
}

impl Told for Task {
    fn of_protobuf(bytes: &[u8]) -> Option<Self> {
        let mut task = Self {
            timestamp: no_time(),
            id: String::new(),
            parent: String::new(),
            name: String::new(),
            state: String::new(),
            failure: String::new(),
            class: String::new(),
            result: String::new(),
            parameters: Vec::new(),
            place: String::new(),
            line: String::new(),
            module: String::new(),
        };
        fields(bytes, |number, content| {
            let text = match number {
                2 => &mut task.id,
                3 => &mut task.parent,
                4 => &mut task.name,
                5 => &mut task.state,
                6 => &mut task.failure,
                7 => &mut task.result,
                8 => {
                    task.parameters.push(pair(bytes_of(content)?)?);
                    return Some(());
                }
                9 => &mut task.place,
                12 => &mut task.class,
                _ => return Some(()),
            };
            *text = text_of(content)?;
            Some(())
        })?;
        Some(task)
    }
}

impl Told for Log {
    fn of_protobuf(bytes: &[u8]) -> Option<Self> {
        let mut log = Self {
            timestamp: no_time(),
            level: 0,
            message: String::new(),
            name: String::new(),
            file: String::new(),
            line: 0,
        };
        fields(bytes, |number, content| {
            match (number, content) {
                (2, Content::Number(level)) => log.level = u8::try_from(level).ok()?,
                (2, _) => return None,
                (3, content) => log.message = text_of(content)?,
                (4, content) => log.name = text_of(content)?,
                _ => {}
            }
            Some(())
        })?;
        Some(log)
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::watch::recording::protobuf::{decoded, encoded};

    /// Reads a message of a channel directly, and by way of JSON.
    fn both<T: Told>(channel: Channel, message: &serde_json::Value) -> (T, T) {
        let bytes = encoded(channel.schema(), message);
        let json = decoded(channel.schema(), &bytes).unwrap();
        (T::of_protobuf(&bytes).unwrap(), parsed(json).unwrap())
    }

    #[test]
    fn messages_are_read_as_their_schemas_have_them() {
        let task = json!({
            "id": "a7", "parent": "t3", "name": "PICK-UP", "state": "FAILED", "failure": "It slips.",
            "class": "GRIPPER-CLOSED-COMPLETELY", "result": "NIL", "place": "x.plan:3",
            "parameters": [{"key": "GRASP", "value": "TOP"}, {"key": "ARM", "value": "LEFT"}],
        });
        let (read, expected) = both::<Task>(Channel::Tasks, &task);
        assert_eq!(read, expected);
        assert_eq!(read.parameters[1].value, "LEFT");

        let log = json!({"level": 3, "name": "(PICK-PLACE PICK-UP)", "message": "Gripping"});
        let (read, expected) = both::<Log>(Channel::Log, &log);
        assert_eq!(read, expected);
        assert_eq!(read.level, 3);

        let shown = json!({
            "held": [{"object": "object/CUP-1", "link": "l_gripper_palm_link", "force": 0.0}],
            "touching": [{"link": "", "object": "object/BOWL-1", "force": {"x": 0.5, "y": -1.0, "z": 3.0}}],
        });
        let (read, expected) = both::<Shown>(Channel::Shown, &shown);
        assert_eq!(read, expected);
        assert_eq!(read.touching[0].force.z, 3.0);

        let objects = json!({"entities": [
            {"frame_id": "object/CUP-1", "metadata": [{"key": "type", "value": "CUP"}], "triangles": [{}]},
            {"frame_id": "object/BOWL-1"},
        ]});
        let (read, expected) = both::<Objects>(Channel::Objects, &objects);
        assert_eq!(read, expected);
        assert_eq!(read.entities[0].metadata[0].value, "CUP");
        assert_eq!(read.entities.len(), 2);
    }

    #[test]
    fn a_message_that_is_cut_off_is_malformed() {
        let task = encoded(
            Channel::Tasks.schema(),
            &json!({"id": "a7", "name": "GOING"}),
        );
        assert!(Task::of_protobuf(&task).is_some());
        for length in [1, 3, task.len() - 1] {
            assert!(Task::of_protobuf(&task[..length]).is_none(), "{length}");
        }
    }
}
