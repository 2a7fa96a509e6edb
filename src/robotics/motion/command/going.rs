//! Driving to a place.

use super::{ArgumentError, ArgumentKind, Arguments, Command, MotionKey, MotionType};
use crate::motion::jobs::drive::Drive;
use crate::motion::jobs::job::Motion;
use spatial::Pose;

/// Drives the base.
#[derive(Clone, Debug, PartialEq)]
pub struct Going {
    /// Where to, in the map.
    target: Pose,
}

impl Command for Going {
    const TYPE: MotionType = MotionType {
        name: "GOING",
        aliases: &[],
        keys: &[
            MotionKey::required("TARGET", ArgumentKind::MapPose, "where to")
                .also(&["LOCATION", "POSE"]),
        ],
        one_of: &[],
        about: &["TARGET"],
        is_known_by_keys: false,
        doc: "Drives the base to a location.",
        example: "(a motion (type going) (target (a location (pose ?pose))))",
    };

    fn new(arguments: &Arguments) -> Result<Self, ArgumentError> {
        let target = arguments.map_pose("TARGET")?;
        Ok(Self { target })
    }

    fn job(self) -> Box<dyn Motion> {
        Box::new(Drive::new(&self.target))
    }
}
