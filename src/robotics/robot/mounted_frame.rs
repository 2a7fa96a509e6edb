//! Frames that a description adds to the robot's links, such as that of a camera on a stand.

use super::LinkId;
use crate::sexp::{DataError, Node};
use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};
use spatial::{Pose, pose};

/// A camera that looks at a point nearer to it than this (m) looks nowhere.
const NOWHERE: f64 = 1e-3;
/// A camera whose direction is this near to the vertical has no upper edge by that; its x axis then points
/// along minus y of the link.
const UPRIGHT: f64 = 1e-6;

/// A frame without a body that is fixed to a link.
#[derive(Clone, Debug, PartialEq)]
pub struct MountedFrame {
    /// The name of the link that it becomes.
    pub name: String,
    /// The link that it is fixed to.
    pub parent: LinkId,
    /// Where it is (m) in the frame of that link.
    pub at: Pose,
}

impl MountedFrame {
    /// The name of the optical frame of a camera that the URDF lacks.
    pub(super) fn name_of(camera: &str) -> String {
        format!("{camera}_optical_frame")
    }
}

/// A pose that is given as ((x y z) (x y z w)).
pub(super) fn given_pose(node: Node<'_>) -> Result<Pose, DataError> {
    let wrong = || node.expected("((x y z) (x y z w)), a point and a quaternion");
    let parts = node.list().map_err(|_| wrong())?;
    let [at, turned] = parts.as_slice() else {
        return Err(wrong());
    };
    let pose = pose::from_xyz_quaternion(at.numbers()?, turned.numbers()?);
    pose.ok_or_else(|| turned.expected("a quaternion x y z w that is not zero"))
}

/// The optical frame of a camera that stands at a point and looks at another one, with what is above in its
/// upper half; both (m) in the frame of a link.
pub(super) fn aimed(at: Node<'_>, looks_at: Node<'_>) -> Result<Pose, DataError> {
    let from = Point3::from(at.numbers::<3>()?);
    let to = Point3::from(looks_at.numbers::<3>()?);
    let way = to - from;
    if way.norm() < NOWHERE {
        return Err(looks_at.expected("another point than :at, where the camera stands"));
    }
    let ahead = way.normalize();
    let level = ahead.cross(&Vector3::z());
    let right = match level.norm() > UPRIGHT {
        true => level.normalize(),
        false => -Vector3::y(),
    };
    let down = ahead.cross(&right);
    let axes = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[right, down, ahead]));
    Ok(Pose::from_parts(
        from.into(),
        UnitQuaternion::from_rotation_matrix(&axes),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sexp::DataFile;

    fn looking(from: &str, to: &str) -> Result<Pose, String> {
        let file = DataFile::read(&format!("{from} {to}"), "f.sexp").map_err(|e| e.to_string())?;
        let nodes: Vec<Node<'_>> = file.nodes().collect();
        aimed(nodes[0], nodes[1]).map_err(|e| e.to_string())
    }

    #[test]
    fn a_camera_looks_at_its_point_with_the_sky_above() {
        let pose = looking("(1 2 3)", "(1 3 2.5)").unwrap();
        let seen = pose.inverse_transform_point(&Point3::new(1.0, 3.0, 2.5));
        assert!(
            seen.x.abs() < 1e-12 && seen.y.abs() < 1e-12 && seen.z > 1.0,
            "{seen}"
        );
        // To its right is what is to the right of somebody who looks along y; up is minus y.
        assert!(pose.inverse_transform_point(&Point3::new(2.0, 2.0, 3.0)).x > 0.99);
        assert!(pose.inverse_transform_point(&Point3::new(1.0, 2.0, 4.0)).y < -0.8);
        assert!((pose.rotation * Vector3::x()).z.abs() < 1e-12);
    }

    #[test]
    fn one_that_looks_straight_down_has_a_picture_too() {
        let pose = looking("(0 0 2)", "(0 0 0)").unwrap();
        assert!(pose.rotation.into_inner().norm() > 0.999);
        assert!((pose.rotation * Vector3::z() + Vector3::z()).norm() < 1e-12);
        let nowhere = looking("(0 0 2)", "(0 0 2)").unwrap_err();
        assert!(nowhere.contains("another point than :at"), "{nowhere}");
    }
}
