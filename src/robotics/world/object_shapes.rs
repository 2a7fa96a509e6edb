//! The shapes of a type of objects as a data file gives them.

use std::sync::Arc;

use crate::mesh::{MeshLibrary, MeshPart, MeshPurpose, MeshRequest};
use crate::sexp::{DataError, DataProblem, Node, Record};
use spatial::pose::from_xyz_rpy;
use spatial::{PlacedShape, Polyhedron, Pose, Shape};

/// Shapes, each with its keys besides `at` and `rpy`.
const SHAPES: &[(&str, &[&str])] = &[
    ("box", &["at", "rpy", "size"]),
    ("cylinder", &["at", "rpy", "radius", "length"]),
    ("sphere", &["at", "rpy", "radius"]),
    ("ring", &["at", "rpy", "count", "radius", "stave", "lean"]),
    ("mesh", &["at", "rpy", "scale"]),
];

/// Distance (m) of an axis from the object's up to which it counts as the same.
const OFF_AXIS: f64 = 0.0025;

/// The longest edge (m) of an object from a mesh: a longer one is in another unit.
const MAX_EDGE: f64 = 5.0;

/// Share of its radius by which a mesh that counts as round may be out of round.
const OUT_OF_ROUND: f64 = 0.045;

/// Shapes of a type of objects.
pub(super) struct ObjectShapes {
    /// What is solid; not empty.
    pub(super) solids: Vec<PlacedShape>,
    /// What is shown.
    pub(super) looks: Vec<PlacedShape>,
    /// Whether all of them are round about the object's z axis.
    pub(super) is_round: bool,
}

impl ObjectShapes {
    /// Reads a list of shapes.
    pub(super) fn read(list: Node<'_>, meshes: &MeshLibrary<'_>) -> Result<Self, DataError> {
        let mut read = Self {
            solids: Vec::new(),
            looks: Vec::new(),
            is_round: true,
        };
        for node in list.list()? {
            let record = node.record("shape", SHAPES)?;
            if record.head() == "mesh" {
                read.add_mesh(&record, meshes)?;
                continue;
            }
            let first = read.solids.len();
            add_primitive(&record, &mut read.solids)?;
            read.looks.extend_from_slice(&read.solids[first..]);
            read.is_round &= is_round(&record)?;
        }
        match read.solids.is_empty() {
            true => Err(list.expected("at least one shape")),
            false => Ok(read),
        }
    }

    /// Adds a mesh: as it is to the looks, its convex bodies to the solids.
    fn add_mesh(&mut self, record: &Record<'_>, meshes: &MeshLibrary<'_>) -> Result<(), DataError> {
        let file = record.thing("name of a file")?;
        let scale = record.optional("scale").map_or(Ok([1.0; 3]), scale_of)?;
        let wanted = [MeshPurpose::Solid, MeshPurpose::Looks].map(|purpose| MeshRequest {
            file: file.text().map(str::to_owned).unwrap_or_default(),
            scale,
            purpose,
        });
        file.text()?;
        let mut found = Vec::new();
        for parts in meshes.load(&wanted) {
            let parts = parts.map_err(|error| file.error(DataProblem::Invalid(error.to_string())));
            found.push(parts?);
        }
        let [solids, looks] = <[Vec<MeshPart>; 2]>::try_from(found).unwrap_or_default();
        check_size(file, &solids)?;
        let pose = place_of(record)?;
        let surfaces = looks.iter().map(|part| &part.surface);
        self.is_round &= pose.rotation.angle() == 0.0 && is_turned(surfaces, &pose);
        let placed = |shape, color| PlacedShape { shape, pose, color };
        let hulls = solids.into_iter();
        self.solids
            .extend(hulls.map(|part| placed(Shape::Hull(Arc::new(part.surface)), None)));
        self.looks.extend(
            looks
                .into_iter()
                .map(|part| placed(Shape::Mesh(Arc::new(part.surface)), part.color)),
        );
        Ok(())
    }
}

/// The factors of a scale: one for all axes, or one for each.
fn scale_of(node: Node<'_>) -> Result<[f64; 3], DataError> {
    let wrong = || node.expected("a number or three numbers, none of which is 0");
    let scale = node
        .number()
        .map(|one| [one; 3])
        .or_else(|_| node.numbers::<3>());
    let scale = scale.map_err(|_| wrong())?;
    match scale.contains(&0.0) {
        true => Err(wrong()),
        false => Ok(scale),
    }
}

/// An error if the mesh is as large as furniture.
fn check_size(file: Node<'_>, parts: &[MeshPart]) -> Result<(), DataError> {
    let bounds = parts.iter().filter_map(|part| part.surface.bounds());
    let edge = bounds.fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], |all, one| {
        [
            std::array::from_fn(|i| f64::min(all[0][i], one[0][i])),
            std::array::from_fn(|i| f64::max(all[1][i], one[1][i])),
        ]
    });
    let longest = (0..3).map(|i| edge[1][i] - edge[0][i]).fold(0.0, f64::max);
    if longest <= MAX_EDGE {
        return Ok(());
    }
    Err(file.error(DataProblem::Invalid(format!(
        "the mesh is {longest:.1} m long: if its numbers are millimetres, add :scale 0.001"
    ))))
}

/// Whether surfaces are the same from all sides of the z axis, as far as their corners tell: in each of
/// some layers, they reach equally far to all sides.
fn is_turned<'a>(surfaces: impl Iterator<Item = &'a Polyhedron> + Clone, pose: &Pose) -> bool {
    const LAYERS: usize = 6;
    const SIDES: usize = 24;
    let corners = surfaces
        .flat_map(|surface| &surface.corners)
        .map(|[x, y, z]| pose * nalgebra::Point3::new(*x, *y, *z));
    let (low, high) = corners
        .clone()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), corner| {
            (low.min(corner.z), high.max(corner.z))
        });
    let height = high - low;
    if !height.is_finite() || height <= 0.0 {
        return false;
    }
    let mut reach = [[f64::NEG_INFINITY; SIDES]; LAYERS];
    for corner in corners {
        let layer = ((corner.z - low) / height * LAYERS as f64) as usize;
        for (side, reach) in reach[layer.min(LAYERS - 1)].iter_mut().enumerate() {
            let (sine, cosine) =
                spatial::trig::sin_cos(std::f64::consts::TAU * side as f64 / SIDES as f64);
            *reach = reach.max(corner.x * cosine + corner.y * sine);
        }
    }
    reach.iter().all(|sides| {
        let most = sides.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let least = sides.iter().copied().fold(f64::INFINITY, f64::min);
        most == f64::NEG_INFINITY || most - least <= OFF_AXIS.max(OUT_OF_ROUND * most)
    })
}

/// Where a shape is.
fn place_of(record: &Record<'_>) -> Result<Pose, DataError> {
    let numbers = |key: &str| {
        record
            .optional(key)
            .map_or(Ok([0.0; 3]), |n| n.numbers::<3>())
    };
    Ok(from_xyz_rpy(numbers("at")?, numbers("rpy")?))
}

/// Whether a shape is round about the object's z axis; a ring of boxes stands for a round wall.
fn is_round(record: &Record<'_>) -> Result<bool, DataError> {
    let numbers = |key: &str| {
        record
            .optional(key)
            .map_or(Ok([0.0; 3]), |n| n.numbers::<3>())
    };
    let ([x, y, _], [roll, pitch, _]) = (numbers("at")?, numbers("rpy")?);
    let is_centred = libm::hypot(x, y) < OFF_AXIS;
    Ok(match record.head() {
        "box" => false,
        "sphere" => is_centred,
        _ => is_centred && roll == 0.0 && pitch == 0.0,
    })
}

/// Adds a primitive, or the boxes of a ring.
fn add_primitive(record: &Record<'_>, solids: &mut Vec<PlacedShape>) -> Result<(), DataError> {
    let size = |key: &str| {
        let node = record.required(key)?;
        let size = node.numbers::<3>()?;
        match size.iter().all(|s| *s > 0.0) {
            true => Ok(size),
            false => Err(node.expected("three numbers above 0")),
        }
    };
    let pose = place_of(record)?;
    let shape = match record.head() {
        "box" => Shape::Box {
            size: size("size")?,
        },
        "cylinder" => Shape::Cylinder {
            radius: record.required("radius")?.positive()?,
            length: record.required("length")?.positive()?,
        },
        "sphere" => Shape::Sphere {
            radius: record.required("radius")?.positive()?,
        },
        _ => {
            let count_node = record.required("count")?;
            let count = count_node.count()?;
            if !(3..=64).contains(&count) {
                return Err(count_node.expected("a whole number from 3 to 64"));
            }
            let radius = record.required("radius")?.positive()?;
            let stave = Shape::Box {
                size: size("stave")?,
            };
            let lean = record.optional("lean").map_or(Ok(0.0), |lean| {
                let angle = lean.number()?;
                match angle.abs() < std::f64::consts::FRAC_PI_2 {
                    true => Ok(angle),
                    false => Err(lean.expected("an angle (rad) below a quarter turn")),
                }
            })?;
            solids.extend((0..count).map(|i| {
                let turn = std::f64::consts::TAU * i as f64 / count as f64;
                let turned = from_xyz_rpy([0.0; 3], [0.0, 0.0, turn]);
                let out = from_xyz_rpy([radius, 0.0, 0.0], [0.0, lean, 0.0]);
                PlacedShape {
                    shape: stave.clone(),
                    pose: pose * turned * out,
                    color: None,
                }
            }));
            return Ok(());
        }
    };
    solids.push(PlacedShape {
        shape,
        pose,
        color: None,
    });
    Ok(())
}
