//! Bodies that move with another one.

use nalgebra::Vector3;

use super::{BodyHandle, Physics, Vector, to_parry};
use spatial::Pose;

impl Physics {
    /// Puts a body at a pose, moving with velocities (m/s, rad/s).
    pub(crate) fn carry(
        &mut self,
        body: BodyHandle,
        pose: &Pose,
        linear: &Vector3<f64>,
        angular: &Vector3<f64>,
    ) {
        if let Some(b) = self.edit().bodies.get_mut(body.0) {
            b.set_position(to_parry(pose), true);
            let vector = |v: &Vector3<f64>| Vector::new(v.x, v.y, v.z);
            b.set_linvel(vector(linear), true);
            b.set_angvel(vector(angular), true);
        }
    }
}
