//! Choosing an arm and a grasp for an object, from where the robot stands or would stand.
//!
//! Candidates are all grasps of the object's type with all arms that may be used; an object
//! that is round can be grasped from any angle. They are tried in order of how near the wrist is
//! to its shoulder, which prefers the arm on the object's side and the side of the object that
//! faces the robot.
//!
//! A [`GraspChooser`] is made once for an object, and asked for any number of base poses. Cheap
//! tests come first, and what keeps the hand itself from a grasp is found out once, since it does
//! not depend on where the base is. Whether a path leads to the grasp is not checked.

use super::aligned_bases::AlignedBases;
use super::grasp_candidates::{
    Candidate, Candidates, GraspChoice, GraspQuestion, SAME, about_z, bar_too_heavy,
};
use super::grasp_reach::{Effort, GraspReach, GraspReachFrom, Station};
use super::lone_hand::{LoneHand, Looked};
use super::overhead::{Overhead, lifting};
use super::shoulder::Shoulder;
use crate::motion::contact::holding::held_objects;
use crate::motion::failure::grasp_obstacle::{GraspObstacle, GraspPart};
use crate::motion::failure::no_grasp::{NoGrasp, TriedGrasp};
use crate::robot::Side;
use crate::world::grasp_library::ToolPoses;
use crate::world::{BodyName, World};
use spatial::Pose;

/// How much nearer (m) a wrist must be for a grasp to come before another one that is earlier in
/// its type's list.
const ORDER: f64 = 0.01;

/// What keeps all grasps of an object from working with the base at a pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoGraspHere {
    /// All of them are too far away, or at an impossible angle.
    OutOfReach,
    /// The hand itself would be in the object by every grasp that is near enough.
    NoFit,
    /// Something is in the way.
    InTheWay,
}

/// A search in vain: what kept each candidate that was tried from working, by its index, and the nearest one that is out
/// of reach.
struct Vain {
    tried: Vec<(usize, Met)>,
    missed: Option<(Side, Pose)>,
}

/// What keeps a candidate from working.
enum Met {
    /// What is known to, without any test.
    Known,
    /// What has been met now.
    Now(GraspObstacle),
}

/// Tells how an object could be grasped from base poses.
pub struct GraspChooser<'w> {
    world: &'w World,
    question: &'w GraspQuestion,
    reach: GraspReach<'w>,
    candidates: &'w Candidates,
    shoulders: [Shoulder; 2],
    /// What each hand holds.
    held: [Option<String>; 2],
    /// How far (m) from the object a wrist is at most when it grasps it.
    span: f64,
    /// What is above the object.
    overhead: Option<Overhead<'w>>,
}

impl<'w> GraspChooser<'w> {
    /// For an object that stands in the world, by some of the candidates.
    pub fn new(world: &'w World, question: &'w GraspQuestion, candidates: &'w Candidates) -> Self {
        let description = &world.models().description;
        let held = |side| {
            let mut held = held_objects(world, side).into_iter();
            held.find(|name| *name != question.object)
        };
        let identity = Pose::identity();
        let spans = candidates.all.iter().filter_map(|candidate| {
            let arm = description.arm(candidate.side);
            let poses = candidate.definition.tool_poses(&identity, &arm.tool_axes);
            let wrist = arm.wrist_for_tool(&poses.ok()?.grasp);
            Some(wrist.translation.vector.norm())
        });
        bar_too_heavy(world, question, candidates);
        Self {
            world,
            question,
            reach: GraspReach::new(world, Some(&question.object), question.torso_moves),
            candidates,
            shoulders: Side::BOTH.map(|side| Shoulder::of(world, side, question.torso_moves)),
            held: Side::BOTH.map(held),
            span: spans.fold(0.0, f64::max),
            overhead: Overhead::of(world, &question.object, &question.in_map).ok(),
        }
    }

    /// Whether the object is too heavy for every grasp, wherever the base is.
    pub(crate) fn is_too_heavy(&self) -> bool {
        let barred = self.candidates.barred.borrow();
        let is_heavy =
            |one: &Option<GraspObstacle>| matches!(one, Some(GraspObstacle::TooHeavy { .. }));
        !barred.is_empty() && barred.iter().all(is_heavy)
    }

    /// Whether every candidate is ruled out wherever the base is, as far as that is known.
    pub(crate) fn is_barred_everywhere(&self) -> bool {
        let count = self.candidates.all.len();
        count > 0 && (0..count).all(|index| self.is_ruled_out(index))
    }

    /// Number of postures that have been checked for collisions.
    pub(crate) fn postures(&self) -> u32 {
        self.reach.postures()
    }

    /// Whether the object may be near enough to the base at a pose in the map frame. Cheap.
    pub fn is_near(&self, base: &Pose) -> bool {
        let object = base.inverse_transform_point(&self.question.in_map.translation.vector.into());
        let mut arms = self.question.arms.iter();
        arms.any(|side| self.shoulders[side.index()].reaches(&object.coords, self.span))
    }

    /// The base poses near one (map frame) from which grasps may work: that one, unless the arms have
    /// to be turned towards what they grasp.
    pub fn bases_near(&self, base: &Pose) -> Vec<Pose> {
        let mut aligned = AlignedBases::new(self.world, base);
        for (index, candidate) in self.candidates.all.iter().enumerate() {
            if self.is_ruled_out(index) {
                continue;
            }
            let arm = self.world.models().description.arm(candidate.side);
            let turned = self.question.in_map * about_z(candidate.turn);
            if let Ok(poses) = candidate.definition.tool_poses(&turned, &arm.tool_axes) {
                aligned.add(candidate.side, &poses.grasp);
            }
        }
        aligned.bases()
    }

    /// The nearest grasp that works with the base at a pose in the map frame, or what keeps all of them from working.
    /// Whether the robot can stand there, and whether a path leads to the grasp, is not checked.
    pub fn with_base_at(&self, base: &Pose, effort: Effort) -> Result<GraspChoice, NoGraspHere> {
        let from = self.reach.glancing_from(base, effort);
        self.search(from, base, |_| Ok(()))
            .map_err(|vain| self.what_keeps(&vain))
    }

    /// As [`Self::with_base_at`], for a grasp that passes another test, too; or everything that was tried.
    pub fn choose(
        &self,
        base: &Pose,
        effort: Effort,
        accept: impl FnMut(&GraspChoice) -> Result<(), GraspObstacle>,
    ) -> Result<GraspChoice, Box<NoGrasp>> {
        let from = self.reach.with_base_at(base, effort);
        self.search(from, base, accept).map_err(|vain| {
            let missed = vain.missed.filter(|_| effort == Effort::THOROUGH);
            let tried = vain.tried.into_iter().filter_map(|(index, met)| {
                let obstacle = match met {
                    Met::Known => self.known_obstacle(index)?,
                    Met::Now(obstacle) => obstacle,
                };
                Some(self.candidates.all[index].tried(obstacle))
            });
            self.no_grasp(tried.collect(), missed)
        })
    }

    /// What keeps all grasps that were tried from working.
    fn what_keeps(&self, vain: &Vain) -> NoGraspHere {
        let (mut is_near, mut fits) = (false, false);
        for (index, met) in &vain.tried {
            let barred = self.candidates.barred.borrow();
            let candidate = &self.candidates.all[*index];
            let obstacle = match met {
                Met::Now(obstacle) => Some(obstacle),
                // They are no obstacles of its own.
                Met::Known if self.is_full_or_failed(candidate) => None,
                Met::Known => barred[*index].as_ref(),
            };
            match obstacle {
                Some(GraspObstacle::OutOfReach { .. }) => {}
                Some(GraspObstacle::NoFit { .. }) => is_near = true,
                _ => (is_near, fits) = (true, true),
            }
        }
        match (is_near, fits) {
            (false, _) => NoGraspHere::OutOfReach,
            (true, false) => NoGraspHere::NoFit,
            (true, true) => NoGraspHere::InTheWay,
        }
    }

    fn search(
        &self,
        mut from: GraspReachFrom<'_>,
        base: &Pose,
        mut accept: impl FnMut(&GraspChoice) -> Result<(), GraspObstacle>,
    ) -> Result<GraspChoice, Vain> {
        let object = base.inverse() * self.question.in_map;
        let (mut tried, mut free) = (Vec::new(), Vec::new());
        let mut missed: Option<(f64, Side, Pose)> = None;
        for (index, candidate) in self.candidates.all.iter().enumerate() {
            if self.is_ruled_out(index) {
                tried.push((index, Met::Known));
                continue;
            }
            let Some(poses) = self.poses(candidate, base, &object) else {
                continue;
            };
            let shoulder = &self.shoulders[candidate.side.index()];
            let arm = self.world.models().description.arm(candidate.side);
            let wrist = arm.wrist_for_tool(&poses.grasp).translation.vector;
            let cost = (wrist - shoulder.at.coords).norm() + ORDER * candidate.place as f64;
            if shoulder.reaches(&wrist, 0.0) {
                free.push((cost, index, poses));
                continue;
            }
            if missed.as_ref().is_none_or(|(least, ..)| cost < *least) {
                missed = Some((cost, candidate.side, poses.grasp));
            }
            let part = GraspPart::Grasp;
            tried.push((index, Met::Now(GraspObstacle::OutOfReach { part })));
        }
        free.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut missed = missed.map(|(_, side, pose)| (side, pose));
        // A hand that cannot come to its first pose has a longer way around the object.
        let (mut later, mut met, mut is_nearest) = (Vec::new(), Vec::new(), true);
        let mut check = |from: &mut GraspReachFrom<'_>, (cost, index, poses): Free| {
            let candidate = &self.candidates.all[index];
            let checked = from.check(candidate.side, candidate.opening, &needed(&poses));
            let checked = checked.map_err(|obstacle| self.bar(index, obstacle));
            let checked = checked.and_then(|torso| {
                let choice = candidate.chosen(poses, torso, cost);
                accept(&choice).map(|()| choice)
            });
            checked.map_err(|obstacle| (index, Met::Now(obstacle)))
        };
        for (cost, index, poses) in free {
            let candidate = &self.candidates.all[index];
            let side = candidate.side;
            match from.height(side, &needed(&poses)) {
                Ok(height) if !from.reaches(side, &poses.pregrasp, height) => {
                    later.push((cost, index, poses));
                }
                Ok(_) => match check(&mut from, (cost, index, poses)) {
                    Ok(choice) => return Ok(choice),
                    Err(failed) => met.push(failed),
                },
                Err(obstacle) => {
                    if std::mem::take(&mut is_nearest) {
                        missed = Some((side, poses.grasp));
                    }
                    tried.push((index, Met::Now(obstacle)));
                }
            }
        }
        for found in later {
            match check(&mut from, found) {
                Ok(choice) => return Ok(choice),
                Err(failed) => met.push(failed),
            }
        }
        met.append(&mut tried);
        self.bar_without_room();
        Err(Vain { tried: met, missed })
    }

    /// Whether [`Self::known_obstacle`] finds anything.
    fn is_ruled_out(&self, index: usize) -> bool {
        self.is_full_or_failed(&self.candidates.all[index])
            || self.candidates.barred.borrow()[index].is_some()
    }

    /// Whether the hand holds something else, or has tried the grasp already.
    fn is_full_or_failed(&self, candidate: &Candidate) -> bool {
        self.held[candidate.side.index()].is_some() || candidate.has_failed
    }

    /// What rules a candidate out without any test.
    fn known_obstacle(&self, index: usize) -> Option<GraspObstacle> {
        let candidate = &self.candidates.all[index];
        if let Some(held) = &self.held[candidate.side.index()] {
            let held = held.clone();
            return Some(GraspObstacle::HandFull { held });
        }
        if candidate.has_failed {
            return Some(GraspObstacle::HasFailed);
        }
        self.candidates.barred.borrow()[index].clone()
    }

    /// After a base pose in vain, rules the candidates out for which the hand, or the forearm, has no room
    /// where the hand approaches or grasps.
    fn bar_without_room(&self) {
        if let Some(next) = self.candidates.looked.get().next(self.postures()) {
            self.bar_where(next);
        }
    }

    /// The hands and grasps, each with one angle by which it may be turned, for which the hand has room at the
    /// object, wherever the base is.
    pub fn with_room(&self) -> Vec<(Side, String, f64)> {
        if self.candidates.looked.get() < Looked::Hand {
            self.bar_where(Looked::Hand);
        }
        let mut found: Vec<(Side, String, f64)> = Vec::new();
        for (index, candidate) in self.candidates.all.iter().enumerate() {
            let is_new = || {
                !found
                    .iter()
                    .any(|(side, grasp, _)| *side == candidate.side && *grasp == candidate.grasp)
            };
            if !self.is_ruled_out(index) && is_new() {
                found.push((candidate.side, candidate.grasp.clone(), candidate.turn));
            }
        }
        found
    }

    /// Rules the candidates out that have no room where it is looked for.
    fn bar_where(&self, next: Looked) {
        self.candidates.looked.set(next);
        let mut hands: Vec<(Side, f64, LoneHand<'_>)> = Vec::new();
        for (index, candidate) in self.candidates.all.iter().enumerate() {
            let (side, opening) = (candidate.side, candidate.opening);
            if self.is_ruled_out(index) {
                continue;
            }
            // With the base at the origin, the poses of the tool are those in the map.
            let poses = self.poses(candidate, &Pose::identity(), &self.question.in_map);
            let Some(poses) = poses else { continue };
            let known = hands
                .iter()
                .position(|(s, o, _)| *s == side && *o == opening);
            let place = match known {
                Some(place) => place,
                None => {
                    let object = Some(self.question.object.as_str());
                    let Some(hand) = LoneHand::new(self.world, side, opening, object) else {
                        continue;
                    };
                    hands.push((side, opening, hand));
                    hands.len() - 1
                }
            };
            let mut stations = needed(&poses);
            stations.retain(|station| station.part != GraspPart::Lift);
            if let Some(obstacle) = hands[place].2.obstacle(&stations, next) {
                self.candidates.barred.borrow_mut()[index] = Some(obstacle);
            }
        }
    }

    /// Keeps what is in the way of a candidate, if it is in its way wherever the base is: what
    /// stands around the object does not move with the base.
    fn bar(&self, index: usize, obstacle: GraspObstacle) -> GraspObstacle {
        let is_lasting = match &obstacle {
            GraspObstacle::NoFit { .. } => true,
            GraspObstacle::Collision { part, hit } => {
                let hand = self.reach.hand_links(self.candidates.all[index].side);
                let stands = match &hit.other {
                    BodyName::Robot(_) => false,
                    BodyName::Object(name) => self
                        .world
                        .object(name)
                        .is_ok_and(|object| object.attachment().is_none()),
                    BodyName::Furniture(_) | BodyName::Floor => true,
                };
                // The lift is along the axes of the base.
                *part != GraspPart::Lift && stands && hand.contains(&hit.moving)
            }
            _ => false,
        };
        if is_lasting {
            self.candidates.barred.borrow_mut()[index] = Some(obstacle.clone());
        }
        obstacle
    }

    fn poses(&self, candidate: &Candidate, base: &Pose, object: &Pose) -> Option<ToolPoses> {
        let arm = self.world.models().description.arm(candidate.side);
        let turned = object * about_z(candidate.turn);
        let poses = candidate.definition.tool_poses(&turned, &arm.tool_axes);
        let poses = lifting(poses.ok()?);
        Some(match &self.overhead {
            Some(overhead) => overhead.picking(base, poses),
            None => poses,
        })
    }

    fn no_grasp(&self, tried: Vec<TriedGrasp>, missed: Option<(Side, Pose)>) -> Box<NoGrasp> {
        let models = self.world.models();
        let joints = &self.world.robot_configuration().joints;
        let out_of_reach = tried
            .iter()
            .all(|t| matches!(t.obstacle, GraspObstacle::OutOfReach { .. }));
        let missing = missed.filter(|_| out_of_reach).and_then(|(side, tool)| {
            let arm = models.description.arm(side);
            let search = models.description.torso_search(&models.robot, joints, side);
            let wrist = search.in_arm_base(
                &arm.wrist_for_tool(&tool),
                models.description.torso.height(joints),
            );
            let seed = arm.positions(joints);
            arm.kinematics.nearest(&wrist, &seed).err()
        });
        let gripper = &models.description.arm(Side::Right).gripper;
        let size = self.world.object(&self.question.object);
        Box::new(NoGrasp {
            object: self.question.object.clone(),
            kind: self.question.kind.clone(),
            size: size.map_or([0.0; 3], |object| object.size()),
            widest: gripper.gap(gripper.limits.upper),
            tried,
            missing,
            refusal: self.candidates.refusal.clone(),
        })
    }
}

/// A candidate that is not ruled out: its cost, its index, and the poses of the tool.
type Free = (f64, usize, ToolPoses);

/// The poses that the hand has to take. A second lift straight above the first may be left out.
pub fn needed(poses: &ToolPoses) -> Vec<Station> {
    let aside = poses.second_lift.translation.vector - poses.lift.translation.vector;
    let out = (aside.xy().norm() > SAME.0).then_some((GraspPart::Lift, poses.second_lift));
    [
        (GraspPart::Approach, poses.second_pregrasp),
        (GraspPart::Grasp, poses.grasp),
        (GraspPart::Lift, poses.lift),
    ]
    .into_iter()
    .chain(out)
    .map(|(part, tool)| Station { part, tool })
    .collect()
}
