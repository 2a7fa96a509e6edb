//! Grasps of a type of objects, found from its shape alone: two fingers that close on it from opposite
//! sides.
//!
//! A hand comes from above, from eight sides, or slanting from above a side. For each of these directions,
//! lines across the object are followed on a grid. Wherever a line enters and leaves something solid that
//! fits between the fingers, they could press: if the surface there is not too slanted for friction, if
//! the hand gets there without touching anything else of the object or what it stands on, and if the
//! pads bear the torque of its weight. Everything is at fixed places: the same shape has the same grasps.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use parry3d_f64::math::Vector;
use parry3d_f64::query::Ray;

use super::hand_directions::{AWAY, Direction, directions};
use super::hand_shape::HandShape;
use super::ungraspable::Ungraspable;
use crate::motion::contact::grip_torque::Pads;
use crate::robot::Side;
use crate::robot::description::Gripper;
use crate::world::Models;
use crate::world::grasp_library::{GraspDefinition, Grip, Lift};
use crate::world::object_library::ObjectType;
use crate::world::solid::{Solid, bounds_of};
use spatial::{Pose, trig};

/// Free room (m) that the fingers have on both sides together, if possible, and at least.
const EASY_ROOM: f64 = 0.03;
const TIGHT_ROOM: f64 = 0.008;
/// Gaps (m) inside a thing into which no finger goes: what they part is pressed together.
const NARROW: f64 = 0.012;
/// How far (m) from what the object stands on the hand stays at least, and where it does so easily even if
/// the object does not stand exactly level.
const ABOVE_GROUND: f64 = 0.0015;
const EASY_ABOVE: f64 = 0.01;
/// Where on that way (m) it is tested.
const ON_THE_WAY: [f64; 4] = [0.0, 0.02, 0.05, 0.1];
/// Depths (m) of the tool's point behind where it would meet the object.
const DEPTHS: [f64; 8] = [0.0025, 0.0045, 0.007, 0.012, 0.02, 0.03, 0.045, 0.06];
/// How far (m) behind the tool's point the middle of the pads is.
const BEHIND: f64 = 0.012;
/// Number of places beside each other at which a direction is tried.
const BESIDE: i32 = 9;
/// Points of a pad at which it is looked for a surface: shares of its length and width.
const OF_PAD: [[f64; 2]; 5] = [
    [0.0, 0.0],
    [0.35, 0.0],
    [-0.35, 0.0],
    [0.0, 0.35],
    [0.0, -0.35],
];
/// Depth (m) within which the points of a pad touch a surface that is not flat.
const YIELDS: f64 = 0.003;
/// Maximum number of grasps from one direction: from above, and from a side.
const MAX_FROM_ABOVE: usize = 4;
const MAX_FROM_SIDE: usize = 1;
/// Grasps that are nearer to each other than this (m) or turned by less (rad) count as the same.
const APART: f64 = 0.025;
const TURNED: f64 = 0.5;
/// Gravity (m/s²), and how much stronger than needed the pads press.
const GRAVITY: f64 = 9.81;
const SAFETY: f64 = 3.0;
/// The least force (N) with which they press.
const MIN_PRESS: f64 = 30.0;

/// The grasps of a type.
#[derive(Clone, Debug, PartialEq)]
pub struct ShapeGrasps {
    /// The arm, the name and the grasp, those to be tried first in front.
    pub grasps: Vec<(Side, String, GraspDefinition)>,
    /// How hard to grip and how wide to open.
    pub grip: Grip,
}

/// How far an attempt to grasp gets, the farthest last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Stage {
    Friction,
    Width,
    Room,
    Torque,
}

/// A grasp with its merits.
struct Found {
    cost: f64,
    direction: usize,
    at: Vector3<f64>,
    gap: f64,
}

impl ShapeGrasps {
    /// The grasps of a type with either hand of the robot; with `wanted`, only those of these names, in that
    /// order.
    ///
    /// # Errors
    ///
    /// Why there is none.
    pub fn of(models: &Models, kind: &ObjectType, wanted: &[String]) -> Result<Self, Ungraspable> {
        let mut grasps = Vec::new();
        let mut grip = None;
        let mut refusal = None;
        for side in models.description.sides() {
            match Search::new(models, side, kind).and_then(|search| search.run(wanted)) {
                Ok((found, own)) => {
                    grip = grip.or(Some(own));
                    grasps.extend(
                        found
                            .into_iter()
                            .map(|(name, definition)| (side, name, definition)),
                    );
                }
                Err(why) => refusal = refusal.or(Some(why)),
            }
        }
        match grip {
            Some(grip) => Ok(Self { grasps, grip }),
            None => Err(refusal.unwrap_or(Ungraspable::NoRoom)),
        }
    }
}

/// The search for grasps with one hand.
struct Search<'a> {
    models: &'a Models,
    side: Side,
    gripper: &'a Gripper,
    kind: &'a ObjectType,
    solids: Vec<Solid>,
    directions: Vec<Direction>,
    /// Corners of the box around the object (m).
    bounds: [Vector3<f64>; 2],
    balance: Vector3<f64>,
    pad: [f64; 2],
    press: f64,
    /// The widest that fits between the fingers (m).
    most: f64,
    farthest: Option<Stage>,
    narrowest: f64,
}

impl<'a> Search<'a> {
    fn new(models: &'a Models, side: Side, kind: &'a ObjectType) -> Result<Self, Ungraspable> {
        let arm = models.description.arm(side);
        let gripper = &arm.gripper;
        if let Some(payload) = arm.payload
            && kind.mass > payload
        {
            return Err(Ungraspable::TooHeavy {
                mass: kind.mass,
                payload,
            });
        }
        let solids = Solid::all(&kind.shapes);
        let bounds = bounds_of(&solids).ok_or(Ungraspable::NoRoom)?;
        let corner = |v: Vector| Vector3::new(v.x, v.y, v.z);
        let press = SAFETY * kind.mass * GRAVITY / (2.0 * kind.friction);
        Ok(Self {
            models,
            side,
            gripper,
            kind,
            bounds: [corner(bounds.mins), corner(bounds.maxs)],
            solids,
            directions: directions(kind.is_round),
            balance: Vector3::from(kind.balance),
            pad: gripper.pad_size.unwrap_or([0.02, 0.02]),
            press: press.clamp(MIN_PRESS.min(gripper.effort), gripper.effort),
            most: gripper.gap(gripper.limits.upper) - TIGHT_ROOM,
            farthest: None,
            narrowest: f64::INFINITY,
        })
    }

    fn run(
        mut self,
        wanted: &[String],
    ) -> Result<(Vec<(String, GraspDefinition)>, Grip), Ungraspable> {
        let mut found = Vec::new();
        for direction in 0..self.directions.len() {
            self.from(direction, &mut found);
        }
        let opening = |gap: f64| {
            let position = self.gripper.position_for_gap(gap);
            (self.gripper).opening_at(position.min(self.gripper.limits.upper))
        };
        let mut chosen: Vec<(String, Found)> = Vec::new();
        found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        for one in found {
            let direction = &self.directions[one.direction];
            let of_name = |(_, other): &&(String, Found)| {
                self.directions[other.direction].name == direction.name
            };
            let count = chosen.iter().filter(of_name).count();
            let most = match direction.is_top {
                true => MAX_FROM_ABOVE,
                false => MAX_FROM_SIDE,
            };
            let is_same = chosen.iter().filter(of_name).any(|(_, other)| {
                let closing = self.directions[other.direction].axes.column(0).into_owned();
                let turned = direction.axes.column(0).dot(&closing).abs();
                (other.at - one.at).norm() < APART && trig::acos(turned.min(1.0)) < TURNED
            });
            if count >= most || is_same {
                continue;
            }
            let name = match count {
                0 => direction.name.to_owned(),
                count => format!("{}-{}", direction.name, count + 1),
            };
            chosen.push((name, one));
        }
        if !wanted.is_empty() {
            let place = |name: &str| wanted.iter().position(|wanted| wanted == name);
            chosen.retain(|(name, _)| place(name).is_some());
            chosen.sort_by_key(|(name, _)| place(name));
        }
        if chosen.is_empty() {
            return Err(self.refusal());
        }
        let widest = chosen.iter().map(|(_, one)| one.gap).fold(0.0, f64::max);
        let grip = Grip {
            effort: self.press,
            opening: opening(widest),
        };
        let grasps = chosen.into_iter().map(|(name, one)| {
            let direction = &self.directions[one.direction];
            let rows = [0, 1, 2].map(|i| [0, 1, 2].map(|j| direction.axes[(i, j)]));
            let lift = Lift::along_object([0.0, 0.0, AWAY]);
            let definition = GraspDefinition {
                translation: one.at.into(),
                rotation: rows,
                pregrasp: direction.pregrasp,
                second_pregrasp: direction.second_pregrasp,
                lift,
                second_lift: lift,
                opening: Some(opening(one.gap)),
            };
            (name, definition)
        });
        Ok((grasps.collect(), grip))
    }

    /// Why nothing was found.
    fn refusal(&self) -> Ungraspable {
        match self.farthest {
            Some(Stage::Friction) => Ungraspable::TooSlanted,
            Some(Stage::Room) => Ungraspable::NoRoom,
            Some(Stage::Torque) => Ungraspable::TooLongLever,
            _ if self.narrowest.is_finite() => Ungraspable::TooWide {
                width: self.narrowest,
                most: self.most,
            },
            _ => Ungraspable::NoRoom,
        }
    }

    fn gets_to(&mut self, stage: Stage) {
        self.farthest = self.farthest.max(Some(stage));
    }

    /// The extent (m) of the box around the object along an axis.
    fn extent(&self, axis: &Vector3<f64>) -> [f64; 2] {
        let [low, high] = &self.bounds;
        (0..3).fold([0.0; 2], |[from, to], i| {
            let [a, b] = [axis[i] * low[i], axis[i] * high[i]];
            [from + a.min(b), to + a.max(b)]
        })
    }

    /// Looks for grasps from a direction.
    fn from(&mut self, direction: usize, found: &mut Vec<Found>) {
        let axes = self.directions[direction].axes;
        let [closing, up, ahead] = [0, 1, 2].map(|i| axes.column(i).into_owned());
        let [low, high] = self.extent(&up);
        let [near, far] = self.extent(&ahead);
        let middle = self.balance.dot(&up);
        let mut besides = vec![middle];
        besides.extend(
            (0..BESIDE).map(|i| low + (high - low) * (f64::from(i) + 0.5) / f64::from(BESIDE)),
        );
        // Deep enough for the pads' middle to be at the object's own.
        let central = self.balance.dot(&ahead) + BEHIND;
        for beside in besides {
            let Some(first) = self.first_met(&closing, &up, &ahead, beside, near, far) else {
                continue;
            };
            let depths = DEPTHS.iter().map(|depth| first + depth);
            let depths = depths.chain([central].into_iter().filter(|at| *at > first));
            for depth in depths {
                let point = up * beside + ahead * depth;
                self.at_line(direction, &point, found);
            }
        }
    }

    /// How far ahead the object begins where a hand comes along a plane.
    fn first_met(
        &self,
        closing: &Vector3<f64>,
        up: &Vector3<f64>,
        ahead: &Vector3<f64>,
        beside: f64,
        near: f64,
        far: f64,
    ) -> Option<f64> {
        const LINES: i32 = 16;
        let [left, right] = self.extent(closing);
        let lines = (0..LINES).filter_map(|i| {
            let across = left + (right - left) * (f64::from(i) + 0.5) / f64::from(LINES);
            let start = closing * across + up * beside + ahead * (near - 0.01);
            let hits = self.hits(&start, ahead, far - near + 0.02);
            hits.map(|way| near - 0.01 + way).reduce(f64::min)
        });
        lines.reduce(f64::min)
    }

    /// How far from a point the surface of each solid is met along a direction.
    fn hits(
        &self,
        from: &Vector3<f64>,
        along: &Vector3<f64>,
        way: f64,
    ) -> impl Iterator<Item = f64> {
        let ray = ray(from, along);
        let solids = self.solids.iter();
        solids.filter_map(move |solid| solid.shape.cast_ray(&solid.pose, &ray, way, true))
    }

    /// The parts of a line that are solid, with the surface's slant at both ends (cosine of its angle to the
    /// line).
    fn parts(&self, through: &Vector3<f64>, along: &Vector3<f64>) -> Vec<[(f64, f64); 2]> {
        let [left, right] = self.extent(along);
        let (from, to) = (left - 0.01, right + 0.01);
        let base = through - along * through.dot(along);
        let mut parts: Vec<[(f64, f64); 2]> = Vec::new();
        for solid in &self.solids {
            let end = |start: f64, sign: f64| {
                let ray = ray(&(base + along * start), &(along * sign));
                let way = to - from;
                let hit = solid
                    .shape
                    .cast_ray_and_get_normal(&solid.pose, &ray, way, true)?;
                let normal = Vector3::new(hit.normal.x, hit.normal.y, hit.normal.z);
                Some((start + sign * hit.time_of_impact, -sign * normal.dot(along)))
            };
            if let (Some(entry), Some(exit)) = (end(from, 1.0), end(to, -1.0))
                && exit.0 >= entry.0
            {
                parts.push([entry, exit]);
            }
        }
        parts.sort_by(|a, b| a[0].0.total_cmp(&b[0].0));
        let mut merged: Vec<[(f64, f64); 2]> = Vec::new();
        for part in parts {
            match merged.last_mut() {
                Some(last) if part[0].0 - last[1].0 <= NARROW => {
                    if part[1].0 > last[1].0 {
                        last[1] = part[1];
                    }
                }
                _ => merged.push(part),
            }
        }
        merged
    }

    /// Looks for grasps with the tool somewhere on the line along which the fingers close.
    fn at_line(&mut self, direction: usize, point: &Vector3<f64>, found: &mut Vec<Found>) {
        let axes = self.directions[direction].axes;
        let [closing, up, ahead] = [0, 1, 2].map(|i| axes.column(i).into_owned());
        let pads = point - ahead * BEHIND;
        let [length, width] = self.pad;
        let lines: Vec<_> = OF_PAD
            .iter()
            .map(|[along, across]| {
                let at = pads + ahead * (along * length) + up * (across * width);
                self.parts(&at, &closing)
            })
            .collect();
        // What the middle line or, where it misses a thin thing, another one meets.
        let guides: Vec<[f64; 2]> = {
            let Some(guide) = lines.iter().find(|parts| !parts.is_empty()) else {
                return;
            };
            (0..guide.len())
                .flat_map(|i| (i..guide.len()).map(move |j| (i, j)))
                .map(|(i, j)| [guide[i][0].0, guide[j][1].0])
                .collect()
        };
        for guide in guides {
            // All that the pads meet between the gaps beside it.
            let touched: Vec<[(f64, f64); 2]> = lines
                .iter()
                .filter_map(|parts| {
                    let inside = |part: &&[(f64, f64); 2]| {
                        part[1].0 > guide[0] - NARROW && part[0].0 < guide[1] + NARROW
                    };
                    let first = parts.iter().find(inside)?;
                    let last = parts.iter().rev().find(inside)?;
                    Some([first[0], last[1]])
                })
                .collect();
            let left = touched.iter().map(|p| p[0].0).fold(f64::INFINITY, f64::min);
            let right = touched
                .iter()
                .map(|p| p[1].0)
                .fold(f64::NEG_INFINITY, f64::max);
            self.between(direction, point, [left, right], &touched, found);
        }
    }

    /// Judges the grasp between two places of a line.
    fn between(
        &mut self,
        direction: usize,
        point: &Vector3<f64>,
        [left, right]: [f64; 2],
        touched: &[[(f64, f64); 2]],
        found: &mut Vec<Found>,
    ) {
        let wide = right - left;
        self.gets_to(Stage::Friction);
        // The pads meet what sticks out.
        let least = 1.0 / libm::hypot(1.0, self.kind.friction);
        let slant = |side: usize, edge: f64| {
            let near = touched.iter().filter_map(|part| {
                let (at, slant) = part[side];
                ((at - edge).abs() <= YIELDS).then_some(slant)
            });
            let slants: Vec<f64> = near.collect();
            let mean = slants.iter().sum::<f64>() / slants.len().max(1) as f64;
            (mean, slants.len())
        };
        let ([one, many], [two, more]) = {
            let (a, n) = slant(0, left);
            let (b, m) = slant(1, right);
            ([a, n as f64], [b, m as f64])
        };
        let slanted = one.min(two);
        if slanted < least {
            return;
        }
        self.gets_to(Stage::Width);
        self.narrowest = self.narrowest.min(wide);
        if wide > self.most {
            return;
        }
        self.gets_to(Stage::Room);
        let axes = self.directions[direction].axes;
        let [closing, ahead] = [0, 2].map(|i| axes.column(i).into_owned());
        let at = point + closing * ((left + right) / 2.0 - point.dot(&closing));
        let widest = self.most + TIGHT_ROOM;
        let gap = (wide + EASY_ROOM).min(widest);
        let gaps = [gap, wide + TIGHT_ROOM];
        let mut rooms = gaps
            .into_iter()
            .filter_map(|gap| Some((gap, self.room(&axes, &at, gap)?)));
        let Some((gap, above)) = rooms.next() else {
            return;
        };
        self.gets_to(Stage::Torque);
        let middle = at - ahead * BEHIND;
        let limits = Pads::between(
            self.gripper,
            self.kind.friction,
            middle,
            closing,
            wide,
            self.press,
        );
        if limits.is_some_and(|pads| {
            pads.excess(self.kind.mass * GRAVITY, &self.balance)
                .is_some()
        }) {
            return;
        }
        let lever = (self.balance - middle).cross(&Vector3::z()).norm();
        let cost = lever / 0.03
            + (10.0 - many - more) * 0.15
            + (1.0 - slanted) * 2.0
            + f64::from(u8::from(gap - wide < EASY_ROOM)) * 0.5
            + (1.0 - above / EASY_ABOVE).max(0.0) * 3.0;
        found.push(Found {
            cost,
            direction,
            at,
            gap,
        });
    }

    /// How far (m) above the ground the hand, so wide open (m), stays when it comes to a place; `None` if
    /// it touches something there or on its way.
    fn room(&self, axes: &Matrix3<f64>, at: &Vector3<f64>, gap: f64) -> Option<f64> {
        let arm = self.models.description.arm(self.side);
        let hand = HandShape::new(self.models, self.side, gap);
        let rotation =
            UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*axes));
        let ahead = axes.column(2).into_owned();
        let mut above = f64::INFINITY;
        for back in ON_THE_WAY {
            let tool = Pose::from_parts((at - ahead * back).into(), rotation * arm.tool_axes);
            above = above.min(hand.lowest(&tool) - self.bounds[0].z);
            if above < ABOVE_GROUND || hand.touches(&tool, &self.solids) {
                return None;
            }
        }
        Some(above)
    }
}

fn ray(from: &Vector3<f64>, along: &Vector3<f64>) -> Ray {
    let [from, along] = [from, along].map(|v| Vector::new(v.x, v.y, v.z));
    Ray::new(from, along)
}
