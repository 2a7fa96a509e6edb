//! Pulling or pushing a drawer or door by its handle.

use super::{ArgumentError, ArgumentKind, Arguments, Command, MotionKey, MotionType};
use crate::motion::jobs::job::Motion;
use crate::motion::jobs::pull::Pull;
use crate::robot::Side;

/// Pulls or pushes what a hand holds by its handle.
#[derive(Clone, Debug, PartialEq)]
pub struct Pulling {
    arm: Side,
    /// The wanted position of the joint (rad or m).
    position: f64,
}

impl Command for Pulling {
    const TYPE: MotionType = MotionType {
        name: "PULLING",
        aliases: &["PUSHING"],
        keys: &[
            MotionKey::required("ARM", ArgumentKind::Side, "the arm that holds the handle"),
            MotionKey::required(
                "DISTANCE",
                ArgumentKind::Number,
                "how far it is to be open then (m or rad)",
            )
            .also(&["POSITION", "JOINT-ANGLE"]),
        ],
        one_of: &[],
        about: &[],
        is_known_by_keys: false,
        doc: "Pulls or pushes a drawer or door by the handle that a hand holds.",
        example: "(a motion (type pulling) (arm left) (distance 0.3))",
    };

    fn new(arguments: &Arguments) -> Result<Self, ArgumentError> {
        Ok(Self {
            arm: arguments.side("ARM")?,
            position: arguments.number("DISTANCE")?,
        })
    }

    fn job(self) -> Box<dyn Motion> {
        Box::new(Pull::new(self.arm, self.position))
    }
}
