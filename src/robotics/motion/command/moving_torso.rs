//! Lifting and lowering the torso.

use super::{ArgumentError, ArgumentKind, Arguments, Command, MotionKey, MotionType};
use crate::motion::jobs::job::Motion;
use crate::motion::jobs::move_torso::MoveTorso;

/// Moves the torso.
#[derive(Clone, Debug, PartialEq)]
pub struct MovingTorso {
    /// The height (m) of the lift joint.
    height: f64,
}

impl Command for MovingTorso {
    const TYPE: MotionType = MotionType {
        name: "MOVING-TORSO",
        aliases: &[],
        keys: &[MotionKey::required(
            "JOINT-ANGLE",
            ArgumentKind::Number,
            "the height of the torso (m)",
        )
        .also(&["POSITION"])],
        one_of: &[],
        about: &[],
        is_known_by_keys: false,
        doc: "Lifts or lowers the torso.",
        example: "(a motion (type moving-torso) (joint-angle 0.3))",
    };

    fn new(arguments: &Arguments) -> Result<Self, ArgumentError> {
        let height = arguments.number("JOINT-ANGLE")?;
        Ok(Self { height })
    }

    fn job(self) -> Box<dyn Motion> {
        Box::new(MoveTorso::new(self.height))
    }
}
