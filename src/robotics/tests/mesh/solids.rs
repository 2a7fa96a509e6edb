//! The convex bodies that stand for meshes.

use super::memory_files::{MemoryFiles, cuboid, load, only, stl};
use crate::mesh::{MeshPart, MeshPurpose};

fn solids(name: &str, bytes: Vec<u8>) -> Vec<MeshPart> {
    only(name, bytes, MeshPurpose::Solid).unwrap_or_else(|error| panic!("{error}"))
}

/// A trough: a floor and four walls, 1 cm thick, in one piece, open above.
fn trough() -> Vec<[[f32; 3]; 3]> {
    // The sides of a square tube's cross-section turned about z, from the outer floor to the inner one.
    let line = [[0.3f32, 0.0], [0.3, 0.2], [0.29, 0.2], [0.29, 0.01]];
    let ring = |[r, z]: [f32; 2]| [[r, r, z], [-r, r, z], [-r, -r, z], [r, -r, z]];
    let mut triangles = Vec::new();
    for pair in line.windows(2) {
        let (low, high) = (ring(pair[0]), ring(pair[1]));
        for i in 0..4 {
            let j = (i + 1) % 4;
            triangles.extend([[low[i], low[j], high[j]], [low[i], high[j], high[i]]]);
        }
    }
    for (corners, is_up) in [(ring(line[0]), false), (ring(line[3]), true)] {
        let [a, b, c, d] = corners;
        triangles.extend(match is_up {
            true => [[a, b, c], [a, c, d]],
            false => [[a, c, b], [a, d, c]],
        });
    }
    triangles
}

#[test]
fn a_box_is_one_body() {
    let parts = solids("a.stl", stl(&cuboid([0.0; 3], [1.0, 0.5, 0.25])));
    assert_eq!((parts.len(), parts[0].surface.corners.len()), (1, 8));
}

#[test]
fn boxes_that_do_not_touch_are_bodies_of_their_own() {
    let mut triangles = cuboid([0.0; 3], [1.0; 3]);
    triangles.extend(cuboid([2.0, 0.0, 0.0], [2.5, 0.5, 0.5]));
    // This one is inside the first and changes nothing.
    triangles.extend(cuboid([0.2; 3], [0.3; 3]));
    assert_eq!(solids("a.stl", stl(&triangles)).len(), 2);
}

#[test]
fn what_is_hollow_stays_hollow() {
    let bodies = solids("a.stl", stl(&trough()));
    assert!(bodies.len() >= 5, "{} bodies", bodies.len());
    let is_in = |point| {
        bodies
            .iter()
            .any(|body| body.surface.convex_contains(point))
    };
    assert!(is_in([0.0, 0.0, 0.005]) && is_in([0.295, 0.0, 0.1]));
    for point in [[0.0, 0.0, 0.1], [0.2, 0.2, 0.05], [-0.25, 0.0, 0.18]] {
        assert!(!is_in(point), "{point:?}");
    }
}

#[test]
fn a_sheet_gets_a_thickness() {
    let sheet = [
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]],
        [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
    ];
    let bodies = solids("a.stl", stl(&sheet));
    let bounds = bodies[0].surface.bounds().expect("it has corners");
    let thickness = bounds[1][2] - bounds[0][2];
    assert!(
        bodies.len() == 1 && (thickness - 1e-3).abs() < 1e-12,
        "{thickness}"
    );
}

#[test]
fn the_same_mesh_gives_the_same_bits_kept_or_not() {
    let files = MemoryFiles::of("/k/a.stl", stl(&trough()));
    let solid = || load(&files, "a.stl", [1.0, 1.5, 1.0], MeshPurpose::Solid).expect("it is right");
    let first = solid();
    assert_eq!(files.kept.lock().expect("nobody has panicked").len(), 1);
    assert_eq!(first, solid());
    // What is damaged is not believed.
    for bytes in files.kept.lock().expect("nobody has panicked").values_mut() {
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
    }
    assert_eq!(first, solid());
    files.kept.lock().expect("nobody has panicked").clear();
    assert_eq!(first, solid());
}
