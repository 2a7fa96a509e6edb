//! Why a trajectory that somebody else has planned is not followed.

use serde::Serialize;

use super::motion_failure::MotionFailure;

/// What is wrong with a trajectory. Points are counted from 0.
#[derive(Clone, Debug, PartialEq, Serialize, thiserror::Error)]
pub enum WrongTrajectory {
    /// There is no point in it.
    #[error("the trajectory has no points: one at least was expected")]
    Empty,
    /// It has more points, or takes longer, than it may.
    #[error("the trajectory has more than {points} points, or takes longer than {seconds} s")]
    TooLong {
        /// How many points it may have.
        points: usize,
        /// How long (s) it may take.
        seconds: f64,
    },
    /// A point has not one number for each joint.
    #[error(
        "point {point} of the trajectory has {given} numbers: {expected} were expected, one for each joint"
    )]
    Count {
        /// The point.
        point: usize,
        /// How many it has.
        given: usize,
        /// How many joints there are.
        expected: usize,
    },
    /// A number is infinite or none.
    #[error("point {point} of the trajectory has a number that is not finite")]
    NotFinite {
        /// The point.
        point: usize,
    },
    /// A time is not later than the one before it.
    #[error(
        "the time of point {point} of the trajectory is not later than that of the point before it"
    )]
    Times {
        /// The point.
        point: usize,
    },
    /// The joints would not rest at the end.
    #[error(
        "the trajectory ends with a velocity of {velocity:.3}: joints have to be at rest there"
    )]
    EndsMoving {
        /// The velocity (rad/s or m/s).
        velocity: f64,
    },
    /// It begins at once, but not where the joints are.
    #[error(
        "{joint} is at {position:.3}, and the trajectory begins at {begin:.3}: plan it from where the robot is"
    )]
    BeginsElsewhere {
        /// The joint.
        joint: String,
        /// Where it is (rad or m).
        position: f64,
        /// Where the trajectory begins.
        begin: f64,
    },
    /// A joint would have to go where it cannot.
    #[error(
        "{joint} would have to be at {position:.3} at {time:.2} s, outside of its limits {lower:.3}..{upper:.3}"
    )]
    BeyondLimits {
        /// The joint.
        joint: String,
        /// Where it would have to be (rad or m).
        position: f64,
        /// Its least position.
        lower: f64,
        /// Its greatest position.
        upper: f64,
        /// When (s).
        time: f64,
    },
    /// A joint would have to be faster than it can.
    #[error("{joint} would have to move at {velocity:.2} at {time:.2} s: its limit is {limit:.2}")]
    TooFast {
        /// The joint.
        joint: String,
        /// How fast (rad/s or m/s).
        velocity: f64,
        /// How fast it can.
        limit: f64,
        /// When (s).
        time: f64,
    },
}

impl From<WrongTrajectory> for MotionFailure {
    fn from(wrong: WrongTrajectory) -> Self {
        Self::WrongTrajectory(Box::new(wrong))
    }
}
