//! A robot elsewhere, which plans drive.

use std::time::Duration;

use robotics::motion::RobotTrouble;
use robotics::robot::RobotPart;
use spatial::Pose;

/// Which of the goals, or questions, of a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct GoalTicket(pub u64);

/// A point of a trajectory.
#[derive(Clone, Debug, PartialEq)]
pub struct TrajectoryPoint {
    /// When (s) it is to be reached, since the begin.
    pub time: f64,
    /// Positions of the joints (rad or m).
    pub positions: Vec<f64>,
    /// Their velocities (rad/s or m/s).
    pub velocities: Vec<f64>,
}

/// What a part of the robot is to do.
#[derive(Clone, Debug, PartialEq)]
pub enum PartGoal {
    /// The base is to drive to a pose in the map.
    Drive(Pose),
    /// Joints are to follow a trajectory, which begins at once.
    Follow {
        /// Their names.
        joints: Vec<String>,
        /// The points; times rise.
        points: Vec<TrajectoryPoint>,
    },
    /// Fingers are to move to a gap (m), with a force (N) at most.
    Fingers {
        /// Between the pads.
        gap: f64,
        /// Of each finger.
        effort: f64,
    },
    /// The camera is to be aimed at a point (m) in the map.
    Aim([f64; 3]),
}

impl PartGoal {
    /// How long (s) it takes as planned, if that is planned.
    pub fn duration(&self) -> f64 {
        match self {
            Self::Follow { points, .. } => points.last().map_or(0.0, |point| point.time),
            _ => 0.0,
        }
    }
}

/// What fingers have reported at their end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FingersReport {
    /// The gap (m).
    pub gap: f64,
    /// Whether something has stopped them.
    pub is_stalled: bool,
}

/// How a goal has ended.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RobotEnd {
    /// Why it was not reached; `None` if it was, as the robot says.
    pub trouble: Option<RobotTrouble>,
    /// Whether it was cancelled by this program.
    pub is_cancelled: bool,
    /// What fingers have reported.
    pub fingers: Option<FingersReport>,
}

/// How a robot is, as it tells.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotState {
    /// Where its base is in the map.
    pub base: Pose,
    /// Where the joints are (rad or m) that were asked for, in their order.
    pub joints: Vec<f64>,
}

/// An object that the robot's camera sees.
#[derive(Clone, Debug, PartialEq)]
pub struct SeenObject {
    /// Its type.
    pub type_name: String,
    /// What it is called; empty if the camera does not know one object of a type from the other.
    pub name: String,
    /// Where it is in the map.
    pub pose: Pose,
}

/// A robot elsewhere. Nothing here waits, but for [`Self::wait`].
pub trait RobotLink {
    /// How the robot is now, with the positions of some joints; never as it was some time ago.
    ///
    /// # Errors
    ///
    /// What of that is not known.
    fn state(&self, joints: &[&str]) -> Result<RobotState, RobotTrouble>;

    /// Sends goals for parts, each of which may take so long (s). The parts begin together: none moves unless all their
    /// servers are there and have accepted the goals.
    fn send(&mut self, goals: &[(RobotPart, PartGoal, f64)]) -> Vec<GoalTicket>;

    /// How a goal has ended, if it has. Tells it once.
    fn end(&mut self, ticket: GoalTicket) -> Option<RobotEnd>;

    /// Lets a goal end.
    fn cancel(&mut self, ticket: GoalTicket);

    /// Whether these joints do not move, or none of the robot's if `None`, nor the base if that is meant, as it tells now.
    fn stands_still(&self, joints: Option<&[&str]>, base: bool) -> bool;

    /// Asks what objects the camera sees: of a type and a name, or of any if these are empty.
    fn look(&mut self, type_name: &str, name: &str) -> GoalTicket;

    /// What it sees, if that has been answered. Tells it once.
    fn seen(&mut self, ticket: GoalTicket) -> Option<Result<Vec<SeenObject>, RobotTrouble>>;

    /// The time of a clock that never jumps.
    fn now(&self) -> Duration;

    /// Waits some milliseconds.
    fn wait(&self);

    /// Tells a person something that must not be overlooked.
    fn shout(&self, text: &str);
}
