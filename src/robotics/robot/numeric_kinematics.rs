//! Inverse kinematics of any chain of up to eight joints: damped least squares from many starts.
//!
//! For arms without a closed form. What is found is a solution; what is not found may still exist, unless
//! the goal is farther away than the chain is long. Everything is determined by goal and seed: the starts
//! are drawn once, when the chain is read.
//!
//! A chain of fewer than six joints, the pieces of a telescope counted once, meets hardly any pose exactly. It brings its tip to the place, and its
//! orientation is within 2 degrees of the wanted one.

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::arm_plane::{ArmPlane, GENERAL};
use super::arm_positions::{ArmPositions, MOST_ARM_JOINTS};
use super::chain_descent::{ChainDescent, DISTANCE, Descent, difference};
use super::chain_length::ChainLength;
use super::joint_chain::{ChainPositions, JointChain, JointChainError};
use super::shares::Shares;
use super::{JointId, KinematicTree, Limits, LinkId, Miss, ReachMap};
use spatial::{Pose, trig};

/// Starts from which a chain of fewer than six joints is to meet a pose exactly, before it meets it nearly.
const EXACT_TRIES: usize = 20;
/// Starts of a search, the seed among them.
const TRIES: usize = 100;
/// After how many starts a goal is taken as out of reach, where only that is asked, if no end has come this near (root
/// of the squared error). Of a thousand poses each of seven chains one is missed, and a question in vain takes a quarter of
/// the time of a search (`how_fast_chains_are_solved`, with a TIAGo added).
const QUICK: [(usize, f64); 2] = [(24, 0.05), (40, 0.0)];
/// The same where few that are missed do no harm: of those poses three are missed, and a question in vain takes half of that
/// time.
const HASTY: [(usize, f64); 3] = [(6, 0.25), (12, 0.05), (24, 0.0)];
/// Random postures of which those are starts whose tips are nearest to the goal.
const POSTURES: usize = 400;
/// A solution whose joints are all this near (rad or m) to the seed needs no comparison.
const NEAR: f64 = 1.0;
/// Solutions that are compared, unless the first one is near, and starts that are tried for that.
const COMPARED: usize = 2;
/// Steps along the solutions towards the seed.
const PULLS: usize = 4;
/// Least difference (rad or m) of a joint between two solutions that count as two.
const APART: f64 = 0.1;
/// Solutions of a goal that are listed at most.
const MOST_SOLUTIONS: usize = 60;

/// Inverse kinematics of one chain.
#[derive(Clone, Debug, PartialEq)]
pub struct NumericKinematics {
    descent: ChainDescent,
    length: ChainLength,
    /// Where a chain of fewer than six joints moves its tip freely, if there is such a plane.
    plane: Option<ArmPlane>,
    /// The middle of the limits, or 0.
    middle: ChainPositions,
    /// Random postures, with the tip of each.
    postures: Vec<(ChainPositions, Pose)>,
}

impl NumericKinematics {
    /// The chain from link `base` to link `tip`.
    ///
    /// # Errors
    ///
    /// If `tip` does not hang on `base`, if there are no moving joints or more than
    /// [`MOST_ARM_JOINTS`] between the two, or if one of them follows a joint elsewhere.
    pub fn new(tree: &KinematicTree, base: LinkId, tip: LinkId) -> Result<Self, JointChainError> {
        JointChain::read(tree, base, tip).map(Self::of)
    }

    fn of(chain: JointChain) -> Self {
        let mut bounds = [[0.0; 2]; MOST_ARM_JOINTS];
        for (bound, limits) in bounds.iter_mut().zip(&chain.limits) {
            *bound = match limits {
                Some(limits) => [limits.lower, limits.upper],
                None => [f64::NEG_INFINITY, f64::INFINITY],
            };
        }
        let mut shares = Shares::new();
        let drawn = |bound: [f64; 2], share: f64| match bound.map(f64::is_finite) {
            [true, true] => bound[0] + share * (bound[1] - bound[0]),
            _ => PI * (2.0 * share - 1.0),
        };
        let plane = ArmPlane::of(&chain);
        let postures = (0..POSTURES).map(|i| {
            let posture = bounds.map(|bound| drawn(bound, shares.next()));
            let posture = match &plane {
                Some(plane) if i % 4 > 0 => plane.in_plane(posture),
                _ => posture,
            };
            (posture, chain.forward(&posture))
        });
        let postures = postures.collect();
        Self {
            middle: bounds.map(|bound| drawn(bound, 0.5)),
            postures,
            length: ChainLength::of(&chain),
            plane,
            descent: ChainDescent::new(chain, bounds),
        }
    }

    /// The joints from the base to the tip that move on their own.
    pub fn joints(&self) -> &[JointId] {
        &self.descent.chain.joints
    }

    /// The limits (rad or m) that solutions respect; `None` for continuous joints.
    pub fn limits(&self) -> &[Option<Limits>] {
        &self.descent.chain.limits
    }

    /// The chain whose tip's point (m, frame of the tip) counts where it cannot meet a pose exactly.
    #[must_use]
    pub fn meeting_at(mut self, point: Vector3<f64>) -> Self {
        self.descent.point = point;
        self
    }

    /// Whether the chain has enough joints for poses in general.
    pub(super) fn is_general(&self) -> bool {
        self.descent.is_general
    }

    /// How far (m, rad) from a goal a solution may be.
    pub fn tolerance(&self) -> (f64, f64) {
        self.descent.tolerance()
    }

    /// The plane in which a chain of fewer than six joints moves its tip freely, if there is one.
    pub fn plane(&self) -> Option<&ArmPlane> {
        self.plane.as_ref()
    }

    /// Pose of the tip in the frame of the base. Joints without a position are at 0.
    pub fn forward(&self, positions: &[f64]) -> Pose {
        self.descent.chain.forward(positions)
    }

    /// A solution near `seed`: joints that turn without limits are within half a turn of the seed.
    ///
    /// The search starts at the seed, then elsewhere; of several solutions the nearer one counts, moved
    /// towards the seed as far as the hand lets it.
    ///
    /// # Errors
    ///
    /// If no solution is found.
    pub fn nearest(&self, goal: &Pose, seed: &ArmPositions) -> Result<ArmPositions, Miss> {
        self.check(goal)?;
        let seed = self.start_at(seed);
        let mut best: Option<(f64, ChainPositions)> = None;
        let mut closest: Option<Descent> = None;
        let mut compared = 0;
        if !self.descent.is_general {
            let mut ends = (self.starts(goal, seed).take(self.exact_tries()))
                .map(|start| self.descent.descend(goal, &start));
            if let Some(exact) = ends.find(|end| end.is_exact()) {
                return Ok(self.cut(&self.turned_to(&exact.positions, &seed)));
            }
        }
        for start in self.starts(goal, seed).take(TRIES) {
            let found = self.descent.descend(goal, &start);
            if self.descent.is_solution(&found) {
                let positions = self.turned_to(&found.positions, &seed);
                let away = self.greatest_move(&positions, &seed);
                if best.is_none_or(|(least, _)| away < least) {
                    best = Some((away, positions));
                }
                if away < NEAR {
                    break;
                }
            } else if closest.is_none_or(|closest| found.error < closest.error) {
                closest = Some(found);
            }
            compared += usize::from(best.is_some());
            if compared == COMPARED {
                break;
            }
        }
        match (best, closest) {
            (Some((away, found)), _) => Ok(self.cut(&self.towards(goal, &found, away, &seed))),
            (None, closest) => Err(Miss::NotFound {
                tries: TRIES,
                distance: closest.map_or(f64::INFINITY, |c| c.distance),
                angle: closest.map_or(PI, |c| c.angle),
            }),
        }
    }

    /// The solution to which the seed leads, if it leads to one: for a pose of the tip near that of the seed.
    pub fn adjusted(&self, goal: &Pose, seed: &ArmPositions) -> Option<ArmPositions> {
        if !self.descent.is_general {
            return self.nearest(goal, seed).ok();
        }
        let seed = self.start_at(seed);
        let found = self.descent.descend(goal, &seed);
        let positions = self.turned_to(&found.positions, &seed);
        let away = self.greatest_move(&positions, &seed);
        self.descent
            .is_solution(&found)
            .then(|| self.cut(&self.towards(goal, &positions, away, &seed)))
    }

    /// Where the chain may bring a tool (m, frame of the tip) ahead of its tip, if that can be mapped.
    pub(super) fn map(&self, tool: Vector3<f64>) -> Option<ReachMap> {
        self.descent
            .is_general
            .then(|| ReachMap::of(&self.descent.chain, &self.descent.bounds, tool))?
    }

    /// Different solutions, with continuous joints within -π..π: any two differ by `step` (rad or m), or
    /// at least 0.1, in some joint. Bounded in number; some may be missing.
    pub fn solutions(&self, goal: &Pose, step: f64) -> Vec<ArmPositions> {
        let apart = step.max(APART);
        let mut found: Vec<ChainPositions> = Vec::new();
        if self.check(goal).is_err() {
            return Vec::new();
        }
        let mut least = f64::INFINITY;
        for (tries, start) in self.starts(goal, self.middle).take(TRIES).enumerate() {
            let is_lost = found.is_empty() && self.is_hopeless(&QUICK, tries, least);
            if is_lost || found.len() == MOST_SOLUTIONS {
                break;
            }
            let end = self.descent.descend(goal, &start);
            least = least.min(end.error);
            let turned = self.turned_to(&end.positions, &[0.0; MOST_ARM_JOINTS]);
            let is_known = |known: &ChainPositions| self.greatest_move(known, &turned) < apart;
            if self.descent.is_solution(&end) && !found.iter().any(is_known) {
                found.push(turned);
            }
        }
        found.iter().map(|positions| self.cut(positions)).collect()
    }

    /// Whether a solution is found, without much trying; no solution is proof only of
    /// [`Miss::TooFar`]. Where there is a plane, only what lies in it counts: elsewhere the hand could not
    /// move straight.
    pub fn reaches(&self, goal: &Pose) -> bool {
        self.reaches_within(goal, &QUICK)
    }

    /// As [`Self::reaches`], sooner, but a few more are missed.
    pub(crate) fn reaches_soon(&self, goal: &Pose) -> bool {
        self.reaches_within(goal, &HASTY)
    }

    fn reaches_within(&self, goal: &Pose, patience: &[(usize, f64)]) -> bool {
        if self.plane.as_ref().is_some_and(|plane| !plane.holds(goal)) {
            return false;
        }
        if self.check(goal).is_err() {
            return false;
        }
        let mut least = f64::INFINITY;
        for (tries, start) in self.starts(goal, self.middle).enumerate() {
            if self.is_hopeless(patience, tries, least) {
                return false;
            }
            let end = self.descent.descend(goal, &start);
            if self.descent.is_solution(&end) {
                return true;
            }
            least = least.min(end.error);
        }
        false
    }

    /// Whether a goal counts as out of reach after so many tries, of which the best one has left that squared error.
    fn is_hopeless(&self, patience: &[(usize, f64)], tries: usize, least: f64) -> bool {
        let mut patience = patience.iter();
        patience.any(|(after, near)| {
            let is_far = least > near * near && (self.descent.is_general || *near == 0.0);
            tries >= *after && is_far
        })
    }

    /// Whether it is certain, without a search, that there is no solution.
    pub(super) fn is_too_far(&self, goal: &Pose) -> bool {
        self.check(goal).is_err()
    }

    /// Starts from which a chain that cannot meet poses in general is to meet one exactly.
    fn exact_tries(&self) -> usize {
        if self.descent.chain.joints.len() < GENERAL {
            EXACT_TRIES
        } else {
            TRIES
        }
    }

    /// What can be said of a goal without a search.
    fn check(&self, goal: &Pose) -> Result<(), Miss> {
        let numbers = goal.translation.vector.iter();
        if !numbers.chain(&goal.rotation.coords).all(|n| n.is_finite()) {
            return Err(Miss::NotFinite);
        }
        match self.length.excess(goal) {
            beyond if beyond > DISTANCE => Err(Miss::TooFar { beyond }),
            _ => Ok(()),
        }
    }

    /// The first start: the seed within the limits; the middle where it says nothing.
    fn start_at(&self, seed: &[f64]) -> ChainPositions {
        let mut start = self.middle;
        for ((position, seed), [lower, upper]) in
            start.iter_mut().zip(seed).zip(&self.descent.bounds)
        {
            if seed.is_finite() {
                *position = seed.max(*lower).min(*upper);
            }
        }
        start
    }

    /// Where searches start: there, then at random postures, those first whose tips are nearest to the
    /// goal.
    fn starts(&self, goal: &Pose, first: ChainPositions) -> impl Iterator<Item = ChainPositions> {
        let goal = *goal;
        // Sorted only if the first start does not lead to the goal.
        let sorted = std::iter::once_with(move || {
            let away = |tip: &Pose| {
                let way = goal.translation.vector - tip.translation.vector;
                let half_turn = goal.rotation.coords.dot(&tip.rotation.coords);
                way.norm_squared() + 4.0 * (1.0 - half_turn * half_turn)
            };
            let postures = self.postures.iter();
            let mut sorted: Vec<_> = postures.map(|(at, tip)| (away(tip), at)).collect();
            let _ = sorted.select_nth_unstable_by(TRIES, |a, b| a.0.total_cmp(&b.0));
            sorted.truncate(TRIES);
            sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
            sorted
        });
        let random = sorted.flatten().map(|(_, start)| *start);
        std::iter::once(first).chain(random)
    }

    /// The positions of the joints that there are.
    fn cut(&self, positions: &ChainPositions) -> ArmPositions {
        let count = self.descent.chain.joints.len();
        positions.iter().copied().take(count).collect()
    }

    /// The solution, whose greatest move from the seed is `away`, or one near it that is nearer to the
    /// seed.
    fn towards(
        &self,
        goal: &Pose,
        solution: &ChainPositions,
        away: f64,
        seed: &ChainPositions,
    ) -> ChainPositions {
        if self.descent.chain.joints.len() <= 6 || away < 1e-3 {
            return *solution;
        }
        let mut at = *solution;
        for _ in 0..PULLS {
            let (tip, columns) = self.descent.chain.forward_and_columns(&at);
            let (mut twist, ..) = difference(goal, &tip);
            let mut pull = [0.0; MOST_ARM_JOINTS];
            for i in 0..MOST_ARM_JOINTS {
                pull[i] = (0.5 * (seed[i] - at[i])).clamp(-0.5, 0.5);
                for (t, c) in twist.iter_mut().zip(&columns[i]) {
                    *t -= c * pull[i];
                }
            }
            let Some(step) = self.descent.step(&columns, &twist, 0.0, &at) else {
                break;
            };
            for (pull, step) in pull.iter_mut().zip(step) {
                *pull += step;
            }
            self.descent.advance(&mut at, &pull);
        }
        let pulled = self.descent.descend(goal, &at);
        let nearer = self.turned_to(&pulled.positions, seed);
        match self.descent.is_solution(&pulled) && self.greatest_move(&nearer, seed) < away {
            true => nearer,
            false => *solution,
        }
    }

    /// The same posture, with joints that can do so turned by full turns towards the seed.
    fn turned_to(&self, positions: &ChainPositions, seed: &ChainPositions) -> ChainPositions {
        let mut turned = *positions;
        for (i, is_turn) in self.descent.chain.is_turn.iter().enumerate() {
            let (Some(position), Some(seed), Some([lower, upper])) =
                (turned.get_mut(i), seed.get(i), self.descent.bounds.get(i))
            else {
                continue;
            };
            let wanted = seed + trig::wrap(*position - seed);
            if *is_turn && (*lower..=*upper).contains(&wanted) {
                *position = wanted;
            }
        }
        turned
    }

    /// Greatest difference (rad or m) of a joint between the postures.
    fn greatest_move(&self, one: &ChainPositions, other: &ChainPositions) -> f64 {
        let moves = one.iter().zip(other).map(|(a, b)| (a - b).abs());
        moves
            .take(self.descent.chain.joints.len())
            .fold(0.0, f64::max)
    }
}
