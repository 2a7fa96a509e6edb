//! The messages of a recording. Names and meanings of the fields are those of Foxglove's
//! schemas, but for the last ones, which are our own.

use serde::{Deserialize, Serialize};

/// A simulated time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Time {
    pub(super) sec: u32,
    pub(super) nsec: u32,
}

impl Time {
    /// The time in nanoseconds.
    pub(super) fn nanoseconds(seconds: f64) -> u64 {
        // The cast saturates; a negative time is none.
        (seconds * 1e9).round() as u64
    }

    /// So many seconds after the session began.
    pub(super) fn new(seconds: f64) -> Self {
        let nanoseconds = Self::nanoseconds(seconds);
        Self {
            sec: u32::try_from(nanoseconds / 1_000_000_000).unwrap_or(u32::MAX),
            // Less than a milliard.
            nsec: (nanoseconds % 1_000_000_000) as u32,
        }
    }
}

/// A point or a direction (m), or a size.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Vector3 {
    pub(super) x: f32,
    pub(super) y: f32,
    pub(super) z: f32,
}

impl From<[f32; 3]> for Vector3 {
    fn from([x, y, z]: [f32; 3]) -> Self {
        Self { x, y, z }
    }
}

impl From<Vector3> for [f32; 3] {
    fn from(v: Vector3) -> Self {
        [v.x, v.y, v.z]
    }
}

/// A rotation as a unit quaternion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Quaternion {
    pub(super) x: f32,
    pub(super) y: f32,
    pub(super) z: f32,
    pub(super) w: f32,
}

impl Default for Quaternion {
    fn default() -> Self {
        [0.0, 0.0, 0.0, 1.0].into()
    }
}

impl From<[f32; 4]> for Quaternion {
    fn from([x, y, z, w]: [f32; 4]) -> Self {
        Self { x, y, z, w }
    }
}

impl From<Quaternion> for [f32; 4] {
    fn from(q: Quaternion) -> Self {
        [q.x, q.y, q.z, q.w]
    }
}

/// `foxglove.FrameTransform`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct FrameTransform {
    pub(super) timestamp: Time,
    pub(super) parent_frame_id: String,
    pub(super) child_frame_id: String,
    pub(super) translation: Vector3,
    pub(super) rotation: Quaternion,
}

/// `foxglove.FrameTransforms`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct FrameTransforms {
    pub(super) transforms: Vec<FrameTransform>,
}

/// `foxglove.SceneUpdate`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct SceneUpdate {
    pub(super) deletions: Vec<SceneEntityDeletion>,
    pub(super) entities: Vec<SceneEntity>,
}

/// `foxglove.SceneEntityDeletion`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct SceneEntityDeletion {
    pub(super) timestamp: Time,
    /// 1: all of the topic.
    #[serde(rename = "type")]
    pub(super) kind: u8,
    pub(super) id: String,
}

/// `foxglove.SceneEntity`. Kinds of primitives that we do not write are always empty.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct SceneEntity {
    pub(super) timestamp: Time,
    pub(super) frame_id: String,
    pub(super) id: String,
    pub(super) lifetime: Time,
    pub(super) frame_locked: bool,
    pub(super) metadata: Vec<KeyValuePair>,
    pub(super) arrows: [(); 0],
    pub(super) cubes: [(); 0],
    pub(super) spheres: [(); 0],
    pub(super) cylinders: [(); 0],
    pub(super) lines: Vec<LinePrimitive>,
    pub(super) triangles: Vec<TriangleListPrimitive>,
    pub(super) texts: [(); 0],
    pub(super) models: [(); 0],
}

impl SceneEntity {
    /// The value of a key of the metadata.
    pub(super) fn metadata(&self, key: &str) -> Option<&str> {
        let pair = self.metadata.iter().find(|pair| pair.key == key)?;
        Some(&pair.value)
    }
}

/// `foxglove.KeyValuePair`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct KeyValuePair {
    pub(super) key: String,
    pub(super) value: String,
}

/// `foxglove.Pose`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct PoseMessage {
    pub(super) position: Vector3,
    pub(super) orientation: Quaternion,
}

/// `foxglove.Color`, as a screen has it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Color {
    pub(super) r: f32,
    pub(super) g: f32,
    pub(super) b: f32,
    pub(super) a: f32,
}

/// `foxglove.LinePrimitive`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct LinePrimitive {
    /// 0: through all points; 2: between each two.
    #[serde(rename = "type")]
    pub(super) kind: u8,
    pub(super) pose: PoseMessage,
    pub(super) thickness: f32,
    pub(super) scale_invariant: bool,
    pub(super) points: Vec<Vector3>,
    pub(super) color: Color,
    pub(super) colors: Vec<Color>,
    pub(super) indices: Vec<u32>,
}

/// `foxglove.TriangleListPrimitive`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct TriangleListPrimitive {
    pub(super) pose: PoseMessage,
    pub(super) points: Vec<Vector3>,
    pub(super) color: Color,
    pub(super) colors: Vec<Color>,
    pub(super) indices: Vec<u32>,
}

/// `foxglove.JointStates`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct JointStates {
    pub(super) timestamp: Time,
    pub(super) joints: Vec<JointState>,
}

/// `foxglove.JointState`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct JointState {
    pub(super) name: String,
    /// rad or m.
    pub(super) position: f64,
}

/// `foxglove.CompressedImage`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct CompressedImage {
    pub(super) timestamp: Time,
    pub(super) frame_id: String,
    pub(super) data: String,
    pub(super) format: String,
}

/// `foxglove.CameraCalibration`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(non_snake_case, reason = "the schema names matrices so")]
pub(super) struct CameraCalibration {
    pub(super) timestamp: Time,
    pub(super) frame_id: String,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) distortion_model: String,
    pub(super) D: Vec<f64>,
    pub(super) K: [f64; 9],
    pub(super) R: [f64; 9],
    pub(super) P: [f64; 12],
}

/// `foxglove.Log`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Log {
    pub(super) timestamp: Time,
    /// 0 unknown, 1 debug, 2 info, 3 warning, 4 error.
    pub(super) level: u8,
    pub(super) message: String,
    pub(super) name: String,
    pub(super) file: String,
    pub(super) line: u32,
}

/// A task or a motion began, or its state changed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Task {
    pub(super) timestamp: Time,
    /// `t` for a task or `m` for a motion, and its number.
    pub(super) id: String,
    /// The task that started it; empty if the prompt did.
    pub(super) parent: String,
    pub(super) name: String,
    pub(super) state: String,
    pub(super) failure: String,
}

/// What is shown beside bodies and their places, until the next message.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Shown {
    pub(super) timestamp: Time,
    pub(super) held: Vec<Held>,
    /// Frames of links and objects that press on one another.
    pub(super) touching: Vec<[String; 2]>,
    pub(super) stops: Vec<Stop>,
    pub(super) axes: Vec<Axes>,
    pub(super) paths: Vec<PathMessage>,
}

/// An object in a hand.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Held {
    /// Frame of the object.
    pub(super) object: String,
    /// Name of the link.
    pub(super) link: String,
}

/// What stopped a motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Stop {
    pub(super) frames: Vec<String>,
    pub(super) position: Vector3,
}

/// Coordinate axes that somebody wanted to see.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Axes {
    pub(super) pose: PoseMessage,
    /// m.
    pub(super) length: f32,
}

/// A planned way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct PathMessage {
    /// `base`, `left` or `right`.
    pub(super) what: String,
    pub(super) frame_id: String,
    pub(super) points: Vec<Vector3>,
}
