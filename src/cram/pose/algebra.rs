//! Sums, products and lengths of vectors and quaternions.

use nalgebra::{Quaternion as Hamilton, Vector3 as Column};

use super::argument;
use super::argument::Result;
use super::value;
use super::value::{Quaternion, Vector3};
use lisp::builtin::{Builtin, pure};
use lisp::image::Image;
use lisp::value::Value;
use spatial::trig;

/// Functions of package `CL-TRANSFORMS`.
pub(crate) static TABLE: &[Builtin] = &[
    pure(
        "V+",
        "vector &rest vectors",
        "The sum of vectors.",
        &[
            "(cl-transforms:v+ (cl-transforms:make-3d-vector 1 2 3) (cl-transforms:make-3d-vector 1 0 0)) => #<3D-VECTOR (2.0d0 2.0d0 3.0d0)>",
        ],
        |image, args| fold(image, args, |a, b| a + b),
    ),
    pure(
        "V-",
        "vector &rest vectors",
        "The first vector less the others; of one vector, its opposite.",
        &[
            "(cl-tf:v- (cl-tf:make-3d-vector 1 2 3) (cl-tf:make-3d-vector 1 1 1)) => #<3D-VECTOR (0.0d0 1.0d0 2.0d0)>",
        ],
        |image, args| match args {
            [only] => {
                let v = column(image, only)?;
                Ok(vector(-v))
            }
            _ => fold(image, args, |a, b| a - b),
        },
    ),
    pure(
        "V*",
        "vector factor",
        "The vector times a number.",
        &[
            "(cl-transforms:v* (cl-transforms:make-3d-vector 1 2 3) 2) => #<3D-VECTOR (2.0d0 4.0d0 6.0d0)>",
        ],
        |image, args| Ok(vector(column(image, &args[0])? * argument::real(&args[1])?)),
    ),
    pure(
        "V-INV",
        "vector",
        "The opposite vector.",
        &["(cl-tf:v-inv (cl-tf:make-3d-vector 1 2 3)) => #<3D-VECTOR (-1.0d0 -2.0d0 -3.0d0)>"],
        |image, args| Ok(vector(-column(image, &args[0])?)),
    ),
    pure(
        "V-NORM",
        "vector",
        "The length of a vector (m).",
        &["(cl-transforms:v-norm (cl-transforms:make-3d-vector 3 4 0)) => 5.0d0"],
        |image, args| Ok(Value::Double(column(image, &args[0])?.norm())),
    ),
    pure(
        "V-DIST",
        "vector other",
        "The distance between two points (m).",
        &[
            "(cl-transforms:v-dist (cl-transforms:make-3d-vector 1 0 0) (cl-transforms:make-3d-vector 1 2 0)) => 2.0d0",
        ],
        |image, args| {
            let difference = column(image, &args[0])? - column(image, &args[1])?;
            Ok(Value::Double(difference.norm()))
        },
    ),
    pure(
        "DOT-PRODUCT",
        "vector other",
        "The scalar product of two vectors.",
        &[
            "(cl-tf:dot-product (cl-tf:make-3d-vector 1 2 3) (cl-tf:make-3d-vector 1 2 3)) => 14.0d0",
        ],
        |image, args| {
            let product = column(image, &args[0])?.dot(&column(image, &args[1])?);
            Ok(Value::Double(product))
        },
    ),
    pure(
        "CROSS-PRODUCT",
        "vector other",
        "The vector product of two vectors.",
        &[
            "(cl-tf:cross-product (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-3d-vector 0 1 0)) => #<3D-VECTOR (0.0d0 0.0d0 1.0d0)>",
        ],
        |image, args| {
            let product = column(image, &args[0])?.cross(&column(image, &args[1])?);
            Ok(vector(product))
        },
    ),
    pure(
        "Q+",
        "quaternion &rest quaternions",
        "The sum of quaternions.",
        &[
            "(cl-tf:q+ (cl-tf:make-identity-rotation) (cl-tf:make-identity-rotation)) => #<QUATERNION (0.0d0 0.0d0 0.0d0 2.0d0)>",
        ],
        |image, args| {
            let mut sum = [0.0; 4];
            for arg in args {
                let Quaternion(q) = argument::quaternion(image, arg)?;
                sum.iter_mut().zip(q).for_each(|(s, x)| *s += x);
            }
            Ok(value::quaternion(sum))
        },
    ),
    pure(
        "Q*",
        "quaternion &rest quaternions",
        "The product of quaternions: the last rotation is applied first.",
        &[
            "(cl-transforms:q* (cl-transforms:make-quaternion 0 0 1 0) (cl-transforms:make-quaternion 0 0 1 0)) => #<QUATERNION (0.0d0 0.0d0 0.0d0 -1.0d0)>",
        ],
        |image, args| {
            let mut product = hamilton(image, &args[0])?;
            for arg in &args[1..] {
                product *= hamilton(image, arg)?;
            }
            Ok(quaternion(&product))
        },
    ),
    pure(
        "Q-INV",
        "quaternion",
        "The quaternion of the opposite rotation.",
        &[
            "(cl-tf:q-inv (cl-tf:make-quaternion 0 0 1 0)) => #<QUATERNION (-0.0d0 -0.0d0 -1.0d0 0.0d0)>",
        ],
        |image, args| {
            let q = hamilton(image, &args[0])?;
            Ok(quaternion(&q.try_inverse().unwrap_or(q)))
        },
    ),
    pure(
        "Q-NORM",
        "quaternion",
        "The length of a quaternion.",
        &["(cl-transforms:q-norm (cl-transforms:make-quaternion 0 0 3 4)) => 5.0d0"],
        |image, args| Ok(Value::Double(hamilton(image, &args[0])?.norm())),
    ),
    pure(
        "NORMALIZE",
        "quaternion",
        "The quaternion at length 1.",
        &[
            "(cl-transforms:normalize (cl-transforms:make-quaternion 0 0 0 2)) => #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>",
        ],
        |image, args| {
            let rotation = argument::quaternion(image, &args[0])?.rotation();
            Ok(value::quaternion(Quaternion::of(&rotation).0))
        },
    ),
    pure(
        "ROTATE",
        "quaternion vector",
        "The vector rotated.",
        &[
            "(cl-tf:rotate (cl-tf:make-quaternion 0 0 1 0) (cl-tf:make-3d-vector 1 2 3)) => #<3D-VECTOR (-1.0d0 -2.0d0 3.0d0)>",
        ],
        |image, args| {
            let rotation = argument::quaternion(image, &args[0])?.rotation();
            Ok(vector(rotation * column(image, &args[1])?))
        },
    ),
    pure(
        "ANGLE-BETWEEN-QUATERNIONS",
        "quaternion other",
        "The angle between two orientations (rad, 0 to pi).",
        &[
            "(cl-tf:angle-between-quaternions (cl-tf:make-identity-rotation) (cl-tf:make-quaternion 0 0 1 0)) => 3.141592653589793d0",
        ],
        |image, args| {
            let a = argument::quaternion(image, &args[0])?.rotation();
            let b = argument::quaternion(image, &args[1])?.rotation();
            let d = a.inverse() * b;
            let angle = 2.0 * trig::atan2(d.imag().norm(), d.w.abs());
            Ok(Value::Double(angle))
        },
    ),
];

fn column(image: &Image, argument: &Value) -> Result<Column<f64>> {
    let Vector3(xyz) = argument::vector(image, argument)?;
    Ok(Column::from(xyz))
}

fn vector(v: Column<f64>) -> Value {
    value::vector([v.x, v.y, v.z])
}

fn hamilton(image: &Image, argument: &Value) -> Result<Hamilton<f64>> {
    let Quaternion([x, y, z, w]) = argument::quaternion(image, argument)?;
    Ok(Hamilton::new(w, x, y, z))
}

fn quaternion(q: &Hamilton<f64>) -> Value {
    value::quaternion([q.i, q.j, q.k, q.w])
}

fn fold(
    image: &Image,
    args: &[Value],
    combine: fn(Column<f64>, Column<f64>) -> Column<f64>,
) -> Result<Value> {
    let mut result = column(image, &args[0])?;
    for arg in &args[1..] {
        result = combine(result, column(image, arg)?);
    }
    Ok(vector(result))
}
