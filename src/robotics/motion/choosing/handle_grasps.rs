//! The ways to take a handle or a knob.

use nalgebra::{Matrix3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

use super::hand_shape::HandShape;
use super::handle_chooser::HandleQuestion;
use crate::motion::planning::handle_approach::OPENING;
use crate::motion::planning::handle_way::{BarGrip, turn};
use crate::robot::{JointKind, LinkId};
use crate::world::{Knob, World};
use spatial::{Pose, trig};

/// Angles (rad) about the bar between the hand and the outward direction, and distances (m) of
/// the hand from the middle of the bar.
const TILTS: [f64; 5] = [0.0, 0.4, -0.4, 0.8, -0.8];
pub(super) const SHIFTS: [f64; 5] = [0.0, 0.12, -0.12, 0.24, -0.24];
/// Minimum distance (m) of the middle of the hand from the ends of a bar.
const END: f64 = 0.07;
/// How far (m) the tips of the fingers stay away from what a knob is fixed to.
const KNOB_CLEARANCE: f64 = 0.005;
/// In how many steps the fingers are turned all around a knob.
const KNOB_TURNS: u32 = 24;

/// A way to take the bar.
#[derive(Clone, Debug)]
pub(super) struct HandleGrasp {
    /// Its name.
    pub(super) name: &'static str,
    /// Where the hand is.
    pub(super) grip: BarGrip,
}

/// The ways to take the bar, the plainest first.
pub(super) fn handle_grasps(world: &World, question: &HandleQuestion) -> Vec<HandleGrasp> {
    let handle = question.handle;
    if let Some(knob) = world.models().knob(handle) {
        return grasps_of_knob(world, question, &knob);
    }
    let (bar, half) = world.bar(handle);
    let middle = world.bar_middle(handle);
    let out = outward(world, handle, &bar);
    let is_upright = (world.furniture_pose(handle).rotation * bar).z.abs() > 0.7;
    let mut all = Vec::new();
    for shift in SHIFTS {
        if shift.abs() > (half - END).max(0.0) {
            continue;
        }
        for tilt in TILTS {
            for roll in [1.0, -1.0] {
                let name = match (is_upright, tilt) {
                    (false, _) => "FRONT-ALONG-Y",
                    (true, t) if t > 0.0 => "LEFT-SIDE",
                    (true, t) if t < 0.0 => "RIGHT-SIDE",
                    (true, _) => "FRONT",
                };
                let is_wanted = |wanted: &String| wanted == name;
                if !question.grasps.is_empty() && !question.grasps.iter().any(is_wanted) {
                    continue;
                }
                // x towards the furniture, z along the bar, so that the fingers close across it.
                let x = -out;
                let z = bar * roll;
                let axes = Matrix3::from_columns(&[x, z.cross(&x), z]);
                let facing =
                    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
                let point = Point3::from(middle + bar * shift);
                let tool =
                    Pose::from_parts(Translation3::from(point.coords), turn(&bar, tilt) * facing);
                all.push(HandleGrasp {
                    name,
                    grip: BarGrip {
                        handle,
                        tool,
                        point,
                        bar,
                    },
                });
            }
        }
    }
    all
}

/// The ways to take a knob: the fingers level or upright first.
fn grasps_of_knob(world: &World, question: &HandleQuestion, knob: &Knob) -> Vec<HandleGrasp> {
    const NAME: &str = "FRONT";
    let models = world.models();
    if !question.grasps.is_empty() && !question.grasps.iter().any(|wanted| wanted == NAME) {
        return Vec::new();
    }
    // The fingers swing, so that their tips are elsewhere when they have closed.
    let gaps = [OPENING, 2.0 * knob.radius];
    let hands = question.arms.iter();
    let reaches = hands.flat_map(|side| gaps.map(|gap| HandShape::new(models, *side, gap).ahead()));
    let ahead = reaches.fold(0.0, f64::max);
    let tip = knob.ends[0] + KNOB_CLEARANCE;
    if tip >= knob.ends[1] {
        return Vec::new();
    }
    let x = -knob.outward;
    let up = world.furniture_pose(knob.link).rotation.inverse() * Vector3::z();
    let across = (up - x * up.dot(&x)).try_normalize(1e-3);
    let across = across.unwrap_or_else(|| {
        let side = Vector3::y() - x * x.y;
        side.try_normalize(1e-3).unwrap_or_else(Vector3::z)
    });
    let middle = Point3::from(knob.outward * (knob.ends[0] + knob.ends[1]) / 2.0);
    let tool = knob.outward * (tip + ahead);
    let mut turns: Vec<u32> = (0..KNOB_TURNS).collect();
    // Quarters first.
    turns.sort_by_key(|i| i % (KNOB_TURNS / 4) != 0);
    let grasp = |i: u32| {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(KNOB_TURNS);
        let z = turn(&x, angle) * across;
        let axes = Matrix3::from_columns(&[x, z.cross(&x), z]);
        let facing = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
        HandleGrasp {
            name: NAME,
            grip: BarGrip {
                handle: knob.link,
                tool: Pose::from_parts(Translation3::from(tool), facing),
                point: middle,
                bar: knob.outward,
            },
        }
    };
    turns.into_iter().map(grasp).collect()
}

/// The direction from the furniture to the bar, in the frame of the handle: away from the posts, or
/// else where the bar goes when its joint begins to move.
fn outward(world: &World, handle: LinkId, bar: &Vector3<f64>) -> Vector3<f64> {
    let across = |v: Vector3<f64>| v - bar * v.dot(bar);
    let posts = world.handle_posts(handle);
    let kitchen = &world.models().kitchen;
    let along = kitchen
        .ancestors(handle)
        .map(|joint| kitchen.joint(joint))
        .find(|joint| joint.is_actuated())
        .map_or_else(Vector3::x, |joint| {
            let here = world.furniture_pose(handle);
            let child = here.inverse() * world.furniture_pose(joint.child);
            let axis = child.rotation * joint.axis.into_inner();
            match joint.kind {
                JointKind::Prismatic => axis,
                _ => axis.cross(&(world.bar_middle(handle) - child.translation.vector)),
            }
        });
    across(-posts)
        .try_normalize(1e-3)
        .or_else(|| across(along).try_normalize(1e-3))
        .unwrap_or_else(|| turn(&Vector3::z(), trig::wrap(std::f64::consts::FRAC_PI_2)) * bar)
}
