//! The connected parts of a surface.

use spatial::Polyhedron;

/// The parts of a surface that share no corner, in the order of their first triangles.
pub(super) fn connected(surface: &Polyhedron) -> Vec<Polyhedron> {
    let mut leader: Vec<u32> = (0..surface.corners.len() as u32).collect();
    for [a, b, c] in &surface.triangles {
        let first = find(&mut leader, *a);
        for other in [b, c] {
            let other = find(&mut leader, *other);
            leader[other as usize] = first;
        }
    }
    let mut part_of: Vec<Option<usize>> = vec![None; surface.corners.len()];
    let mut place_of = vec![u32::MAX; surface.corners.len()];
    let mut parts: Vec<Polyhedron> = Vec::new();
    for triangle in &surface.triangles {
        let first = find(&mut leader, triangle[0]) as usize;
        let place = *part_of[first].get_or_insert_with(|| {
            parts.push(Polyhedron::default());
            parts.len() - 1
        });
        let part = &mut parts[place];
        let triangle = triangle.map(|corner| {
            let known = &mut place_of[corner as usize];
            if *known == u32::MAX {
                *known = part.corners.len() as u32;
                part.corners.push(surface.corners[corner as usize]);
            }
            *known
        });
        part.triangles.push(triangle);
    }
    parts
}

/// The corner that stands for the part of a corner.
fn find(leader: &mut [u32], mut corner: u32) -> u32 {
    while leader[corner as usize] != corner {
        let next = leader[leader[corner as usize] as usize];
        leader[corner as usize] = next;
        corner = next;
    }
    corner
}
