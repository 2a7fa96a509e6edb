//! The channels of a recording, in a table of topics and schemas.

use super::schema::{self, MessageType};

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
    /// What presses on objects, as arrows.
    Contacts,
    /// What the robot does, as a text above it, and failures.
    Markers,
    /// Positions and velocities of joints.
    Joints,
    /// What the robot's camera sees.
    Picture,
    /// The camera's calibration.
    Calibration,
    /// Log messages and printed output.
    Log,
    /// Tasks, actions and motions.
    Tasks,
    /// Held objects, and what else is shown.
    Shown,
}

impl Channel {
    /// All channels.
    pub(super) const ALL: [Self; 13] = [
        Self::Transforms,
        Self::Still,
        Self::Furnishing,
        Self::Objects,
        Self::Overlay,
        Self::Contacts,
        Self::Markers,
        Self::Joints,
        Self::Picture,
        Self::Calibration,
        Self::Log,
        Self::Tasks,
        Self::Shown,
    ];

    /// Its topic.
    pub(super) fn topic(self) -> &'static str {
        match self {
            Self::Transforms => "/tf",
            Self::Still => "/tf_static",
            Self::Furnishing => "/scene/robot_and_kitchen",
            Self::Objects => "/scene/objects",
            Self::Overlay => "/scene/plans",
            Self::Contacts => "/scene/contacts",
            Self::Markers => "/scene/tasks",
            Self::Joints => "/joint_states",
            Self::Picture => "/camera/image",
            Self::Calibration => "/camera/calibration",
            Self::Log => "/log",
            Self::Tasks => "/tasks",
            Self::Shown => "/shown",
        }
    }

    /// The type of the channel's messages.
    pub(super) fn schema(self) -> &'static MessageType {
        match self {
            Self::Transforms | Self::Still => &schema::FRAME_TRANSFORMS,
            Self::Furnishing | Self::Objects | Self::Overlay | Self::Contacts | Self::Markers => {
                &schema::SCENE_UPDATE
            }
            Self::Joints => &schema::JOINT_STATES,
            Self::Picture => &schema::COMPRESSED_IMAGE,
            Self::Calibration => &schema::CAMERA_CALIBRATION,
            Self::Log => &schema::LOG,
            Self::Tasks => &schema::TASK,
            Self::Shown => &schema::SHOWN,
        }
    }

    /// The channel with this topic.
    pub(crate) fn of_topic(topic: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|channel| channel.topic() == topic)
    }
}
