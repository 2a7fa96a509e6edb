//! The parts of the robot that motions use exclusively.

use std::fmt;

use serde::Serialize;

/// The part of the robot that a motion uses exclusively. At most one job per module may be
/// active at a time; jobs of different modules set different joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub enum ProcessModule {
    /// The base.
    Navigation,
    /// The torso lift.
    Torso,
    /// Pan and tilt of the head.
    Neck,
    /// The cameras.
    Perception,
    /// The fingers of both hands.
    Grippers,
    /// Both arms, and the torso if a hand's goal needs another height.
    Arms,
    /// Nothing of the robot: any number of jobs may let time pass at once.
    Clock,
}

impl ProcessModule {
    /// Whether a job of this module must wait for one of the other.
    pub fn excludes(self, other: ProcessModule) -> bool {
        self == other && self != Self::Clock
    }
}

impl fmt::Display for ProcessModule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Navigation => "navigation",
            Self::Torso => "torso",
            Self::Neck => "neck",
            Self::Perception => "perception",
            Self::Grippers => "grippers",
            Self::Arms => "arms",
            Self::Clock => "clock",
        })
    }
}
