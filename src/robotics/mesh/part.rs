//! A part of a mesh in one colour.

use spatial::Polyhedron;

/// A part of a mesh in one colour.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshPart {
    /// Its surface (m), in the frame of the mesh.
    pub surface: Polyhedron,
    /// Linear colour, red green blue alpha in 0..1, if the file gives one.
    pub color: Option<[f32; 4]>,
}
