//! Meshes as binary data for the page.
//!
//! Numbers are little-endian. For each node: its number, the number of corners and of triangle
//! corners (u32 each); then each corner as three f32 (m), three i8 for the normal (127 is 1),
//! one u8 for the gloss, and four u8 for the linear colour (255 is 1; the square root of the
//! value, since dark colours need finer steps); then the triangles as u32.

use std::sync::Arc;

use crate::watch::Node;

/// The meshes of the nodes, one after the other.
pub(crate) fn mesh_bytes(nodes: &[Arc<Node>]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for node in nodes {
        let mesh = &node.mesh;
        let corners = mesh.triangles.len() * 3;
        for number in [node.id as usize, mesh.vertices.len(), corners] {
            bytes.extend(u32::try_from(number).unwrap_or(u32::MAX).to_le_bytes());
        }
        for vertex in &mesh.vertices {
            for number in vertex.at {
                bytes.extend(number.to_le_bytes());
            }
            // The casts saturate.
            let normal = vertex.normal.map(|n| (n * 127.0).round() as i8);
            bytes.extend(normal.map(|n| n.to_le_bytes()[0]));
            bytes.push(share(vertex.gloss));
            let [red, green, blue, alpha] = vertex.color;
            bytes.extend([red, green, blue].map(|c| share(c.max(0.0).sqrt())));
            bytes.push(share(alpha));
        }
        for corner in mesh.triangles.iter().flatten() {
            bytes.extend(corner.to_le_bytes());
        }
    }
    bytes
}

fn share(value: f32) -> u8 {
    (value * 255.0).round() as u8
}
