//! Inverse kinematics of any chain of up to eight joints: damped least squares from many starts.
//!
//! For arms without a closed form. What is found is a solution; what is not found may still exist, unless
//! the goal is farther away than the chain is long. Everything is determined by goal and seed: the starts
//! are drawn once, when the chain is read.
//!
//! A chain of fewer than six joints, the pieces of a telescope counted once, meets hardly any pose exactly. It brings its tip to the place, and its
//! orientation is within 2 degrees of the wanted one.

use std::f64::consts::PI;

use nalgebra::{Translation3, Vector3};

use super::arm_plane::{ArmPlane, GENERAL};
use super::arm_positions::{ArmPositions, MOST_ARM_JOINTS};
use super::chain_length::ChainLength;
use super::joint_chain::{ChainPositions, Columns, JointChain, JointChainError};
use super::shares::Shares;
use super::{JointId, KinematicTree, Limits, LinkId, Miss, ReachMap};
use spatial::{Pose, trig};

/// Greatest distance (m) and angle (rad) of a solution from the goal.
const DISTANCE: f64 = 1e-6;
const ANGLE: f64 = 1e-5;
/// The same for a chain that cannot meet poses in general.
const LOOSE_DISTANCE: f64 = 1e-4;
const LOOSE_ANGLE: f64 = 0.035;
/// Starts from which such a chain is to meet a pose exactly, before it meets it nearly.
const EXACT_TRIES: usize = 20;
/// From what distance (m) and angle (rad) of the goal such a chain approaches the place first, how much (m)
/// a radian counts then, and the steps of that.
const SETTLING: (f64, f64) = (0.03, 0.2);
const LEVER: f64 = 0.01;
const SETTLING_STEPS: usize = 12;
/// Starts of a search, the seed among them.
const TRIES: usize = 100;
/// After how many starts a goal is taken as out of reach, where only that is asked, if no end has come this near (root
/// of the squared error): of 1,500 poses that a TIAGo reaches in 100 tries, two take more than 24 starts.
const QUICK: [(usize, f64); 2] = [(24, 0.05), (40, 0.0)];
/// The same where few that are missed do no harm: of those poses 1 % is lost, and of those out of reach, three in four
/// are given up after 12 starts at most.
const HASTY: [(usize, f64); 3] = [(6, 0.25), (12, 0.05), (24, 0.0)];
/// Random postures of which those are starts whose tips are nearest to the goal.
const POSTURES: usize = 400;
/// A squared error that no step makes smaller.
const EXACT: f64 = 1e-20;
/// Steps from a start.
const STEPS: usize = 60;
/// Steps without progress after which a start is given up; progress is 2 % of the squared error.
const SLOW_STEPS: usize = 6;
const PROGRESS: f64 = 0.98;
/// Greatest move (rad or m) of a joint in a step.
const STRIDE: f64 = 0.8;
/// Damping: at the goal, for each unit of squared error, and the squared error that counts at most.
const DAMPING: [f64; 3] = [1e-8, 0.05, 0.2];
/// A position that is this near to a limit is at the limit.
const AT_LIMIT: f64 = 1e-12;
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

/// Where a start has led.
#[derive(Clone, Copy)]
struct Descent {
    positions: ChainPositions,
    /// Distance (m) and angle (rad) from the goal.
    distance: f64,
    angle: f64,
    /// Sum of their squares.
    error: f64,
}

/// Inverse kinematics of one chain.
#[derive(Clone, Debug, PartialEq)]
pub struct NumericKinematics {
    chain: JointChain,
    length: ChainLength,
    /// Whether the chain has enough joints for poses in general; the pieces of a telescope count once.
    is_general: bool,
    /// Where a chain of fewer than six joints moves its tip freely, if there is such a plane.
    plane: Option<ArmPlane>,
    /// The point of the tip that such a chain brings to the place (m, frame of the tip).
    point: Vector3<f64>,
    /// Least and greatest position of each joint; infinite for continuous ones.
    bounds: [[f64; 2]; MOST_ARM_JOINTS],
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
            is_general: chain.freedoms() >= GENERAL,
            plane,
            point: Vector3::zeros(),
            bounds,
            chain,
        }
    }

    /// The joints from the base to the tip that move on their own.
    pub fn joints(&self) -> &[JointId] {
        &self.chain.joints
    }

    /// The limits (rad or m) that solutions respect; `None` for continuous joints.
    pub fn limits(&self) -> &[Option<Limits>] {
        &self.chain.limits
    }

    /// The chain whose tip's point (m, frame of the tip) counts where it cannot meet a pose exactly.
    #[must_use]
    pub fn meeting_at(mut self, point: Vector3<f64>) -> Self {
        self.point = point;
        self
    }

    /// How far (m, rad) from a goal a solution may be.
    pub fn tolerance(&self) -> (f64, f64) {
        match self.is_general() {
            true => (DISTANCE, ANGLE),
            false => (LOOSE_DISTANCE, LOOSE_ANGLE),
        }
    }

    /// The plane in which a chain of fewer than six joints moves its tip freely, if there is one.
    pub fn plane(&self) -> Option<&ArmPlane> {
        self.plane.as_ref()
    }

    /// Pose of the tip in the frame of the base. Joints without a position are at 0.
    pub fn forward(&self, positions: &[f64]) -> Pose {
        self.chain.forward(positions)
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
        if !self.is_general() {
            let mut ends = (self.starts(goal, seed).take(self.exact_tries()))
                .map(|start| self.descend(goal, &start));
            if let Some(exact) = ends.find(|end| end.distance < DISTANCE && end.angle < ANGLE) {
                return Ok(self.cut(&self.turned_to(&exact.positions, &seed)));
            }
        }
        for start in self.starts(goal, seed).take(TRIES) {
            let found = self.descend(goal, &start);
            if self.is_solution(&found) {
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
        if !self.is_general() {
            return self.nearest(goal, seed).ok();
        }
        let seed = self.start_at(seed);
        let found = self.descend(goal, &seed);
        let positions = self.turned_to(&found.positions, &seed);
        let away = self.greatest_move(&positions, &seed);
        self.is_solution(&found)
            .then(|| self.cut(&self.towards(goal, &positions, away, &seed)))
    }

    /// The same chain on a lift that moves its base along a direction (m per m of the lift, frame of the base);
    /// `None` if there are too many joints for that, or too few for poses in general.
    pub(super) fn on_lift(&self, rise: &Vector3<f64>, limits: Limits) -> Option<Self> {
        let chain = self.chain.on_lift(rise, limits)?;
        self.is_general.then(|| Self::of(chain))
    }

    /// Where the chain may bring a tool (m, frame of the tip) ahead of its tip, if that can be mapped.
    pub(super) fn map(&self, tool: Vector3<f64>) -> Option<ReachMap> {
        self.is_general
            .then(|| ReachMap::of(&self.chain, &self.bounds, tool))?
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
            let end = self.descend(goal, &start);
            least = least.min(end.error);
            let turned = self.turned_to(&end.positions, &[0.0; MOST_ARM_JOINTS]);
            let is_known = |known: &ChainPositions| self.greatest_move(known, &turned) < apart;
            if self.is_solution(&end) && !found.iter().any(is_known) {
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
    pub(super) fn reaches_soon(&self, goal: &Pose) -> bool {
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
            let end = self.descend(goal, &start);
            if self.is_solution(&end) {
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
            let is_far = least > near * near && (self.is_general() || *near == 0.0);
            tries >= *after && is_far
        })
    }

    /// Whether it is certain, without a search, that there is no solution.
    pub(super) fn is_too_far(&self, goal: &Pose) -> bool {
        self.check(goal).is_err()
    }

    /// Whether the chain has enough joints for poses in general.
    fn is_general(&self) -> bool {
        self.is_general
    }

    /// Starts from which a chain that cannot meet poses in general is to meet one exactly.
    fn exact_tries(&self) -> usize {
        if self.chain.joints.len() < GENERAL {
            EXACT_TRIES
        } else {
            TRIES
        }
    }

    fn is_solution(&self, found: &Descent) -> bool {
        let (distance, angle) = self.tolerance();
        found.distance < distance && found.angle < angle
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
        for ((position, seed), [lower, upper]) in start.iter_mut().zip(seed).zip(&self.bounds) {
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
        let count = self.chain.joints.len();
        positions.iter().copied().take(count).collect()
    }

    /// Goes from the start to where the tip is nearest to the goal.
    fn descend(&self, goal: &Pose, start: &ChainPositions) -> Descent {
        let mut at = *start;
        let mut best = Descent {
            positions: at,
            distance: f64::INFINITY,
            angle: f64::INFINITY,
            error: f64::INFINITY,
        };
        let mut slow = 0;
        for _ in 0..STEPS {
            let was_solution = self.is_general() && self.is_solution(&best);
            let (tip, columns) = self.chain.forward_and_columns(&at);
            let (twist, distance, angle) = difference(goal, &tip);
            let error = distance * distance + angle * angle;
            slow = if error > PROGRESS * best.error {
                slow + 1
            } else {
                0
            };
            if error < best.error {
                best = Descent {
                    positions: at,
                    distance,
                    angle,
                    error,
                };
            }
            // One step more than needed makes a solution much better.
            if was_solution || error < EXACT || slow > SLOW_STEPS {
                break;
            }
            let Some(step) = self.step(&columns, &twist, error, &at) else {
                break;
            };
            self.advance(&mut at, &step);
        }
        match self.is_general() {
            true => best,
            false => self.settled(goal, best),
        }
    }

    /// Goes on to where the tip is at the place of the goal, and its orientation as near as that permits.
    fn settled(&self, goal: &Pose, from: Descent) -> Descent {
        let (distance, angle) = SETTLING;
        if from.error < EXACT || from.distance > distance || from.angle > angle {
            return from;
        }
        let mut at = from.positions;
        let mut end = from;
        let goal = &(goal * Translation3::from(self.point));
        for _ in 0..SETTLING_STEPS {
            let (tip, mut columns) = self.chain.forward_and_columns(&at);
            let arm = tip.rotation * self.point;
            for column in &mut columns {
                let [x, y, z, a, b, c] = *column;
                let shift = Vector3::new(a, b, c).cross(&arm);
                *column = [x + shift.x, y + shift.y, z + shift.z, a, b, c];
            }
            let tip = tip * Translation3::from(self.point);
            let (mut twist, distance, angle) = difference(goal, &tip);
            end = Descent {
                positions: at,
                distance,
                angle,
                error: distance * distance + angle * angle,
            };
            for row in columns.iter_mut().chain([&mut twist]) {
                for turn in row.iter_mut().skip(3) {
                    *turn *= LEVER;
                }
            }
            let error = distance * distance + (LEVER * angle) * (LEVER * angle);
            let Some(step) = self.step(&columns, &twist, error * LEVER * LEVER, &at) else {
                break;
            };
            if step.iter().all(|move_of_joint| move_of_joint.abs() < 1e-9) {
                break;
            }
            self.advance(&mut at, &step);
        }
        end
    }

    /// Moves the joints by the step, or a part of it if it is great, within the limits.
    fn advance(&self, at: &mut ChainPositions, step: &ChainPositions) {
        let greatest = step.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
        let scale = if greatest > STRIDE {
            STRIDE / greatest
        } else {
            1.0
        };
        for ((position, d), [lower, upper]) in at.iter_mut().zip(step).zip(&self.bounds) {
            *position = (*position + scale * d).max(*lower).min(*upper);
        }
    }

    /// The step of the joints that brings the tip nearer. Joints that it would push beyond a limit at
    /// which they are take no part.
    fn step(
        &self,
        columns: &Columns,
        twist: &[f64; 6],
        error: f64,
        at: &ChainPositions,
    ) -> Option<ChainPositions> {
        let damping = DAMPING[0] + DAMPING[1] * error.min(DAMPING[2]);
        let count = self.chain.joints.len();
        let mut takes_part = [false; MOST_ARM_JOINTS];
        for (takes_part, [lower, upper]) in takes_part.iter_mut().zip(&self.bounds).take(count) {
            *takes_part = lower < upper;
        }
        loop {
            let weights = solved(columns, &takes_part, damping, twist)?;
            let mut step = [0.0; MOST_ARM_JOINTS];
            let mut is_blocked = false;
            for i in 0..MOST_ARM_JOINTS {
                if !takes_part[i] {
                    continue;
                }
                step[i] = dot(&columns[i], &weights);
                let [lower, upper] = self.bounds[i];
                let pushes_down = step[i] < 0.0 && at[i] <= lower + AT_LIMIT;
                let pushes_up = step[i] > 0.0 && at[i] >= upper - AT_LIMIT;
                if pushes_down || pushes_up {
                    takes_part[i] = false;
                    is_blocked = true;
                }
            }
            if !is_blocked {
                return Some(step);
            }
        }
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
        if self.chain.joints.len() <= 6 || away < 1e-3 {
            return *solution;
        }
        let mut at = *solution;
        for _ in 0..PULLS {
            let (tip, columns) = self.chain.forward_and_columns(&at);
            let (mut twist, ..) = difference(goal, &tip);
            let mut pull = [0.0; MOST_ARM_JOINTS];
            for i in 0..MOST_ARM_JOINTS {
                pull[i] = (0.5 * (seed[i] - at[i])).clamp(-0.5, 0.5);
                for (t, c) in twist.iter_mut().zip(&columns[i]) {
                    *t -= c * pull[i];
                }
            }
            let Some(step) = self.step(&columns, &twist, 0.0, &at) else {
                break;
            };
            for (pull, step) in pull.iter_mut().zip(step) {
                *pull += step;
            }
            self.advance(&mut at, &pull);
        }
        let pulled = self.descend(goal, &at);
        let nearer = self.turned_to(&pulled.positions, seed);
        match self.is_solution(&pulled) && self.greatest_move(&nearer, seed) < away {
            true => nearer,
            false => *solution,
        }
    }

    /// The same posture, with joints that can do so turned by full turns towards the seed.
    fn turned_to(&self, positions: &ChainPositions, seed: &ChainPositions) -> ChainPositions {
        let mut turned = *positions;
        for (i, is_turn) in self.chain.is_turn.iter().enumerate() {
            let (Some(position), Some(seed), Some([lower, upper])) =
                (turned.get_mut(i), seed.get(i), self.bounds.get(i))
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
        moves.take(self.chain.joints.len()).fold(0.0, f64::max)
    }
}

/// The way (m) and the turn (rad) from the tip to the goal, and the sizes of both.
fn difference(goal: &Pose, tip: &Pose) -> ([f64; 6], f64, f64) {
    let way = goal.translation.vector - tip.translation.vector;
    let turn = goal.rotation * tip.rotation.inverse();
    let imaginary = turn.imag();
    let sine = imaginary.norm();
    let half = trig::atan2(sine, turn.w.abs());
    let share = if sine > 1e-12 { 2.0 * half / sine } else { 2.0 };
    let turn = imaginary * (share * turn.w.signum());
    let twist = [way.x, way.y, way.z, turn.x, turn.y, turn.z];
    (twist, way.norm(), 2.0 * half)
}

fn dot(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    let mut sum = 0.0;
    for (a, b) in a.iter().zip(b) {
        sum += a * b;
    }
    sum
}

/// Solves (J Jᵀ + damping) x = twist for x, J having the columns that take part: by Cholesky.
fn solved(
    columns: &Columns,
    takes_part: &[bool; MOST_ARM_JOINTS],
    damping: f64,
    twist: &[f64; 6],
) -> Option<[f64; 6]> {
    let mut matrix = [[0.0; 6]; 6];
    for (i, row) in matrix.iter_mut().enumerate() {
        row[i] = damping;
    }
    for (column, _) in columns.iter().zip(takes_part).filter(|(_, takes)| **takes) {
        for i in 0..6 {
            for j in 0..=i {
                matrix[i][j] += column[i] * column[j];
            }
        }
    }
    // The lower triangle becomes the factor.
    for j in 0..6 {
        for k in 0..j {
            matrix[j][j] -= matrix[j][k] * matrix[j][k];
        }
        if matrix[j][j].is_nan() || matrix[j][j] <= 0.0 {
            return None;
        }
        matrix[j][j] = matrix[j][j].sqrt();
        for i in j + 1..6 {
            for k in 0..j {
                matrix[i][j] -= matrix[i][k] * matrix[j][k];
            }
            matrix[i][j] /= matrix[j][j];
        }
    }
    let mut x = *twist;
    for i in 0..6 {
        for k in 0..i {
            x[i] -= matrix[i][k] * x[k];
        }
        x[i] /= matrix[i][i];
    }
    for i in (0..6).rev() {
        for k in i + 1..6 {
            x[i] -= matrix[k][i] * x[k];
        }
        x[i] /= matrix[i][i];
    }
    Some(x)
}
