//! Where an arm may bring its hand: the places about the axis of its first joint, with the hand pointing which way.
//!
//! For arms without a closed form, which take long to find that a pose is out of reach. The map is made of random
//! postures, each of which counts for the cells beside its own, too. So it rules out most of what is out of reach, and
//! next to nothing of what is not; that a hand may be somewhere says nothing of its roll.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::OnceLock;

use nalgebra::{Point3, UnitQuaternion, Vector3};

use super::arm_positions::MOST_ARM_JOINTS;
use super::joint_chain::JointChain;
use super::shares::Shares;
use spatial::{Pose, trig};

/// Random postures of which the map is made.
const POSTURES: usize = 200_000;
/// Size (m) of a cell away from the axis and along it.
const CELL: f64 = 0.05;
/// Cells away from the axis, and along it, the first joint in the middle.
const RADII: usize = 32;
const LEVELS: usize = 64;
/// Cells by the angle between the hand and the axis, and by that between the hand and the way from the axis.
const TILTS: usize = 18;
const TURNS: usize = 18;
/// Directions from the axis, a bit each.
const DIRECTIONS: usize = 24;
const EVERYWHERE: u32 = (1 << DIRECTIONS) - 1;
/// A hand nearer (rad) than this to the direction of the axis points to no side.
const UPRIGHT: f64 = PI / 12.0;

/// Where an arm may bring its hand.
#[derive(Clone, Debug)]
pub struct ReachMap {
    chain: JointChain,
    bounds: [[f64; 2]; MOST_ARM_JOINTS],
    /// The axis of the first joint as z, in the frame of the arm's base.
    axis: Pose,
    /// The place of the tool (m, frame of the tip), which the hand points to.
    tool: Vector3<f64>,
    /// In which directions from the axis the hand may be, by cell; made when it is asked for the first time.
    cells: OnceLock<Vec<u32>>,
}

impl PartialEq for ReachMap {
    fn eq(&self, other: &Self) -> bool {
        (&self.chain, self.bounds, self.tool) == (&other.chain, other.bounds, other.tool)
    }
}

/// A hand about the axis.
struct Hand {
    /// Distance from the axis, and place along it (m).
    radius: f64,
    level: f64,
    /// Direction from the axis (rad).
    direction: f64,
    /// Angle to the axis, and to the way from it (rad).
    tilt: f64,
    turn: f64,
}

impl ReachMap {
    /// The map of a chain whose joints have these limits, for a tool (m, frame of the tip) ahead of its tip; `None`
    /// unless the first joint turns, and alone.
    pub(super) fn of(
        chain: &JointChain,
        bounds: &[[f64; 2]; MOST_ARM_JOINTS],
        tool: Vector3<f64>,
    ) -> Option<Self> {
        let (first, others) = chain.segments.split_first()?;
        let is_alone = others.iter().all(|segment| segment.leader != 0);
        if first.slides || first.leader != 0 || !is_alone || tool.norm() < 1e-3 {
            return None;
        }
        let along = UnitQuaternion::rotation_between(&Vector3::z(), &first.axis)
            .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), PI));
        Some(Self {
            chain: chain.clone(),
            bounds: *bounds,
            axis: first.origin * along,
            tool,
            cells: OnceLock::new(),
        })
    }

    /// Whether the tip may be at a pose in the frame of the arm's base. What is beyond the map may be within reach.
    pub(super) fn holds(&self, tip: &Pose) -> bool {
        let hand = self.hand(tip);
        let cells = self.cells.get_or_init(|| self.map());
        let (Some(radius), Some(level)) = (hand.radius_cell(), hand.level_cell()) else {
            return true;
        };
        let bit = 1 << part(hand.direction, DIRECTIONS);
        let at = index(radius, level, hand.tilt_cell(), part(hand.turn, TURNS));
        cells
            .get(at)
            .is_some_and(|directions| directions & bit != 0)
    }

    fn hand(&self, tip: &Pose) -> Hand {
        let tip = self.axis.inv_mul(tip);
        let place = tip * Point3::from(self.tool);
        let ahead = tip.rotation * self.tool;
        let direction = trig::atan2(place.y, place.x);
        Hand {
            radius: place.coords.xy().norm(),
            level: place.z,
            direction,
            tilt: trig::atan2(ahead.xy().norm(), ahead.z),
            turn: trig::atan2(ahead.y, ahead.x) - direction,
        }
    }

    fn map(&self) -> Vec<u32> {
        let mut cells = vec![0; RADII * LEVELS * TILTS * TURNS];
        let mut shares = Shares::new();
        let [lower, upper] = self.bounds[0];
        for _ in 0..POSTURES {
            let mut posture = self.bounds.map(|[lower, upper]| {
                let share = shares.next();
                match (upper - lower).is_finite() {
                    true => lower + share * (upper - lower),
                    false => PI * (2.0 * share - 1.0),
                }
            });
            posture[0] = 0.0;
            let hand = self.hand(&self.chain.forward(&posture));
            // Where the first joint takes it.
            let directions = match hand.radius < CELL {
                true => EVERYWHERE,
                false => directions(hand.direction + lower, hand.direction + upper),
            };
            hand.mark(&mut cells, directions);
        }
        cells
    }
}

impl Hand {
    fn radius_cell(&self) -> Option<usize> {
        Some((self.radius / CELL) as usize).filter(|cell| *cell < RADII)
    }

    fn level_cell(&self) -> Option<usize> {
        let level = (self.level / CELL).floor() + LEVELS as f64 / 2.0;
        (0.0..LEVELS as f64)
            .contains(&level)
            .then_some(level as usize)
    }

    fn tilt_cell(&self) -> usize {
        ((self.tilt / PI * TILTS as f64) as usize).min(TILTS - 1)
    }

    /// Marks its cell and those beside it.
    fn mark(&self, cells: &mut [u32], directions: u32) {
        let (Some(radius), Some(level)) = (self.radius_cell(), self.level_cell()) else {
            return;
        };
        let is_sideless = self.radius < CELL || (self.tilt - FRAC_PI_2).abs() > FRAC_PI_2 - UPRIGHT;
        let turn = part(self.turn, TURNS);
        let turns = match is_sideless {
            true => 0..=TURNS - 1,
            false => turn + TURNS - 1..=turn + TURNS + 1,
        };
        for radius in beside(radius, RADII) {
            for level in beside(level, LEVELS) {
                for tilt in beside(self.tilt_cell(), TILTS) {
                    for turn in turns.clone() {
                        if let Some(cell) = cells.get_mut(index(radius, level, tilt, turn % TURNS))
                        {
                            *cell |= directions;
                        }
                    }
                }
            }
        }
    }
}

/// A number and those beside it, below a count.
fn beside(number: usize, count: usize) -> std::ops::RangeInclusive<usize> {
    number.saturating_sub(1)..=(number + 1).min(count - 1)
}

/// In which of so many equal parts of a full turn an angle (rad) is.
fn part(angle: f64, parts: usize) -> usize {
    let share = angle / TAU;
    let round = share - share.floor();
    ((round * parts as f64) as usize).min(parts - 1)
}

/// The bits of the directions between two angles (rad), and of those beside them.
fn directions(from: f64, to: f64) -> u32 {
    let width = TAU / DIRECTIONS as f64;
    // Not finite for a joint that turns without limits.
    let count = (to - from) / width;
    if !count.is_finite() || count >= DIRECTIONS as f64 {
        return EVERYWHERE;
    }
    let first = part(from - width, DIRECTIONS);
    (0..count as usize + 4).fold(0, |bits, i| bits | 1 << ((first + i) % DIRECTIONS))
}

fn index(radius: usize, level: usize, tilt: usize, turn: usize) -> usize {
    ((radius * LEVELS + level) * TILTS + tilt) * TURNS + turn
}

#[cfg(test)]
mod tests {
    use descriptions::FETCH_URDF;
    use nalgebra::Translation3;
    use rand_pcg::Pcg64;
    use rand_pcg::rand_core::{Rng, SeedableRng};

    use super::*;
    use crate::robot::{KinematicTree, NumericKinematics};

    #[test]
    fn a_map_holds_what_is_reached_and_rules_out_most_of_the_rest() {
        let tree = KinematicTree::from_urdf(FETCH_URDF, "fetch.urdf").expect("Fetch is right");
        let [base, tip] = ["torso_lift_link", "wrist_roll_link"].map(|name| tree.link_named(name));
        let arm = NumericKinematics::new(&tree, base.expect("a torso"), tip.expect("a wrist"));
        let arm = arm.expect("an arm");
        let tool = Vector3::new(0.2, 0.0, 0.0);
        let map = arm.map(tool).expect("its first joint turns");
        let mut random = Pcg64::seed_from_u64(5);
        let mut unit = || f64::from(random.next_u32()) / f64::from(u32::MAX);
        let (mut reached, mut held, mut beyond, mut ruled_out) = (0, 0, 0, 0);
        while reached < 300 {
            let place = Vector3::new(1.4 * unit() - 0.2, 1.6 * unit() - 0.8, 1.6 * unit() - 0.8);
            let [roll, pitch, yaw] = [TAU, PI, TAU].map(|most| most * unit());
            let turned = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
            let goal = Pose::from_parts(place.into(), turned) * Translation3::from(-tool);
            if arm.reaches(&goal) {
                reached += 1;
                held += u32::from(map.holds(&goal));
            } else {
                beyond += 1;
                ruled_out += u32::from(!map.holds(&goal));
            }
        }
        assert!(held >= 298, "{held} of {reached}");
        assert!(ruled_out * 2 > beyond, "{ruled_out} of {beyond}");
    }
}
