//! Constructs vectors, quaternions, poses and transforms, and extracts their parts.

use super::argument;
use super::argument::Result;
use super::names;
use super::value;
use super::value::{Placement, Quaternion, Vector3};
use lisp::builtin::{Builtin, pure};
use lisp::builtins::keywords;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;

/// Functions of package `CL-TRANSFORMS`.
pub(crate) static TABLE: &[Builtin] = &[
    pure(
        "MAKE-3D-VECTOR",
        "x y z",
        "A vector (m).",
        &["(cl-transforms:make-3d-vector 1 0.5 0) => #<3D-VECTOR (1.0d0 0.5d0 0.0d0)>"],
        |_, args| {
            let xyz = [
                argument::real(&args[0])?,
                argument::real(&args[1])?,
                argument::real(&args[2])?,
            ];
            Ok(value::vector(xyz))
        },
    ),
    pure(
        "MAKE-IDENTITY-VECTOR",
        "",
        "The vector of three zeros.",
        &["(cl-transforms:make-identity-vector) => #<3D-VECTOR (0.0d0 0.0d0 0.0d0)>"],
        |_, _| Ok(value::vector([0.0; 3])),
    ),
    pure(
        "MAKE-QUATERNION",
        "x y z w",
        "A quaternion; it is kept as given and normalised when it is computed with.",
        &["(cl-transforms:make-quaternion 0 0 0 1) => #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>"],
        |_, args| {
            let xyzw = [
                argument::real(&args[0])?,
                argument::real(&args[1])?,
                argument::real(&args[2])?,
                argument::real(&args[3])?,
            ];
            Ok(value::quaternion(xyzw))
        },
    ),
    pure(
        "MAKE-IDENTITY-ROTATION",
        "",
        "The quaternion of no rotation.",
        &["(cl-transforms:make-identity-rotation) => #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>"],
        |_, _| Ok(value::quaternion(Quaternion::IDENTITY.0)),
    ),
    pure(
        "MAKE-POSE",
        "origin orientation",
        "A pose in no frame.",
        &[
            "(cl-tf:make-pose (cl-tf:make-3d-vector 1 2 0) (cl-tf:make-identity-rotation)) => #<POSE #<3D-VECTOR (1.0d0 2.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>",
        ],
        |image, args| Ok(value::pose(parts(image, args)?)),
    ),
    pure(
        "MAKE-IDENTITY-POSE",
        "",
        "The pose at the origin.",
        &[
            "(cl-tf:make-identity-pose) => #<POSE #<3D-VECTOR (0.0d0 0.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>",
        ],
        |_, _| Ok(value::pose(Placement::IDENTITY)),
    ),
    pure(
        "MAKE-TRANSFORM",
        "translation rotation",
        "A transform between frames that it does not name.",
        &[
            "(cl-tf:make-transform (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)) => #<TRANSFORM #<3D-VECTOR (1.0d0 0.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>",
        ],
        |image, args| Ok(value::transform(parts(image, args)?)),
    ),
    pure(
        "MAKE-IDENTITY-TRANSFORM",
        "",
        "The transform that changes nothing.",
        &[
            "(cl-tf:make-identity-transform) => #<TRANSFORM #<3D-VECTOR (0.0d0 0.0d0 0.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>",
        ],
        |_, _| Ok(value::transform(Placement::IDENTITY)),
    ),
    pure(
        "X",
        "object",
        "The x of a vector or quaternion.",
        &["(cl-transforms:x (cl-transforms:make-3d-vector 1 2 3)) => 1.0d0"],
        |image, args| component(image, &args[0], 0),
    ),
    pure(
        "Y",
        "object",
        "The y of a vector or quaternion.",
        &["(cl-transforms:y (cl-transforms:make-3d-vector 1 2 3)) => 2.0d0"],
        |image, args| component(image, &args[0], 1),
    ),
    pure(
        "Z",
        "object",
        "The z of a vector or quaternion.",
        &["(cl-transforms:z (cl-transforms:make-3d-vector 1 2 3)) => 3.0d0"],
        |image, args| component(image, &args[0], 2),
    ),
    pure(
        "W",
        "quaternion",
        "The w of a quaternion.",
        &["(cl-transforms:w (cl-transforms:make-quaternion 0 0 0 1)) => 1.0d0"],
        |image, args| component(image, &args[0], 3),
    ),
    pure(
        "ORIGIN",
        "pose",
        "The position of a pose (m).",
        &[
            "(cl-transforms:origin (cl-transforms:make-identity-pose)) => #<3D-VECTOR (0.0d0 0.0d0 0.0d0)>",
        ],
        |_, args| position(&args[0], names::POSE),
    ),
    pure(
        "ORIENTATION",
        "pose",
        "The orientation of a pose.",
        &[
            "(cl-transforms:orientation (cl-transforms:make-identity-pose)) => #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>",
        ],
        |_, args| orientation(&args[0], names::POSE),
    ),
    pure(
        "TRANSLATION",
        "transform",
        "The translation of a transform (m).",
        &[
            "(cl-transforms:translation (cl-transforms:make-identity-transform)) => #<3D-VECTOR (0.0d0 0.0d0 0.0d0)>",
        ],
        |_, args| position(&args[0], names::TRANSFORM),
    ),
    pure(
        "ROTATION",
        "transform",
        "The rotation of a transform.",
        &[
            "(cl-transforms:rotation (cl-transforms:make-identity-transform)) => #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>",
        ],
        |_, args| orientation(&args[0], names::TRANSFORM),
    ),
    pure(
        "COPY-3D-VECTOR",
        "vector &key x y z",
        "A vector with some numbers changed.",
        &[
            "(cl-transforms:copy-3d-vector (cl-transforms:make-3d-vector 1 2 3) :z 0) => #<3D-VECTOR (1.0d0 2.0d0 0.0d0)>",
        ],
        copy_vector,
    ),
    pure(
        "COPY-QUATERNION",
        "quaternion &key x y z w",
        "A quaternion with some numbers changed.",
        &[
            "(cl-tf:copy-quaternion (cl-tf:make-quaternion 0 0 1 0) :x 1 :z 0) => #<QUATERNION (1.0d0 0.0d0 0.0d0 0.0d0)>",
        ],
        copy_quaternion,
    ),
    pure(
        "COPY-POSE",
        "pose &key origin orientation",
        "A pose with another position or orientation.",
        &[
            "(cl-tf:copy-pose (cl-tf:make-identity-pose) :origin (cl-tf:make-3d-vector 1 2 3)) => #<POSE #<3D-VECTOR (1.0d0 2.0d0 3.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>",
        ],
        |image, args| {
            let old = argument::placement(image, &args[0])?;
            let names = [image.keyword("ORIGIN"), image.keyword("ORIENTATION")];
            Ok(value::pose(changed(image, old, &args[1..], names)?))
        },
    ),
    pure(
        "COPY-TRANSFORM",
        "transform &key translation rotation",
        "A transform with another translation or rotation.",
        &[
            "(cl-tf:copy-transform (cl-tf:make-identity-transform) :translation (cl-tf:make-3d-vector 1 2 3)) => #<TRANSFORM #<3D-VECTOR (1.0d0 2.0d0 3.0d0)> #<QUATERNION (0.0d0 0.0d0 0.0d0 1.0d0)>>",
        ],
        |image, args| {
            let old = argument::as_kind(&args[0], names::TRANSFORM)?;
            let names = [image.keyword("TRANSLATION"), image.keyword("ROTATION")];
            Ok(value::transform(changed(image, old, &args[1..], names)?))
        },
    ),
];

/// The placement given by two arguments: position and orientation.
fn parts(image: &Image, args: &[Value]) -> Result<Placement> {
    Ok(Placement {
        position: argument::vector(image, &args[0])?,
        orientation: argument::quaternion(image, &args[1])?,
    })
}

/// The placement with the parts that two keyword arguments replace.
pub(crate) fn changed(
    image: &Image,
    mut placement: Placement,
    args: &[Value],
    names: [Sym; 2],
) -> Result<Placement> {
    let [position, orientation] = keywords::parse(image, args, names)?;
    if let Some(position) = position {
        placement.position = argument::vector(image, &position)?;
    }
    if let Some(orientation) = orientation {
        placement.orientation = argument::quaternion(image, &orientation)?;
    }
    Ok(placement)
}

fn component(image: &Image, argument: &Value, index: usize) -> Result<Value> {
    let found = match (value::as_vector(argument), value::as_quaternion(argument)) {
        (Some(v), _) => v.get(index).copied(),
        (_, Some(q)) => q.get(index).copied(),
        _ => None,
    };
    match found {
        Some(x) => Ok(Value::Double(x)),
        None if value::as_placement(argument).is_some() => Err(Raise::simple(format!(
            "{} is a pose: take its ORIGIN or ORIENTATION first.",
            lisp::print::to_string(image, argument, true)
        ))),
        None if index == 3 => Err(Raise::type_error(argument, names::QUATERNION)),
        None => Err(Raise::type_error(argument, names::VECTOR_3D)),
    }
}

fn position(argument: &Value, expected: Sym) -> Result<Value> {
    let Vector3(xyz) = argument::as_kind(argument, expected)?.position;
    Ok(value::vector(xyz))
}

fn orientation(argument: &Value, expected: Sym) -> Result<Value> {
    let Quaternion(xyzw) = argument::as_kind(argument, expected)?.orientation;
    Ok(value::quaternion(xyzw))
}

fn copy_vector(image: &mut Image, args: &[Value]) -> Result<Value> {
    let Vector3(mut xyz) = argument::vector(image, &args[0])?;
    let names = ["X", "Y", "Z"].map(|n| image.keyword(n));
    let given = keywords::parse(image, &args[1..], names)?;
    for (slot, new) in xyz.iter_mut().zip(given) {
        if let Some(new) = new {
            *slot = argument::real(&new)?;
        }
    }
    Ok(value::vector(xyz))
}

fn copy_quaternion(image: &mut Image, args: &[Value]) -> Result<Value> {
    let Quaternion(mut xyzw) = argument::quaternion(image, &args[0])?;
    let names = ["X", "Y", "Z", "W"].map(|n| image.keyword(n));
    let given = keywords::parse(image, &args[1..], names)?;
    for (slot, new) in xyzw.iter_mut().zip(given) {
        if let Some(new) = new {
            *slot = argument::real(&new)?;
        }
    }
    Ok(value::quaternion(xyzw))
}
