//! Nodes as entities of a scene message, and back.

use std::sync::Arc;

use indexmap::IndexMap;
use nalgebra::Vector3 as Direction;

use super::message::{
    Color, KeyValuePair, LinePrimitive, SceneEntity, Time, TriangleListPrimitive, Vector3,
};
use crate::watch::{Frame, Kind, Node, Path, Placed, Vertex, VisualMesh};

/// The frame in which everything is placed.
pub(super) const MAP: &str = "map";

/// Thickness of lines (pixels).
const LINE: f32 = 3.0;

/// Half the length (m) of the cross that marks where a motion was stopped.
const CROSS: f32 = 0.06;

/// The frame of a node.
pub(super) fn frame_of(node: &Node) -> String {
    match node.kind {
        Kind::Robot => node.name.clone(),
        Kind::Furniture => format!("kitchen/{}", node.name),
        Kind::Object => format!("object/{}", node.name),
    }
}

/// The node as an entity.
pub(super) fn entity(node: &Node, time: f64) -> SceneEntity {
    let pair = |key: &str, value: &str| KeyValuePair {
        key: key.to_owned(),
        value: value.to_owned(),
    };
    SceneEntity {
        timestamp: Time::new(time),
        frame_id: frame_of(node),
        id: node.id.to_string(),
        frame_locked: true,
        metadata: vec![
            pair("name", &node.name),
            pair("kind", node.kind.name()),
            pair("type", &node.type_name),
        ],
        triangles: triangle_lists(&node.mesh),
        ..SceneEntity::default()
    }
}

/// A mesh as lists of triangles, one for each colour, in the order in which the colours occur.
fn triangle_lists(mesh: &VisualMesh) -> Vec<TriangleListPrimitive> {
    let mut lists: IndexMap<[u32; 4], (TriangleListPrimitive, IndexMap<u32, u32>)> =
        IndexMap::new();
    for triangle in &mesh.triangles {
        let Some(first) = mesh.vertices.get(triangle[0] as usize) else {
            continue;
        };
        let (list, known) = lists.entry(first.color.map(f32::to_bits)).or_default();
        list.color = color(first.color);
        for corner in triangle {
            let Some(vertex) = mesh.vertices.get(*corner as usize) else {
                continue;
            };
            let next = u32::try_from(known.len()).unwrap_or(u32::MAX);
            let index = *known.entry(*corner).or_insert_with(|| {
                list.points.push(vertex.at.map(tidy).into());
                next
            });
            list.indices.push(index);
        }
    }
    lists.into_values().map(|(list, _)| list).collect()
}

/// Rounds to hundredths of a millimetre, to keep the text short.
pub(super) fn tidy(value: f32) -> f32 {
    (value * 1e5).round() / 1e5
}

/// The entity as a node with this number, if the entity is one of ours.
pub(super) fn node(entity: &SceneEntity, id: u32, still: Option<Placed>) -> Option<Node> {
    let kind = entity.metadata("kind")?;
    let kind = Kind::ALL.into_iter().find(|k| k.name() == kind)?;
    let mut mesh = VisualMesh::default();
    for list in &entity.triangles {
        let first = u32::try_from(mesh.vertices.len()).ok()?;
        let corners = list.points.iter().enumerate();
        mesh.vertices.extend(corners.map(|(i, point)| Vertex {
            at: (*point).into(),
            normal: [0.0, 0.0, 1.0],
            color: linear(*list.colors.get(i).unwrap_or(&list.color)),
            gloss: if kind == Kind::Furniture { 0.4 } else { 1.0 },
        }));
        let count = mesh.vertices.len();
        let triangles = list.indices.chunks_exact(3);
        mesh.triangles.extend(triangles.filter_map(|corners| {
            let corner = |i: usize| corners.get(i)?.checked_add(first);
            let triangle = [corner(0)?, corner(1)?, corner(2)?];
            triangle
                .iter()
                .all(|c| (*c as usize) < count)
                .then_some(triangle)
        }));
    }
    smooth(&mut mesh);
    Some(Node {
        id,
        name: entity.metadata("name")?.to_owned(),
        kind,
        type_name: entity.metadata("type").unwrap_or_default().to_owned(),
        parent: None,
        still,
        mesh: mesh.into(),
        shapes: Arc::default(),
    })
}

/// Gives each corner the area-weighted mean of the normals of the adjacent triangles: faces
/// stay flat, and bevelled edges look round.
fn smooth(mesh: &mut VisualMesh) {
    let mut sums = vec![Direction::<f32>::zeros(); mesh.vertices.len()];
    for triangle in &mesh.triangles {
        // The indices of triangles were checked before.
        let [a, b, c] = triangle.map(|i| Direction::from(mesh.vertices[i as usize].at));
        let outward = (b - a).cross(&(c - a));
        for corner in triangle {
            sums[*corner as usize] += outward;
        }
    }
    for (vertex, sum) in mesh.vertices.iter_mut().zip(sums) {
        if let Some(normal) = sum.try_normalize(1e-20) {
            vertex.normal = normal.into();
        }
    }
}

/// What is shown besides bodies, as lines.
pub(super) fn lines(frame: &Frame, frame_id: impl Fn(u32) -> Option<String>) -> Vec<SceneEntity> {
    let plain = |rgb: [f32; 3]| Color {
        r: rgb[0],
        g: rgb[1],
        b: rgb[2],
        a: 1.0,
    };
    let entity = |id: String, frame_id: String, line: LinePrimitive| SceneEntity {
        timestamp: Time::new(frame.time),
        frame_id,
        id,
        frame_locked: true,
        lines: vec![line],
        ..SceneEntity::default()
    };
    let mut entities = Vec::new();
    for path in frame.paths.iter() {
        let color = match path.what {
            "base" => [0.1, 0.45, 0.8],
            "left" => [0.1, 0.62, 0.42],
            _ => [0.62, 0.32, 0.76],
        };
        let line = LinePrimitive {
            kind: 0,
            thickness: LINE,
            scale_invariant: true,
            points: path.points.iter().map(|p| (*p).into()).collect(),
            color: plain(color),
            ..LinePrimitive::default()
        };
        let frame_id = path
            .frame
            .and_then(&frame_id)
            .unwrap_or_else(|| MAP.to_owned());
        entities.push(entity(format!("way of {}", path.what), frame_id, line));
    }
    for (i, hit) in frame.hits.iter().enumerate() {
        let ends = (0..3).flat_map(|axis| [-CROSS, CROSS].map(|d| moved(hit.at, axis, d)));
        let line = LinePrimitive {
            kind: 2,
            thickness: LINE,
            scale_invariant: true,
            points: ends.collect(),
            color: plain([0.9, 0.1, 0.05]),
            ..LinePrimitive::default()
        };
        entities.push(entity(format!("stop {i}"), MAP.to_owned(), line));
    }
    if let Some((place, size)) = &frame.axes {
        let axes = 0..3;
        let line = LinePrimitive {
            kind: 2,
            thickness: LINE,
            scale_invariant: true,
            pose: crate::watch::recording::message::PoseMessage {
                position: place.at.into(),
                orientation: place.turn.into(),
            },
            points: axes
                .clone()
                .flat_map(|a| [0.0, *size].map(|d| moved([0.0; 3], a, d)))
                .collect(),
            colors: axes.flat_map(|a| [a; 2]).map(|a| plain(unit(a))).collect(),
            ..LinePrimitive::default()
        };
        entities.push(entity("axes".to_owned(), MAP.to_owned(), line));
    }
    entities
}

fn unit(axis: usize) -> [f32; 3] {
    [0, 1, 2].map(|i| if i == axis { 1.0 } else { 0.0 })
}

fn moved(at: [f32; 3], axis: usize, distance: f32) -> Vector3 {
    let [x, y, z] = unit(axis);
    [
        at[0] + x * distance,
        at[1] + y * distance,
        at[2] + z * distance,
    ]
    .into()
}

/// The name of something that has a path, as in [`Path::WHAT`].
pub(crate) fn path_name(text: &str) -> Option<&'static str> {
    Path::WHAT.into_iter().find(|what| *what == text)
}

/// A linear colour in sRGB.
pub(super) fn color([r, g, b, a]: [f32; 4]) -> Color {
    let [r, g, b] = [r, g, b].map(|light| {
        let value = match light.clamp(0.0, 1.0) {
            l if l <= 0.003_130_8 => 12.92 * l,
            l => 1.055 * libm::powf(l, 1.0 / 2.4) - 0.055,
        };
        (value * 1e3).round() / 1e3
    });
    Color { r, g, b, a }
}

/// An sRGB colour as a linear one.
fn linear(Color { r, g, b, a }: Color) -> [f32; 4] {
    let [r, g, b] = [r, g, b].map(|value| match value.clamp(0.0, 1.0) {
        v if v <= 0.040_45 => v / 12.92,
        v => libm::powf((v + 0.055) / 1.055, 2.4),
    });
    [r, g, b, a]
}
