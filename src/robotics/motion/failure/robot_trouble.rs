//! What goes wrong between a plan and a robot that is driven from outside.

use serde::Serialize;
use thiserror::Error;

use super::process_module::ProcessModule;

/// What has gone wrong.
#[derive(Clone, Debug, Error, PartialEq, Serialize)]
pub enum RobotTrouble {
    /// Nobody offers an action or a service; nothing was sent.
    #[error("nobody serves {name} (waited {waited:.0} s)")]
    Unserved {
        /// Its name.
        name: String,
        /// How long (s) was waited.
        waited: f64,
    },
    /// Several offer an action by one name: which of them moves the robot is not known, so nothing was sent.
    #[error("{servers} servers serve {name}: end all but one (waited {waited:.0} s)")]
    Contested {
        /// Its name.
        name: String,
        /// How many they are.
        servers: usize,
        /// How long (s) was waited.
        waited: f64,
    },
    /// Parts were to begin together, and one of them was not accepted by then; all were cancelled.
    #[error(
        "{name} has not accepted its goal by when all parts were to begin together: all were cancelled"
    )]
    Apart {
        /// Its name.
        name: String,
    },
    /// It was not said whether a goal is accepted, or a question was not answered.
    #[error("{name} has not answered (waited {waited:.0} s)")]
    NoAnswer {
        /// Its name.
        name: String,
        /// How long (s) was waited.
        waited: f64,
    },
    /// A goal was rejected; nothing has moved.
    #[error("{name} has rejected the goal")]
    Rejected {
        /// Its name.
        name: String,
    },
    /// A goal was given up by its server.
    #[error("{name} has given up: {text}")]
    Aborted {
        /// Its name.
        name: String,
        /// What it says about that.
        text: String,
    },
    /// A goal was cancelled, not by this program.
    #[error("the goal of {name} was cancelled by someone else")]
    CanceledElsewhere {
        /// Its name.
        name: String,
    },
    /// There was no result in time.
    #[error(
        "no result of {name} within {limit:.0} s (actionlib-action-timed-out); {}",
        if *.has_ended { "it was cancelled" } else { "it was cancelled, AND NOTHING SAYS THAT IT HAS ENDED" }
    )]
    Late {
        /// Its name.
        name: String,
        /// How long (s) it was waited for.
        limit: f64,
        /// Whether the goal has ended after it was cancelled.
        has_ended: bool,
    },
    /// A goal was accepted, and its turn has not come in time.
    #[error(
        "{name} has accepted the goal and not begun it within {limit:.0} s (actionlib-action-timed-out); {}",
        if *.has_ended { "it was cancelled" } else { "it was cancelled, AND NOTHING SAYS THAT IT HAS ENDED" }
    )]
    NotBegun {
        /// Its name.
        name: String,
        /// How long (s) that was waited for.
        limit: f64,
        /// Whether the goal has ended after it was cancelled.
        has_ended: bool,
    },
    /// The server has gone away while it had a goal.
    #[error("the server of {name} is gone")]
    Gone {
        /// Its name.
        name: String,
    },
    /// The server does not know a goal that it had accepted.
    #[error("the server of {name} does not know the goal any more: it may have begun anew")]
    Forgotten {
        /// Its name.
        name: String,
    },
    /// A goal has been cancelled by this program, and nothing says that it has ended.
    #[error("the goal of {name} was cancelled, AND NOTHING SAYS THAT IT HAS ENDED")]
    NotEnding {
        /// Its name.
        name: String,
    },
    /// A goal was reported to be reached, and is not.
    #[error("{name} reported success {beside}")]
    Beside {
        /// Its name.
        name: String,
        /// How far from the goal, where.
        beside: String,
    },
    /// It is not known where the robot is.
    #[error("{0}")]
    NoState(String),
    /// The fingers have met without an object between them.
    #[error(
        "There was no object to grip\n{name} closed the fingers to {gap:.4} m: nothing is between them"
    )]
    NothingGripped {
        /// Its name.
        name: String,
        /// The gap (m).
        gap: f64,
    },
    /// The camera's objects cannot be told.
    #[error("{name} cannot tell what the camera sees: {text}")]
    Blind {
        /// Its name.
        name: String,
        /// What it says about that.
        text: String,
    },
    /// The motion cannot be carried out by another robot.
    #[error("{0}")]
    NotPossible(String),
}

/// What has gone wrong with a motion of a part of the robot.
#[derive(Clone, Debug, Error, PartialEq, Serialize)]
#[error("{trouble}")]
pub struct RobotFailure {
    /// The part.
    pub module: ProcessModule,
    /// What has gone wrong.
    pub trouble: RobotTrouble,
}

impl RobotFailure {
    /// Name of CRAM's failure class.
    pub(super) fn class_name(&self) -> &'static str {
        use ProcessModule as P;
        use RobotTrouble as T;
        match &self.trouble {
            T::NothingGripped { .. } => "GRIPPER-CLOSED-COMPLETELY",
            T::Rejected { .. } => match self.module {
                P::Navigation => "NAVIGATION-POSE-UNREACHABLE",
                P::Torso => "TORSO-GOAL-UNREACHABLE",
                P::Neck => "PTU-GOAL-UNREACHABLE",
                P::Perception => "PERCEPTION-LOW-LEVEL-FAILURE",
                P::Grippers => "GRIPPER-LOW-LEVEL-FAILURE",
                P::Arms => "MANIPULATION-POSE-UNREACHABLE",
                P::Clock => "LOW-LEVEL-FAILURE",
            },
            T::Aborted { .. }
            | T::CanceledElsewhere { .. }
            | T::Late { .. }
            | T::NotBegun { .. }
            | T::NotEnding { .. }
            | T::Beside { .. } => match self.module {
                P::Navigation => "NAVIGATION-GOAL-NOT-REACHED",
                P::Torso => "TORSO-GOAL-NOT-REACHED",
                P::Neck => "PTU-GOAL-NOT-REACHED",
                P::Perception => "PERCEPTION-LOW-LEVEL-FAILURE",
                P::Grippers => "GRIPPER-GOAL-NOT-REACHED",
                P::Arms => "MANIPULATION-GOAL-NOT-REACHED",
                P::Clock => "LOW-LEVEL-FAILURE",
            },
            T::Unserved { .. }
            | T::Contested { .. }
            | T::Apart { .. }
            | T::NoAnswer { .. }
            | T::Gone { .. }
            | T::Forgotten { .. }
            | T::NoState(_)
            | T::Blind { .. }
            | T::NotPossible(_) => match self.module {
                P::Navigation => "NAVIGATION-LOW-LEVEL-FAILURE",
                P::Torso => "TORSO-LOW-LEVEL-FAILURE",
                P::Neck => "PTU-LOW-LEVEL-FAILURE",
                P::Perception => "PERCEPTION-LOW-LEVEL-FAILURE",
                P::Grippers => "GRIPPER-LOW-LEVEL-FAILURE",
                P::Arms => "MANIPULATION-LOW-LEVEL-FAILURE",
                P::Clock => "LOW-LEVEL-FAILURE",
            },
        }
    }
}
