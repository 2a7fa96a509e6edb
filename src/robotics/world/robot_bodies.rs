//! The robot's bodies in the physics engine, and which of them follow the robot.
//!
//! Everything that moves costs the engine time, but most of the robot is far from anything that
//! it could push. So a body stays behind, and sleeps, until the part of the robot for which it
//! stands comes near an object, or an object comes near the body. Then it takes its place again:
//! at rest at first, which nothing notices, since nothing can touch it within that step.

use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};

use super::link_geometry::RigidGroup;
use super::object::Object;
use super::physics::STEP_SECONDS;
use super::scene::{World, pose_of};
use super::solid::{from_parry_vector, to_parry};
use crate::robot::LinkId;
use spatial::Pose;

/// Distance (m) from an object within which a body follows the robot: several times as far as
/// anything of the robot moves within a step.
const NEAR: f64 = 0.05;

/// The space in which an object may touch something within a step.
struct Zone {
    /// Bounds in the map frame (m).
    bounds: Aabb,
    /// The number of the hand that holds the object, and so does not collide with it.
    hand: Option<usize>,
}

impl World {
    /// Moves the bodies near objects to where the robot is set, and leaves the others behind. Call
    /// before a step.
    pub(super) fn move_robot_bodies(&mut self) {
        let robot_moves = self.state.robot_moves;
        let mut objects = self.state.objects.values();
        if !robot_moves && !objects.any(|object| self.physics.is_awake(object.body)) {
            return;
        }
        let models = &self.models;
        let zones: Vec<Zone> = self.objects().map(|object| self.zone(object)).collect();
        let carriers: Vec<usize> = self
            .objects()
            .flat_map(|o| self.carrying_links(o))
            .collect();
        let groups = models.robot_geometry.groups.iter();
        let bodies = self.robot_bodies.iter().zip(groups).zip(&models.hands);
        for (place, ((body, group), hand)) in bodies.enumerate() {
            let Some(behind) = self.state.left_behind.get_mut(place) else {
                continue;
            };
            if !robot_moves && behind.is_none() {
                continue;
            }
            let pose = pose_of(&self.state.robot_poses, group.root);
            let bounds = bounds_of(group, &pose);
            let is_near = |bounds: &Aabb| {
                let mut zones = zones.iter().filter(|z| z.hand.is_none() || z.hand != *hand);
                zones.any(|zone| zone.bounds.intersects(bounds))
            };
            let follows = carriers.contains(&place)
                || is_near(&bounds)
                || behind.is_some_and(|behind| is_near(&behind));
            match (follows, behind.is_some()) {
                (true, true) => {
                    self.physics.place(*body, &pose);
                    *behind = None;
                }
                (true, false) => self.physics.move_to(*body, &pose),
                (false, true) => {}
                (false, false) => {
                    *behind = Some(bounds_of(group, &self.physics.pose(*body)));
                    self.physics.sleep(*body);
                }
            }
        }
    }

    /// Puts all bodies where the robot is, at once, and leaves them behind there.
    pub(super) fn place_robot_bodies(&mut self) {
        let groups = self.models.robot_geometry.groups.iter();
        let bodies = self.robot_bodies.iter().zip(groups);
        let behind = bodies.map(|(body, group)| {
            let pose = pose_of(&self.state.robot_poses, group.root);
            self.physics.place(*body, &pose);
            self.physics.sleep(*body);
            Some(bounds_of(group, &pose))
        });
        self.state.left_behind = behind.collect();
    }

    /// Puts the body of which the link is part where the link is, if it has stayed behind.
    pub(super) fn bring_body(&mut self, link: LinkId) {
        let geometry = &self.models.robot_geometry;
        let place = geometry.group_of.get(link.index()).copied();
        let Some((body, root)) = self.body_of_link(link) else {
            return;
        };
        let behind = place.and_then(|place| self.state.left_behind.get_mut(place));
        if behind.and_then(Option::take).is_some() {
            let pose = self.link_pose(root);
            self.physics.place(body, &pose);
        }
    }

    /// The space that the object, with all that may touch it soon, takes up during a step.
    fn zone(&self, object: &Object) -> Zone {
        let pose = to_parry(&self.physics.pose(object.body));
        let (linear, angular) = self.physics.velocity(object.body);
        let center = from_parry_vector(object.bounds.center());
        let half = from_parry_vector(object.bounds.half_extents());
        let radius = center.norm() + half.norm();
        let travel = (linear.norm() + angular.norm() * radius) * STEP_SECONDS;
        let bounds = object.bounds.transform_by(&pose);
        Zone {
            bounds: bounds.loosened(NEAR + travel),
            hand: object.hold().map(|hold| hold.side().index()),
        }
    }

    /// The places in the list of bodies of those to which the object is welded.
    fn carrying_links<'w>(&'w self, object: &'w Object) -> impl Iterator<Item = usize> + 'w {
        let groups = &self.models.robot_geometry.group_of;
        let links = object.attachments().map(|one| one.link);
        links.filter_map(|link| groups.get(link.index()).copied())
    }
}

/// The bounds (m) of a body at a pose; empty if nothing of it is solid.
fn bounds_of(group: &RigidGroup, pose: &Pose) -> Aabb {
    let bounds = group.bounds.map(|b| b.transform_by(&to_parry(pose)));
    bounds.unwrap_or_else(Aabb::new_invalid)
}
