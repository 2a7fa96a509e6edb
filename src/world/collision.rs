//! What touches what, for any configuration of the robot.
//!
//! A query reads the world and changes nothing, and it does not look at where the robot
//! is: the configuration to judge is handed in. Attached objects are carried along with the
//! link that holds them. The pairs judged are robot or held object against furniture, floor
//! and objects, and the robot against itself; furniture is never judged against furniture.
//!
//! Castors never meet the floor, which they roll on, and links that are neighbours or
//! always overlap are left out as the robot's description says.

use std::ops::ControlFlow;

use nalgebra::Point3;
use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::math::Pose as ParryPose;

use super::allowed_pairs::AllowedPairs;
use super::body_name::BodyName;
use super::models::Models;
use super::part_key::PartKey;
use super::robot_configuration::RobotConfiguration;
use super::separation::{Separation, below_floor, separation};
use super::solid::{Solid, from_parry_vector, to_parry};
use crate::robot::LinkId;
use crate::spatial::Pose;

/// Two bodies that are nearer to each other than a query allows.
#[derive(Clone, Debug, PartialEq)]
pub struct CollisionHit {
    /// The robot's link, or the object that the robot holds.
    pub moving: BodyName,
    /// The other body.
    pub other: BodyName,
    /// How far the two overlap (m); negative for a gap that is smaller than asked for.
    pub depth: f64,
    /// A point of the overlap, or between the two, in the map frame (m).
    pub point: Point3<f64>,
}

/// The two bodies that are nearest to each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Clearance {
    /// The robot's link, or the object that the robot holds.
    pub moving: BodyName,
    /// The other body.
    pub other: BodyName,
    /// The gap between the two (m); negative when they overlap.
    pub distance: f64,
}

/// A piece of furniture, placed in the map frame.
pub(crate) struct Obstacle {
    pub(crate) key: PartKey,
    pub(crate) solid: Solid,
    /// Pose of the solid in the map frame.
    pub(crate) pose: ParryPose,
    /// Bounds in the map frame (m).
    pub(crate) bounds: Aabb,
}

/// An object where it lies.
pub(crate) struct ObjectAt<'w> {
    pub(crate) key: PartKey,
    pub(crate) name: &'w str,
    pub(crate) solids: &'w [Solid],
    pub(crate) pose: ParryPose,
    pub(crate) bounds: Aabb,
}

/// An object that moves with a link.
pub(crate) struct HeldObject<'w> {
    pub(crate) key: PartKey,
    pub(crate) name: &'w str,
    pub(crate) solids: &'w [Solid],
    /// Bounds in the object's frame (m).
    pub(crate) bounds: Aabb,
    /// The link that carries the object.
    pub(crate) link: LinkId,
    /// Pose of the object in the link's frame.
    pub(crate) at: Pose,
}

/// Something that moves with the robot, placed for one query.
struct Mover {
    key: PartKey,
    pose: ParryPose,
    bounds: Aabb,
}

/// One pair that is near, in the terms of the query.
struct Near {
    moving: PartKey,
    other: PartKey,
    separation: Separation,
}

/// Judges configurations of the robot in one state of the world.
///
/// Making one costs a few microseconds, a query about as much: keep it for a whole search.
pub struct CollisionChecker<'w> {
    models: &'w Models,
    furniture: &'w [Obstacle],
    objects: Vec<ObjectAt<'w>>,
    held: Vec<HeldObject<'w>>,
    poses: Vec<Pose>,
    movers: Vec<Mover>,
    candidates: Vec<usize>,
}

impl<'w> CollisionChecker<'w> {
    pub(crate) fn new(
        models: &'w Models,
        furniture: &'w [Obstacle],
        objects: Vec<ObjectAt<'w>>,
        held: Vec<HeldObject<'w>>,
    ) -> Self {
        Self {
            models,
            furniture,
            objects,
            held,
            poses: Vec::new(),
            movers: Vec::new(),
            candidates: Vec::new(),
        }
    }

    /// Whether nothing but allowed pairs is nearer than `margin` (m).
    ///
    /// With a negative margin, overlaps of up to that depth pass.
    pub fn is_free(
        &mut self,
        robot: &RobotConfiguration,
        allowed: &AllowedPairs,
        margin: f64,
    ) -> bool {
        self.first_hit(robot, allowed, margin).is_none()
    }

    /// Some pair that is nearer than `margin` (m) and not allowed, the first one found in a
    /// fixed order; `None` when there is none.
    pub fn first_hit(
        &mut self,
        robot: &RobotConfiguration,
        allowed: &AllowedPairs,
        margin: f64,
    ) -> Option<CollisionHit> {
        self.with_poses(robot, |checker, poses| {
            checker.first_hit_at(poses, allowed, margin)
        })
    }

    /// As [`Self::first_hit`], for the poses of all links as forward kinematics gives them.
    pub fn first_hit_at(
        &mut self,
        link_poses: &[Pose],
        allowed: &AllowedPairs,
        margin: f64,
    ) -> Option<CollisionHit> {
        let mut found = None;
        self.search(link_poses, allowed, margin, |near| {
            found = Some(near);
            ControlFlow::Break(())
        });
        found.and_then(|near| self.report(&near))
    }

    /// Every pair of bodies that is nearer than `margin` (m) and not allowed, the deepest first.
    pub fn all_hits(
        &mut self,
        robot: &RobotConfiguration,
        allowed: &AllowedPairs,
        margin: f64,
    ) -> Vec<CollisionHit> {
        let mut found: Vec<Near> = Vec::new();
        self.with_poses(robot, |checker, poses| {
            checker.search(poses, allowed, margin, |near| {
                let known = found
                    .iter_mut()
                    .find(|n| n.moving == near.moving && n.other == near.other);
                match known {
                    Some(n) if n.separation.distance <= near.separation.distance => {}
                    Some(n) => *n = near,
                    None => found.push(near),
                }
                ControlFlow::Continue(())
            });
        });
        found.sort_by(|a, b| a.separation.distance.total_cmp(&b.separation.distance));
        found.iter().filter_map(|near| self.report(near)).collect()
    }

    /// The pair with the smallest gap among those nearer than `reach` (m) and not allowed.
    pub fn clearance(
        &mut self,
        robot: &RobotConfiguration,
        allowed: &AllowedPairs,
        reach: f64,
    ) -> Option<Clearance> {
        let nearest = self.all_hits(robot, allowed, reach).into_iter().next()?;
        Some(Clearance {
            moving: nearest.moving,
            other: nearest.other,
            distance: -nearest.depth,
        })
    }

    /// As [`Self::clearance`], without the pairs of the robot with itself.
    pub fn clearance_to_world(
        &mut self,
        robot: &RobotConfiguration,
        allowed: &AllowedPairs,
        reach: f64,
    ) -> Option<Clearance> {
        let hits = self.all_hits(robot, allowed, reach);
        let nearest = hits.into_iter().find(|hit| {
            let own = hit.other.robot_link().is_some();
            !own && !matches!(hit.other, BodyName::Floor)
        })?;
        Some(Clearance {
            moving: nearest.moving,
            other: nearest.other,
            distance: -nearest.depth,
        })
    }

    fn with_poses<T>(
        &mut self,
        robot: &RobotConfiguration,
        query: impl FnOnce(&mut Self, &[Pose]) -> T,
    ) -> T {
        let mut poses = std::mem::take(&mut self.poses);
        self.models
            .robot
            .forward_kinematics(&robot.base, &robot.joints, &mut poses);
        let result = query(self, &poses);
        self.poses = poses;
        result
    }

    /// Visits the near pairs in a fixed order until told to stop.
    fn search(
        &mut self,
        link_poses: &[Pose],
        allowed: &AllowedPairs,
        margin: f64,
        mut visit: impl FnMut(Near) -> ControlFlow<()>,
    ) {
        let allowed = self.allowed_keys(allowed);
        self.place_movers(link_poses);
        let mut candidates = std::mem::take(&mut self.candidates);
        let _ = self
            .search_world(&allowed, margin, &mut candidates, &mut visit)
            .is_continue()
            && self.search_self(&allowed, margin, &mut visit).is_continue();
        self.candidates = candidates;
    }

    fn place_movers(&mut self, link_poses: &[Pose]) {
        let geometry = &self.models.robot_geometry;
        self.movers.clear();
        for link in &geometry.solid_links {
            // A pose for every link is the contract of `first_hit_at`; without one the
            // link is taken to be at the origin.
            let pose = link_poses
                .get(link.link.index())
                .map_or(ParryPose::IDENTITY, to_parry);
            let key = PartKey::Robot(index(link.link));
            self.movers.push(Mover {
                key,
                pose,
                bounds: link.bounds.transform_by(&pose),
            });
        }
        for held in &self.held {
            let link = link_poses
                .get(held.link.index())
                .copied()
                .unwrap_or_default();
            let pose = to_parry(&(link * held.at));
            let bounds = held.bounds.transform_by(&pose);
            self.movers.push(Mover {
                key: held.key,
                pose,
                bounds,
            });
        }
    }

    /// The solids of the mover at that place of the list.
    fn solids(&self, mover: usize) -> &[Solid] {
        let links = &self.models.robot_geometry.solid_links;
        match links.get(mover) {
            Some(link) => &link.solids,
            None => self.held.get(mover - links.len()).map_or(&[], |h| h.solids),
        }
    }

    fn search_world(
        &self,
        allowed: &[(PartKey, PartKey)],
        margin: f64,
        candidates: &mut Vec<usize>,
        visit: &mut impl FnMut(Near) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let slack = margin.max(0.0);
        let Some(whole) = self
            .movers
            .iter()
            .map(|m| m.bounds)
            .reduce(|a, b| a.merged(&b))
        else {
            return ControlFlow::Continue(());
        };
        let whole = whole.loosened(slack);
        candidates.clear();
        candidates.extend(
            (0..self.furniture.len()).filter(|&i| self.furniture[i].bounds.intersects(&whole)),
        );

        for (place, mover) in self.movers.iter().enumerate() {
            let bounds = mover.bounds.loosened(slack);
            let solids = self.solids(place);
            for &i in candidates.iter() {
                // Candidates are places in this very list.
                let obstacle = &self.furniture[i];
                if !obstacle.bounds.intersects(&bounds)
                    || is_allowed(allowed, mover.key, obstacle.key)
                {
                    continue;
                }
                for solid in solids {
                    let pose = mover.pose * solid.pose;
                    let near = separation(&pose, solid, &obstacle.pose, &obstacle.solid, margin);
                    if let Some(separation) = near {
                        visit(Near {
                            moving: mover.key,
                            other: obstacle.key,
                            separation,
                        })?;
                    }
                }
            }
            for object in &self.objects {
                if !object.bounds.intersects(&bounds) || is_allowed(allowed, mover.key, object.key)
                {
                    continue;
                }
                self.search_pair(
                    mover,
                    solids,
                    object.key,
                    &object.pose,
                    object.solids,
                    margin,
                    visit,
                )?;
            }
            if mover.bounds.mins.z < margin
                && !self.models.rolls_on_floor(mover.key)
                && !is_allowed(allowed, mover.key, PartKey::Floor)
            {
                for solid in solids {
                    if let Some(separation) = below_floor(&(mover.pose * solid.pose), solid, margin)
                    {
                        visit(Near {
                            moving: mover.key,
                            other: PartKey::Floor,
                            separation,
                        })?;
                    }
                }
            }
        }
        ControlFlow::Continue(())
    }

    fn search_self(
        &self,
        allowed: &[(PartKey, PartKey)],
        margin: f64,
        visit: &mut impl FnMut(Near) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let slack = margin.max(0.0);
        let links = self.models.robot_geometry.solid_links.len();
        for &(a, b) in &self.models.self_pairs {
            self.search_movers(a, b, slack, allowed, margin, visit)?;
        }
        for (i, held) in self.held.iter().enumerate() {
            let place = links + i;
            for link in 0..links {
                // Both lists have one entry per link with solids.
                let id = self.models.robot_geometry.solid_links[link].link;
                if !self.models.belong_to_same_hand(held.link, id) {
                    self.search_movers(place, link, slack, allowed, margin, visit)?;
                }
            }
            for other in (place + 1)..self.movers.len() {
                self.search_movers(place, other, slack, allowed, margin, visit)?;
            }
        }
        ControlFlow::Continue(())
    }

    fn search_movers(
        &self,
        a: usize,
        b: usize,
        slack: f64,
        allowed: &[(PartKey, PartKey)],
        margin: f64,
        visit: &mut impl FnMut(Near) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let (Some(one), Some(two)) = (self.movers.get(a), self.movers.get(b)) else {
            return ControlFlow::Continue(());
        };
        if !one.bounds.loosened(slack).intersects(&two.bounds)
            || is_allowed(allowed, one.key, two.key)
        {
            return ControlFlow::Continue(());
        }
        self.search_pair(
            one,
            self.solids(a),
            two.key,
            &two.pose,
            self.solids(b),
            margin,
            visit,
        )
    }

    #[allow(clippy::too_many_arguments)]
    fn search_pair(
        &self,
        mover: &Mover,
        solids: &[Solid],
        other: PartKey,
        other_pose: &ParryPose,
        other_solids: &[Solid],
        margin: f64,
        visit: &mut impl FnMut(Near) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        for two in other_solids {
            let pose2 = other_pose * two.pose;
            for one in solids {
                let pose1 = mover.pose * one.pose;
                if let Some(separation) = separation(&pose1, one, &pose2, two, margin) {
                    visit(Near {
                        moving: mover.key,
                        other,
                        separation,
                    })?;
                }
            }
        }
        ControlFlow::Continue(())
    }

    fn allowed_keys(&self, allowed: &AllowedPairs) -> Vec<(PartKey, PartKey)> {
        allowed
            .iter()
            .filter_map(|(a, b)| Some((self.key_of(a)?, self.key_of(b)?)))
            .collect()
    }

    fn key_of(&self, name: &BodyName) -> Option<PartKey> {
        Some(match name {
            BodyName::Floor => PartKey::Floor,
            BodyName::Robot(link) => PartKey::Robot(index(link.id)),
            BodyName::Furniture(link) => PartKey::Furniture(index(link.id)),
            BodyName::Object(name) => {
                let lying = self.objects.iter().map(|o| (o.name, o.key));
                let held = self.held.iter().map(|o| (o.name, o.key));
                lying.chain(held).find(|(n, _)| n == name)?.1
            }
        })
    }

    fn name_of(&self, key: PartKey) -> Option<BodyName> {
        Some(match key {
            PartKey::Floor => BodyName::Floor,
            PartKey::Robot(i) => BodyName::Robot(self.models.robot_geometry.name(i)?.clone()),
            PartKey::Furniture(i) => {
                BodyName::Furniture(self.models.kitchen_geometry.name(i)?.clone())
            }
            PartKey::Object(_) => {
                let lying = self.objects.iter().map(|o| (o.name, o.key));
                let held = self.held.iter().map(|o| (o.name, o.key));
                let (name, _) = lying.chain(held).find(|(_, k)| *k == key)?;
                BodyName::Object(name.to_owned())
            }
        })
    }

    fn report(&self, near: &Near) -> Option<CollisionHit> {
        Some(CollisionHit {
            moving: self.name_of(near.moving)?,
            other: self.name_of(near.other)?,
            depth: -near.separation.distance,
            point: from_parry_vector(near.separation.point).into(),
        })
    }
}

/// The link's place in its tree as keys count it.
pub(crate) fn index(link: LinkId) -> u32 {
    // A tree of four milliard links does not fit into memory.
    u32::try_from(link.index()).unwrap_or(u32::MAX)
}

fn is_allowed(allowed: &[(PartKey, PartKey)], a: PartKey, b: PartKey) -> bool {
    allowed
        .iter()
        .any(|&(x, y)| (x == a && y == b) || (x == b && y == a))
}
