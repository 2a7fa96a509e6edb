//! Choosing an arm and a grasp for an object, from where the robot stands or would stand.
//!
//! Candidates are all grasps of the object's type with all arms that may be used; an object
//! that is round can be grasped from any angle. They are tried in order of how near the wrist is
//! to its shoulder, which prefers the arm on the object's side and the side of the object that
//! faces the robot.
//!
//! A [`GraspChooser`] is made once for an object, and asked for any number of base poses. Cheap
//! tests come first. Whether a path leads to the grasp is checked only when the robot is about
//! to go there ([`Simulation::choose_grasp`]).

use std::f64::consts::TAU;

use nalgebra::{Point3, UnitQuaternion, Vector3};

use super::Simulation;
use super::imagined::Imagined;
use crate::motion::{
    Effort, GraspObstacle, GraspPart, GraspReach, MotionFailure, NoGrasp, Station, TriedGrasp,
    plan_grasp,
};
use crate::robot::Side;
use crate::spatial::{Pose, pose};
use crate::world::grasp_library::{GraspDefinition, ToolPoses};
use crate::world::{World, WorldError};

/// Number of angles from which a round object can be grasped.
const TURNS: i32 = 24;
/// Poses this close together (m, rad) are the same grasp.
const SAME: (f64, f64) = (1e-3, 1e-2);
/// How much nearer (m) a wrist must be for a grasp to come before another one that is earlier in
/// its type's list.
const ORDER: f64 = 0.01;
/// Maximum number of grasps for which a path is searched.
const MOST_PATHS: usize = 6;

/// What is to be grasped, and how.
#[derive(Clone, Debug)]
pub(in crate::session) struct GraspQuestion {
    /// Name of the object in the world.
    pub(crate) object: String,
    /// Name of its type.
    pub(crate) kind: String,
    /// Pose of the object in the map frame.
    pub(crate) in_map: Pose,
    /// The arms that may be used, in order of preference among equals.
    pub(crate) arms: Vec<Side>,
    /// Names of the grasps that may be used, exactly as they are defined; if there are none, all
    /// grasps of the type from all angles.
    pub(crate) grasps: Vec<String>,
    /// Whether the torso may move, as it does for the motions of the hands.
    pub(crate) torso_moves: bool,
    /// Where the object is to be put down with the same grasp, if that is known.
    pub(crate) target: Option<PlacingTarget>,
    /// Arms, grasps and turns (rad) that have failed already.
    pub(crate) failed: Vec<(Side, String, f64)>,
}

/// Where an object is to be put down.
#[derive(Clone, Debug)]
pub(in crate::session) struct PlacingTarget {
    /// Pose of the object in the map frame.
    pub(crate) pose: Pose,
    /// The base pose in the map frame; if there is none, any around the target will do.
    pub(crate) base: Option<Pose>,
}

/// A grasp that works.
#[derive(Clone, Debug)]
pub(in crate::session) struct GraspChoice {
    /// The hand.
    pub(crate) side: Side,
    /// Name of the grasp.
    pub(crate) grasp: String,
    /// The angle (rad) by which it is turned about the z axis of a round object.
    pub(crate) turn: f64,
    /// The poses of the tool in the frame of the base.
    pub(crate) poses: ToolPoses,
    /// Height (m) of the torso.
    pub(crate) torso: f64,
    /// Distance (m) of the wrist from the shoulder, mostly: less is better.
    pub(crate) cost: f64,
}

/// One way to take the object.
struct Candidate {
    side: Side,
    grasp: String,
    turn: f64,
    definition: GraspDefinition,
    /// Place in the list of grasps.
    place: usize,
    has_failed: bool,
}

/// Tells how an object could be grasped from base poses.
pub(in crate::session) struct GraspChooser<'w> {
    simulation: &'w Simulation,
    question: &'w GraspQuestion,
    reach: GraspReach<'w>,
    candidates: Vec<Candidate>,
    /// The shoulders in the frame of the base (m).
    shoulders: [Point3<f64>; 2],
    /// What each hand holds.
    held: [Option<String>; 2],
}

impl<'w> GraspChooser<'w> {
    /// For an object that stands in the world, which is the simulation's or a copy of it.
    pub(in crate::session) fn new(
        simulation: &'w Simulation,
        world: &'w World,
        question: &'w GraspQuestion,
    ) -> Self {
        let opening = simulation.grasps.grip(&question.kind).opening;
        let models = world.models();
        let robot = world.robot_configuration();
        let shoulders = Side::BOTH.map(|side| {
            let arm = models.description.arm(side);
            let base = models.description.base.frame;
            let torso = models.robot.relative_pose(base, arm.base, &robot.joints);
            let joint = models.robot.joint(arm.joints()[0]);
            (torso.unwrap_or_default() * joint.origin)
                .translation
                .vector
                .into()
        });
        Self {
            simulation,
            question,
            reach: GraspReach::new(world, &question.object, opening, question.torso_moves),
            candidates: candidates(simulation, question),
            shoulders,
            held: Side::BOTH.map(|side| {
                let held = simulation.held_by(side).into_iter();
                held.into_iter().find(|name| *name != question.object)
            }),
        }
    }

    /// The nearest grasp that works with the base at a pose in the map frame, or everything that
    /// was tried. Whether the robot can stand there, and whether a path leads to the grasp, is
    /// not checked.
    pub(in crate::session) fn with_base_at(
        &self,
        base: &Pose,
    ) -> Result<GraspChoice, Box<NoGrasp>> {
        self.choose(base, Effort::QUICK, |_| Ok(()))
    }

    /// As [`Self::with_base_at`], for a grasp that passes another test, too.
    fn choose(
        &self,
        base: &Pose,
        effort: Effort,
        mut accept: impl FnMut(&GraspChoice) -> Result<(), GraspObstacle>,
    ) -> Result<GraspChoice, Box<NoGrasp>> {
        let object = base.inverse() * self.question.in_map;
        let mut from = self.reach.with_base_at(base, effort);
        let mut tried = Vec::new();
        let mut free = Vec::new();
        for candidate in &self.candidates {
            let side = candidate.side;
            if let Some(held) = &self.held[side.index()] {
                let held = held.clone();
                tried.push(candidate.tried(GraspObstacle::HandFull { held }));
                continue;
            }
            if candidate.has_failed {
                tried.push(candidate.tried(GraspObstacle::HasFailed));
                continue;
            }
            let Some(poses) = self.poses(candidate, &object) else {
                continue;
            };
            let arm = self.simulation.models.description.arm(side);
            let wrist = arm.wrist_for_tool(&poses.grasp).translation.vector;
            let distance = (wrist - self.shoulders[side.index()].coords).norm();
            free.push((distance + ORDER * candidate.place as f64, candidate, poses));
        }
        free.sort_by(|a, b| a.0.total_cmp(&b.0));
        // A hand that cannot come to its first pose has a longer way around the object.
        let (mut later, mut met, mut missed) = (Vec::new(), Vec::new(), None);
        for (cost, candidate, poses) in free {
            let (side, stations) = (candidate.side, needed(&poses));
            match from.height(side, &stations) {
                Ok(height) if !from.reaches(side, &poses.pregrasp, height) => {
                    later.push((cost, candidate, poses));
                }
                Ok(_) => {
                    let checked = from.check(side, &stations).and_then(|torso| {
                        let choice = candidate.chosen(poses, torso, cost);
                        accept(&choice).map(|()| choice)
                    });
                    match checked {
                        Ok(choice) => return Ok(choice),
                        Err(obstacle) => met.push(candidate.tried(obstacle)),
                    }
                }
                Err(obstacle) => {
                    missed = missed.or(Some((side, poses.grasp)));
                    tried.push(candidate.tried(obstacle));
                }
            }
        }
        for (cost, candidate, poses) in later {
            let checked = from
                .check(candidate.side, &needed(&poses))
                .and_then(|torso| {
                    let choice = candidate.chosen(poses, torso, cost);
                    accept(&choice).map(|()| choice)
                });
            match checked {
                Ok(choice) => return Ok(choice),
                Err(obstacle) => met.push(candidate.tried(obstacle)),
            }
        }
        met.append(&mut tried);
        let missed = missed.filter(|_| effort == Effort::THOROUGH);
        Err(self.no_grasp(met, missed))
    }

    fn poses(&self, candidate: &Candidate, object: &Pose) -> Option<ToolPoses> {
        let arm = self.simulation.models.description.arm(candidate.side);
        let turned = object * about_z(candidate.turn);
        candidate
            .definition
            .tool_poses(&turned, &arm.tool_axes)
            .ok()
    }

    fn no_grasp(&self, tried: Vec<TriedGrasp>, missed: Option<(Side, Pose)>) -> Box<NoGrasp> {
        let models = &self.simulation.models;
        let joints = &self.simulation.world.robot_configuration().joints;
        let out_of_reach = tried
            .iter()
            .all(|t| matches!(t.obstacle, GraspObstacle::OutOfReach { .. }));
        let missing = missed.filter(|_| out_of_reach).and_then(|(side, tool)| {
            let arm = models.description.arm(side);
            let search = models.description.torso_search(&models.robot, joints, side);
            let wrist = search.in_arm_base(
                &arm.wrist_for_tool(&tool),
                joints.get(models.description.torso.joint),
            );
            let seed = arm.positions(joints);
            arm.kinematics.nearest(&wrist, &seed).err()
        });
        let gripper = &models.description.arm(Side::Right).gripper;
        let size = self.simulation.world.object(&self.question.object);
        Box::new(NoGrasp {
            object: self.question.object.clone(),
            kind: self.question.kind.clone(),
            size: size.map_or([0.0; 3], |object| object.size()),
            widest: gripper.gap(gripper.limits.upper),
            tried,
            missing,
        })
    }
}

impl Candidate {
    fn chosen(&self, poses: ToolPoses, torso: f64, cost: f64) -> GraspChoice {
        GraspChoice {
            side: self.side,
            grasp: self.grasp.clone(),
            turn: self.turn,
            poses,
            torso,
            cost,
        }
    }

    fn tried(&self, obstacle: GraspObstacle) -> TriedGrasp {
        TriedGrasp {
            side: self.side,
            grasp: self.grasp.clone(),
            turn: self.turn,
            obstacle,
        }
    }
}

/// The poses that the hand has to take.
fn needed(poses: &ToolPoses) -> [Station; 3] {
    [
        (GraspPart::Approach, poses.second_pregrasp),
        (GraspPart::Grasp, poses.grasp),
        (GraspPart::Lift, poses.lift),
    ]
    .map(|(part, tool)| Station { part, tool })
}

/// A turn (rad) about the vertical axis.
pub(in crate::session) fn about_z(turn: f64) -> UnitQuaternion<f64> {
    pose::from_xy_yaw(0.0, 0.0, turn).rotation
}

/// All ways to take the object, those with the least turn first.
fn candidates(simulation: &Simulation, question: &GraspQuestion) -> Vec<Candidate> {
    let kind = simulation.models.objects.get(&question.kind);
    let turns = kind.is_some_and(|kind| kind.is_round) && question.grasps.is_empty();
    let half = if turns { TURNS / 2 } else { 0 };
    let mut all: Vec<Candidate> = Vec::new();
    for side in &question.arms {
        let names = simulation.defined_grasps(&question.kind, *side);
        let wanted = |name: &&String| question.grasps.is_empty() || question.grasps.contains(name);
        let definitions: Vec<(&String, GraspDefinition)> = names
            .iter()
            .filter(wanted)
            .filter_map(|name| Some((name, simulation.definition(&question.kind, *side, name)?)))
            .collect();
        let mut poses: Vec<Pose> = Vec::new();
        let steps = (0..=half).flat_map(|i| {
            if i == 0 || i == half {
                vec![i]
            } else {
                vec![i, -i]
            }
        });
        for step in steps {
            let turn = TAU * f64::from(step) / f64::from(TURNS);
            for (place, (name, definition)) in definitions.iter().enumerate() {
                let Ok(orientation) = definition.orientation() else {
                    continue;
                };
                let at = about_z(turn)
                    * Pose::from_parts(Vector3::from(definition.translation).into(), orientation);
                let is_same = |other: &Pose| {
                    pose::distance_between(other, &at) < SAME.0
                        && pose::angle_between(other, &at) < SAME.1
                };
                if turns && poses.iter().any(is_same) {
                    continue;
                }
                poses.push(at);
                let failed = |(arm, grasp, angle): &(Side, String, f64)| {
                    arm == side && grasp == *name && (angle - turn).abs() < SAME.1
                };
                all.push(Candidate {
                    has_failed: question.failed.iter().any(failed),
                    side: *side,
                    grasp: (*name).clone(),
                    turn,
                    definition: definition.clone(),
                    place,
                });
            }
        }
    }
    all
}

impl Simulation {
    /// The nearest grasp by which an object can be picked up from where the robot stands, by a
    /// path that the arm finds from its present posture; and put down at the target, if there is
    /// one.
    pub(in crate::session) fn choose_grasp(
        &self,
        question: &GraspQuestion,
        base: Option<&Pose>,
    ) -> Result<GraspChoice, MotionFailure> {
        let opening = self.grasps.grip(&question.kind).opening;
        let chooser = GraspChooser::new(self, &self.world, question);
        let mut paths = 0;
        let here = self.base();
        let choice = chooser.choose(base.unwrap_or(&here), Effort::THOROUGH, |choice| {
            if let Some(target) = &question.target {
                self.check_target(question, target, choice)?;
            }
            if base.is_some() {
                return Ok(());
            }
            paths += 1;
            if paths > MOST_PATHS {
                let report = "too many others have none".to_owned();
                return Err(GraspObstacle::NoPath { report });
            }
            let stations = needed(&choice.poses);
            plan_grasp(
                &self.world,
                choice.side,
                &question.object,
                opening,
                &choice.poses.pregrasp,
                &stations,
            )
            .map_err(|failure| GraspObstacle::NoPath {
                report: failure.to_string().lines().collect::<Vec<_>>().join(" "),
            })
        });
        choice.map_err(MotionFailure::NoGrasp)
    }

    /// Whether the object can be put down at the target with the grasp, as it is or, if it is
    /// round, from another angle.
    fn check_target(
        &self,
        question: &GraspQuestion,
        target: &PlacingTarget,
        choice: &GraspChoice,
    ) -> Result<(), GraspObstacle> {
        let imagined = Imagined {
            object: &question.object,
            object_pose: Some(target.pose),
            base_pose: None,
            side: choice.side,
            opening: self.grasps.grip(&question.kind).opening,
        };
        let unknown = |error: WorldError| GraspObstacle::NoPath {
            report: error.to_string(),
        };
        let Some(world) = imagined.world(&self.world).map_err(unknown)? else {
            return Err(GraspObstacle::NotAtTarget {
                obstacle: Box::new(GraspObstacle::NoPath {
                    report: "something else is there".to_owned(),
                }),
            });
        };
        let stands = world.object_pose(&question.object).map_err(unknown)?;
        let is_round = self.models.objects.get(&question.kind);
        let at_target = GraspQuestion {
            in_map: stands,
            arms: vec![choice.side],
            grasps: vec![choice.grasp.clone()],
            target: None,
            failed: Vec::new(),
            ..question.clone()
        };
        let at_target = match is_round.is_some_and(|kind| kind.is_round) {
            true => GraspQuestion {
                grasps: Vec::new(),
                ..at_target
            },
            false => at_target,
        };
        let chooser = GraspChooser::new(self, &world, &at_target);
        let bases = match &target.base {
            Some(base) => vec![*base],
            None => self.places_around(&stands),
        };
        let mut obstacle = None;
        for base in bases {
            match chooser.with_base_at(&base) {
                Ok(_) => return Ok(()),
                Err(nothing) => {
                    let tried = nothing.tried.into_iter().map(|t| t.obstacle);
                    obstacle = obstacle.or(tried.into_iter().next());
                }
            }
        }
        let nowhere = GraspObstacle::OutOfReach {
            part: GraspPart::Grasp,
        };
        Err(GraspObstacle::NotAtTarget {
            obstacle: Box::new(obstacle.unwrap_or(nowhere)),
        })
    }
}
