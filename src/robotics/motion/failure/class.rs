//! CRAM's names for the failures of motions.

use super::motion_failure::MotionFailure;
use super::process_module::ProcessModule;

impl MotionFailure {
    /// Name of CRAM's failure class, by which handlers catch this failure.
    pub fn class_name(&self) -> &'static str {
        match self {
            Self::GoalOccupied { .. }
            | Self::GoalOffMap { .. }
            | Self::BaseIsFixed { .. }
            | Self::Enclosed { .. } => "NAVIGATION-POSE-UNREACHABLE",
            Self::DriveStartOccupied { .. }
            | Self::DriveBlocked { .. }
            | Self::DrivePushes { .. } => "NAVIGATION-GOAL-NOT-REACHED",
            Self::TorsoGoalOutOfLimits { .. } => "TORSO-GOAL-NOT-REACHED",
            Self::TorsoBlocked { .. } => "TORSO-GOAL-UNREACHABLE",
            Self::NeckLimit { .. } | Self::NeckBlocked { .. } | Self::NeckMissing => {
                "PTU-GOAL-NOT-REACHED"
            }
            Self::ObjectNotFound { .. } => "PERCEPTION-OBJECT-NOT-FOUND",
            Self::NothingGripped { .. }
            | Self::WrongObject { .. }
            | Self::NotBetweenFingers { .. }
            | Self::HeldObjectSlipped(_)
            | Self::HandleSlipped(_) => "GRIPPER-CLOSED-COMPLETELY",
            Self::HoldsNoHandle { .. } | Self::PartStopped(_) | Self::ArmTooShort(_) => {
                "ENVIRONMENT-MANIPULATION-GOAL-NOT-REACHED"
            }
            Self::GripperLimit { .. }
            | Self::FingersBlocked { .. }
            | Self::FingerPins { .. }
            | Self::GripEffort { .. } => "GRIPPER-GOAL-NOT-REACHED",
            Self::PoseUnreachable(_)
            | Self::NoGrasp(_)
            | Self::NoHandleGrasp(_)
            | Self::WrongTrajectory(_)
            | Self::TorsoConflict { .. } => "MANIPULATION-POSE-UNREACHABLE",
            Self::JointLimit { .. }
            | Self::JointCount { .. }
            | Self::ArmGoalInCollision { .. }
            | Self::ArmStartInCollision { .. }
            | Self::ArmPathNotFound { .. }
            | Self::NoLevelPath { .. }
            | Self::NotCarriedUpright { .. }
            | Self::ArmBlocked { .. }
            | Self::HandGoalMissed { .. }
            | Self::HeldObjectStuck(_)
            | Self::ObjectPinned(_)
            | Self::ObjectPushed(_)
            | Self::TooHeavy(_)
            | Self::LoopBroken(_)
            | Self::NothingBelow { .. }
            | Self::WouldNotStand { .. }
            | Self::NoWayDown { .. }
            | Self::HoldsNothing { .. } => "MANIPULATION-GOAL-NOT-REACHED",
            Self::NotFinite { module } => match module {
                ProcessModule::Navigation => "NAVIGATION-POSE-UNREACHABLE",
                ProcessModule::Torso => "TORSO-GOAL-NOT-REACHED",
                ProcessModule::Neck => "PTU-GOAL-NOT-REACHED",
                ProcessModule::Perception => "PERCEPTION-LOW-LEVEL-FAILURE",
                ProcessModule::Grippers => "GRIPPER-GOAL-NOT-REACHED",
                ProcessModule::Arms => "MANIPULATION-POSE-UNREACHABLE",
                ProcessModule::Clock => "LOW-LEVEL-FAILURE",
            },
            Self::Stalled { module } => match module {
                ProcessModule::Navigation => "NAVIGATION-GOAL-NOT-REACHED",
                ProcessModule::Torso => "TORSO-GOAL-NOT-REACHED",
                ProcessModule::Neck => "PTU-GOAL-NOT-REACHED",
                ProcessModule::Perception => "PERCEPTION-LOW-LEVEL-FAILURE",
                ProcessModule::Grippers => "GRIPPER-GOAL-NOT-REACHED",
                ProcessModule::Arms => "MANIPULATION-GOAL-NOT-REACHED",
                ProcessModule::Clock => "LOW-LEVEL-FAILURE",
            },
            Self::Robot(failure) => failure.class_name(),
            Self::UnknownName(_) => "LOW-LEVEL-FAILURE",
        }
    }
}
