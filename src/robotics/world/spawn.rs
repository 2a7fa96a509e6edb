//! Adding objects to the world, placing them elsewhere and removing them.
//!
//! An object that would overlap something is lifted until it is free, or shifted aside if
//! that is a smaller displacement, and set down exactly on what is below; one that hovers
//! just above something is set down too. So the physics engine never throws anything out of
//! furniture. These are edits of the world: no time passes.

use std::sync::Arc;

use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::math::{Pose as ParryPose, Vector};
use parry3d_f64::query::{ShapeCastOptions, cast_shapes};

use super::body_name::BodyName;
use super::error::WorldError;
use super::hollow::is_hollow;
use super::object::Object;
use super::object_library::ObjectType;
use super::part_key::PartKey;
use super::physics::{BodyHandle, BodyKind, Surface};
use super::scene::World;
use super::separation::{lowest_point, separation};
use super::solid::{Solid, bounds_of, from_parry_vector, to_parry};
use spatial::Pose;

/// Objects whose bounds are nearer to each other than this (m) may touch.
const TOUCHING: f64 = 0.01;

/// Step (m) by which an overlapping object is lifted in search of free space.
const LIFT_STEP: f64 = 0.005;

/// Lift (m) up to which an object is not shifted aside.
const NEAR_LIFT: f64 = 0.6;

/// Largest lift (m): above everything in a kitchen.
const LIFT_LIMIT: f64 = 4.0;

/// Step (m) and limit (m) of shifts to the side.
const SHIFT_STEP: f64 = 0.02;
const SHIFT_LIMIT: f64 = 0.3;

/// Where to look for free space beside an object.
const DIRECTIONS: [(f64, f64); 8] = {
    const D: f64 = std::f64::consts::FRAC_1_SQRT_2;
    [
        (1.0, 0.0),
        (-1.0, 0.0),
        (0.0, 1.0),
        (0.0, -1.0),
        (D, D),
        (-D, D),
        (-D, -D),
        (D, -D),
    ]
};

/// Gap (m) up to which a hovering object is set down instead of dropped.
const SNAP_GAP: f64 = 0.05;

/// Overlap (m) that counts as touching.
const TOUCH: f64 = 1e-6;

/// Where an object was placed, and how that differs from the request.
#[derive(Clone, Debug, PartialEq)]
pub struct SpawnReport {
    /// Whether the object is new; otherwise an existing one was moved.
    pub is_new: bool,
    /// Where the object is now, in the map frame.
    pub pose: Pose,
    /// How much higher (m) that is than requested; negative if it was set down.
    pub lifted: f64,
    /// How far (m) it was shifted to the side.
    pub shifted: f64,
    /// What the object would have overlapped at the requested pose.
    pub blocked_by: Option<BodyName>,
    /// What the object was set down on; `None` if it is left to fall.
    pub support: Option<BodyName>,
}

/// A body near the requested pose of an object.
#[derive(Clone)]
pub(super) struct Neighbour {
    pub(super) key: PartKey,
    pub(super) pose: ParryPose,
    /// Bounds in the map frame (m).
    pub(super) bounds: Aabb,
    pub(super) solid: Solid,
}

impl World {
    /// Adds an object of a type in the library at the pose, with the type's colour and mass
    /// (kg) unless others are given. If an object with that name and type exists, it is moved
    /// there instead, and keeps its colour and mass unless others are given.
    pub fn spawn(
        &mut self,
        name: &str,
        type_name: &str,
        pose: &Pose,
        color: Option<[f32; 4]>,
        mass: Option<f64>,
    ) -> Result<SpawnReport, WorldError> {
        let library = &self.models.objects;
        let Some(known) = library.get(type_name) else {
            return Err(WorldError::UnknownType {
                name: type_name.to_owned(),
                closest: library.closest_name(type_name).map(str::to_owned),
            });
        };
        if let Some(object) = self.state.objects.get(name) {
            if object.type_name != type_name {
                return Err(WorldError::OtherType {
                    name: name.to_owned(),
                    type_name: object.type_name.clone(),
                    wanted: type_name.to_owned(),
                });
            }
            let report = self.move_object(name, pose)?;
            self.change(name, color, mass)?;
            return Ok(report);
        }
        let mut object = known.clone();
        object.color = color.unwrap_or(object.color);
        object.mass = mass.unwrap_or(object.mass);
        self.spawn_kind(name, &object, pose)
    }

    /// As [`World::spawn`], for a type that need not be in the library.
    pub fn spawn_kind(
        &mut self,
        name: &str,
        kind: &ObjectType,
        pose: &Pose,
    ) -> Result<SpawnReport, WorldError> {
        if self.state.objects.contains_key(name) {
            return self.move_object(name, pose);
        }
        self.check_place(name, pose)?;
        check_mass(name, kind.mass)?;
        let solids = Solid::all(&kind.shapes);
        let Some(bounds) = bounds_of(&solids) else {
            return Err(WorldError::NoSolid {
                type_name: kind.name.clone(),
            });
        };
        let number = self.state.next_number;
        let key = PartKey::Object(number);
        let mut report = self.find_place(key, &solids, &bounds, pose);
        report.is_new = true;
        self.insert(name, kind, &report.pose)?;
        Ok(report)
    }

    /// Adds an object of a kind exactly at a pose, whatever is there.
    pub(super) fn insert(
        &mut self,
        name: &str,
        kind: &ObjectType,
        pose: &Pose,
    ) -> Result<(), WorldError> {
        let (mass, friction) = (kind.mass, kind.friction);
        check_mass(name, mass)?;
        let solids = Solid::all(&kind.shapes);
        let Some(bounds) = bounds_of(&solids) else {
            return Err(WorldError::NoSolid {
                type_name: kind.name.clone(),
            });
        };
        let number = self.state.next_number;
        self.state.next_number += 1;
        let key = PartKey::Object(number);
        let parts: Vec<_> = solids
            .iter()
            .map(|s| (s.clone(), key.code(), Surface::Plain))
            .collect();
        let body = self
            .physics
            .add_body(BodyKind::Object { mass, friction }, pose, &parts);
        self.state.objects.insert(
            name.to_owned(),
            Object {
                name: name.to_owned(),
                type_name: kind.name.clone(),
                color: kind.color,
                mass,
                friction,
                shapes: Arc::from(kind.shapes.as_slice()),
                is_hollow: is_hollow(&solids),
                solids: Arc::from(solids),
                looks: kind.looks.as_deref().map(Arc::from),
                balance: kind.balance,
                edition: kind.edition,
                bounds,
                number,
                body,
                attachment: None,
                second: None,
                content: super::content::Content::default(),
                swing: nalgebra::Vector3::zeros(),
                inside: kind.inside,
                cavity: std::sync::OnceLock::new(),
            },
        );
        Ok(())
    }

    /// Gives the object another colour or mass (kg).
    fn change(
        &mut self,
        name: &str,
        color: Option<[f32; 4]>,
        mass: Option<f64>,
    ) -> Result<(), WorldError> {
        if let Some(mass) = mass {
            check_mass(name, mass)?;
            self.physics.set_mass(self.object(name)?.body, mass);
        }
        if let Some(object) = self.state.objects.get_mut(name) {
            object.color = color.unwrap_or(object.color);
            object.mass = mass.unwrap_or(object.mass);
        }
        Ok(())
    }

    /// Puts the object elsewhere, detached and at rest.
    pub fn move_object(&mut self, name: &str, pose: &Pose) -> Result<SpawnReport, WorldError> {
        self.check_place(name, pose)?;
        self.detach(name)?;
        let object = self.object(name)?;
        let (key, body) = (object.key(), object.body);
        let (solids, bounds) = (Arc::clone(&object.solids), object.bounds);
        let report = self.find_place(key, &solids, &bounds, pose);
        if let Some(object) = self.state.objects.get(name).cloned() {
            self.let_fall_around(&object);
        }
        let from = self.physics.pose(body);
        self.take_grains_along(name, &from, &report.pose);
        self.physics.place(body, &report.pose);
        Ok(report)
    }

    /// Removes the object from the world.
    pub fn remove(&mut self, name: &str) -> Result<(), WorldError> {
        self.detach(name)?;
        let number = self.object(name)?.number;
        self.release_grains_of(number);
        // The line above has found it. The remaining objects keep their order.
        if let Some(object) = self.state.objects.shift_remove(name) {
            self.let_fall_around(&object);
            self.physics.remove_body(object.body);
        }
        Ok(())
    }

    /// Lets the objects fall that may rest on an object or lean on it, as far as nothing else holds
    /// them. Among objects that sleep since they were spawned, the engine knows of no contact; and
    /// time passes without steps while nothing moves.
    fn let_fall_around(&mut self, object: &Object) {
        let near = self.bounds_of(object).loosened(TOUCHING);
        let others = self.objects().filter(|other| {
            let is_free = other.attachment.is_none() && other.body != object.body;
            is_free && near.intersects(&self.bounds_of(other))
        });
        let others: Vec<BodyHandle> = others.map(|other| other.body).collect();
        for body in others {
            self.physics.begin_to_fall(body);
        }
    }

    /// Removes all objects and grains from the world.
    pub fn remove_all(&mut self) {
        self.remove_grains(|_| true);
        for (_, object) in std::mem::take(&mut self.state.objects) {
            self.physics.remove_body(object.body);
        }
    }

    /// A free pose for the solids near the given one: above it, else beside it, else high above.
    fn find_place(
        &self,
        own: PartKey,
        solids: &[Solid],
        bounds: &Aabb,
        pose: &Pose,
    ) -> SpawnReport {
        let wanted = to_parry(pose);
        let bounds = bounds.transform_by(&wanted);
        let neighbours = self.neighbours(Some(own), &bounds.loosened(TOUCH));
        let blocked_by = first_overlap(solids, &wanted, &neighbours);
        let is_free = |place: &ParryPose| first_overlap(solids, place, &neighbours).is_none();
        let place = if blocked_by.is_none() {
            Some(wanted)
        } else {
            raised(&wanted, LIFT_STEP, NEAR_LIFT, is_free)
                .or_else(|| self.beside(own, solids, &bounds, &wanted))
                .or_else(|| raised(&wanted, LIFT_STEP, LIFT_LIMIT, is_free))
        };
        // Nothing in a kitchen is as high as the last pose tried.
        let place = place.unwrap_or(wanted);
        let around = self.neighbours(Some(own), &bounds.loosened(SHIFT_LIMIT));
        let landing = drop_onto(solids, &place, &around)
            .filter(|(gap, _)| blocked_by.is_some() || *gap <= SNAP_GAP);
        let fall = landing.map_or(0.0, |(gap, _)| gap);
        let way = place.translation - wanted.translation - Vector::Z * fall;
        let mut pose = *pose;
        pose.translation.vector += from_parry_vector(way);
        SpawnReport {
            is_new: false,
            pose,
            lifted: way.z,
            shifted: Vector::new(way.x, way.y, 0.0).length(),
            blocked_by: blocked_by.and_then(|key| self.body_name(key)),
            support: landing.and_then(|(_, key)| self.body_name(key)),
        }
    }

    /// What is below the object if it is at the pose, and how far (m) it can fall.
    pub fn below(&self, name: &str, pose: &Pose) -> Result<Option<(f64, BodyName)>, WorldError> {
        let object = self.object(name)?;
        let at = to_parry(pose);
        let mut around = self.neighbours(Some(object.key()), &object.bounds.transform_by(&at));
        around.retain(|n| !matches!(n.key, PartKey::Robot(_)));
        let landing = drop_onto(&object.solids, &at, &around);
        Ok(landing.and_then(|(gap, key)| Some((gap, self.body_name(key)?))))
    }

    /// The nearest free pose to the side of the wanted one, lifted a little if necessary.
    fn beside(
        &self,
        own: PartKey,
        solids: &[Solid],
        bounds: &Aabb,
        wanted: &ParryPose,
    ) -> Option<ParryPose> {
        let neighbours = self.neighbours(Some(own), &bounds.loosened(SHIFT_LIMIT));
        let is_free = |place: &ParryPose| first_overlap(solids, place, &neighbours).is_none();
        let mut distance = SHIFT_STEP;
        while distance <= SHIFT_LIMIT {
            for (x, y) in DIRECTIONS {
                let mut place = *wanted;
                place.translation += Vector::new(x, y, 0.0) * distance;
                if is_free(&place) {
                    return Some(place);
                }
                if let Some(place) = raised(&place, SHIFT_STEP, NEAR_LIFT, is_free) {
                    return Some(place);
                }
            }
            distance += SHIFT_STEP;
        }
        None
    }

    /// Everything above, below and within the bounds, except the floor and the object with that
    /// key.
    pub(super) fn neighbours(&self, own: Option<PartKey>, bounds: &Aabb) -> Vec<Neighbour> {
        let mut column = *bounds;
        column.mins.z = f64::NEG_INFINITY;
        column.maxs.z = f64::INFINITY;
        let mut found = Vec::new();
        let mut add = |key, pose: ParryPose, solid: &Solid| {
            let bounds = solid.shape.compute_aabb(&pose);
            if bounds.intersects(&column) {
                found.push(Neighbour {
                    key,
                    pose,
                    bounds,
                    solid: solid.clone(),
                });
            }
        };
        for obstacle in self.state.furniture.all() {
            add(obstacle.key, obstacle.placed.pose, &obstacle.solid);
        }
        for link in &self.models.robot_geometry.solid_links {
            let pose = to_parry(&self.link_pose(link.link));
            let key = PartKey::Robot(super::part_key::index(link.link));
            link.solids.iter().for_each(|s| add(key, pose * s.pose, s));
        }
        for object in self.state.objects.values().filter(|o| Some(o.key()) != own) {
            let pose = to_parry(&self.physics.pose(object.body));
            object
                .solids
                .iter()
                .for_each(|s| add(object.key(), pose * s.pose, s));
        }
        found
    }

    /// The name of the body with that key.
    pub fn body_name(&self, key: PartKey) -> Option<BodyName> {
        Some(match key {
            PartKey::Floor => BodyName::Floor,
            PartKey::Grain => return None,
            PartKey::Robot(i) => BodyName::Robot(self.models.robot_geometry.name(i)?.clone()),
            PartKey::Furniture(i) => {
                BodyName::Furniture(self.models.kitchen_geometry.name(i)?.clone())
            }
            PartKey::Object(_) => {
                let object = self.state.objects.values().find(|o| o.key() == key)?;
                BodyName::Object(object.name.clone())
            }
        })
    }
}

fn check_mass(name: &str, mass: f64) -> Result<(), WorldError> {
    if mass.is_finite() && mass > 0.0 {
        return Ok(());
    }
    Err(WorldError::ImpossibleNumber {
        quantity: "the mass",
        name: name.to_owned(),
        value: mass,
    })
}

/// The lowest free pose above, in steps of `step` (m) up to `limit` (m).
fn raised(
    from: &ParryPose,
    step: f64,
    limit: f64,
    is_free: impl Fn(&ParryPose) -> bool,
) -> Option<ParryPose> {
    let mut place = *from;
    while place.translation.z < from.translation.z + limit {
        place.translation.z += step;
        if is_free(&place) {
            return Some(place);
        }
    }
    None
}

/// The first body that the solids overlap at the pose.
pub(super) fn first_overlap(
    solids: &[Solid],
    at: &ParryPose,
    neighbours: &[Neighbour],
) -> Option<PartKey> {
    for solid in solids {
        let pose = at * solid.pose;
        if lowest_point(&pose, solid).z < -TOUCH {
            return Some(PartKey::Floor);
        }
        let bounds = solid.shape.compute_aabb(&pose);
        for other in neighbours {
            if !bounds.intersects(&other.bounds) {
                continue;
            }
            if separation(&pose, solid, &other.pose, &other.solid, -TOUCH).is_some() {
                return Some(other.key);
            }
        }
    }
    None
}

/// How far (m) the solids can fall from the pose, and onto what.
pub(super) fn drop_onto(
    solids: &[Solid],
    at: &ParryPose,
    neighbours: &[Neighbour],
) -> Option<(f64, PartKey)> {
    let bottom = solids.iter().map(|s| lowest_point(&(at * s.pose), s).z);
    let floor = bottom.reduce(f64::min)?.max(0.0);
    match way_along(solids, at, -Vector::Z, neighbours) {
        Some((gap, key)) if gap < floor => Some((gap, key)),
        _ => Some((floor, PartKey::Floor)),
    }
}

/// How far (m) the solids can move from the pose in a direction until they meet one of the neighbours,
/// and which; `None` if they meet none of them.
pub(super) fn way_along(
    solids: &[Solid],
    at: &ParryPose,
    direction: Vector,
    neighbours: &[Neighbour],
) -> Option<(f64, PartKey)> {
    let mut nearest: Option<(f64, PartKey)> = None;
    for solid in solids {
        let pose = at * solid.pose;
        for other in neighbours {
            let options = ShapeCastOptions::with_max_time_of_impact(LIFT_LIMIT);
            let hit = cast_shapes(
                &pose,
                direction,
                &*solid.shape,
                &other.pose,
                Vector::ZERO,
                &*other.solid.shape,
                options,
            );
            // All shapes are convex, so that the cast is supported.
            if let Ok(Some(hit)) = hit
                && nearest.is_none_or(|(best, _)| hit.time_of_impact < best)
            {
                nearest = Some((hit.time_of_impact, other.key));
            }
        }
    }
    nearest
}
