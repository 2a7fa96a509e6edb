//! Objects and furniture as markers, which rviz draws.

use std::time::Duration;

use super::{header, pose, xyz};
use crate::scene_state::{SceneModel, SceneState};
use crate::value::Value;
use spatial::{PlacedShape, Polyhedron, Pose, Shape};

/// Kinds of markers.
const BOX: i64 = 1;
const SPHERE: i64 = 2;
const CYLINDER: i64 = 3;
const TRIANGLES: i64 = 11;

/// What a message does with a marker.
const ADD: i64 = 0;
const DELETE_ALL: i64 = 3;

/// The colour of furniture that has none.
const WOOD: [f32; 4] = [0.76, 0.7, 0.6, 1.0];

/// All objects. Whoever gets the message forgets all markers that it has had before.
pub fn object_markers(stamp: Duration, model: &SceneModel, state: &SceneState) -> Value {
    let objects = state.objects.iter();
    let solids = objects.flat_map(|object| {
        let shapes = object.shapes.iter().enumerate();
        shapes.map(|(i, placed)| Solid {
            name: &object.name,
            number: i,
            carrier: &object.pose,
            placed,
            color: placed.color.unwrap_or(object.color),
        })
    });
    markers(stamp, model, solids)
}

/// All furniture, in the same way.
pub fn furniture_markers(stamp: Duration, model: &SceneModel, state: &SceneState) -> Value {
    let pieces = model.furniture.iter().zip(&state.furniture);
    let solids = pieces.flat_map(|((name, shapes), carrier)| {
        let shapes = shapes.iter().enumerate();
        shapes.map(move |(i, placed)| Solid {
            name,
            number: i,
            carrier,
            placed,
            color: placed.color.unwrap_or(WOOD),
        })
    });
    markers(stamp, model, solids)
}

/// A shape of a thing that is somewhere.
struct Solid<'a> {
    name: &'a str,
    number: usize,
    carrier: &'a Pose,
    placed: &'a PlacedShape,
    color: [f32; 4],
}

fn markers<'a>(
    stamp: Duration,
    model: &SceneModel,
    solids: impl Iterator<Item = Solid<'a>>,
) -> Value {
    let none_before = Value::record([
        ("header", header(stamp, model.map)),
        ("action", Value::Integer(DELETE_ALL)),
    ]);
    let solids = solids.map(|solid| marker(header(stamp, model.map), &solid));
    let all = std::iter::once(none_before).chain(solids);
    Value::record([("markers", Value::list(all))])
}

fn marker(header: Value, solid: &Solid<'_>) -> Value {
    let (kind, scale, points) = match &solid.placed.shape {
        Shape::Box { size } => (BOX, *size, Vec::new()),
        Shape::Cylinder { radius, length } => {
            (CYLINDER, [2.0 * radius, 2.0 * radius, *length], Vec::new())
        }
        Shape::Sphere { radius } => (SPHERE, [2.0 * radius; 3], Vec::new()),
        Shape::Hull(body) | Shape::Mesh(body) => (TRIANGLES, [1.0; 3], corners(body)),
    };
    let [r, g, b, a] = solid.color.map(f64::from);
    Value::record([
        ("header", header),
        ("ns", solid.name.into()),
        ("id", Value::Integer(solid.number as i64)),
        ("type", Value::Integer(kind)),
        ("action", Value::Integer(ADD)),
        ("pose", pose(&(solid.carrier * solid.placed.pose))),
        ("scale", xyz(scale)),
        (
            "color",
            Value::record([
                ("r", r.into()),
                ("g", g.into()),
                ("b", b.into()),
                ("a", a.into()),
            ]),
        ),
        ("points", Value::list(points)),
    ])
}

/// The corners of all triangles, three for each.
fn corners(body: &Polyhedron) -> Vec<Value> {
    let triangles = body.triangles.iter();
    let corners = triangles.flat_map(|triangle| body.triangle(*triangle));
    corners.map(xyz).collect()
}
