//! Lowering what a hand holds.

use super::{ArgumentError, ArgumentKind, Arguments, Command, MotionKey, MotionType};
use crate::motion::jobs::job::Motion;
use crate::motion::jobs::move_tcp::PoseGoal;
use crate::motion::jobs::put::Put;
use crate::robot::Side;

/// Lowers a held object.
#[derive(Clone, Debug, PartialEq)]
pub struct Putting {
    arm: Side,
    /// Where the hand goes.
    target: PoseGoal,
}

impl Command for Putting {
    const TYPE: MotionType = MotionType {
        name: "PUTTING",
        aliases: &[],
        keys: &[
            MotionKey::required("ARM", ArgumentKind::Side, "left or right"),
            MotionKey::required("TARGET", ArgumentKind::Place, "where the hand goes")
                .also(&["LOCATION", "POSE"]),
        ],
        one_of: &[],
        about: &[],
        is_known_by_keys: false,
        doc: "Lowers a held object until something carries it.",
        example: "(a motion (type putting) (arm left) (target (a location (pose ?hand-pose))))",
    };

    fn new(arguments: &Arguments) -> Result<Self, ArgumentError> {
        let target = arguments.place("TARGET");
        let target = target.ok_or(ArgumentError::Missing("TARGET"))?;
        Ok(Self {
            arm: arguments.side("ARM")?,
            target,
        })
    }

    fn job(self) -> Box<dyn Motion> {
        Box::new(Put::new(self.arm, self.target))
    }
}
