//! Moving the joints of the arms.

use super::{ArgumentError, ArgumentKind, Arguments, Command, MotionKey, MotionType};
use crate::motion::jobs::job::Motion;
use crate::motion::jobs::move_joints::MoveJoints;

/// Moves the arms to configurations.
#[derive(Clone, Debug, PartialEq)]
pub struct MovingArmJoints {
    /// Joint angles (rad).
    left: Option<Vec<f64>>,
    right: Option<Vec<f64>>,
}

impl Command for MovingArmJoints {
    const TYPE: MotionType = MotionType {
        name: "MOVING-ARM-JOINTS",
        aliases: &[],
        keys: &[
            MotionKey::optional(
                "LEFT-CONFIGURATION",
                ArgumentKind::Numbers,
                "seven joint angles of the left arm (rad)",
            )
            .also(&["LEFT-JOINT-STATES"]),
            MotionKey::optional(
                "RIGHT-CONFIGURATION",
                ArgumentKind::Numbers,
                "seven joint angles of the right arm (rad)",
            )
            .also(&["RIGHT-JOINT-STATES"]),
        ],
        one_of: &["LEFT-CONFIGURATION", "RIGHT-CONFIGURATION"],
        about: &[],
        is_known_by_keys: false,
        doc: "Moves the joints of the arms.",
        example: "(a motion (type moving-arm-joints) (left-configuration ?left-configuration))",
    };

    fn new(arguments: &Arguments) -> Result<Self, ArgumentError> {
        Ok(Self {
            left: arguments.numbers("LEFT-CONFIGURATION"),
            right: arguments.numbers("RIGHT-CONFIGURATION"),
        })
    }

    fn job(self) -> Box<dyn Motion> {
        Box::new(MoveJoints::new(self.left, self.right))
    }
}
