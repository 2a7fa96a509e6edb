//! Opening and closing hands, and gripping. All of them take one hand or both.

use super::{ArgumentError, ArgumentKind, Arguments, Command, MotionKey, MotionType};
use crate::motion::failure::process_module::ProcessModule;
use crate::motion::jobs::gripper::{GripperCommand, MoveGripper};
use crate::motion::jobs::job::Motion;
use crate::motion::jobs::together::Together;
use crate::robot::Side;

const GRIPPER: MotionKey =
    MotionKey::required("GRIPPER", ArgumentKind::Sides, "left, right, or both")
        .also(&["ARM", "ARMS"]);

fn job(hands: Vec<Side>, command: &GripperCommand) -> Box<dyn Motion> {
    let motions = hands
        .into_iter()
        .map(|hand| Box::new(MoveGripper::new(hand, command.clone())) as Box<dyn Motion>);
    Box::new(Together::new(ProcessModule::Grippers, motions.collect()))
}

/// Opens hands.
#[derive(Clone, Debug, PartialEq)]
pub struct Opening {
    hands: Vec<Side>,
}

impl Command for Opening {
    const TYPE: MotionType = MotionType {
        name: "OPENING",
        aliases: &["OPENING-GRIPPER"],
        keys: &[GRIPPER],
        one_of: &[],
        about: &[],
        is_known_by_keys: true,
        doc: "Opens a hand.",
        example: "(a motion (type opening) (gripper left))",
    };

    fn new(arguments: &Arguments) -> Result<Self, ArgumentError> {
        let hands = arguments.sides("GRIPPER")?;
        Ok(Self { hands })
    }

    fn job(self) -> Box<dyn Motion> {
        job(self.hands, &GripperCommand::Open)
    }
}

/// Closes hands.
#[derive(Clone, Debug, PartialEq)]
pub struct Closing {
    hands: Vec<Side>,
}

impl Command for Closing {
    const TYPE: MotionType = MotionType {
        name: "CLOSING",
        aliases: &["CLOSING-GRIPPER"],
        keys: &[GRIPPER],
        one_of: &[],
        about: &[],
        is_known_by_keys: true,
        doc: "Closes a hand.",
        example: "(a motion (type closing) (gripper left))",
    };

    fn new(arguments: &Arguments) -> Result<Self, ArgumentError> {
        let hands = arguments.sides("GRIPPER")?;
        Ok(Self { hands })
    }

    fn job(self) -> Box<dyn Motion> {
        job(self.hands, &GripperCommand::Close)
    }
}

/// Closes hands on an object.
#[derive(Clone, Debug, PartialEq)]
pub struct Gripping {
    hands: Vec<Side>,
    /// The name of what is to be held, if that matters.
    object: Option<String>,
    /// The force of each finger (N).
    effort: Option<f64>,
}

impl Command for Gripping {
    const TYPE: MotionType = MotionType {
        name: "GRIPPING",
        aliases: &[],
        keys: &[
            GRIPPER,
            MotionKey::optional(
                "EFFORT",
                ArgumentKind::Number,
                "the force of each finger (N), as much as possible unless given; the product with \
                 the friction limits what the hand can hold",
            ),
            MotionKey::optional("OBJECT", ArgumentKind::InWorld, "what is to be held"),
        ],
        one_of: &[],
        about: &[],
        is_known_by_keys: false,
        doc: "Closes a hand on an object.",
        example: "(a motion (type gripping) (gripper left))",
    };

    fn new(arguments: &Arguments) -> Result<Self, ArgumentError> {
        Ok(Self {
            hands: arguments.sides("GRIPPER")?,
            object: arguments.in_world("OBJECT").flatten(),
            effort: arguments.number("EFFORT").ok(),
        })
    }

    fn job(self) -> Box<dyn Motion> {
        let command = GripperCommand::Grip {
            object: self.object,
            effort: self.effort,
            together: self.hands.len() > 1,
        };
        job(self.hands, &command)
    }
}

/// Moves the fingers of hands to an opening.
#[derive(Clone, Debug, PartialEq)]
pub struct MovingGripperJoint {
    hands: Vec<Side>,
    /// Distance (m) between the fingers.
    opening: f64,
}

impl Command for MovingGripperJoint {
    const TYPE: MotionType = MotionType {
        name: "MOVING-GRIPPER-JOINT",
        aliases: &[],
        keys: &[
            GRIPPER,
            MotionKey::required(
                "JOINT-ANGLE",
                ArgumentKind::Number,
                "how far the fingers are apart (m)",
            )
            .also(&["POSITION"]),
        ],
        one_of: &[],
        about: &[],
        is_known_by_keys: false,
        doc: "Opens a hand a little.",
        example: "(a motion (type moving-gripper-joint) (gripper left) (joint-angle 0.05))",
    };

    fn new(arguments: &Arguments) -> Result<Self, ArgumentError> {
        Ok(Self {
            hands: arguments.sides("GRIPPER")?,
            opening: arguments.number("JOINT-ANGLE")?,
        })
    }

    fn job(self) -> Box<dyn Motion> {
        job(self.hands, &GripperCommand::Position(self.opening))
    }
}
