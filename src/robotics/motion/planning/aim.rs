//! The positions of the neck's joints with which the robot looks at a point.

use nalgebra::{Matrix2, Point3, Vector2};

use super::configuration::with_joints;
use crate::robot::description::{Aim, Neck};
use crate::robot::{JointId, JointPositions, LinkId};
use crate::world::World;
use spatial::{Pose, trig};

/// Angle (rad) between the camera's axis and the point at which the search ends.
const EXACT: f64 = 1e-9;
/// Steps of the search from a start, and the greatest move (rad) of a joint in one.
const STEPS: usize = 60;
const STRIDE: f64 = 0.5;
/// Difference (rad) with which the effect of a joint is measured.
const DELTA: f64 = 1e-6;
/// Damping of steps.
const DAMPING: f64 = 1e-6;
/// Where each joint starts (rad), beside 0, if the search from there fails.
const STARTS: [f64; 2] = [-1.0, 1.0];

/// Positions (rad or m) of the neck's joints that aim the head at the point of the map frame (m). They may be
/// beyond the limits.
pub fn neck_positions(world: &World, point: &Point3<f64>) -> Vec<f64> {
    let neck = &world.models().description.neck;
    match neck.aim {
        Aim::PanTilt { pan, tilt } => pan_and_tilt(world, neck, [pan, tilt], point).to_vec(),
        Aim::Camera(frame) => search(world, &neck.joints, frame, point),
    }
}

/// Whether the camera has a point of the map frame (m) in its picture, whatever is in the way.
pub fn is_in_picture(world: &World, point: &Point3<f64>) -> bool {
    let camera = world.models().description.camera();
    let seen = world.link_pose(camera.frame).inverse_transform_point(point);
    let (sin, cos) = trig::sin_cos(0.5 * camera.vertical_view);
    // Half the picture's height, then its width, at the distance of the point (m).
    let half = seen.z * sin / cos;
    let wide = half * camera.width as f64 / camera.height as f64;
    seen.z > 0.0 && seen.y.abs() <= half && seen.x.abs() <= wide
}

/// Angles (rad) of pan and tilt: the x axis of the tilted link passes through the point if the point is level
/// with it.
fn pan_and_tilt(
    world: &World,
    neck: &Neck,
    [pan, tilt]: [LinkId; 2],
    point: &Point3<f64>,
) -> [f64; 2] {
    let tree = &world.models().robot;
    let level = with_joints(world.robot_configuration(), &neck.joints, &[0.0, 0.0]);
    let frame_of = |link| tree.link_pose(link, &level.base, &level.joints);
    // Each joint turns about an axis of its own frame: pan about z, tilt about y.
    let seen = frame_of(pan).inverse_transform_point(point);
    let axis = frame_of(pan).inverse() * frame_of(tilt);
    let pan_angle = trig::atan2(seen.y, seen.x);
    let ahead = libm::hypot(seen.x, seen.y) - axis.translation.x;
    let tilt_angle = trig::atan2(axis.translation.z - seen.z, ahead);
    [pan_angle, tilt_angle]
}

/// Positions of any joints that turn the camera's axis to the point, or as near to it as is found.
fn search(world: &World, joints: &[JointId], camera: LinkId, point: &Point3<f64>) -> Vec<f64> {
    let tree = &world.models().robot;
    let robot = world.robot_configuration();
    let aim = |q: &JointPositions| off(&tree.link_pose(camera, &robot.base, q), point);
    let limits = joints.iter().map(|joint| tree.joint(*joint).limits);
    let zero: &Vec<f64> = &limits
        .map(|limits| limits.map_or(0.0, |limits| limits.clamp(0.0)))
        .collect();
    let starts = STARTS.iter().flat_map(|away| {
        (0..joints.len()).map(move |i| {
            let mut start = zero.clone();
            start[i] += away;
            start
        })
    });
    let mut best = (f64::INFINITY, zero.clone());
    for mut at in std::iter::once(zero.clone()).chain(starts) {
        if best.0 < EXACT {
            break;
        }
        for _ in 0..STEPS {
            let q = with_joints(robot, joints, &at).joints;
            let error = aim(&q);
            if error.norm() < best.0 {
                best = (error.norm(), at.clone());
            }
            if error.norm() < EXACT {
                break;
            }
            let columns: Vec<Vector2<f64>> = (0..at.len())
                .map(|i| {
                    let mut moved = at.clone();
                    moved[i] += DELTA;
                    (aim(&with_joints(robot, joints, &moved).joints) - error) / DELTA
                })
                .collect();
            let square = columns.iter().map(|c| c * c.transpose());
            let square = square.sum::<Matrix2<f64>>() + Matrix2::identity() * DAMPING;
            let Some(inverse) = square.try_inverse() else {
                break;
            };
            let weights = inverse * error;
            for (position, column) in at.iter_mut().zip(&columns) {
                *position -= column.dot(&weights).clamp(-STRIDE, STRIDE);
            }
        }
    }
    let (_, mut found) = best;
    for position in &mut found {
        *position = trig::wrap(*position);
    }
    found
}

/// By how much (rad) a point is to the right of and below the axis of a camera at a pose.
fn off(camera: &Pose, point: &Point3<f64>) -> Vector2<f64> {
    let seen = camera.inverse_transform_point(point);
    let aside = libm::hypot(seen.x, seen.y);
    let angle = trig::atan2(aside, seen.z);
    match aside > 0.0 {
        true => Vector2::new(seen.x, seen.y) * (angle / aside),
        false => Vector2::zeros(),
    }
}
