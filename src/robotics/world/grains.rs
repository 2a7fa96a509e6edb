//! Grains: many small balls of one kind, such as rice, that are filled into a vessel, poured, and lost beside it.
//!
//! Each is a body of the engine, but none is an object: grains have no names, nobody grasps or sees them, and the robot
//! neither goes around them nor touches them. What counts is how many are in a vessel.
//!
//! Friction keeps grains at their places in a vessel that a hand carries level. That is a rule: once they lie still
//! there, they ride with it, without a part in the engine, until it is tilted or let go.

use std::sync::Arc;

use nalgebra::Point3;
use parry3d_f64::math::Vector;

use super::cavity::Cavity;
use super::content::tilt_of;
use super::error::WorldError;
use super::hash::Hasher;
use super::object::Object;
use super::part_key::PartKey;
use super::physics::BodyHandle;
use super::scene::World;
use spatial::Pose;

/// Radius (m) of a grain.
pub const GRAIN_RADIUS: f64 = 0.006;
/// Mass (kg) of a grain: that of as much water.
const MASS: f64 = 0.0009;
/// Volume (ml) of a grain.
pub const GRAIN_VOLUME: f64 =
    4.0 / 3.0 * std::f64::consts::PI * GRAIN_RADIUS * GRAIN_RADIUS * GRAIN_RADIUS * 1e6;
/// The most grains in a world: with more, a step takes too long.
pub const MAX_GRAINS: usize = 2000;
/// Gap (m) between grains, and between them and walls, when they are filled in.
const GAP: f64 = 0.0006;
/// A vessel that is tilted more than this (rad) cannot be filled.
const UPRIGHT: f64 = 0.1;
/// A grain slower than this (m/s) counts as at rest: it may still tremble between others.
const SLOW: f64 = 0.01;
/// A grain that moves less than this (m) in its vessel in a tenth of a second lies still: in a hand, it trembles.
const STILL: f64 = 0.002;
/// So near (m) above a vessel a grain is about to fall on those in it: more than it falls in a step.
const ABOVE: f64 = 0.03;
/// Where each grain is is noted once in so many steps: a tenth of a second.
const NOTED: u64 = 24;
/// Grains begin to ride in a vessel that is tilted less than this (rad).
const LEVEL: f64 = 0.1;
/// They no longer do in one that is tilted more than this (rad): grains begin to slide at the angle of friction, 0.46.
const TILTED: f64 = 0.25;

/// Grains that were filled into a vessel at one time.
#[derive(Clone, Debug)]
pub struct Grains {
    /// What they are, such as `rice`.
    what: Arc<str>,
    /// Red, green, blue, alpha in 0..1.
    color: [f32; 4],
    grains: Vec<Grain>,
}

/// One of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grain {
    body: BodyHandle,
    /// The number of the object in which it is, or was last.
    vessel: u32,
    /// Where it rides in that, in its frame.
    rides: Option<Pose>,
    /// Where it was in that, in its frame (m), when that was noted last.
    noted: Point3<f64>,
}

impl Grains {
    /// What they are, such as `rice`.
    pub fn what(&self) -> &str {
        &self.what
    }

    /// Red, green, blue, alpha in 0..1.
    pub fn color(&self) -> [f32; 4] {
        self.color
    }

    /// How much memory (bytes) they take beside what the engine keeps of them.
    pub(super) fn bytes(&self) -> usize {
        size_of::<Self>() + size_of_val(self.grains.as_slice())
    }

    pub(super) fn hash_into(&self, hasher: &mut Hasher) {
        hasher.text(&self.what);
        for grain in &self.grains {
            hasher.integer(u64::from(grain.vessel));
            if let Some(at) = &grain.rides {
                hasher.pose(at);
            }
        }
    }
}

impl Cavity {
    /// Where grains that are filled in lie, in the vessel's frame, from its floor to its rim: in layers, each in the
    /// gaps of the one below.
    fn places_of_grains(&self) -> Vec<Point3<f64>> {
        let across = 2.0 * GRAIN_RADIUS + GAP;
        let row = across * 3.0_f64.sqrt() / 2.0;
        let layer = across * (2.0_f64 / 3.0).sqrt();
        let mut places = Vec::new();
        let mut height = self.floor() + GRAIN_RADIUS + GAP;
        let mut is_shifted = false;
        while height + GRAIN_RADIUS <= self.rim {
            let widths = [-GRAIN_RADIUS, 0.0, GRAIN_RADIUS].map(|up| self.radius_at(height + up));
            let width = widths.into_iter().fold(f64::INFINITY, f64::min);
            // The walls of what is built of staves are nearer than on average.
            let room = width.min(self.narrowest.max(width - GAP)) - GRAIN_RADIUS - GAP;
            let shift = if is_shifted { 1.0 } else { 0.0 };
            let (shift_x, shift_y) = (shift * across / 2.0, shift * row / 3.0);
            let mut in_layer = Vec::new();
            let rows = (room.max(0.0) / row).ceil() as i32 + 1;
            for j in -rows..=rows {
                let y = f64::from(j) * row + shift_y;
                let half = if j % 2 == 0 { 0.0 } else { across / 2.0 };
                for i in -rows..=rows {
                    let x = f64::from(i) * across + half + shift_x;
                    if x * x + y * y <= room * room && room > 0.0 {
                        in_layer.push((x * x + y * y, x, y));
                    }
                }
            }
            in_layer.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
            let [axis_x, axis_y] = self.axis;
            let in_vessel =
                |(_, x, y): &(f64, f64, f64)| Point3::new(axis_x + x, axis_y + y, height);
            places.extend(in_layer.iter().map(in_vessel));
            height += layer;
            is_shifted = !is_shifted;
        }
        places
    }

    /// Whether the middle of a grain at a point in the vessel's frame is in it, also in a heap above its rim.
    fn holds_grain(&self, at: &Point3<f64>) -> bool {
        let [x, y] = self.axis;
        let (out_x, out_y) = (at.x - x, at.y - y);
        let radius = self.radius_at(at.z.min(self.rim - GAP));
        at.z > self.foot
            && at.z < self.rim + GRAIN_RADIUS
            && out_x * out_x + out_y * out_y < radius * radius
    }
}

impl Object {
    /// The room for grains in it; `None` if they do not get in.
    fn room_for_grains(&self) -> Option<&Cavity> {
        self.cavity().filter(|_| self.inside.is_none())
    }
}

impl World {
    /// How many grains fit into a vessel, when it is filled up to its rim; `None` if none get in.
    pub fn grains_that_fit(&self, name: &str) -> Result<Option<usize>, WorldError> {
        let places = self.places_of_grains(self.object(name)?);
        Ok(places.map(|places| places.len()))
    }

    /// Where grains that are filled into a vessel lie (m, map frame): not where a spoon is.
    fn places_of_grains(&self, vessel: &Object) -> Option<Vec<Point3<f64>>> {
        let cavity = vessel.room_for_grains()?;
        let at = self.physics.pose(vessel.body);
        let mut others = self.neighbours(Some(vessel.key()), &self.bounds_of(vessel));
        others.retain(|other| !matches!(other.key, PartKey::Robot(_)));
        let is_free = |place: &Point3<f64>| {
            let place = Vector::new(place.x, place.y, place.z);
            others.iter().all(|other| {
                let shape = &other.solid.shape;
                let distance = shape.distance_to_point(&other.pose, place, true);
                distance > GRAIN_RADIUS + GAP
            })
        };
        let places = cavity.places_of_grains().into_iter();
        Some(places.map(|place| at * place).filter(is_free).collect())
    }

    /// Fills a vessel with grains, in place of what was in it or has been lost from it; there have to be as many
    /// places as [`World::grains_that_fit`] says. They settle as time passes.
    pub fn fill_with_grains(
        &mut self,
        name: &str,
        what: &str,
        count: usize,
        color: [f32; 4],
    ) -> Result<(), WorldError> {
        let object = self.object(name)?;
        let (number, at) = (object.number, self.physics.pose(object.body));
        let no_room = || WorldError::NoRoomForGrains {
            name: name.to_owned(),
        };
        let places = self.places_of_grains(object).ok_or_else(no_room)?;
        if tilt_of(&at) > UPRIGHT || count > places.len() {
            return Err(no_room());
        }
        let others = self.all_grains().filter(|grain| grain.vessel != number);
        if others.count() + count > MAX_GRAINS {
            return Err(WorldError::TooManyGrains { most: MAX_GRAINS });
        }
        self.set_content(name, "", 0.0)?;
        let grains: Vec<Grain> = places
            .iter()
            .take(count)
            .map(|place| {
                let at = Pose::from_parts(place.coords.into(), at.rotation);
                let key = PartKey::Grain.code();
                Grain {
                    body: self.physics.add_grain(&at, GRAIN_RADIUS, MASS, key),
                    vessel: number,
                    rides: None,
                    noted: Point3::origin(),
                }
            })
            .collect();
        if !grains.is_empty() {
            self.state.grains.push(Grains {
                what: what.into(),
                color,
                grains,
            });
        }
        Ok(())
    }

    /// Grains with the middles (m, map frame) of each.
    pub fn grains(&self) -> impl Iterator<Item = (&Grains, Vec<Point3<f64>>)> {
        let lots = self.state.grains.iter();
        lots.map(|lot| {
            let places = lot.grains.iter().map(|grain| self.place_of(grain));
            (lot, places.collect())
        })
    }

    /// What grains are in a vessel, and how many of each, in the order in which they were filled into anything.
    pub fn grains_in(&self, name: &str) -> Result<Vec<(&str, usize)>, WorldError> {
        let vessel = self.object(name)?;
        let mut found: Vec<(&str, usize)> = Vec::new();
        for lot in &self.state.grains {
            let within = lot.grains.iter();
            let count = within
                .filter(|grain| self.is_grain_in(grain, vessel))
                .count();
            match found.iter_mut().find(|(what, _)| *what == lot.what()) {
                Some((_, known)) => *known += count,
                None => found.push((lot.what(), count)),
            }
        }
        found.retain(|(_, count)| *count > 0);
        Ok(found)
    }

    /// How many grains have left a vessel and are in none.
    pub fn grains_spilled_from(&self, name: &str) -> Result<usize, WorldError> {
        let number = self.object(name)?.number;
        let lost = self.all_grains();
        let lost = lost.filter(|grain| grain.vessel == number && self.is_beside(grain));
        Ok(lost.count())
    }

    /// Removes the grains that are in no vessel; returns how many.
    pub fn remove_spilled_grains(&mut self) -> usize {
        let beside = self.all_grains().filter(|grain| self.is_beside(grain));
        let beside: Vec<BodyHandle> = beside.map(|grain| grain.body).collect();
        self.remove_grains(|grain| beside.contains(&grain.body));
        beside.len()
    }

    /// Removes the grains for which that is true.
    pub(super) fn remove_grains(&mut self, goes: impl Fn(&Grain) -> bool) {
        for lot in &mut self.state.grains {
            let grains = std::mem::take(&mut lot.grains);
            let (gone, kept): (Vec<_>, Vec<_>) = grains.into_iter().partition(&goes);
            lot.grains = kept;
            for grain in gone {
                self.physics.remove_body(grain.body);
            }
        }
        self.state.grains.retain(|lot| !lot.grains.is_empty());
    }

    /// Removes the grains that are in a vessel, or were last.
    pub(super) fn remove_grains_of(&mut self, number: u32) {
        self.remove_grains(|grain| grain.vessel == number);
    }

    /// How many grains there are.
    pub fn grain_count(&self) -> usize {
        self.all_grains().count()
    }

    fn all_grains(&self) -> impl Iterator<Item = &Grain> {
        self.state.grains.iter().flat_map(|lot| &lot.grains)
    }

    /// Whether no grain moves.
    pub(super) fn grains_are_at_rest(&self) -> bool {
        self.all_grains().all(|grain| self.is_grain_slow(grain))
    }

    /// Whether every grain sleeps, or rides.
    pub(super) fn grains_sleep(&self) -> bool {
        self.all_grains()
            .all(|grain| grain.rides.is_some() || !self.physics.is_awake(grain.body))
    }

    fn is_grain_slow(&self, grain: &Grain) -> bool {
        let is_slow = || self.physics.velocity(grain.body).0.norm() < SLOW;
        grain.rides.is_some() || !self.physics.is_awake(grain.body) || is_slow()
    }

    /// Lets grains ride in vessels that are carried level, and no longer in others; notes, now and then, in which vessel
    /// each is.
    pub(super) fn follow_grains(&mut self) {
        if self.state.grains.is_empty() {
            return;
        }
        self.release_riding_grains();
        if !self.state.steps.is_multiple_of(NOTED) {
            return;
        }
        let mut lots = std::mem::take(&mut self.state.grains);
        for grain in lots.iter_mut().flat_map(|lot| &mut lot.grains) {
            if grain.rides.is_none()
                && self.physics.is_awake(grain.body)
                && let Some(object) = self.vessel_around(grain)
            {
                grain.vessel = object.number;
            }
        }
        self.state.grains = lots;
        self.let_grains_ride();
    }

    /// Gives the grains back to the engine that ride in what is tilted, or in no hand, or into which others fall.
    fn release_riding_grains(&mut self) {
        let riding = self.all_grains().filter(|grain| grain.rides.is_some());
        let mut vessels: Vec<u32> = riding.map(|grain| grain.vessel).collect();
        vessels.dedup();
        vessels.retain(|number| {
            let vessel = self.numbered(*number);
            !vessel.is_some_and(|vessel| {
                let tilt = tilt_of(&self.physics.pose(vessel.body));
                vessel.attachment.is_some() && tilt < TILTED && !self.is_filled_from_above(vessel)
            })
        });
        for number in vessels {
            self.release_grains_of(number);
        }
    }

    /// Whether a grain that does not ride is in a vessel, or just above it.
    fn is_filled_from_above(&self, vessel: &Object) -> bool {
        let Some(cavity) = vessel.room_for_grains() else {
            return false;
        };
        let pose = self.physics.pose(vessel.body);
        let mut loose = self.all_grains().filter(|grain| grain.rides.is_none());
        loose.any(|grain| {
            let place: Point3<f64> = self.physics.pose(grain.body).translation.vector.into();
            let within = pose.inverse_transform_point(&place);
            // As if it were a grain's fall lower already.
            let below = within - nalgebra::Vector3::z() * ABOVE;
            cavity.holds_grain(&within) || cavity.holds_grain(&below)
        })
    }

    /// Gives the grains that ride in a vessel back to the engine, moving as it moves.
    pub(super) fn release_grains_of(&mut self, number: u32) {
        let Some(body) = self.numbered(number).map(|vessel| vessel.body) else {
            return;
        };
        let (pose, (linear, angular)) = (self.physics.pose(body), self.physics.velocity(body));
        let mut lots = std::mem::take(&mut self.state.grains);
        for grain in lots.iter_mut().flat_map(|lot| &mut lot.grains) {
            if grain.vessel != number {
                continue;
            }
            if let Some(within) = grain.rides.take() {
                let at = pose * within;
                let arm = at.translation.vector - pose.translation.vector;
                let speed = linear + angular.cross(&arm);
                self.physics.set_enabled(grain.body, true);
                self.physics.carry(grain.body, &at, &speed, &angular);
            }
        }
        self.state.grains = lots;
    }

    /// Lets the grains ride in a vessel that a hand holds level, if all that are in it lie still in it.
    fn let_grains_ride(&mut self) {
        let held = self.state.objects.values();
        let held = held.filter(|object| object.attachment.is_some());
        let level = held.filter(|object| tilt_of(&self.physics.pose(object.body)) < LEVEL);
        let level: Vec<(u32, Pose)> = level
            .map(|vessel| (vessel.number, self.physics.pose(vessel.body)))
            .collect();
        for (number, pose) in level {
            let mut lots = std::mem::take(&mut self.state.grains);
            let mut lie_still = true;
            let mut within: Vec<&mut Grain> = Vec::new();
            for grain in lots.iter_mut().flat_map(|lot| &mut lot.grains) {
                let is_loose = grain.vessel == number && grain.rides.is_none();
                if !is_loose || !self.is_in_numbered(grain) {
                    continue;
                }
                let now = pose.inverse_transform_point(&self.place_of(grain));
                lie_still &= (now - grain.noted).norm() < STILL;
                grain.noted = now;
                within.push(grain);
            }
            if lie_still {
                for grain in within {
                    grain.rides = Some(pose.inverse() * self.physics.pose(grain.body));
                    self.physics.set_enabled(grain.body, false);
                }
            }
            self.state.grains = lots;
        }
    }

    /// Whether a grain is in the vessel in which it was last.
    fn is_in_numbered(&self, grain: &Grain) -> bool {
        self.numbered(grain.vessel)
            .is_some_and(|vessel| self.is_grain_in(grain, vessel))
    }

    /// Takes the grains in a vessel along that is put from a pose to another one.
    pub(super) fn take_grains_along(&mut self, name: &str, from: &Pose, to: &Pose) {
        let Some(vessel) = self.state.objects.get(name) else {
            return;
        };
        let change = to * from.inverse();
        let within = self.all_grains();
        let within: Vec<BodyHandle> = within
            .filter(|grain| grain.rides.is_none() && self.is_grain_in(grain, vessel))
            .map(|grain| grain.body)
            .collect();
        for body in within {
            let place = change * self.physics.pose(body);
            self.physics.place(body, &place);
        }
    }

    fn numbered(&self, number: u32) -> Option<&Object> {
        let mut objects = self.state.objects.values();
        objects.find(|object| object.number == number)
    }

    /// Where its middle is (m, map frame).
    fn place_of(&self, grain: &Grain) -> Point3<f64> {
        let riding = grain.rides.as_ref().and_then(|within| {
            let vessel = self.numbered(grain.vessel)?;
            Some(self.physics.pose(vessel.body) * within)
        });
        let pose = riding.unwrap_or_else(|| self.physics.pose(grain.body));
        pose.translation.vector.into()
    }

    fn is_beside(&self, grain: &Grain) -> bool {
        self.vessel_around(grain).is_none()
    }

    fn vessel_around(&self, grain: &Grain) -> Option<&Object> {
        let mut objects = self.state.objects.values();
        objects.find(|object| self.is_grain_in(grain, object))
    }

    fn is_grain_in(&self, grain: &Grain, object: &Object) -> bool {
        if grain.rides.is_some() {
            return grain.vessel == object.number;
        }
        let at: Point3<f64> = self.physics.pose(grain.body).translation.vector.into();
        let pose = self.physics.pose(object.body);
        let within = pose.inverse_transform_point(&at);
        let bounds = &object.bounds;
        let is_near = within.x > bounds.mins.x
            && within.x < bounds.maxs.x
            && within.y > bounds.mins.y
            && within.y < bounds.maxs.y
            && within.z > bounds.mins.z
            && within.z < bounds.maxs.z + GRAIN_RADIUS;
        // Whether it has room inside takes long to find out for the first time.
        is_near
            && object
                .room_for_grains()
                .is_some_and(|cavity| cavity.holds_grain(&within))
    }
}
