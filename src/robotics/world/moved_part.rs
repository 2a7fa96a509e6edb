//! Drawers and doors elsewhere than they are, with what rides in them.
//!
//! A part is everything that a joint of the kitchen moves. Things that stand in it, or on what
//! stands in it, ride along. What is found out here about a part at another position changes
//! nothing in the world.

use std::sync::Arc;

use nalgebra::Point3;

use super::allowed_pairs::AllowedPairs;
use super::body_name::BodyName;
use super::collision::{CollisionChecker, CollisionHit};
use super::object::Object;
use super::obstacles::{Obstacle, Obstacles};
use super::part_key::{PartKey, index};
use super::physics::BodyHandle;
use super::scene::{World, pose_of};
use super::separation::separation;
use super::solid::{Solid, from_parry_vector, to_parry};
use super::surroundings::ObjectAt;
use super::two_stages::come_out;
use crate::robot::{JointId, JointKind, JointPositions, LinkId};
use parry3d_f64::math::{Pose as ParryPose, Vector};
use spatial::Pose;

/// Things closer to each other than this (m) touch, so that one may carry the other.
const TOUCHING: f64 = 0.003;
/// Overlap (m) with its surroundings that a part may have: rounding, not contact.
pub(super) const SLACK: f64 = 0.001;
/// How far (m) from its axis a door may overlap its surroundings: what is there is its hinge.
const HINGE: f64 = 0.03;

/// What a joint of the kitchen moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The joint.
    pub joint: JointId,
    /// The links that it moves.
    pub links: Vec<LinkId>,
    /// What rides along, by name, in the order of the world's objects.
    pub(crate) riders: Vec<String>,
}

/// A part at another position than it has.
pub struct MovedPart<'w> {
    world: &'w World,
    part: Part,
    /// Poses of all links of the kitchen in the map frame.
    poses: Vec<Pose>,
    furniture: Obstacles,
}

impl World {
    /// What the joint moves now.
    pub fn part(&self, joint: JointId) -> Part {
        let kitchen = &self.models.kitchen;
        let child = kitchen.joint(joint).child;
        let links = kitchen.links().map(|(link, _)| link);
        let links: Vec<LinkId> = links.filter(|l| kitchen.carries(child, *l)).collect();
        let riders = self.riders(child, &links);
        Part {
            joint,
            links,
            riders,
        }
    }

    /// The objects that stand in the link, directly or on one another.
    fn riders(&self, link: LinkId, links: &[LinkId]) -> Vec<String> {
        let Some(extent) = self.assembly_extent(link) else {
            return Vec::new();
        };
        let is_in = |object: &&Object| {
            let t = self.physics.pose(object.body).translation;
            let [x, y] = extent.local([t.x, t.y]);
            object.attachment.is_none()
                && (extent.min[0]..=extent.max[0]).contains(&x)
                && (extent.min[1]..=extent.max[1]).contains(&y)
                && t.z >= extent.frame.translation.z + extent.min[2]
        };
        let mut waiting: Vec<ObjectAt<'_>> = self
            .state
            .objects
            .values()
            .filter(is_in)
            .map(|object| self.object_at(object))
            .collect();
        let own: Vec<&Arc<Obstacle>> = self
            .state
            .furniture
            .all()
            .iter()
            .filter(|obstacle| is_of(links, obstacle.key))
            .collect();
        let on_link = |object: &ObjectAt<'_>| {
            own.iter()
                .any(|o| touches(object, &o.placed.pose, &o.solid, TOUCHING).is_some())
        };
        let mut riding: Vec<ObjectAt<'_>> = Vec::new();
        loop {
            let on_rider = |object: &ObjectAt<'_>| {
                riding.iter().any(|rider| {
                    let mut solids = rider.solids.iter();
                    solids.any(|s| touches(object, &(rider.pose * s.pose), s, TOUCHING).is_some())
                })
            };
            let next = waiting.iter().position(|o| on_link(o) || on_rider(o));
            match next {
                Some(place) => riding.push(waiting.remove(place)),
                None => break,
            }
        }
        let rides = |object: &&Object| riding.iter().any(|r| r.key == object.key());
        let riders = self.state.objects.values().filter(rides);
        riders.map(|object| object.name.clone()).collect()
    }

    /// Poses of all links of the kitchen in the map frame with the joint at another position
    /// (rad or m).
    pub fn kitchen_with(&self, joint: JointId, position: f64) -> (JointPositions, Vec<Pose>) {
        let mut positions = self.state.kitchen.clone();
        positions.set(joint, position);
        come_out(&self.models.kitchen, &mut positions, joint);
        self.placed_kitchen(positions)
    }

    /// Poses of all links of the kitchen in the map frame with those positions of its joints (rad or m).
    fn placed_kitchen(&self, positions: JointPositions) -> (JointPositions, Vec<Pose>) {
        let mut poses = Vec::new();
        self.models
            .kitchen
            .forward_kinematics(&Pose::identity(), &positions, &mut poses);
        (positions, poses)
    }

    /// The part as it would be with its joint at a position (rad or m).
    pub fn moved(&self, part: &Part, position: f64) -> MovedPart<'_> {
        let (_, poses) = self.kitchen_with(part.joint, position);
        self.moved_to(part, poses)
    }

    /// The part as it would be with several joints at positions (rad or m).
    pub(crate) fn moved_by(&self, part: &Part, joints: &[(JointId, f64)]) -> MovedPart<'_> {
        let mut positions = self.state.kitchen.clone();
        for (joint, position) in joints {
            positions.set(*joint, *position);
        }
        let (_, poses) = self.placed_kitchen(positions);
        self.moved_to(part, poses)
    }

    fn moved_to(&self, part: &Part, poses: Vec<Pose>) -> MovedPart<'_> {
        let geometry = &self.models.kitchen_geometry;
        let furniture = self.state.furniture.with_links_at(geometry, &poses);
        MovedPart {
            world: self,
            part: part.clone(),
            poses,
            furniture,
        }
    }

    /// Puts what rides in the part where it comes to be when the links of the kitchen are moved to
    /// the poses.
    pub(super) fn carry_riders(&mut self, part: &Part, poses: &[Pose]) {
        let child = self.models.kitchen.joint(part.joint).child;
        let way = pose_of(poses, child) * self.furniture_pose(child).inverse();
        let bodies = self.bodies_of(&part.riders);
        for body in bodies {
            let pose = way * self.physics.pose(body);
            self.physics.place(body, &pose);
        }
    }

    fn bodies_of(&self, names: &[String]) -> Vec<BodyHandle> {
        let objects = names.iter().filter_map(|n| self.state.objects.get(n));
        objects.map(|object| object.body).collect()
    }

    /// What the part and its riders are pressed against from outside, and the sum of the forces (N)
    /// of the last step.
    pub(super) fn resistance(&self, part: &Part) -> Option<(BodyName, f64)> {
        let is_rider = |name: &BodyName| name.object().is_some_and(|n| self.rides(part, n));
        let mut forces = Vec::new();
        for (body, group) in self
            .kitchen_bodies
            .iter()
            .zip(&self.models.kitchen_geometry.groups)
        {
            if let (Some(body), true) = (body, part.links.contains(&group.root)) {
                forces.extend(self.forces_on(*body, |_, _| true));
            }
        }
        forces.retain(|force| !is_rider(&force.body));
        for body in self.bodies_of(&part.riders) {
            let outside = self.forces_on(body, |_, other| {
                !is_of(&part.links, PartKey::from_code(other))
            });
            forces.extend(outside.into_iter().filter(|force| !is_rider(&force.body)));
        }
        let sum = forces.iter().map(|force| force.force).sum();
        let most = forces
            .into_iter()
            .max_by(|a, b| a.force.total_cmp(&b.force))?;
        Some((most.body, sum))
    }

    fn rides(&self, part: &Part, name: &str) -> bool {
        part.riders.iter().any(|rider| rider == name)
    }
}

impl MovedPart<'_> {
    /// The pose of a link of the kitchen in the map frame.
    pub fn pose(&self, link: LinkId) -> Pose {
        pose_of(&self.poses, link)
    }

    /// The pose in the map frame of an object that rides along.
    fn rider_pose(&self, object: &Object) -> Option<ParryPose> {
        if !self.world.rides(&self.part, &object.name) {
            return None;
        }
        let child = self.world.models.kitchen.joint(self.part.joint).child;
        let way = self.pose(child) * self.world.furniture_pose(child).inverse();
        Some(to_parry(&(way * self.world.physics.pose(object.body))))
    }

    /// An object where it then is, and whether it rides along.
    fn object_at<'a>(&'a self, object: &'a Object) -> (ObjectAt<'a>, bool) {
        let mut at = self.world.object_at(object);
        let pose = self.rider_pose(object);
        if let Some(pose) = pose {
            at.pose = pose;
            at.bounds = object.bounds.transform_by(&pose);
        }
        (at, pose.is_some())
    }

    /// A checker of robot configurations in the world as it then is.
    pub fn checker(&self) -> CollisionChecker<'_> {
        self.world
            .checker_among(&self.furniture, |object| self.object_at(object).0)
    }

    /// What other furniture the links of the part overlap there.
    pub(super) fn furniture_hit(&self) -> Option<CollisionHit> {
        self.own_obstacles()
            .find_map(|own| self.against_furniture(own.key, &own.placed.pose, &own.solid))
    }

    /// What the part, or something that rides in it, would run into there: other furniture, or an
    /// object that does not ride along.
    pub fn hit(&self) -> Option<CollisionHit> {
        if let Some(hit) = self.furniture_hit() {
            return Some(hit);
        }
        let objects: Vec<(ObjectAt<'_>, bool)> = self
            .world
            .state
            .objects
            .values()
            .map(|object| self.object_at(object))
            .collect();
        let (riders, others): (Vec<_>, Vec<_>) = objects.into_iter().partition(|(_, rides)| *rides);
        for (other, _) in &others {
            for own in self.own_obstacles() {
                if let Some(hit) = touches(other, &own.placed.pose, &own.solid, -SLACK) {
                    return self.report(own.key, other.key, hit);
                }
            }
            for (rider, _) in &riders {
                for solid in rider.solids {
                    if let Some(hit) = touches(other, &(rider.pose * solid.pose), solid, -SLACK) {
                        return self.report(rider.key, other.key, hit);
                    }
                }
            }
        }
        riders.iter().find_map(|(rider, _)| {
            let mut solids = rider.solids.iter();
            solids.find_map(|s| self.against_furniture(rider.key, &(rider.pose * s.pose), s))
        })
    }

    /// What the part, or something that rides in it, would be in there: what [`Self::hit`] tells, and
    /// the robot with what it holds.
    pub(super) fn hits(&self) -> Vec<CollisionHit> {
        let mut hits: Vec<CollisionHit> = self.hit().into_iter().collect();
        let robot = self.world.robot_configuration();
        let of_robot = self.checker().all_hits(robot, &AllowedPairs::none(), 0.0);
        let moves = |body: &BodyName| match body {
            BodyName::Furniture(link) => self.part.links.contains(&link.id),
            BodyName::Object(name) => self.part.riders.contains(name),
            _ => false,
        };
        let of_part = of_robot.into_iter().filter(|hit| moves(&hit.other));
        hits.extend(of_part.filter(|hit| hit.depth > SLACK));
        hits
    }

    /// What a thing that stands at a pose now and rides along would run into.
    pub(super) fn meets_as_rider(
        &self,
        solids: &[Solid],
        key: Option<PartKey>,
        pose: &Pose,
    ) -> Option<BodyName> {
        let child = self.world.models.kitchen.joint(self.part.joint).child;
        let way = self.pose(child) * self.world.furniture_pose(child).inverse();
        let at = to_parry(&(way * pose));
        let objects = self.world.state.objects.values();
        let others: Vec<ObjectAt<'_>> = objects
            .filter(|object| Some(object.key()) != key && object.attachment.is_none())
            .map(|object| self.object_at(object))
            .filter(|(_, rides)| !rides)
            .map(|(object, _)| object)
            .collect();
        solids.iter().find_map(|solid| {
            let placed = at * solid.pose;
            let bounds = solid.shape.compute_aabb(&placed);
            let mut places = self.furniture.places_near(&bounds);
            // These are places in this list.
            let furniture = places.find_map(|place| {
                let other = &self.furniture.all()[place];
                let is_other = !is_of(&self.part.links, other.key);
                let meets = is_other
                    && separation(&placed, solid, &other.placed.pose, &other.solid, 0.0).is_some();
                meets.then_some(other.key)
            });
            let met = furniture.or_else(|| {
                let mut others = others.iter();
                others
                    .find(|other| touches(other, &placed, solid, 0.0).is_some())
                    .map(|other| other.key)
            });
            self.world.body_name(met?)
        })
    }

    /// What of the part would run into a thing that stands at a pose and stays there.
    pub(super) fn meets(&self, solids: &[Solid], pose: &Pose) -> Option<BodyName> {
        let at = to_parry(pose);
        self.own_obstacles().find_map(|own| {
            let meets = solids.iter().any(|solid| {
                let placed = at * solid.pose;
                separation(&placed, solid, &own.placed.pose, &own.solid, 0.0).is_some()
            });
            meets.then(|| self.world.body_name(own.key)).flatten()
        })
    }

    fn own_obstacles(&self) -> impl Iterator<Item = &Obstacle> {
        let all = self.furniture.all().iter().map(|obstacle| &**obstacle);
        all.filter(|obstacle| is_of(&self.part.links, obstacle.key))
    }

    fn against_furniture(
        &self,
        key: PartKey,
        pose: &ParryPose,
        solid: &Solid,
    ) -> Option<CollisionHit> {
        let bounds = solid.shape.compute_aabb(pose);
        for place in self.furniture.places_near(&bounds) {
            // These are places in this list.
            let other = &self.furniture.all()[place];
            if is_of(&self.part.links, other.key) {
                continue;
            }
            if let Some(hit) = separation(pose, solid, &other.placed.pose, &other.solid, -SLACK)
                && !self.were_built_so(key, other.key)
                && !self.is_at_hinge(key, hit.point)
            {
                return self.report(key, other.key, (hit.distance, from_parry_vector(hit.point)));
            }
        }
        None
    }

    /// Whether a link of the part is in another one as their file has it.
    fn were_built_so(&self, own: PartKey, other: PartKey) -> bool {
        matches!(own, PartKey::Furniture(_)) && self.world.models.overlap_at_rest(own, other, SLACK)
    }

    /// Whether a point of a link of the part is at the hinge by which the part turns.
    fn is_at_hinge(&self, own: PartKey, point: Vector) -> bool {
        let joint = self.world.models.kitchen.joint(self.part.joint);
        let turns = matches!(joint.kind, JointKind::Revolute);
        let child = self.pose(joint.child);
        let axis = child.rotation * joint.axis.into_inner();
        let from_axis = from_parry_vector(point) - child.translation.vector;
        let across = from_axis - axis * axis.dot(&from_axis);
        turns && matches!(own, PartKey::Furniture(_)) && across.norm() <= HINGE
    }

    fn report(
        &self,
        moving: PartKey,
        other: PartKey,
        (distance, point): (f64, nalgebra::Vector3<f64>),
    ) -> Option<CollisionHit> {
        Some(CollisionHit {
            moving: self.world.body_name(moving)?,
            other: self.world.body_name(other)?,
            depth: -distance,
            point: Point3::from(point),
        })
    }
}

/// Whether the key is that of one of the links of the kitchen.
fn is_of(links: &[LinkId], key: PartKey) -> bool {
    links
        .iter()
        .any(|link| PartKey::Furniture(index(*link)) == key)
}

/// The distance (m) of the object from a solid if it is below the margin (m), and where.
fn touches(
    object: &ObjectAt<'_>,
    pose: &ParryPose,
    solid: &Solid,
    margin: f64,
) -> Option<(f64, nalgebra::Vector3<f64>)> {
    use parry3d_f64::bounding_volume::BoundingVolume;
    let bounds = solid.shape.compute_aabb(pose).loosened(margin.max(0.0));
    if !object.bounds.intersects(&bounds) {
        return None;
    }
    object.solids.iter().find_map(|own| {
        let at = object.pose * own.pose;
        let near = separation(&at, own, pose, solid, margin)?;
        Some((near.distance, from_parry_vector(near.point)))
    })
}
