//! Checks poses of the base for the robot's present posture.

use std::f64::consts::{FRAC_PI_8, PI};

use super::base_path::MARGIN;
use super::configuration::at_place;
use crate::motion::contact::expected_contacts::ExpectedContacts;
use crate::motion::contact::touching::TouchingPairs;
use crate::motion::failure::base_place::BasePlace;
use crate::robot::description::DriveKind;
use crate::world::{
    AllowedPairs, BodyName, CollisionChecker, CollisionHit, RobotConfiguration, World,
};
use spatial::{Pose, trig};

/// How far (m) the robot's links extend beyond their frames.
const LINK_EXTENT: f64 = 0.15;
/// Displacements (m) tried to get out of a contact: spacing and number of steps.
const WAY_OUT: (f64, u32) = (0.01, 12);
/// Clearance (m) at which the robot counts as out of a contact.
const WAY_OUT_GAP: f64 = 0.005;

/// Checks poses of the base for the robot's present posture.
pub struct BaseChecker<'w> {
    checker: CollisionChecker<'w>,
    robot: RobotConfiguration,
    /// Poses of the links in the frame of the base, and in the map for the pose checked last.
    in_base: Vec<Pose>,
    in_map: Vec<Pose>,
    touching: TouchingPairs,
    /// Pairs that move with the robot.
    own: AllowedPairs,
}

impl<'w> BaseChecker<'w> {
    /// A checker for the present state of the world.
    pub fn new(world: &'w World) -> Self {
        let mut checker = world.collision_checker();
        let robot = world.robot_configuration().clone();
        // Driving brings no parts of the robot closer to each other.
        let near = checker.all_hits(&robot, &AllowedPairs::none(), MARGIN);
        let rides = |body: &BodyName| match body {
            BodyName::Robot(_) => true,
            BodyName::Object(name) => world.object(name).is_ok_and(|o| o.attachment().is_some()),
            BodyName::Furniture(_) | BodyName::Floor => false,
        };
        let own = near
            .into_iter()
            .filter(|hit| rides(&hit.other))
            .fold(AllowedPairs::none(), |all, hit| {
                all.and(hit.moving, hit.other)
            });
        let contacts = ExpectedContacts {
            allowed: own.clone(),
            ..ExpectedContacts::default()
        };
        let touching = TouchingPairs::new(&mut checker, &robot, &contacts, 0.0, 0.0);
        let mut in_base = Vec::new();
        let tree = &world.models().robot;
        tree.forward_kinematics(&Pose::identity(), &robot.joints, &mut in_base);
        Self {
            checker,
            robot,
            in_map: in_base.clone(),
            in_base,
            touching,
            own,
        }
    }

    /// What would be closer to the robot than the margin (m) at the pose.
    pub fn blocked(&mut self, place: &BasePlace, margin: f64) -> Option<CollisionHit> {
        self.robot = at_place(&self.robot, place);
        for (in_map, in_base) in self.in_map.iter_mut().zip(&self.in_base) {
            *in_map = self.robot.base * in_base;
        }
        let near = self
            .checker
            .first_hit_around(&self.in_map, self.touching.relaxed(), margin);
        // Within the robot, nothing changes.
        near.or_else(|| self.touching.first_deep(&mut self.checker, &self.robot))
    }

    /// What would be closer to the robot than the margin (m) at the pose, one of all, where [`Self::blocked`] finds
    /// something. Faster: neighbouring poses are mostly blocked by the same.
    pub(crate) fn blocker(&mut self, place: &BasePlace, margin: f64) -> Option<BodyName> {
        self.robot = at_place(&self.robot, place);
        let links = (&self.robot.base, self.in_base.as_slice());
        let near =
            self.checker
                .any_body_around(links, &mut self.in_map, self.touching.relaxed(), margin);
        near.or_else(|| {
            let deep = self.touching.first_deep(&mut self.checker, &self.robot)?;
            Some(deep.other)
        })
    }

    /// A pose at which the robot, which touches something at the start, no longer does; the
    /// straight path there leads out of the contact from the first centimetre on.
    pub(super) fn way_out(&mut self, start: &BasePlace, drive: DriveKind) -> Option<BasePlace> {
        if self.touching.is_empty() {
            return None;
        }
        let [x, y, yaw] = *start;
        let at = |r: f64, direction: f64| {
            let (s, c) = trig::sin_cos(direction);
            [x + r * c, y + r * s, yaw]
        };
        let directions: Vec<f64> = match drive {
            DriveKind::Omnidirectional | DriveKind::Fixed => {
                (0..16).map(|i| f64::from(i) * FRAC_PI_8).collect()
            }
            DriveKind::Differential => vec![yaw, yaw + PI],
        };
        let (spacing, steps) = WAY_OUT;
        for step in 1..=steps {
            for &turn in &directions {
                let end = at(f64::from(step) * spacing, turn);
                if self.touches(&end) {
                    continue;
                }
                let on_way = |i: u32| at(f64::from(i) * spacing, turn);
                if (1..step).all(|i| self.blocked(&on_way(i), 0.0).is_none()) {
                    return Some(end);
                }
            }
        }
        None
    }

    /// Whether the robot touches anything at the pose, whatever it touches now.
    fn touches(&mut self, place: &BasePlace) -> bool {
        self.robot = at_place(&self.robot, place);
        !self.checker.is_free(&self.robot, &self.own, WAY_OUT_GAP)
    }

    /// The largest distance (m) of any part of the robot from the axis of the base.
    pub(super) fn reach(&self) -> f64 {
        let places = self.in_base.iter().map(|p| p.translation);
        places.map(|t| libm::hypot(t.x, t.y)).fold(0.0, f64::max) + LINK_EXTENT
    }
}
