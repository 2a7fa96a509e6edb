//! One way to grasp an object, and the poses of the tool that it means.
//!
//! Nothing here knows of a particular robot: the hand is the gripper frame of a grasp (z forward, x across the
//! palm), which the robot description turns into its tool frame.

use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};
use thiserror::Error;

use spatial::Pose;

/// How far the rows of a rotation may deviate from unit length and right angles; it allows
/// for hand-written matrices with entries such as 0.707.
const ROTATION_SLACK: f64 = 0.01;

/// One way to grasp objects of one type with one arm; lengths in m, along the object's axes.
#[derive(Clone, Debug, PartialEq)]
pub struct GraspDefinition {
    /// Position of the hand in the object's frame.
    pub translation: [f64; 3],
    /// Orientation of the hand in the object's frame: the rows of the matrix as written.
    pub rotation: [[f64; 3]; 3],
    /// First pregrasp, relative to `translation`.
    pub pregrasp: [f64; 3],
    /// Second pregrasp, relative to `translation`.
    pub second_pregrasp: [f64; 3],
    /// First lift.
    pub lift: Lift,
    /// Second lift.
    pub second_lift: Lift,
    /// How wide (m) the hand opens beforehand, if not as for other grasps of the type.
    pub opening: Option<f64>,
}

/// How the hand lifts what it has grasped. CRAM has had two notations for this; if both are
/// given, they add up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lift {
    /// Position of the hand relative to that of the grasp, along the object's axes (m). For an
    /// object that lies on its side this does not point upwards.
    pub offset: [f64; 3],
    /// Further displacement of hand and object in the frame of the robot's base, whatever
    /// the orientation of the object.
    pub in_base: Pose,
}

impl Lift {
    /// Along the object's axes only (m).
    pub fn along_object(offset: [f64; 3]) -> Self {
        Self {
            offset,
            in_base: Pose::identity(),
        }
    }
}

/// Poses of the robot's tool for a grasp, in the frame of the robot's base.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolPoses {
    /// The tool approaches here first.
    pub pregrasp: Pose,
    /// Then here.
    pub second_pregrasp: Pose,
    /// Here the gripper closes.
    pub grasp: Pose,
    /// The tool lifts to here.
    pub lift: Pose,
    /// Then to here.
    pub second_lift: Pose,
}

/// A matrix that is not a rotation, as rows.
#[derive(Clone, Debug, PartialEq, Error)]
#[error(
    "{0:?} is not a rotation: its rows must have length 1, be at right angles to each other \
     and make a right-handed frame"
)]
pub struct NotARotation(pub [[f64; 3]; 3]);

impl GraspDefinition {
    /// Orientation of the hand in the object's frame; small errors of the matrix are corrected.
    pub fn orientation(&self) -> Result<UnitQuaternion<f64>, NotARotation> {
        let matrix = Matrix3::from(self.rotation).transpose();
        let flaw = (matrix * matrix.transpose() - Matrix3::identity()).amax();
        // NaN counts as a flaw too.
        let sound = flaw <= ROTATION_SLACK && matrix.determinant() > 0.0;
        if !sound {
            return Err(NotARotation(self.rotation));
        }
        // Orthonormalised starting from the third column, the approach direction.
        let z = matrix.column(2).normalize();
        let x: Vector3<f64> = matrix.column(0) - z * z.dot(&matrix.column(0));
        let x = x.normalize();
        let square = Matrix3::from_columns(&[x, z.cross(&x), z]);
        let rotation = Rotation3::from_matrix_unchecked(square);
        Ok(UnitQuaternion::from_rotation_matrix(&rotation))
    }

    /// The five poses of the tool for an object at `object`, all in the frame of the robot's
    /// base; `tool_axes` is the tool's orientation in the hand's frame.
    pub fn tool_poses(
        &self,
        object: &Pose,
        tool_axes: &UnitQuaternion<f64>,
    ) -> Result<ToolPoses, NotARotation> {
        let orientation = self.orientation()? * tool_axes;
        let at = |offset: [f64; 3]| {
            let place = Vector3::from(self.translation) + Vector3::from(offset);
            object * Pose::from_parts(Translation3::from(place), orientation)
        };
        let lifted = |lift: &Lift| lift.in_base * at(lift.offset);
        Ok(ToolPoses {
            pregrasp: at(self.pregrasp),
            second_pregrasp: at(self.second_pregrasp),
            grasp: at([0.0; 3]),
            lift: lifted(&self.lift),
            second_lift: lifted(&self.second_lift),
        })
    }
}
