//! Following a trajectory that somebody else has planned.

use super::{ArgumentError, ArgumentKind, Arguments, Command, MotionKey, MotionType};
use crate::motion::jobs::follow_trajectory::{FollowArm, FollowTorso, points_of_rows};
use crate::motion::jobs::job::Motion;
use crate::robot::Side;

/// Moves an arm, both arms, or the torso, along a trajectory.
#[derive(Clone, Debug, PartialEq)]
pub struct FollowingTrajectory {
    /// The arms; without one, it is the torso that moves.
    sides: Vec<Side>,
    /// When (s) the points are to be reached.
    times: Vec<f64>,
    /// The positions (rad or m) of all joints at the first point, then those at the second one, and so on.
    positions: Vec<f64>,
    /// Their velocities (rad/s or m/s) likewise.
    velocities: Option<Vec<f64>>,
}

impl Command for FollowingTrajectory {
    const TYPE: MotionType = MotionType {
        name: "FOLLOWING-TRAJECTORY",
        aliases: &[],
        keys: &[
            MotionKey::optional(
                "ARM",
                ArgumentKind::Sides,
                "the arm, or both in a list, whose joints come one after the other; without one, the torso moves",
            ),
            MotionKey::required(
                "TIMES",
                ArgumentKind::Numbers,
                "when the points are to be reached (s)",
            ),
            MotionKey::required(
                "POSITIONS",
                ArgumentKind::Numbers,
                "the positions (rad or m) of all joints at the first point, from the shoulder to the wrist, then those \
                 at the second one, and so on",
            ),
            MotionKey::optional(
                "VELOCITIES",
                ArgumentKind::Numbers,
                "their velocities (rad/s or m/s) there, in the same order; without them the joints move evenly from \
                 point to point",
            ),
        ],
        one_of: &[],
        about: &[],
        is_known_by_keys: false,
        doc: "Moves an arm, both arms, or the torso, along a trajectory that somebody else has planned. It is refused if joints \
              would have to be faster than they can, or beyond their limits, and stops where something is in the way.",
        example: "(a motion (type following-trajectory) (times ?times) (positions ?positions))",
    };

    fn new(arguments: &Arguments) -> Result<Self, ArgumentError> {
        let numbers = |key: &'static str| {
            let given = arguments.numbers(key);
            given.ok_or(ArgumentError::Missing(key))
        };
        Ok(Self {
            sides: arguments.sides("ARM").unwrap_or_default(),
            times: numbers("TIMES")?,
            positions: numbers("POSITIONS")?,
            velocities: arguments.numbers("VELOCITIES"),
        })
    }

    fn job(self) -> Box<dyn Motion> {
        let points = points_of_rows(&self.times, &self.positions, self.velocities.as_deref());
        match self.sides.is_empty() {
            false => Box::new(FollowArm::new(&self.sides, points)),
            true => Box::new(FollowTorso::new(points)),
        }
    }
}
