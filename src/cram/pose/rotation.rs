//! Quaternions from and to angles, axes and matrices.

use crate::pose::value::Vector3;
use nalgebra::{Matrix3, Quaternion as Hamilton, Rotation3, UnitQuaternion, Vector3 as Column};

use super::argument::Result;
use super::value;
use super::value::Quaternion;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;
use spatial::{pose, trig};

/// The axis and the angle (rad) of a quaternion, as two values.
///
/// `(cl-tf:quaternion->axis-angle (cl-tf:make-quaternion 0 0 1 0))` => `#<3D-VECTOR (0.0d0 0.0d0 1.0d0)> ; 3.141592653589793d0`
#[builtin("QUATERNION->AXIS-ANGLE")]
fn quaternion_to_axis_angle(quaternion: Quaternion) -> Result<Value> {
    let q = quaternion.rotation();
    let length = q.imag().norm();
    let angle = 2.0 * trig::atan2(length, q.w);
    let axis = if length > 0.0 {
        q.imag() / length
    } else {
        Column::x()
    };
    Ok(Value::values(vec![
        value::vector([axis.x, axis.y, axis.z]),
        Value::Double(angle),
    ]))
}

/// The rotation matrix of a quaternion as a list of three rows.
///
/// `(cl-tf:quaternion->matrix (cl-tf:make-identity-rotation))` => `((1.0d0 0.0d0 0.0d0) (0.0d0 1.0d0 0.0d0) (0.0d0 0.0d0 1.0d0))`
#[builtin("QUATERNION->MATRIX")]
fn quaternion_to_matrix(quaternion: Quaternion) -> Result<Value> {
    let q = quaternion.rotation();
    let m = q.to_rotation_matrix();
    let rows = m
        .matrix()
        .row_iter()
        .map(|row| Value::list([row[0], row[1], row[2]].map(Value::Double)));
    Ok(Value::list(rows.collect::<Vec<_>>()))
}

/// The heading of an orientation (rad, -pi to pi).
///
/// `(cl-transforms:get-yaw (cl-transforms:make-identity-rotation))` => `0.0d0`
#[builtin]
fn get_yaw(quaternion: Quaternion) -> Result<Value> {
    let rotation = quaternion.rotation();
    let turned = spatial::Pose::from_parts(Default::default(), rotation);
    Ok(Value::Double(pose::yaw(&turned)))
}

/// The angle brought into -pi to pi (rad).
///
/// `(cl-transforms:normalize-angle 0)` => `0.0d0`
#[builtin]
fn normalize_angle(angle: f64) -> Result<Value> {
    Ok(Value::Double(trig::wrap(angle)))
}

/// The shortest turn from one angle to another (rad, -pi to pi).
///
/// `(cl-transforms:shortest-angular-distance 1 1)` => `0.0d0`
#[builtin]
fn shortest_angular_distance(from: f64, to: f64) -> Result<Value> {
    let difference = to - from;
    Ok(Value::Double(trig::wrap(difference)))
}

/// The angle in radians.
///
/// `(cl-transforms:degrees->radians 0)` => `0.0d0`
#[builtin("DEGREES->RADIANS")]
fn degrees_to_radians(degrees: f64) -> Result<Value> {
    Ok(Value::Double(degrees.to_radians()))
}

/// The angle in degrees.
///
/// `(cl-transforms:radians->degrees 0)` => `0.0d0`
#[builtin("RADIANS->DEGREES")]
fn radians_to_degrees(radians: f64) -> Result<Value> {
    Ok(Value::Double(radians.to_degrees()))
}

/// The quaternion of rotations about the fixed axes x, then y, then z (rad).
///
/// `(cl-transforms:euler->quaternion :az 0)` => `#<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>`
#[builtin("EULER->QUATERNION")]
fn euler_to_quaternion(
    #[key] ax: Option<f64>,
    #[key] ay: Option<f64>,
    #[key] az: Option<f64>,
) -> Value {
    let angles = [ax, ay, az].map(Option::unwrap_or_default);
    let turned = pose::from_xyz_rpy([0.0; 3], angles);
    value::quaternion(Quaternion::of(&turned.rotation).0)
}

/// The angles (rad) about x, y and z of a quaternion: a list (:AX x :AY y :AZ z), or three values.
///
/// `(cl-tf:quaternion->euler (cl-tf:make-identity-rotation))` => `(:AX 0.0d0 :AY 0.0d0 :AZ 0.0d0)`
// Roll, pitch and yaw about fixed axes, from the rotation's matrix.
#[builtin("QUATERNION->EULER")]
fn quaternion_to_euler(
    image: &mut Image,
    quaternion: Quaternion,
    #[key] just_values: Option<bool>,
) -> Value {
    let m = quaternion.rotation().to_rotation_matrix();
    let m = m.matrix();
    let roll = trig::atan2(m[(2, 1)], m[(2, 2)]);
    let pitch = trig::asin(-m[(2, 0)]);
    let yaw = trig::atan2(m[(1, 0)], m[(0, 0)]);
    // Adding zero turns -0 into 0.
    let angles = [roll, pitch, yaw].map(|a| Value::Double(a + 0.0));
    if just_values == Some(true) {
        return Value::values(angles.to_vec());
    }
    let [ax, ay, az] = angles;
    let names = ["AX", "AY", "AZ"].map(|n| Value::from(image.keyword(n)));
    let [kx, ky, kz] = names;
    Value::list([kx, ax, ky, ay, kz, az])
}

/// The quaternion of a rotation by an angle (rad) about an axis.
///
/// `(cl-transforms:axis-angle->quaternion (cl-transforms:make-3d-vector 0 0 1) 0)` => `#<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>`
#[builtin("AXIS-ANGLE->QUATERNION")]
fn axis_angle_to_quaternion(axis: Vector3, angle: f64) -> Result<Value> {
    let axis = Column::from(axis.0);
    let length = axis.norm();
    if length == 0.0 {
        return Err(Raise::simple(
            "The axis of a rotation cannot be the vector of three zeros.",
        ));
    }
    let (sin, cos) = trig::sin_cos(angle / 2.0);
    let v = axis * (sin / length);
    Ok(value::quaternion([v.x, v.y, v.z, cos]))
}

/// The quaternion of a 3 × 3 rotation matrix: an array, or a list of three rows.
///
/// `(cl-transforms:matrix->quaternion '((1 0 0) (0 1 0) (0 0 1)))` => `#<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>`
#[builtin("MATRIX->QUATERNION")]
fn matrix_to_quaternion(image: &mut Image, matrix: &Value) -> Result<Value> {
    let numbers = matrix_numbers(matrix).ok_or_else(|| {
        Raise::simple(format!(
            "{} is not a rotation matrix: an array or a list of three rows of three numbers was expected.",
            print::to_string(image, matrix, true)
        ))
    })?;
    let matrix = Matrix3::from_row_slice(&numbers);
    Ok(value::quaternion(quaternion_of(&matrix).0))
}

/// Shepperd's method on the matrix as given: exact for rotations, close for rounded ones.
fn quaternion_of(matrix: &Matrix3<f64>) -> Quaternion {
    let rotation = Rotation3::from_matrix_unchecked(*matrix);
    let q = UnitQuaternion::from_rotation_matrix(&rotation);
    let unit = UnitQuaternion::from_quaternion(Hamilton::new(q.w, q.i, q.j, q.k));
    Quaternion::of(&unit)
}

/// Nine numbers of a 3 × 3 array or of a list of three lists.
fn matrix_numbers(argument: &Value) -> Option<[f64; 9]> {
    let items: Vec<Value> = match argument {
        Value::Array(array) => {
            let is_square = array.dimensions.borrow().as_slice() == [3, 3];
            is_square.then(|| array.items.to_vec())?
        }
        Value::Cons(_) => argument
            .list_to_vec()?
            .iter()
            .map(Value::list_to_vec)
            .collect::<Option<Vec<_>>>()?
            .concat(),
        _ => return None,
    };
    let numbers: Option<Vec<f64>> = items.iter().map(number::to_f64).collect();
    numbers?.try_into().ok()
}

/// Functions of package `CL-TRANSFORMS`.
pub(crate) static TABLE: &[Builtin] = builtins![
    euler_to_quaternion,
    quaternion_to_euler,
    axis_angle_to_quaternion,
    quaternion_to_axis_angle,
    matrix_to_quaternion,
    quaternion_to_matrix,
    get_yaw,
    normalize_angle,
    shortest_angular_distance,
    degrees_to_radians,
    radians_to_degrees,
];
