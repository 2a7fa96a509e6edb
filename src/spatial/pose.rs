//! Rigid transforms.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

use super::trig;

/// A rigid transform: the pose of a child frame in its parent frame (m, unit quaternion).
pub type Pose = Isometry3<f64>;

/// A pose from a position (m) and a quaternion `[x, y, z, w]`, which is normalised.
///
/// Returns `None` when the quaternion is zero or a number is not finite.
pub fn from_xyz_quaternion(xyz: [f64; 3], xyzw: [f64; 4]) -> Option<Pose> {
    let [x, y, z, w] = xyzw;
    let q = Quaternion::new(w, x, y, z);
    let finite = xyz.iter().chain(&xyzw).all(|v| v.is_finite());
    (finite && q.norm() > 1e-9)
        .then(|| Pose::from_parts(Translation3::from(xyz), UnitQuaternion::from_quaternion(q)))
}

/// A pose from a position (m) and the fixed-axis roll, pitch and yaw (rad) of a URDF `origin`.
pub fn from_xyz_rpy(xyz: [f64; 3], rpy: [f64; 3]) -> Pose {
    let [(sr, cr), (sp, cp), (sy, cy)] = rpy.map(|a| trig::sin_cos(a / 2.0));
    let q = Quaternion::new(
        cy * cp * cr + sy * sp * sr,
        cy * cp * sr - sy * sp * cr,
        sy * cp * sr + cy * sp * cr,
        sy * cp * cr - cy * sp * sr,
    );
    Pose::from_parts(Translation3::from(xyz), UnitQuaternion::from_quaternion(q))
}

/// The planar pose (x m, y m, yaw rad) as a spatial pose with z = 0.
pub fn from_xy_yaw(x: f64, y: f64, yaw: f64) -> Pose {
    from_xyz_rpy([x, y, 0.0], [0.0, 0.0, yaw])
}

/// Heading (rad, in -π..π) of the pose's x axis projected onto the ground.
pub fn yaw(pose: &Pose) -> f64 {
    let q = pose.rotation.quaternion();
    trig::atan2(
        2.0 * (q.w * q.k + q.i * q.j),
        1.0 - 2.0 * (q.j * q.j + q.k * q.k),
    )
}

/// Angle (rad) between the two orientations.
pub fn angle_between(a: &Pose, b: &Pose) -> f64 {
    let d = a.rotation.inverse() * b.rotation;
    2.0 * trig::atan2(d.imag().norm(), d.w.abs())
}

/// Distance (m) between the two origins.
pub fn distance_between(a: &Pose, b: &Pose) -> f64 {
    (a.translation.vector - b.translation.vector).norm()
}

/// The pose at `fraction` (0..1) of the motion from `a` to `b`: the origin moves in a straight
/// line, and the orientation turns uniformly about one axis through the smaller angle.
pub fn between(a: &Pose, b: &Pose, fraction: f64) -> Pose {
    let origin = a.translation.vector + (b.translation.vector - a.translation.vector) * fraction;
    let turn = a.rotation.inverse() * b.rotation;
    let (imag, w) = (turn.imag(), turn.w);
    let sine = imag.norm();
    let rotation = if sine < 1e-12 {
        a.rotation
    } else {
        let half = trig::atan2(sine, w.abs()) * fraction;
        let (s, c) = trig::sin_cos(half);
        let axis = imag * (w.signum() * s / sine);
        a.rotation * UnitQuaternion::from_quaternion(Quaternion::from_parts(c, axis))
    };
    Pose::from_parts(Translation3::from(origin), rotation)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halfway_between_two_poses_is_half_the_way_and_half_the_turn() {
        let b = from_xyz_rpy([1.0, 2.0, 0.0], [0.0, 0.0, 1.0]);
        let middle = between(&Pose::identity(), &b, 0.5);
        assert!((yaw(&middle) - 0.5).abs() < 1e-12);
        assert_eq!(middle.translation.vector.as_slice(), [0.5, 1.0, 0.0]);
        assert!(angle_between(&between(&Pose::identity(), &b, 1.0), &b) < 1e-12);
    }
}
