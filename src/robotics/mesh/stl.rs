//! STL files, binary and ASCII.

use super::clean::MAX_TRIANGLES;
use super::part::MeshPart;
use spatial::Polyhedron;

/// Bytes before the triangles of a binary file.
const HEADER: usize = 84;

/// Bytes of a triangle in a binary file.
const RECORD: usize = 50;

/// The triangles of a file. The size of a file tells a binary one from one of text, which many binary
/// ones pretend to be.
pub(super) fn read(bytes: &[u8]) -> Result<Vec<MeshPart>, String> {
    let surface = match binary_count(bytes) {
        _ if is_text(bytes) => ascii(bytes)?,
        Some(count) => binary(bytes, count)?,
        None => return Err("the file ends before the number of its triangles".to_owned()),
    };
    Ok(vec![MeshPart {
        surface,
        color: None,
    }])
}

/// The number of triangles that a binary file says to have.
fn binary_count(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(80..HEADER)?.try_into().ok()?;
    usize::try_from(u32::from_le_bytes(count)).ok()
}

/// Whether a file is of text. Many binary ones begin like one, but no text has bytes of value 0.
fn is_text(bytes: &[u8]) -> bool {
    let head = bytes.get(..bytes.len().min(HEADER)).unwrap_or_default();
    head.trim_ascii_start().starts_with(b"solid")
        && !head.contains(&0)
        && binary_count(bytes).is_none_or(|count| !fills(bytes, count))
}

/// Whether a binary file with so many triangles has just so many bytes.
fn fills(bytes: &[u8], count: usize) -> bool {
    bytes.len() as u64 == HEADER as u64 + RECORD as u64 * count as u64
}

fn binary(bytes: &[u8], count: usize) -> Result<Polyhedron, String> {
    let records = bytes.get(HEADER..).unwrap_or_default();
    if records.len() / RECORD < count {
        return Err(format!(
            "the file ends after {} of {count} triangles",
            records.len() / RECORD
        ));
    }
    if count > MAX_TRIANGLES {
        return Err(super::clean::too_many(count));
    }
    let mut surface = Polyhedron {
        corners: Vec::with_capacity(3 * count),
        triangles: Vec::with_capacity(count),
    };
    for record in records.chunks_exact(RECORD).take(count) {
        // A normal comes first, which follows from the corners.
        let numbers = record.get(12..48).unwrap_or_default().chunks_exact(4);
        let numbers: Vec<f64> = numbers
            .filter_map(|number| Some(f64::from(f32::from_le_bytes(number.try_into().ok()?))))
            .collect();
        add(&mut surface, &numbers);
    }
    Ok(surface)
}

fn add(surface: &mut Polyhedron, numbers: &[f64]) {
    let first = surface.corners.len() as u32;
    let corners = numbers.chunks_exact(3).map(|c| [c[0], c[1], c[2]]);
    surface.corners.extend(corners);
    surface.triangles.push([first, first + 1, first + 2]);
}

fn ascii(bytes: &[u8]) -> Result<Polyhedron, String> {
    let text = String::from_utf8_lossy(bytes);
    let mut surface = Polyhedron::default();
    let mut numbers = Vec::with_capacity(9);
    for (line, content) in (1..).zip(text.lines()) {
        let mut words = content.split_whitespace();
        match words.next() {
            Some("vertex") => {
                let before = numbers.len();
                numbers.extend(words.map_while(|word| word.parse::<f64>().ok()).take(3));
                if numbers.len() != before + 3 {
                    return Err(format!("line {line}: expected vertex and three numbers"));
                }
            }
            Some("endloop") => {
                // Facets with more corners are fans of triangles.
                for i in 1..(numbers.len() / 3).saturating_sub(1) {
                    let corners = [0, i, i + 1].into_iter();
                    let corners: Vec<f64> = corners
                        .flat_map(|c| numbers[3 * c..3 * c + 3].to_vec())
                        .collect();
                    add(&mut surface, &corners);
                }
                numbers.clear();
                if surface.triangles.len() > MAX_TRIANGLES {
                    return Err(super::clean::too_many(surface.triangles.len()));
                }
            }
            _ => {}
        }
    }
    match text.contains("endsolid") {
        true => Ok(surface),
        false => Err("the file ends before endsolid".to_owned()),
    }
}
