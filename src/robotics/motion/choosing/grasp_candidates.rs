//! The ways to take an object: all grasps of its type with all arms that may be used, from all angles if it is round.

use std::cell::{Cell, RefCell};
use std::f64::consts::TAU;

use nalgebra::{UnitQuaternion, Vector3};

use super::lone_hand::Looked;
use crate::motion::contact::grip_torque::{ExcessTorque, Pads};
use crate::motion::failure::grasp_obstacle::GraspObstacle;
use crate::motion::failure::no_grasp::TriedGrasp;
use crate::robot::Side;
use crate::world::grasp_library::{GraspDefinition, GraspLibrary, ToolPoses};
use crate::world::physics::GRAVITY;
use crate::world::{Models, World};
use spatial::{Pose, pose};

/// Number of angles from which a round object can be grasped.
pub(super) const TURNS: i32 = 24;
/// Poses this close together (m, rad) are the same grasp.
pub(super) const SAME: (f64, f64) = (1e-3, 1e-2);
/// What is to be grasped, and how.
#[derive(Clone, Debug)]
pub struct GraspQuestion {
    /// Name of the object in the world.
    pub object: String,
    /// Name of its type.
    pub kind: String,
    /// Pose of the object in the map frame.
    pub in_map: Pose,
    /// The arms that may be used, in order of preference among equals.
    pub arms: Vec<Side>,
    /// Names of the grasps that may be used, exactly as they are defined; if there are none, all
    /// grasps of the type from all angles.
    pub grasps: Vec<String>,
    /// Whether the torso may move, as it does for the motions of the hands.
    pub torso_moves: bool,
    /// Arms, grasps and turns (rad) that have failed already.
    pub failed: Vec<(Side, String, f64)>,
}

/// A grasp that works.
#[derive(Clone, Debug)]
pub struct GraspChoice {
    /// The hand.
    pub side: Side,
    /// Name of the grasp.
    pub grasp: String,
    /// The angle (rad) by which it is turned about the z axis of a round object.
    pub turn: f64,
    /// The poses of the tool in the frame of the base.
    pub poses: ToolPoses,
    /// How wide (m) the hand opens before.
    pub opening: f64,
    /// Height (m) of the torso.
    pub torso: f64,
    /// Distance (m) of the wrist from the shoulder, mostly: less is better.
    pub cost: f64,
}

/// One way to take the object.
pub(super) struct Candidate {
    pub(super) side: Side,
    pub(super) grasp: String,
    pub(super) turn: f64,
    pub(super) definition: GraspDefinition,
    /// How wide (m) the hand opens for it.
    pub(super) opening: f64,
    /// The force (N) with which each finger presses.
    pub(super) press: f64,
    /// Place in the list of grasps.
    pub(super) place: usize,
    pub(super) has_failed: bool,
}

impl Candidate {
    pub(super) fn chosen(&self, poses: ToolPoses, torso: f64, cost: f64) -> GraspChoice {
        GraspChoice {
            side: self.side,
            grasp: self.grasp.clone(),
            turn: self.turn,
            poses,
            opening: self.opening,
            torso,
            cost,
        }
    }

    pub(super) fn tried(&self, obstacle: GraspObstacle) -> TriedGrasp {
        TriedGrasp {
            side: self.side,
            grasp: self.grasp.clone(),
            turn: self.turn,
            obstacle,
        }
    }
}

/// All ways to take an object in one state of the world.
pub struct Candidates {
    pub(super) all: Vec<Candidate>,
    /// Why no hand can grasp the object, if that is known of its type.
    pub(super) refusal: Option<String>,
    /// What keeps the hand from each of them wherever the base is, as far as it is known.
    pub(super) barred: RefCell<Vec<Option<GraspObstacle>>>,
    /// What has been looked at of the room for hands.
    pub(super) looked: Cell<Looked>,
}

impl Candidates {
    /// Those that a question permits.
    pub fn new(models: &Models, grasps: &GraspLibrary, question: &GraspQuestion) -> Self {
        let all = candidates(models, grasps, question);
        let barred = RefCell::new(vec![None; all.len()]);
        let refusal = grasps.refusal(&question.kind).map(str::to_owned);
        Self {
            all,
            refusal,
            barred,
            looked: Cell::default(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }
}

/// Rules the candidates out whose fingers would not transmit the torque of the object's weight as it
/// stands.
pub(super) fn bar_too_heavy(world: &World, question: &GraspQuestion, candidates: &Candidates) {
    let Ok(object) = world.object(&question.object) else {
        return;
    };
    let mut barred = candidates.barred.borrow_mut();
    for (candidate, barred) in candidates.all.iter().zip(barred.iter_mut()) {
        let arm = world.models().description.arm(candidate.side);
        let turned = question.in_map * about_z(candidate.turn);
        let Ok(poses) = candidate.definition.tool_poses(&turned, &arm.tool_axes) else {
            continue;
        };
        let pads = Pads::closing(
            &arm.gripper,
            object,
            &question.in_map,
            &poses.grasp,
            candidate.opening,
            candidate.press.min(arm.gripper.effort),
        );
        let weight = object.mass() * GRAVITY;
        let at = object.balance_at(&question.in_map);
        if let Some(excess) = pads.and_then(|pads| pads.excess(weight, &at)) {
            let ExcessTorque { torque, limit } = excess;
            *barred = Some(GraspObstacle::TooHeavy { torque, limit });
        }
    }
}

/// A turn (rad) about the vertical axis.
pub fn about_z(turn: f64) -> UnitQuaternion<f64> {
    pose::from_xy_yaw(0.0, 0.0, turn).rotation
}

/// All ways to take the object, those with the least turn first.
fn candidates(models: &Models, grasps: &GraspLibrary, question: &GraspQuestion) -> Vec<Candidate> {
    let kind = models.objects.get(&question.kind);
    let turns = kind.is_some_and(|kind| kind.is_round) && question.grasps.is_empty();
    let half = if turns { TURNS / 2 } else { 0 };
    let mut all: Vec<Candidate> = Vec::new();
    for side in &question.arms {
        let wanted = |name: &String| question.grasps.is_empty() || question.grasps.contains(name);
        // A type without grasps of its own has those of its supertype, unless its shape rules them out.
        let kinds = models.objects.lineage(&question.kind);
        let kinds = kinds.take_while(|kind| grasps.refusal(kind).is_none());
        let mut kinds = kinds.map(|kind| {
            let listed = grasps.grasps(kind);
            // What is not listed has to be asked for.
            let others = question.grasps.iter().filter(|n| !listed.contains(n));
            let names = listed.iter().chain(others);
            let known = names.filter_map(|name| Some((name, grasps.get(kind, *side, name)?)));
            known.collect::<Vec<_>>()
        });
        let mut definitions = kinds.find(|known| !known.is_empty()).unwrap_or_default();
        definitions.retain(|(name, _)| wanted(name));
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
                    definition: (*definition).clone(),
                    opening: grasps.opening(&question.kind, definition),
                    press: grasps.grip(&question.kind).effort,
                    place,
                });
            }
        }
    }
    all
}
