//! Collision queries for any configuration of the robot.
//!
//! A query reads the world without changing it, and does not depend on where the robot is:
//! the configuration to check is passed in. Attached objects move with the link that holds
//! them. The pairs checked are robot or held object against furniture, floor and objects,
//! and the robot against itself; furniture is never checked against furniture.
//!
//! Castors are never checked against the floor, on which they roll. Links that are
//! neighbours or always overlap are left out, as given by the robot's description. Queries
//! may require a gap. Between parts of the robot at most 5 mm is required, and between the
//! floor and anything but the arms and what they hold none: the robot's build determines
//! these gaps.

use std::ops::ControlFlow;
use std::rc::Rc;

use nalgebra::Point3;
use serde::Serialize;

use super::allowed_pairs::AllowedPairs;
use super::body_name::BodyName;
use super::collision_search::{Near, Question, Scratch, Wanted, in_order};
use super::link_pairs::LinkPairs;
use super::models::Models;
use super::moving_parts::{MovingParts, Pairs};
use super::part_key::{PartKey, index};
use super::robot_configuration::RobotConfiguration;
use super::solid::from_parry_vector;
use super::surroundings::Surroundings;
use crate::robot::LinkId;
use spatial::Pose;

/// Two bodies that are closer together than a query allows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CollisionHit {
    /// The robot's link, or the object that the robot holds.
    pub moving: BodyName,
    /// The other body.
    pub other: BodyName,
    /// How far the two overlap (m); negative for a gap smaller than required.
    pub depth: f64,
    /// A point of the overlap, or between the two, in the map frame (m).
    pub point: Point3<f64>,
}

/// The two bodies that are closest to each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Clearance {
    /// The robot's link, or the object that the robot holds.
    pub moving: BodyName,
    /// The other body.
    pub other: BodyName,
    /// The gap between the two (m); negative when they overlap.
    pub distance: f64,
}

/// Checks configurations of the robot in one state of the world.
///
/// Creating one takes a few microseconds, as does a query: keep it for a whole search.
pub struct CollisionChecker<'w> {
    pub(super) surroundings: Surroundings<'w>,
    /// The configuration in which a query was made last, and the poses of the links in it.
    last: Option<RobotConfiguration>,
    poses: Vec<Pose>,
    moved: Vec<bool>,
    /// Whether the coming search is for `last`, and `moved` says what has moved before it.
    is_update: bool,
    scratch: Scratch,
    /// For looking at some links again.
    poses_again: Vec<Pose>,
    scratch_again: Scratch,
    moving: Option<MovingParts>,
    /// The pairs of solid links that move relative to each other, once they have been listed.
    changing: Option<LinkPairs>,
    pairs: Pairs,
    /// The pairs of bodies that a query is about, if not all.
    only: Option<Keys>,
    /// The links that a query is about, if not all.
    links: Option<Rc<[PartKey]>>,
    /// The keys of pairs that were passed in.
    known: Vec<(AllowedPairs, Keys)>,
}

/// Pairs of bodies, each in order, sorted.
type Keys = Rc<[(PartKey, PartKey)]>;

/// How many lists of pairs are remembered by a checker: callers use the same few again and again.
const MAX_KNOWN: usize = 4;

/// Some links of the robot.
#[derive(Clone, Debug)]
pub(crate) struct SomeLinks {
    keys: Rc<[PartKey]>,
    /// For each link of the robot, whether it is one of them.
    are_some: Vec<bool>,
}

impl SomeLinks {
    /// Of a robot with that number of links.
    pub(crate) fn new(links: impl Iterator<Item = LinkId>, count: usize) -> Self {
        let mut are_some = vec![false; count];
        let mut keys = Vec::new();
        for link in links {
            if let Some(is_one) = are_some.get_mut(link.index()) {
                *is_one = true;
                keys.push(PartKey::Robot(index(link)));
            }
        }
        Self {
            keys: keys.into(),
            are_some,
        }
    }
}

impl<'w> CollisionChecker<'w> {
    pub fn new(surroundings: Surroundings<'w>) -> Self {
        Self {
            surroundings,
            last: None,
            poses: Vec::new(),
            moved: Vec::new(),
            is_update: false,
            scratch: Scratch::default(),
            poses_again: Vec::new(),
            scratch_again: Scratch::default(),
            moving: None,
            changing: None,
            pairs: Pairs::All,
            only: None,
            links: None,
            known: Vec::new(),
        }
    }

    /// The models of the world.
    pub(crate) fn models(&self) -> &'w Models {
        self.surroundings.models
    }

    /// A checker that knows where the links are in a configuration.
    pub(crate) fn knowing(mut self, robot: &RobotConfiguration, link_poses: &[Pose]) -> Self {
        self.last = Some(robot.clone());
        self.poses = link_poses.to_vec();
        self
    }

    /// A checker for which the lying objects of some names are not there.
    pub(crate) fn without(mut self, absent: &[String]) -> Self {
        let objects = &mut self.surroundings.objects;
        objects.retain(|object| !absent.iter().any(|name| name == object.name));
        self
    }

    /// As [`Self::expect`], for a single query, which the preparation for many is not worth.
    pub(crate) fn expect_once(&mut self, moving: MovingParts, pairs: Pairs) {
        self.changing = None;
        self.moving = Some(moving);
        self.pairs = pairs;
    }

    /// Says what moves between the configurations that are queried from now on, and which pairs
    /// the queries are about.
    pub fn expect(&mut self, moving: MovingParts, pairs: Pairs) {
        let models = self.surroundings.models;
        let links = &models.robot_geometry.solid_links;
        let all = &models.self_pairs;
        // The pairs are indices of this list.
        let changing = all.filtered(|a, b| moving.part(links[a].link, links[b].link));
        self.changing = Some(changing);
        self.moving = Some(moving);
        self.pairs = pairs;
    }

    /// Which pairs queries are about from now on; the value is what they were about.
    pub(crate) fn look_at(&mut self, pairs: Pairs) -> Pairs {
        std::mem::replace(&mut self.pairs, pairs)
    }

    /// Whether no pairs but the allowed ones are closer than `margin` (m).
    ///
    /// With a negative margin, overlaps up to that depth are accepted.
    pub fn is_free(
        &mut self,
        robot: &RobotConfiguration,
        allowed: &AllowedPairs,
        margin: f64,
    ) -> bool {
        self.any_near(robot, allowed, margin).is_none()
    }

    /// A pair that is closer than `margin` (m) and not allowed, any one. Searches for a free configuration ask about
    /// many that are like each other: the pair that was found last is the first to be looked at, for which little has
    /// to be placed.
    pub(super) fn any_near(
        &mut self,
        robot: &RobotConfiguration,
        allowed: &AllowedPairs,
        margin: f64,
    ) -> Option<Near> {
        let mut found = self.last_near(robot, allowed, margin);
        if found.is_none() {
            self.with_poses(robot, |checker, poses| {
                checker.search(poses, allowed, Wanted::Whether, margin, |near, _| {
                    found = Some(near);
                    ControlFlow::Break(())
                });
            });
        }
        found
    }

    /// The pair that was found last, if it is still near; otherwise it is forgotten.
    fn last_near(
        &mut self,
        robot: &RobotConfiguration,
        allowed: &AllowedPairs,
        margin: f64,
    ) -> Option<Near> {
        if self.only.is_some() || self.links.is_some() {
            return None;
        }
        let looked = self.scratch.last?;
        let tree = &self.surroundings.models.robot;
        let mut poses = std::mem::take(&mut self.poses_again);
        poses.resize(tree.links().count(), Pose::identity());
        for link in self.scratch.last_links() {
            tree.place_link(link, &robot.base, &robot.joints, &mut poses);
        }
        let allowed = self.keys_of(allowed);
        let mut scratch = std::mem::take(&mut self.scratch_again);
        let question = self.question(&allowed, Wanted::Whether);
        let around = &self.surroundings;
        let found = around.near_again(looked, &poses, question, margin, &mut scratch);
        (self.poses_again, self.scratch_again) = (poses, scratch);
        if found.is_none() {
            self.scratch.last = None;
        }
        found
    }

    /// A pair that is closer than `margin` (m) and not allowed, the first one found in a
    /// fixed order; `None` if there is none.
    pub fn first_hit(
        &mut self,
        robot: &RobotConfiguration,
        allowed: &AllowedPairs,
        margin: f64,
    ) -> Option<CollisionHit> {
        self.with_poses(robot, |checker, poses| {
            checker.first(poses, allowed, Wanted::HowMuch, margin)
        })
    }

    /// As [`Self::first_hit`], without finding out how far the two overlap, nor where, which takes most of the time:
    /// both are meaningless.
    pub(crate) fn first_touch(
        &mut self,
        robot: &RobotConfiguration,
        allowed: &AllowedPairs,
        margin: f64,
    ) -> Option<CollisionHit> {
        // In the fixed order, not the last one first.
        self.scratch.last = None;
        self.with_poses(robot, |checker, poses| {
            checker.first(poses, allowed, Wanted::Whether, margin)
        })
    }

    /// As [`Self::first_hit`], for the poses of all links as forward kinematics gives them, without
    /// the pairs of the robot's own links and of what it holds: for a robot that moves as a whole,
    /// within which no distance changes.
    pub(crate) fn first_hit_around(
        &mut self,
        link_poses: &[Pose],
        allowed: &AllowedPairs,
        margin: f64,
    ) -> Option<CollisionHit> {
        self.last = None;
        self.first(link_poses, allowed, Wanted::HowMuchToOthers, margin)
    }

    /// What is closer than `margin` (m) and not allowed, and no part of the robot nor held by it, any one, with the links
    /// at poses in the frame of the base and the base at a pose in the map frame: for a robot that moves as a whole.
    /// `in_map` is for the poses of the links in the map frame.
    pub(crate) fn any_body_around(
        &mut self,
        (base, in_base): (&Pose, &[Pose]),
        in_map: &mut Vec<Pose>,
        allowed: &AllowedPairs,
        margin: f64,
    ) -> Option<BodyName> {
        self.last = None;
        let mut found = self.last_around((base, in_base), in_map, allowed, margin);
        if found.is_none() {
            in_map.clear();
            in_map.extend(in_base.iter().map(|pose| base * pose));
            self.search(
                in_map,
                allowed,
                Wanted::WhetherToOthers,
                margin,
                |near, _| {
                    found = Some(near);
                    ControlFlow::Break(())
                },
            );
        }
        found.and_then(|near| self.name_of(near.other))
    }

    /// The pair that was found last, if it is still near, as [`Self::any_body_around`] has it; otherwise it is forgotten.
    fn last_around(
        &mut self,
        (base, in_base): (&Pose, &[Pose]),
        in_map: &mut Vec<Pose>,
        allowed: &AllowedPairs,
        margin: f64,
    ) -> Option<Near> {
        let looked = self.scratch.last?;
        in_map.resize(in_base.len(), Pose::identity());
        for link in self.scratch.last_links() {
            let (Some(at), Some(pose)) = (in_map.get_mut(link.index()), in_base.get(link.index()))
            else {
                return None;
            };
            *at = base * pose;
        }
        let allowed = self.keys_of(allowed);
        let mut scratch = std::mem::take(&mut self.scratch_again);
        let question = self.question(&allowed, Wanted::WhetherToOthers);
        let around = &self.surroundings;
        let found = around.near_again(looked, in_map, question, margin, &mut scratch);
        self.scratch_again = scratch;
        if found.is_none() {
            self.scratch.last = None;
        }
        found
    }

    /// Whether one of some links is closer than `margin` (m), which is positive, to what is no part of the robot and
    /// not allowed.
    pub(crate) fn links_touch(
        &mut self,
        robot: &RobotConfiguration,
        links: &SomeLinks,
        allowed: &AllowedPairs,
        margin: f64,
    ) -> bool {
        self.links = Some(Rc::clone(&links.keys));
        let is_free = self.is_free(robot, allowed, margin);
        self.links = None;
        !is_free
    }

    /// As [`Self::any_near`], of some links with what is no part of the robot, at poses in the map frame; those of other
    /// links do not matter.
    pub(super) fn any_near_at(
        &mut self,
        link_poses: &[Pose],
        links: &SomeLinks,
        allowed: &AllowedPairs,
        margin: f64,
    ) -> Option<Near> {
        self.last = None;
        self.moved.clone_from(&links.are_some);
        self.is_update = true;
        self.links = Some(Rc::clone(&links.keys));
        let mut found = None;
        self.search(link_poses, allowed, Wanted::Whether, margin, |near, _| {
            found = Some(near);
            ControlFlow::Break(())
        });
        self.links = None;
        found
    }

    fn first(
        &mut self,
        link_poses: &[Pose],
        allowed: &AllowedPairs,
        wanted: Wanted,
        margin: f64,
    ) -> Option<CollisionHit> {
        let mut found = None;
        self.search(link_poses, allowed, wanted, margin, |near, _| {
            found = Some(near);
            ControlFlow::Break(())
        });
        found.and_then(|near| self.report(&near))
    }

    /// Every pair of bodies that is closer than `margin` (m) and not allowed, the deepest first.
    pub fn all_hits(
        &mut self,
        robot: &RobotConfiguration,
        allowed: &AllowedPairs,
        margin: f64,
    ) -> Vec<CollisionHit> {
        let mut found: Vec<Near> = Vec::new();
        self.with_poses(robot, |checker, poses| {
            checker.search(poses, allowed, Wanted::HowMuch, margin, |near, _| {
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

    /// As [`Self::all_hits`], of some pairs of bodies only.
    pub(crate) fn hits_among(
        &mut self,
        robot: &RobotConfiguration,
        pairs: &AllowedPairs,
        allowed: &AllowedPairs,
        margin: f64,
    ) -> Vec<CollisionHit> {
        self.only = Some(self.keys_of(pairs));
        let hits = self.all_hits(robot, allowed, margin);
        self.only = None;
        hits
    }

    /// The pair with the smallest gap among those closer than `reach` (m) and not allowed. Pairs
    /// of the robot's own links do not count: how close those are is a matter of posture.
    pub fn clearance(
        &mut self,
        robot: &RobotConfiguration,
        allowed: &AllowedPairs,
        reach: f64,
    ) -> Option<Clearance> {
        let mut found = None;
        self.with_poses(robot, |checker, poses| {
            checker.search(
                poses,
                allowed,
                Wanted::HowMuchToOthers,
                reach,
                |near, margin| {
                    // From here on, only closer pairs matter.
                    *margin = near.separation.distance;
                    found = Some(near);
                    ControlFlow::Continue(())
                },
            );
        });
        let nearest = self.report(&found?)?;
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
        let tree = &self.surroundings.models.robot;
        match &mut self.last {
            Some(last) if last.base == robot.base => {
                let (before, now) = (&last.joints, &robot.joints);
                tree.update_forward_kinematics(before, now, &mut poses, &mut self.moved);
                last.joints.clone_from(&robot.joints);
                self.is_update = true;
            }
            last => {
                tree.forward_kinematics(&robot.base, &robot.joints, &mut poses);
                *last = Some(robot.clone());
            }
        }
        let result = query(self, &poses);
        self.poses = poses;
        result
    }

    fn search(
        &mut self,
        link_poses: &[Pose],
        allowed: &AllowedPairs,
        wanted: Wanted,
        margin: f64,
        visit: impl FnMut(Near, &mut f64) -> ControlFlow<()>,
    ) {
        let allowed = self.keys_of(allowed);
        let is_update = std::mem::take(&mut self.is_update);
        let mut scratch = std::mem::take(&mut self.scratch);
        let question = self.question(&allowed, wanted);
        let moved = is_update.then_some(self.moved.as_slice());
        self.surroundings
            .search(link_poses, moved, question, margin, &mut scratch, visit);
        self.scratch = scratch;
    }

    fn question<'q>(&'q self, allowed: &'q [(PartKey, PartKey)], wanted: Wanted) -> Question<'q> {
        Question {
            allowed,
            only: self.only.as_deref(),
            links: self.links.as_deref(),
            moving: self.moving.as_ref(),
            pairs: self.pairs,
            self_pairs: match (self.pairs, &self.changing) {
                (Pairs::Changing, Some(changing)) => changing,
                _ => &self.surroundings.models.self_pairs,
            },
            wanted,
        }
    }

    /// The keys of the pairs.
    fn keys_of(&mut self, pairs: &AllowedPairs) -> Keys {
        let known = self.known.iter().find(|(list, _)| list.is_same(pairs));
        if let Some((_, keys)) = known {
            return keys.clone();
        }
        let keys = pairs.iter();
        let keys = keys.filter_map(|(a, b)| Some(in_order(self.key_of(a)?, self.key_of(b)?)));
        let mut keys: Vec<_> = keys.collect();
        keys.sort_unstable();
        let keys = Keys::from(keys);
        self.known.truncate(MAX_KNOWN - 1);
        self.known.insert(0, (pairs.clone(), keys.clone()));
        keys
    }

    fn key_of(&self, name: &BodyName) -> Option<PartKey> {
        Some(match name {
            BodyName::Floor => PartKey::Floor,
            BodyName::Robot(link) => PartKey::Robot(index(link.id)),
            BodyName::Furniture(link) => PartKey::Furniture(index(link.id)),
            BodyName::Object(name) => {
                let lying = self.surroundings.objects.iter().map(|o| (o.name, o.key));
                let held = self.surroundings.held.iter().map(|o| (o.name, o.key));
                lying.chain(held).find(|(n, _)| n == name)?.1
            }
        })
    }

    fn name_of(&self, key: PartKey) -> Option<BodyName> {
        Some(match key {
            PartKey::Floor => BodyName::Floor,
            PartKey::Grain => return None,
            PartKey::Robot(i) => {
                BodyName::Robot(self.surroundings.models.robot_geometry.name(i)?.clone())
            }
            PartKey::Furniture(i) => {
                BodyName::Furniture(self.surroundings.models.kitchen_geometry.name(i)?.clone())
            }
            PartKey::Object(_) => {
                let lying = self.surroundings.objects.iter().map(|o| (o.name, o.key));
                let held = self.surroundings.held.iter().map(|o| (o.name, o.key));
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

#[cfg(test)]
mod tests;
