//! How a chain of joints is brought to a pose of its tip: damped least squares from one start.

use nalgebra::{Translation3, Vector3};

use super::arm_plane::GENERAL;
use super::arm_positions::MOST_ARM_JOINTS;
use super::joint_chain::{ChainPositions, Columns, JointChain};
use spatial::{Pose, trig};

/// Greatest distance (m) and angle (rad) of a solution from the goal.
pub(super) const DISTANCE: f64 = 1e-6;
const ANGLE: f64 = 1e-5;
/// The same for a chain that cannot meet poses in general.
const LOOSE_DISTANCE: f64 = 1e-4;
const LOOSE_ANGLE: f64 = 0.035;
/// From what distance (m) and angle (rad) of the goal such a chain approaches the place first, how much (m)
/// a radian counts then, and the steps of that.
const SETTLING: (f64, f64) = (0.03, 0.2);
const LEVER: f64 = 0.01;
const SETTLING_STEPS: usize = 12;
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
/// Where a start has led.
#[derive(Clone, Copy)]
pub(super) struct Descent {
    pub(super) positions: ChainPositions,
    /// Distance (m) and angle (rad) from the goal.
    pub(super) distance: f64,
    pub(super) angle: f64,
    /// Sum of their squares.
    pub(super) error: f64,
}

impl Descent {
    /// Whether it has led to the goal, however many joints there are.
    pub(super) fn is_exact(&self) -> bool {
        self.distance < DISTANCE && self.angle < ANGLE
    }
}

/// A chain within its limits.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ChainDescent {
    pub(super) chain: JointChain,
    /// Least and greatest position of each joint; infinite for continuous ones.
    pub(super) bounds: [[f64; 2]; MOST_ARM_JOINTS],
    /// Whether the chain has enough joints for poses in general; the pieces of a telescope count once.
    pub(super) is_general: bool,
    /// The point of the tip that a chain of fewer joints brings to the place (m, frame of the tip).
    pub(super) point: Vector3<f64>,
}

impl ChainDescent {
    pub(super) fn new(chain: JointChain, bounds: [[f64; 2]; MOST_ARM_JOINTS]) -> Self {
        Self {
            is_general: chain.freedoms() >= GENERAL,
            point: Vector3::zeros(),
            bounds,
            chain,
        }
    }

    /// How far (m, rad) from a goal a solution may be.
    pub(super) fn tolerance(&self) -> (f64, f64) {
        match self.is_general {
            true => (DISTANCE, ANGLE),
            false => (LOOSE_DISTANCE, LOOSE_ANGLE),
        }
    }

    /// Whether it has led to a solution.
    pub(super) fn is_solution(&self, found: &Descent) -> bool {
        let (distance, angle) = self.tolerance();
        found.distance < distance && found.angle < angle
    }

    /// Goes from the start to where the tip is nearest to the goal.
    pub(super) fn descend(&self, goal: &Pose, start: &ChainPositions) -> Descent {
        let mut at = *start;
        let mut best = Descent {
            positions: at,
            distance: f64::INFINITY,
            angle: f64::INFINITY,
            error: f64::INFINITY,
        };
        let mut slow = 0;
        for _ in 0..STEPS {
            let was_solution = self.is_general && self.is_solution(&best);
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
        match self.is_general {
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
    pub(super) fn advance(&self, at: &mut ChainPositions, step: &ChainPositions) {
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
    pub(super) fn step(
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
}

/// The way (m) and the turn (rad) from the tip to the goal, and the sizes of both.
pub(super) fn difference(goal: &Pose, tip: &Pose) -> ([f64; 6], f64, f64) {
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
