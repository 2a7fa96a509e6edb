//! The values in a description of a robot that are more than names and numbers.

use super::description::{DriveKind, Speed};
use super::mounted_frame::given_pose;
use crate::sexp::{DataError, Node, Record};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use spatial::Pose;

pub(super) fn drive_kind(node: Node<'_>) -> Result<DriveKind, DataError> {
    let name = node.symbol()?;
    let mut kinds = DriveKind::NAMED.iter();
    let kind = kinds
        .find(|(known, _)| *known == name)
        .map(|(_, kind)| *kind);
    kind.ok_or_else(|| node.expected("omnidirectional, differential or fixed"))
}

/// Where the base is after start-up: one that drives stands upright on the floor.
pub(super) fn base_start(node: Node<'_>, kind: DriveKind) -> Result<Pose, DataError> {
    let pose = given_pose(node)?;
    let up = pose.rotation * Vector3::z();
    if up.z < 1.0 - 1e-9 {
        return Err(node.expected("an upright pose; how a base leans or hangs is said by its URDF"));
    }
    match pose.translation.z == 0.0 || kind == DriveKind::Fixed {
        true => Ok(pose),
        false => Err(node.expected("a pose on the floor, with z 0, for a base that drives")),
    }
}

pub(super) fn optional_positive(record: &Record<'_>, key: &str) -> Result<Option<f64>, DataError> {
    record.optional(key).map(|node| node.positive()).transpose()
}

pub(super) fn speed(
    record: &Record<'_>,
    velocity: &str,
    acceleration: &str,
) -> Result<Speed, DataError> {
    Ok(Speed {
        velocity: record.required(velocity)?.positive()?,
        acceleration: record.required(acceleration)?.positive()?,
    })
}

/// A rotation, given as the rows of its matrix.
/// A rotation, and its third row.
pub(super) fn rotation(node: Node<'_>) -> Result<(UnitQuaternion<f64>, Vector3<f64>), DataError> {
    let wrong = || node.expected("the three rows of a rotation matrix");
    let rows = node.list().map_err(|_| wrong())?;
    let rows: Vec<[f64; 3]> = rows
        .iter()
        .map(Node::numbers::<3>)
        .collect::<Result<_, _>>()?;
    let [a, b, c] = <[[f64; 3]; 3]>::try_from(rows).map_err(|_| wrong())?;
    let matrix = Matrix3::from([a, b, c]).transpose();
    let error = (matrix * matrix.transpose() - Matrix3::identity()).norm();
    if error > 1e-6 || matrix.determinant() < 0.0 {
        return Err(wrong());
    }
    let rotation = Rotation3::from_matrix_unchecked(matrix);
    Ok((UnitQuaternion::from_rotation_matrix(&rotation), c.into()))
}

/// Length and width (m) of a pad.
pub(super) fn pad_size(node: Node<'_>) -> Result<[f64; 2], DataError> {
    match node.list()?.as_slice() {
        [length, width] => Ok([length.positive()?, width.positive()?]),
        _ => Err(node.expected("the length and the width of a pad")),
    }
}
