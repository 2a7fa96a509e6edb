//! Moving hands to poses.

use super::{ArgumentError, ArgumentKind, Arguments, Command, MotionKey, MotionType};
use crate::motion::contact::expected_contacts::CollisionMode;
use crate::motion::jobs::job::Motion;
use crate::motion::jobs::move_tcp::{MoveTcp, PoseGoal, TcpPath};

/// Moves hands.
#[derive(Clone, Debug, PartialEq)]
pub struct MovingTcp {
    left: Option<PoseGoal>,
    right: Option<PoseGoal>,
    path: TcpPath,
    mode: CollisionMode,
    /// Name of the object that the hands may touch.
    object: Option<String>,
}

/// What arms may touch.
const MODES: &[&str] = &[
    "AVOID-ALL",
    "ALLOW-HAND",
    "ALLOW-FINGERS",
    "ALLOW-ARM",
    "ALLOW-ATTACHED",
    "ALLOW-ALL",
];

impl Command for MovingTcp {
    const TYPE: MotionType = MotionType {
        name: "MOVING-TCP",
        aliases: &[],
        keys: &[
            MotionKey::optional(
                "LEFT-TARGET",
                ArgumentKind::Place,
                "where the left hand goes",
            )
            .also(&["LEFT-POSE"]),
            MotionKey::optional(
                "RIGHT-TARGET",
                ArgumentKind::Place,
                "where the right hand goes",
            )
            .also(&["RIGHT-POSE"]),
            MotionKey::optional(
                "COLLISION-MODE",
                ArgumentKind::Member(MODES),
                "what the arm may touch",
            ),
            MotionKey::optional(
                "OBJECT",
                ArgumentKind::InWorld,
                "the only object that the hands may touch, where they may touch any",
            )
            .also(&["COLLISION-OBJECT-B"]),
        ],
        one_of: &["LEFT-TARGET", "RIGHT-TARGET"],
        about: &[],
        is_known_by_keys: false,
        doc: "Moves hands to poses.",
        example: "(a motion (type moving-tcp) (left-target (a location (pose ?hand-pose))))",
    };

    fn new(arguments: &Arguments) -> Result<Self, ArgumentError> {
        let (path, mode) = match arguments.word("COLLISION-MODE") {
            None | Some("AVOID-ALL") => (TcpPath::Free, CollisionMode::AvoidAll),
            Some("ALLOW-ALL") => (TcpPath::Straight, CollisionMode::AllowAll),
            Some(_) => (TcpPath::Straight, CollisionMode::AllowHand),
        };
        Ok(Self {
            left: arguments.place("LEFT-TARGET"),
            right: arguments.place("RIGHT-TARGET"),
            path,
            mode,
            object: arguments.in_world("OBJECT").flatten(),
        })
    }

    fn job(self) -> Box<dyn Motion> {
        let motion = MoveTcp::new(self.left, self.right, self.path, self.mode);
        Box::new(motion.touching_only(self.object))
    }
}
