//! Turning the head to look at something.

use super::{ArgumentError, ArgumentKind, Arguments, Command, MotionKey, MotionType};
use crate::motion::jobs::job::Motion;
use crate::motion::jobs::look::{Look, LookDirection, LookTarget};
use crate::motion::jobs::move_tcp::PoseGoal;

/// Turns the head.
#[derive(Clone, Debug, PartialEq)]
pub struct Looking {
    /// What to look at.
    target: LookTarget,
}

/// The words for directions.
const DIRECTIONS: [(&str, LookDirection); 5] = [
    ("FORWARD", LookDirection::Forward),
    ("LEFT", LookDirection::Left),
    ("RIGHT", LookDirection::Right),
    ("UP", LookDirection::Up),
    ("DOWN", LookDirection::Down),
];

impl Command for Looking {
    const TYPE: MotionType = MotionType {
        name: "LOOKING",
        aliases: &[],
        keys: &[
            MotionKey::optional("TARGET", ArgumentKind::Place, "the location to look at")
                .also(&["LOCATION", "POSE"]),
            MotionKey::optional("FRAME", ArgumentKind::Frame, "the frame to look at"),
            MotionKey::optional(
                "DIRECTION",
                ArgumentKind::Word,
                "forward, left, right, up or down",
            ),
            MotionKey::optional("OBJECT", ArgumentKind::InWorld, "the object to look at"),
            MotionKey::optional(
                "CAMERA",
                ArgumentKind::Member(&["HEAD"]),
                "the camera; the head has one",
            ),
        ],
        one_of: &["TARGET", "FRAME", "DIRECTION", "OBJECT"],
        about: &["TARGET", "FRAME", "OBJECT", "DIRECTION"],
        is_known_by_keys: false,
        doc: "Turns the head.",
        example: "(a motion (type looking) (direction down))",
    };

    fn new(arguments: &Arguments) -> Result<Self, ArgumentError> {
        let target = if let Some(place) = arguments.place("TARGET") {
            match place {
                PoseGoal::InMap(pose) => LookTarget::InMap(pose),
                PoseGoal::InBase(pose) => LookTarget::InBase(pose),
            }
        } else if let Some(frame) = arguments.word("FRAME") {
            LookTarget::Frame(frame.to_owned())
        } else if let Some(object) = arguments.in_world("OBJECT") {
            LookTarget::Frame(object.ok_or(ArgumentError::Nameless("OBJECT"))?)
        } else {
            let word = arguments.word("DIRECTION");
            let word = word.ok_or(ArgumentError::Missing("TARGET"))?;
            let direction = DIRECTIONS.iter().find(|(name, _)| *name == word);
            let unknown = || ArgumentError::UnknownDirection(word.to_owned());
            LookTarget::Direction(direction.ok_or_else(unknown)?.1)
        };
        Ok(Self { target })
    }

    fn job(self) -> Box<dyn Motion> {
        Box::new(Look::new(self.target))
    }
}
