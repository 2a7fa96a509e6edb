//! The channels of a recording, in a table of topics and schemas.

use serde_json::Value;

use super::schema;

/// A channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Channel {
    /// Transforms of the links and objects that can move.
    Transforms,
    /// Transforms of furniture that cannot move; written once.
    Still,
    /// Robot and kitchen as bodies; written once.
    Furnishing,
    /// Objects as bodies; all of them are written whenever one appears or disappears.
    Objects,
    /// Planned paths, coordinate axes and what stopped a motion, as lines.
    Overlay,
    /// Positions of the robot's joints.
    Joints,
    /// What the robot's camera sees.
    Picture,
    /// The camera's calibration.
    Calibration,
    /// Log messages and printed output.
    Log,
    /// Tasks and motions.
    Tasks,
    /// Held objects, and what else is shown.
    Shown,
}

impl Channel {
    /// All channels.
    pub(crate) const ALL: [Self; 11] = [
        Self::Transforms,
        Self::Still,
        Self::Furnishing,
        Self::Objects,
        Self::Overlay,
        Self::Joints,
        Self::Picture,
        Self::Calibration,
        Self::Log,
        Self::Tasks,
        Self::Shown,
    ];

    /// Its topic.
    pub(crate) fn topic(self) -> &'static str {
        match self {
            Self::Transforms => "/tf",
            Self::Still => "/tf_static",
            Self::Furnishing => "/scene/robot_and_kitchen",
            Self::Objects => "/scene/objects",
            Self::Overlay => "/scene/plans",
            Self::Joints => "/joint_states",
            Self::Picture => "/camera/image",
            Self::Calibration => "/camera/calibration",
            Self::Log => "/log",
            Self::Tasks => "/tasks",
            Self::Shown => "/shown",
        }
    }

    /// Name and text of the schema of the channel's messages.
    pub(crate) fn schema(self) -> (&'static str, Value) {
        match self {
            Self::Transforms | Self::Still => {
                ("foxglove.FrameTransforms", schema::frame_transforms())
            }
            Self::Furnishing | Self::Objects | Self::Overlay => {
                ("foxglove.SceneUpdate", schema::scene_update())
            }
            Self::Joints => ("foxglove.JointStates", schema::joint_states()),
            Self::Picture => ("foxglove.CompressedImage", schema::compressed_image()),
            Self::Calibration => ("foxglove.CameraCalibration", schema::camera_calibration()),
            Self::Log => ("foxglove.Log", schema::log()),
            Self::Tasks => ("planwright.Task", schema::task()),
            Self::Shown => ("planwright.Shown", schema::shown()),
        }
    }

    /// The channel with this topic.
    pub(crate) fn of_topic(topic: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|channel| channel.topic() == topic)
    }
}
