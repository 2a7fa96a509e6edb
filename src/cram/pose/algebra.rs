//! Sums, products and lengths of vectors and quaternions.

use nalgebra::{Quaternion as Hamilton, Vector3 as Column};

use super::argument;
use super::argument::Result;
use super::value;
use super::value::{Quaternion, Vector3};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use spatial::trig;

/// The sum of vectors.
///
/// `(cl-transforms:v+ (cl-transforms:make-3d-vector 1 2 3) (cl-transforms:make-3d-vector 1 0 0))` => `#<3D-VECTOR (2.0d0 2.0d0 3.0d0)>`
#[builtin("V+")]
fn v_plus(image: &mut Image, vector: Vector3, vectors: &[Value]) -> Result<Value> {
    fold(image, vector, vectors, |a, b| a + b)
}

/// The first vector less the others; of one vector, its opposite.
///
/// `(cl-tf:v- (cl-tf:make-3d-vector 1 2 3) (cl-tf:make-3d-vector 1 1 1))` => `#<3D-VECTOR (0.0d0 1.0d0 2.0d0)>`
#[builtin("V-", "vector &rest vectors")]
fn v_minus(image: &mut Image, first: Vector3, others: &[Value]) -> Result<Value> {
    match others {
        [] => vector(-Column::from(first.0)),
        _ => fold(image, first, others, |a, b| a - b),
    }
}

/// The vector times a number.
///
/// `(cl-transforms:v* (cl-transforms:make-3d-vector 1 2 3) 2)` => `#<3D-VECTOR (2.0d0 4.0d0 6.0d0)>`
#[builtin("V*", "vector factor")]
fn v_builtin(image: &mut Image, vector_value: &Value, factor: f64) -> Result<Value> {
    vector(column(image, vector_value)? * factor)
}

/// The opposite vector.
///
/// `(cl-tf:v-inv (cl-tf:make-3d-vector 1 2 3))` => `#<3D-VECTOR (-1.0d0 -2.0d0 -3.0d0)>`
#[builtin(_, "vector")]
fn v_inv(image: &mut Image, vector_value: &Value) -> Result<Value> {
    vector(-column(image, vector_value)?)
}

/// The length of a vector (m).
///
/// `(cl-transforms:v-norm (cl-transforms:make-3d-vector 3 4 0))` => `5.0d0`
///
/// `(cl-transforms:v-norm (cl-transforms:make-3d-vector 1d200 0 0))` => `1.0d200`
#[builtin]
fn v_norm(image: &mut Image, vector: &Value) -> Result<Value> {
    let v = column(image, vector)?;
    length(v.norm(), v.as_slice())
}

/// The distance between two points (m).
///
/// `(cl-transforms:v-dist (cl-transforms:make-3d-vector 1 0 0) (cl-transforms:make-3d-vector 1 2 0))` => `2.0d0`
#[builtin]
fn v_dist(image: &mut Image, vector: &Value, other: &Value) -> Result<Value> {
    let difference = column(image, vector)? - column(image, other)?;
    length(difference.norm(), difference.as_slice())
}

/// The scalar product of two vectors.
///
/// `(cl-tf:dot-product (cl-tf:make-3d-vector 1 2 3) (cl-tf:make-3d-vector 1 2 3))` => `14.0d0`
#[builtin]
fn dot_product(image: &mut Image, vector: &Value, other: &Value) -> Result<Value> {
    let product = column(image, vector)?.dot(&column(image, other)?);
    finite(product)
}

/// The vector product of two vectors.
///
/// `(cl-tf:cross-product (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-3d-vector 0 1 0))` => `#<3D-VECTOR (0.0d0 0.0d0 1.0d0)>`
#[builtin(_, "vector other")]
fn cross_product(image: &mut Image, vector_value: &Value, other: &Value) -> Result<Value> {
    let product = column(image, vector_value)?.cross(&column(image, other)?);
    vector(product)
}

/// The sum of quaternions.
///
/// `(cl-tf:q+ (cl-tf:make-identity-rotation) (cl-tf:make-identity-rotation))` => `#<QUATERNION (0.0d0 0.0d0 0.0d0 2.0d0)>`
#[builtin("Q+", "quaternion &rest quaternions")]
fn q_plus(image: &mut Image, quaternions: &[Value]) -> Result<Value> {
    let mut sum = [0.0; 4];
    for arg in quaternions {
        let Quaternion(q) = argument::quaternion(image, arg)?;
        sum.iter_mut().zip(q).for_each(|(s, x)| *s += x);
    }
    let [x, y, z, w] = sum;
    quaternion(&Hamilton::new(w, x, y, z))
}

/// The product of quaternions: the last rotation is applied first.
///
/// `(cl-transforms:q* (cl-transforms:make-quaternion 0 0 1 0) (cl-transforms:make-quaternion 0 0 1 0))` => `#<QUATERNION (0.0d0 0.0d0 0.0d0 -1.0d0)>`
#[builtin("Q*", "quaternion &rest quaternions")]
fn q(image: &mut Image, quaternion_value: &Value, quaternions: &[Value]) -> Result<Value> {
    let mut product = hamilton(image, quaternion_value)?;
    for arg in quaternions {
        product *= hamilton(image, arg)?;
    }
    quaternion(&product)
}

/// The quaternion of the opposite rotation.
///
/// `(cl-tf:q-inv (cl-tf:make-quaternion 0 0 1 0))` => `#<QUATERNION (-0.0d0 -0.0d0 -1.0d0 0.0d0)>`
#[builtin(_, "quaternion")]
fn q_inv(image: &mut Image, quaternion_value: &Value) -> Result<Value> {
    let q = hamilton(image, quaternion_value)?;
    quaternion(&q.try_inverse().unwrap_or(q))
}

/// The length of a quaternion.
///
/// `(cl-transforms:q-norm (cl-transforms:make-quaternion 0 0 3 4))` => `5.0d0`
#[builtin]
fn q_norm(image: &mut Image, quaternion: &Value) -> Result<Value> {
    let q = hamilton(image, quaternion)?;
    length(q.norm(), q.coords.as_slice())
}

/// The quaternion at length 1.
///
/// `(cl-transforms:normalize (cl-transforms:make-quaternion 0 0 0 2))` => `#<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>`
#[builtin]
fn normalize(quaternion: Quaternion) -> Result<Value> {
    let rotation = quaternion.rotation();
    Ok(value::quaternion(Quaternion::of(&rotation).0))
}

/// The vector rotated.
///
/// `(cl-tf:rotate (cl-tf:make-quaternion 0 0 1 0) (cl-tf:make-3d-vector 1 2 3))` => `#<3D-VECTOR (-1.0d0 -2.0d0 3.0d0)>`
#[builtin(_, "quaternion vector")]
fn rotate(image: &mut Image, quaternion: Quaternion, vector_value: &Value) -> Result<Value> {
    let rotation = quaternion.rotation();
    vector(rotation * column(image, vector_value)?)
}

/// The angle between two orientations (rad, 0 to pi).
///
/// `(cl-tf:angle-between-quaternions (cl-tf:make-identity-rotation) (cl-tf:make-quaternion 0 0 1 0))` => `3.141592653589793d0`
#[builtin]
fn angle_between_quaternions(quaternion: Quaternion, other: Quaternion) -> Result<Value> {
    let a = quaternion.rotation();
    let b = other.rotation();
    let d = a.inverse() * b;
    let angle = 2.0 * trig::atan2(d.imag().norm(), d.w.abs());
    Ok(Value::Double(angle))
}

fn column(image: &Image, argument: &Value) -> Result<Column<f64>> {
    let Vector3(xyz) = argument::vector(image, argument)?;
    Ok(Column::from(xyz))
}

fn vector(v: Column<f64>) -> Result<Value> {
    let parts = [v.x, v.y, v.z];
    parts
        .into_iter()
        .try_for_each(|part| finite(part).map(drop))?;
    Ok(value::vector(parts))
}

/// A number; an error if it is none because it would be too large.
fn finite(number: f64) -> Result<Value> {
    match number.is_finite() {
        true => Ok(Value::Double(number)),
        false => Err(Raise::new(
            known::FLOATING_POINT_OVERFLOW,
            "The result is larger than a double-float can be.",
        )),
    }
}

/// The length of what has these parts: `norm`, unless their squares are beyond what a number can be.
fn length(norm: f64, parts: &[f64]) -> Result<Value> {
    let largest = parts
        .iter()
        .fold(0.0_f64, |most, part| most.max(part.abs()));
    let is_exact = norm.is_finite() && norm > f64::MIN_POSITIVE.sqrt();
    if is_exact || largest == 0.0 {
        return finite(norm);
    }
    let squares = parts.iter().map(|part| (part / largest) * (part / largest));
    finite(largest * squares.sum::<f64>().sqrt())
}

fn hamilton(image: &Image, argument: &Value) -> Result<Hamilton<f64>> {
    let Quaternion([x, y, z, w]) = argument::quaternion(image, argument)?;
    Ok(Hamilton::new(w, x, y, z))
}

fn quaternion(q: &Hamilton<f64>) -> Result<Value> {
    let parts = [q.i, q.j, q.k, q.w];
    parts
        .into_iter()
        .try_for_each(|part| finite(part).map(drop))?;
    Ok(value::quaternion(parts))
}

fn fold(
    image: &Image,
    first: Vector3,
    others: &[Value],
    combine: fn(Column<f64>, Column<f64>) -> Column<f64>,
) -> Result<Value> {
    let mut result = Column::from(first.0);
    for arg in others {
        result = combine(result, column(image, arg)?);
    }
    vector(result)
}

/// Functions of package `CL-TRANSFORMS`.
pub(crate) static TABLE: &[Builtin] = builtins![
    v_plus,
    v_minus,
    v_builtin,
    v_inv,
    v_norm,
    v_dist,
    dot_product,
    cross_product,
    q_plus,
    q,
    q_inv,
    q_norm,
    normalize,
    rotate,
    angle_between_quaternions,
];
