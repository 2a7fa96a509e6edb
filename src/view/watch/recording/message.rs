//! The messages of a recording. Names and meanings of the fields are those of Foxglove's
//! schemas, except for the last few messages, which are our own.

use serde::{Deserialize, Serialize};

/// A simulated time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Time {
    pub sec: u32,
    pub nsec: u32,
}

impl Time {
    /// The time in nanoseconds.
    pub(crate) fn nanoseconds(seconds: f64) -> u64 {
        // The cast saturates; negative times become zero.
        (seconds * 1e9).round() as u64
    }

    /// The time this many seconds after the session began.
    pub(super) fn new(seconds: f64) -> Self {
        let nanoseconds = Self::nanoseconds(seconds);
        Self {
            sec: u32::try_from(nanoseconds / 1_000_000_000).unwrap_or(u32::MAX),
            // Less than a billion.
            nsec: (nanoseconds % 1_000_000_000) as u32,
        }
    }
}

/// A point (m), a direction or a size.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Vector3 {
    pub x: f32,
    pub y: f32,
    pub z: f32,
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
pub struct Quaternion {
    pub x: f32,
    pub y: f32,
    pub z: f32,
    pub w: f32,
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
pub(crate) struct FrameTransform {
    pub timestamp: Time,
    pub parent_frame_id: String,
    pub child_frame_id: String,
    pub translation: Vector3,
    pub rotation: Quaternion,
}

/// `foxglove.FrameTransforms`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct FrameTransforms {
    pub transforms: Vec<FrameTransform>,
}

/// `foxglove.SceneUpdate`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct SceneUpdate {
    pub deletions: Vec<SceneEntityDeletion>,
    pub entities: Vec<SceneEntity>,
}

/// `foxglove.SceneEntityDeletion`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct SceneEntityDeletion {
    pub timestamp: Time,
    /// 1 deletes everything on the topic.
    #[serde(rename = "type")]
    pub kind: u8,
    pub id: String,
}

/// `foxglove.SceneEntity`. Kinds of primitives that we never write are always empty.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct SceneEntity {
    pub timestamp: Time,
    pub frame_id: String,
    pub id: String,
    pub lifetime: Time,
    pub frame_locked: bool,
    pub metadata: Vec<KeyValuePair>,
    #[serde(default)]
    pub arrows: Vec<ArrowPrimitive>,
    pub cubes: [(); 0],
    pub spheres: [(); 0],
    pub cylinders: [(); 0],
    pub lines: Vec<LinePrimitive>,
    pub triangles: Vec<TriangleListPrimitive>,
    #[serde(default)]
    pub texts: Vec<TextPrimitive>,
    pub models: [(); 0],
}

impl SceneEntity {
    /// The value of a metadata key.
    pub(super) fn metadata(&self, key: &str) -> Option<&str> {
        let pair = self.metadata.iter().find(|pair| pair.key == key)?;
        Some(&pair.value)
    }
}

/// `foxglove.KeyValuePair`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct KeyValuePair {
    pub key: String,
    pub value: String,
}

/// `foxglove.Pose`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct PoseMessage {
    pub position: Vector3,
    pub orientation: Quaternion,
}

/// `foxglove.Color`, in sRGB.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Color {
    pub r: f32,
    pub g: f32,
    pub b: f32,
    pub a: f32,
}

/// `foxglove.ArrowPrimitive`: from the pose's origin along its x axis; lengths in m.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct ArrowPrimitive {
    pub pose: PoseMessage,
    pub(crate) shaft_length: f32,
    pub(crate) shaft_diameter: f32,
    pub(crate) head_length: f32,
    pub(crate) head_diameter: f32,
    pub color: Color,
}

/// `foxglove.LinePrimitive`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct LinePrimitive {
    /// 0: a line through all points; 2: a line for each pair of points.
    #[serde(rename = "type")]
    pub kind: u8,
    pub pose: PoseMessage,
    pub(crate) thickness: f32,
    pub(crate) scale_invariant: bool,
    pub points: Vec<Vector3>,
    pub color: Color,
    pub colors: Vec<Color>,
    pub indices: Vec<u32>,
}

/// `foxglove.TriangleListPrimitive`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct TriangleListPrimitive {
    pub pose: PoseMessage,
    pub points: Vec<Vector3>,
    pub color: Color,
    pub colors: Vec<Color>,
    pub indices: Vec<u32>,
}

/// `foxglove.TextPrimitive`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct TextPrimitive {
    pub pose: PoseMessage,
    pub(crate) billboard: bool,
    /// m, or pixels if the size does not depend on the distance.
    pub(crate) font_size: f32,
    pub(crate) scale_invariant: bool,
    pub color: Color,
    pub text: String,
}

/// `foxglove.JointStates`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct JointStates {
    pub timestamp: Time,
    pub joints: Vec<JointState>,
}

/// `foxglove.JointState`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct JointState {
    pub name: String,
    /// rad or m.
    pub position: f64,
    /// rad/s or m/s; recordings of earlier versions have none.
    #[serde(default)]
    pub velocity: f64,
}

/// `foxglove.CompressedImage`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct CompressedImage {
    pub timestamp: Time,
    pub frame_id: String,
    pub data: String,
    pub format: String,
}

/// `foxglove.CameraCalibration`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(non_snake_case, reason = "the schema names matrices so")]
pub(crate) struct CameraCalibration {
    pub timestamp: Time,
    pub frame_id: String,
    pub width: u32,
    pub height: u32,
    pub(crate) distortion_model: String,
    pub D: Vec<f64>,
    pub K: [f64; 9],
    pub R: [f64; 9],
    pub P: [f64; 12],
}

/// `foxglove.Log`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Log {
    pub timestamp: Time,
    /// 0 unknown, 1 debug, 2 info, 3 warning, 4 error.
    pub level: u8,
    pub message: String,
    pub name: String,
    pub file: String,
    pub line: u32,
}

/// A task, an action or a motion began, or its state changed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Task {
    pub timestamp: Time,
    /// `t` for a task, `a` for an action or `m` for a motion, and its number.
    pub id: String,
    /// The task that started it; empty if the prompt did.
    pub parent: String,
    pub name: String,
    pub state: String,
    pub failure: String,
    /// The class of the failure; recordings of earlier versions do not tell it.
    #[serde(default)]
    pub class: String,
    #[serde(default)]
    pub result: String,
    /// What it is to do; told when it begins, as are the place and the line of the plan, and
    /// the process module of a motion.
    #[serde(default)]
    pub parameters: Vec<KeyValuePair>,
    #[serde(default)]
    pub place: String,
    #[serde(default)]
    pub line: String,
    #[serde(default)]
    pub module: String,
}

/// What is shown besides bodies and their poses, until the next message.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Shown {
    pub timestamp: Time,
    pub held: Vec<Held>,
    pub touching: Vec<Touching>,
    pub stops: Vec<Stop>,
    pub axes: Vec<Axes>,
    pub paths: Vec<PathMessage>,
}

/// A body that presses on an object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "TouchingForm")]
pub(crate) struct Touching {
    /// Frame of the body; empty for the floor.
    pub link: String,
    /// Frame of the object.
    pub object: String,
    /// Where (m), and the normal force on the object (N); recordings of earlier versions have
    /// neither.
    pub position: Vector3,
    pub force: Vector3,
}

/// How they are written: recordings of earlier versions have pairs.
#[derive(Deserialize)]
#[serde(untagged)]
enum TouchingForm {
    Named {
        link: String,
        object: String,
        #[serde(default)]
        position: Vector3,
        #[serde(default)]
        force: Vector3,
    },
    Pair([String; 2]),
}

impl From<TouchingForm> for Touching {
    fn from(form: TouchingForm) -> Self {
        match form {
            TouchingForm::Named {
                link,
                object,
                position,
                force,
            } => Self {
                link,
                object,
                position,
                force,
            },
            TouchingForm::Pair([link, object]) => Self {
                link,
                object,
                position: Vector3::default(),
                force: Vector3::default(),
            },
        }
    }
}

/// An object in one of the robot's hands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Held {
    /// Frame of the object.
    pub object: String,
    /// Name of the link.
    pub link: String,
    /// The force (N) that the grip transmits; recordings of earlier versions have none.
    #[serde(default)]
    pub force: f32,
}

/// What stopped a motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Stop {
    pub frames: Vec<String>,
    pub position: Vector3,
}

/// Coordinate axes that the user wanted to see.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Axes {
    pub pose: PoseMessage,
    /// m.
    pub length: f32,
}

/// A planned path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct PathMessage {
    /// `base`, `left` or `right`.
    pub what: String,
    pub frame_id: String,
    pub points: Vec<Vector3>,
}
