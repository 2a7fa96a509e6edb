//! Arguments of the functions on poses: numbers of any type, lists instead of vectors.

use std::rc::Rc;

use super::names;
use super::value;
use super::value::{Placement, Quaternion, Vector3};
use lisp::image::Image;
use lisp::print;
use lisp::typed::FromValue;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::number;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;

pub type Result<T> = std::result::Result<T, Box<Raise>>;

impl FromValue<'_> for Vector3 {
    fn from_value(image: &mut Image, value: &Value) -> Result<Self> {
        vector(image, value)
    }
}

impl FromValue<'_> for Quaternion {
    fn from_value(image: &mut Image, value: &Value) -> Result<Self> {
        quaternion(image, value)
    }
}

impl FromValue<'_> for Placement {
    fn from_value(image: &mut Image, value: &Value) -> Result<Self> {
        placement(image, value)
    }
}

/// The name of a frame: a string.
pub(crate) struct FrameName(pub(crate) Rc<str>);

impl FromValue<'_> for FrameName {
    fn from_value(_: &mut Image, value: &Value) -> Result<Self> {
        let name = value.as_text();
        name.map(|name| FrameName(name.into()))
            .ok_or_else(|| Raise::type_error(value, known::STRING))
    }
}

/// `count` numbers from a list; `what` and `names` describe them in errors.
fn numbers<const N: usize>(
    image: &Image,
    list: &Value,
    what: &str,
    names: &str,
) -> Result<[f64; N]> {
    let shown = || print::to_string(image, list, true);
    let Some(items) = list.list_to_vec() else {
        return Err(Raise::simple(format!(
            "{} is not {what}: a list ({names}) was expected.",
            shown()
        )));
    };
    let count = items.len();
    if count != N {
        return Err(Raise::simple(format!(
            "{} has {count} number{} but {what} has {N}: ({names}).",
            shown(),
            if count == 1 { "" } else { "s" }
        )));
    }
    let mut result = [0.0; N];
    for (slot, item) in result.iter_mut().zip(&items) {
        *slot = number::to_f64(item).ok_or_else(|| {
            Raise::simple(format!(
                "{} in {} is not a number: {what} is a list ({names}).",
                print::to_string(image, item, true),
                shown()
            ))
        })?;
    }
    Ok(result)
}

/// A vector, or a list (x y z).
pub fn vector(image: &Image, argument: &Value) -> Result<Vector3> {
    match argument {
        Value::Cons(_) => numbers(image, argument, "a position", "x y z").map(Vector3),
        Value::Symbol(known::NIL, ..) => Err(Raise::type_error(argument, names::VECTOR_3D)),
        other => value::as_vector(other)
            .map(Vector3)
            .ok_or_else(|| Raise::type_error(other, names::VECTOR_3D)),
    }
}

/// A quaternion, or a list (x y z w).
pub fn quaternion(image: &Image, argument: &Value) -> Result<Quaternion> {
    match argument {
        Value::Cons(_) => numbers(image, argument, "a quaternion", "x y z w").map(Quaternion),
        other => value::as_quaternion(other)
            .map(Quaternion)
            .ok_or_else(|| Raise::type_error(other, names::QUATERNION)),
    }
}

/// A position and an orientation written as `((x y z) (x y z w))`.
pub(crate) fn placement_list(image: &Image, list: &Value) -> Result<Placement> {
    let parts = list.list_to_vec().unwrap_or_default();
    let [position, orientation] = parts.as_slice() else {
        return Err(Raise::simple(format!(
            "{} is not a pose: a pose is a list of two lists, ((x y z) (x y z w)), as in ((1 0 0.8) (0 0 0 1)).",
            print::to_string(image, list, true)
        )));
    };
    Ok(Placement {
        position: vector_part(image, position)?,
        orientation: quaternion_part(image, orientation)?,
    })
}

fn vector_part(image: &Image, part: &Value) -> Result<Vector3> {
    match value::as_vector(part) {
        Some(v) => Ok(Vector3(v)),
        None => numbers(image, part, "the position of a pose", "x y z").map(Vector3),
    }
}

fn quaternion_part(image: &Image, part: &Value) -> Result<Quaternion> {
    match value::as_quaternion(part) {
        Some(q) => Ok(Quaternion(q)),
        None => numbers(image, part, "the orientation of a pose", "x y z w").map(Quaternion),
    }
}

/// Any pose or transform, or a list `((x y z) (x y z w))`.
pub fn placement(image: &Image, argument: &Value) -> Result<Placement> {
    match argument {
        Value::Cons(_) => placement_list(image, argument),
        other => as_kind(other, names::POSE),
    }
}

/// Any pose or transform; `expected` is the type named in errors.
pub(crate) fn as_kind(argument: &Value, expected: Sym) -> Result<Placement> {
    value::as_placement(argument).ok_or_else(|| Raise::type_error(argument, expected))
}
