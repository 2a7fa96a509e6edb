//! Inverse kinematics in closed form, of an arm with the PR2's joint layout: the joint positions that put
//! the wrist at a pose, in closed form and complete over the one redundant freedom.
//!
//! Limits are the soft limits of the URDF (those of the safety controller) where it gives
//! any. All dimensions come from the kinematic tree. A pose of the wrist is the pose of the
//! arm's tip link in the frame of the arm's base link; nothing here knows of tools,
//! collisions or other arms.

use nalgebra::Matrix3;

use super::arm_chain::{ArmChain, ArmChainError, ELBOW, FLEX, FOREARM, LIFT, PAN, ROLL, WRIST};
use super::arm_kinematics::toward_seed;
use super::elbow_curve::{ElbowCurve, Stretch, wrist_angles};
use super::unreachable::Unreachable;
use super::{ArmPositions, JointId, KinematicTree, Limits, LinkId};
use spatial::{Pose, trig};

/// Positions up to this far (rad) outside a limit are clamped to the limit.
const SLACK: f64 = 1e-9;
/// Samples evaluated on each stretch before the best one is refined.
const PLACES: usize = 9;
/// Steps of refinement; each narrows the stretch to 62 %.
const REFINEMENTS: usize = 8;

/// A solution with its place in the solution set.
#[derive(Clone, Debug)]
struct Candidate {
    stretch: Stretch,
    share: f64,
    /// Sum of the squared joint differences (rad²) from the seed.
    distance: f64,
    positions: ArmPositions,
}

/// The nearer of two candidates, or the first if they are equally near.
fn nearer(a: Option<Candidate>, b: Option<Candidate>) -> Option<Candidate> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b.distance < a.distance { b } else { a }),
        (a, b) => a.or(b),
    }
}

/// The orientation of the forearm before it is rolled, in the frame of the arm's base.
fn forearm_rotation(positions: &ArmPositions) -> Matrix3<f64> {
    let (sin, cos) = trig::sin_cos(positions[PAN]);
    let pan = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
    pan * about_y(positions[LIFT]) * about_x(positions[ROLL]) * about_y(positions[ELBOW])
}

fn about_x(angle: f64) -> Matrix3<f64> {
    let (sin, cos) = trig::sin_cos(angle);
    Matrix3::new(1.0, 0.0, 0.0, 0.0, cos, -sin, 0.0, sin, cos)
}

fn about_y(angle: f64) -> Matrix3<f64> {
    let (sin, cos) = trig::sin_cos(angle);
    Matrix3::new(cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos)
}

/// Inverse kinematics of one arm.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosedForm {
    chain: ArmChain,
}

impl ClosedForm {
    /// The arm from link `base` (the torso) to link `tip` (the wrist).
    pub fn new(tree: &KinematicTree, base: LinkId, tip: LinkId) -> Result<Self, ArmChainError> {
        Ok(Self {
            chain: ArmChain::read(tree, base, tip)?,
        })
    }

    /// The joints from the shoulder to the wrist: shoulder pan, shoulder lift, upper arm
    /// roll, elbow flex, forearm roll, wrist flex, wrist roll.
    pub fn joints(&self) -> &[JointId] {
        &self.chain.joints
    }

    /// The limits (rad) that solutions respect; `None` for continuous joints.
    pub fn limits(&self) -> &[Option<Limits>] {
        &self.chain.limits
    }

    /// The solutions with the upper arm rolled to `roll` (rad): at most two, with continuous
    /// joints within -π..π.
    pub fn solve(&self, wrist: &Pose, roll: f64) -> Vec<ArmPositions> {
        let curve = ElbowCurve::new(&self.chain, wrist);
        let found = curve.positions_at_roll(roll).into_iter().flatten();
        found.filter_map(|q| self.within_limits(q)).collect()
    }

    /// Solutions from every part of the solution set, with continuous joints within -π..π.
    /// Neighbours are about `step` (rad) apart in the shoulder joint that moves most.
    ///
    /// Empty exactly when the pose is unreachable.
    pub fn solutions(&self, wrist: &Pose, step: f64) -> Vec<ArmPositions> {
        let curve = ElbowCurve::new(&self.chain, wrist);
        let mut found = Vec::new();
        for stretch in curve.stretches() {
            let at = |share: f64| {
                let q = curve.positions(stretch.lift_at(share), stretch.bend)?;
                self.within_limits(q)
            };
            let coarse: Vec<ArmPositions> =
                (0..=8).filter_map(|i| at(f64::from(i) / 8.0)).collect();
            let lengths = coarse.windows(2).map(|pair| {
                let turns = (0..3).map(|j| (pair[1][j] - pair[0][j]).abs());
                turns.fold(0.0, f64::max)
            });
            let length: f64 = lengths.sum();
            let count = (length / step.max(1e-4)).ceil().clamp(1.0, 10_000.0) as u32;
            found.extend((0..=count).filter_map(|i| at(f64::from(i) / f64::from(count))));
        }
        found
    }

    /// Whether there is a solution at all; faster than finding one.
    pub fn reaches(&self, wrist: &Pose) -> bool {
        !self.is_too_far(wrist) && !ElbowCurve::new(&self.chain, wrist).stretches().is_empty()
    }

    /// Whether the wrist is farther away than the arm is long.
    pub(super) fn is_too_far(&self, wrist: &Pose) -> bool {
        let away = (wrist.translation.vector - self.chain.shoulder).norm();
        away > self.chain.length() || away.is_nan()
    }

    /// A solution near `seed`: continuous joints are within half a turn of the seed.
    ///
    /// "Near" means the least sum of squared joint differences among samples spread over all
    /// parts of the solution set, refined around the best one. If there is no solution, the
    /// error says why.
    pub fn nearest(&self, wrist: &Pose, seed: &ArmPositions) -> Result<ArmPositions, Unreachable> {
        let curve = ElbowCurve::new(&self.chain, wrist);
        let mut best: Option<Candidate> = None;
        for stretch in curve.stretches() {
            for i in 0..PLACES {
                let share = i as f64 / (PLACES - 1) as f64;
                let found = self.candidate(&curve, stretch, share, seed);
                best = nearer(best, found);
            }
        }
        match best {
            Some(best) => Ok(self.refine(&curve, best, seed).positions),
            None => Err(Unreachable::explain(&self.chain, &curve)),
        }
    }

    /// The orientation of the wrist's last link in the frame of the arm's base.
    pub(crate) fn hand_rotation(&self, positions: &ArmPositions) -> Matrix3<f64> {
        forearm_rotation(positions)
            * about_x(positions[FOREARM])
            * about_y(positions[FLEX])
            * about_x(positions[WRIST])
    }

    /// The positions with the last three joints turned so that the hand has an orientation in the frame of
    /// the arm's base. The wrist stays where it is. `None` if that is beyond the limits.
    pub(crate) fn with_hand_turned(
        &self,
        positions: &ArmPositions,
        hand: &Matrix3<f64>,
    ) -> Option<ArmPositions> {
        let [forearm, flex, wrist] = wrist_angles(&forearm_rotation(positions), hand);
        let mut turned = *positions;
        (turned[FOREARM], turned[FLEX], turned[WRIST]) = (forearm, flex, wrist);
        let turned = self.within_limits(turned)?;
        Some(self.toward_seed(turned, positions))
    }

    fn candidate(
        &self,
        curve: &ElbowCurve<'_>,
        stretch: Stretch,
        share: f64,
        seed: &ArmPositions,
    ) -> Option<Candidate> {
        let positions = curve.positions(stretch.lift_at(share), stretch.bend)?;
        let positions = self.toward_seed(self.within_limits(positions)?, seed);
        let differences = positions.iter().zip(seed).map(|(a, b)| a - b);
        Some(Candidate {
            stretch,
            share,
            distance: differences.map(|d| d * d).sum(),
            positions,
        })
    }

    /// Golden-section search between the neighbours of the best sample.
    fn refine(&self, curve: &ElbowCurve<'_>, best: Candidate, seed: &ArmPositions) -> Candidate {
        const GOLDEN: f64 = 0.618_033_988_749_894_8;
        let at = |share: f64| self.candidate(curve, best.stretch, share, seed);
        let distance = |c: &Option<Candidate>| c.as_ref().map_or(f64::INFINITY, |c| c.distance);
        let width = 1.0 / (PLACES - 1) as f64;
        let mut lo = (best.share - width).max(0.0);
        let mut hi = (best.share + width).min(1.0);
        let mut left = at(hi - GOLDEN * (hi - lo));
        let mut right = at(lo + GOLDEN * (hi - lo));
        for _ in 0..REFINEMENTS {
            if distance(&left) <= distance(&right) {
                hi = lo + GOLDEN * (hi - lo);
                right = left;
                left = at(hi - GOLDEN * (hi - lo));
            } else {
                lo = hi - GOLDEN * (hi - lo);
                left = right;
                right = at(lo + GOLDEN * (hi - lo));
            }
        }
        let refined = nearer(left, right);
        nearer(Some(best.clone()), refined).unwrap_or(best)
    }

    /// The positions, clamped to limits that they exceed only by rounding; `None` if they
    /// exceed a limit by more.
    fn within_limits(&self, mut positions: ArmPositions) -> Option<ArmPositions> {
        for (position, limits) in positions.iter_mut().zip(&self.chain.limits) {
            if let Some(limits) = limits {
                if limits.excess(*position) > SLACK {
                    return None;
                }
                *position = limits.clamp(*position);
            }
        }
        Some(positions)
    }

    fn toward_seed(&self, positions: ArmPositions, seed: &ArmPositions) -> ArmPositions {
        toward_seed(positions, &self.chain.limits, seed)
    }
}
