//! What is kept of a mesh that has been read, as bytes.

use sha2::{Digest, Sha256};

use super::part::MeshPart;
use spatial::Polyhedron;

/// Changes whenever the same file would give something else.
const VERSION: &[u8] = b"planwright mesh 1\n";

/// Bytes of a digest.
const DIGEST: usize = 32;

/// The name under which parts are kept that were made of some bytes.
pub(super) fn name(made_of: &[&[u8]]) -> String {
    let mut digest = Sha256::new();
    digest.update(VERSION);
    for bytes in made_of {
        digest.update((bytes.len() as u64).to_le_bytes());
        digest.update(bytes);
    }
    let digest = digest.finalize();
    let digits = digest.iter().map(|byte| format!("{byte:02x}"));
    digits.collect::<String>() + ".mesh"
}

/// The bytes of parts, after a digest of them.
pub(super) fn bytes_of(parts: &[MeshPart]) -> Vec<u8> {
    let mut bytes = vec![0; DIGEST];
    bytes.extend((parts.len() as u32).to_le_bytes());
    for MeshPart { surface, color } in parts {
        let shades = color.unwrap_or([f32::NAN; 4]);
        bytes.extend(shades.iter().flat_map(|shade| shade.to_le_bytes()));
        bytes.extend((surface.corners.len() as u32).to_le_bytes());
        bytes.extend((surface.triangles.len() as u32).to_le_bytes());
        let numbers = surface.corners.iter().flatten();
        bytes.extend(numbers.flat_map(|number| number.to_le_bytes()));
        let places = surface.triangles.iter().flatten();
        bytes.extend(places.flat_map(|place| place.to_le_bytes()));
    }
    let digest = Sha256::digest(bytes.get(DIGEST..).unwrap_or_default());
    if let Some(start) = bytes.get_mut(..DIGEST) {
        start.copy_from_slice(&digest);
    }
    bytes
}

/// The parts that the bytes are of; `None` if they are not whole.
pub(super) fn parts_of(bytes: &[u8]) -> Option<Vec<MeshPart>> {
    let (digest, mut rest) = bytes.split_at_checked(DIGEST)?;
    if Sha256::digest(rest).as_slice() != digest {
        return None;
    }
    let mut parts = Vec::new();
    for _ in 0..count(&mut rest)? {
        let mut color = [0.0; 4];
        for shade in &mut color {
            *shade = f32::from_le_bytes(taken(&mut rest)?);
        }
        let (corners, triangles) = (count(&mut rest)?, count(&mut rest)?);
        let mut surface = Polyhedron::default();
        let (numbers, after) = rest.split_at_checked(corners.checked_mul(24)?)?;
        surface.corners.reserve_exact(corners);
        for corner in numbers.chunks_exact(24) {
            let mut numbers = corner.chunks_exact(8).filter_map(|n| n.try_into().ok());
            let mut next = || numbers.next().map(f64::from_le_bytes);
            surface.corners.push([next()?, next()?, next()?]);
        }
        let (places, after) = after.split_at_checked(triangles.checked_mul(12)?)?;
        surface.triangles.reserve_exact(triangles);
        for triangle in places.chunks_exact(12) {
            let mut places = triangle.chunks_exact(4).filter_map(|n| n.try_into().ok());
            let mut next = || places.next().map(u32::from_le_bytes);
            surface.triangles.push([next()?, next()?, next()?]);
        }
        if surface
            .triangles
            .iter()
            .flatten()
            .any(|place| *place as usize >= corners)
        {
            return None;
        }
        rest = after;
        parts.push(MeshPart {
            surface,
            color: (!color[0].is_nan()).then_some(color),
        });
    }
    rest.is_empty().then_some(parts)
}

fn taken<const N: usize>(rest: &mut &[u8]) -> Option<[u8; N]> {
    let (taken, after) = rest.split_first_chunk()?;
    *rest = after;
    Some(*taken)
}

fn count(rest: &mut &[u8]) -> Option<usize> {
    usize::try_from(u32::from_le_bytes(taken(rest)?)).ok()
}
