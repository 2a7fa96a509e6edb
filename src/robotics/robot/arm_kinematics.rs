//! Inverse kinematics of an arm: the joint positions that put the wrist at a pose.
//!
//! Where the layout of the joints allows it, they are calculated in closed form, which also proves
//! that a pose is unreachable; otherwise they are searched numerically. Limits are the soft limits of
//! the URDF (those of the safety controller) where it gives any. All dimensions come from the
//! kinematic tree. A pose of the wrist is the pose of the arm's tip link in the frame of the arm's
//! base link; nothing here knows of tools, collisions or other arms.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

use super::closed_form::ClosedForm;
use super::{
    ArmPlane, ArmPositions, JointChainError, JointId, KinematicTree, Limits, LinkId,
    NumericKinematics, ReachMap, Unreachable,
};
use spatial::{Pose, trig};

/// Inverse kinematics of one arm.
#[derive(Clone, Debug, PartialEq)]
pub struct ArmKinematics {
    solver: Solver,
}

#[derive(Clone, Debug, PartialEq)]
enum Solver {
    ClosedForm(ClosedForm),
    Numeric(NumericKinematics),
}

impl ArmKinematics {
    /// The arm from link `base` (the torso) to link `tip` (the wrist).
    ///
    /// # Errors
    ///
    /// If there is no chain of one to eight joints between the two.
    pub fn new(tree: &KinematicTree, base: LinkId, tip: LinkId) -> Result<Self, JointChainError> {
        let solver = match ClosedForm::new(tree, base, tip) {
            Ok(solver) => Solver::ClosedForm(solver),
            Err(_) => Solver::Numeric(NumericKinematics::new(tree, base, tip)?),
        };
        Ok(Self { solver })
    }

    /// Whether they are calculated: then all solutions are found, and a pose without any is proved
    /// to be unreachable.
    pub fn is_closed_form(&self) -> bool {
        matches!(self.solver, Solver::ClosedForm(_))
    }

    /// The same, for a hand whose tool is at a point (m, frame of the wrist): an arm of fewer than six joints
    /// brings that to its place.
    #[must_use]
    pub fn with_tool_at(self, point: Vector3<f64>) -> Self {
        Self {
            solver: match self.solver {
                Solver::Numeric(solver) => Solver::Numeric(solver.meeting_at(point)),
                closed_form @ Solver::ClosedForm(_) => closed_form,
            },
        }
    }

    /// How far (m, rad) from a pose a solution may be: next to nothing, but for an arm of fewer than six
    /// joints.
    pub fn tolerance(&self) -> (f64, f64) {
        match &self.solver {
            Solver::ClosedForm(_) => (0.0, 0.0),
            Solver::Numeric(solver) => solver.tolerance(),
        }
    }

    /// The plane in which an arm of fewer than six joints moves its hand freely, if there is one.
    pub fn plane(&self) -> Option<&ArmPlane> {
        match &self.solver {
            Solver::ClosedForm(_) => None,
            Solver::Numeric(solver) => solver.plane(),
        }
    }

    /// The joints from the shoulder to the wrist.
    pub fn joints(&self) -> &[JointId] {
        match &self.solver {
            Solver::ClosedForm(solver) => solver.joints(),
            Solver::Numeric(solver) => solver.joints(),
        }
    }

    /// The limits (rad or m) that solutions respect; `None` for continuous joints.
    pub fn limits(&self) -> &[Option<Limits>] {
        match &self.solver {
            Solver::ClosedForm(solver) => solver.limits(),
            Solver::Numeric(solver) => solver.limits(),
        }
    }

    /// Solutions from every part of the solution set, with continuous joints within -π..π.
    /// Neighbours are about `step` (rad) apart.
    pub fn solutions(&self, wrist: &Pose, step: f64) -> Vec<ArmPositions> {
        match &self.solver {
            Solver::ClosedForm(solver) => solver.solutions(wrist, step),
            Solver::Numeric(solver) => solver.solutions(wrist, step),
        }
    }

    /// Whether there is a solution at all; faster than finding one.
    pub fn reaches(&self, wrist: &Pose) -> bool {
        match &self.solver {
            Solver::ClosedForm(solver) => solver.reaches(wrist),
            Solver::Numeric(solver) => solver.reaches(wrist),
        }
    }

    /// Whether it is certain, and soon found, that there is no solution.
    pub(crate) fn surely_misses(&self, wrist: &Pose) -> bool {
        match &self.solver {
            Solver::ClosedForm(solver) => !solver.reaches(wrist),
            Solver::Numeric(solver) => solver.is_too_far(wrist),
        }
    }

    /// Whether the wrist is farther away than the arm is long.
    pub(crate) fn is_too_far(&self, wrist: &Pose) -> bool {
        match &self.solver {
            Solver::ClosedForm(solver) => solver.is_too_far(wrist),
            Solver::Numeric(solver) => solver.is_too_far(wrist),
        }
    }

    /// A solution near `seed`: continuous joints are within half a turn of the seed. If there is no
    /// solution, or none was found, the error says why.
    pub fn nearest(&self, wrist: &Pose, seed: &ArmPositions) -> Result<ArmPositions, Unreachable> {
        match &self.solver {
            Solver::ClosedForm(solver) => solver.nearest(wrist, seed),
            Solver::Numeric(solver) => solver.nearest(wrist, seed).map_err(Unreachable::Searched),
        }
    }

    /// The orientation of the wrist's last link in the frame of the arm's base.
    pub(crate) fn hand_rotation(&self, positions: &ArmPositions) -> Matrix3<f64> {
        match &self.solver {
            Solver::ClosedForm(solver) => solver.hand_rotation(positions),
            Solver::Numeric(solver) => rotation_of(&solver.forward(positions)),
        }
    }

    /// The positions with the hand turned to an orientation in the frame of the arm's base. The
    /// wrist stays where it is. `None` if that is beyond the limits.
    pub(crate) fn with_hand_turned(
        &self,
        positions: &ArmPositions,
        hand: &Matrix3<f64>,
    ) -> Option<ArmPositions> {
        match &self.solver {
            Solver::ClosedForm(solver) => solver.with_hand_turned(positions, hand),
            Solver::Numeric(solver) => {
                let mut wrist = solver.forward(positions);
                let hand = Rotation3::from_matrix_unchecked(*hand);
                wrist.rotation = UnitQuaternion::from_rotation_matrix(&hand);
                solver.adjusted(&wrist, positions)
            }
        }
    }

    /// Where the arm may bring a tool (m, frame of the wrist) ahead of its wrist. `None` for an arm that is solved in
    /// closed form, which tells that sooner itself, or that cannot be mapped.
    pub(super) fn map(&self, tool: Vector3<f64>) -> Option<ReachMap> {
        match &self.solver {
            Solver::ClosedForm(_) => None,
            Solver::Numeric(solver) => solver.map(tool),
        }
    }

    /// The chain to the tip from a link below the lift that raises the arm: it tells of all heights at once what is out of
    /// reach. `None` for an arm that is solved in closed form, which tells that sooner of each height, or has too few
    /// joints for poses in general, and if there is no such chain of at most eight joints.
    pub(super) fn with_lift(
        &self,
        tree: &KinematicTree,
        (below, tip): (LinkId, LinkId),
        lift: JointId,
    ) -> Option<NumericKinematics> {
        let Solver::Numeric(solver) = &self.solver else {
            return None;
        };
        let lifted = NumericKinematics::new(tree, below, tip).ok()?;
        let (first, arm) = lifted.joints().split_first()?;
        let is_lift = solver.is_general() && *first == lift && arm == solver.joints();
        is_lift.then_some(lifted)
    }
}

fn rotation_of(pose: &Pose) -> Matrix3<f64> {
    pose.rotation.to_rotation_matrix().into_inner()
}

/// The positions with the joints that have no limits turned to within half a turn of the seed.
pub(super) fn toward_seed(
    mut positions: ArmPositions,
    limits: &[Option<Limits>],
    seed: &ArmPositions,
) -> ArmPositions {
    for ((position, limits), seed) in positions.iter_mut().zip(limits).zip(seed) {
        if limits.is_none() {
            *position = seed + trig::wrap(*position - seed);
        }
    }
    positions
}
