//! OBJ files (Wavefront), and the colours in the MTL files that they name.

use super::clean::{MAX_TRIANGLES, too_many};
use super::part::MeshPart;

/// The objects and groups of a file, each a part of its own; `colors` are those of materials by name.
pub(super) fn read(bytes: &[u8], colors: &[(String, [f32; 4])]) -> Result<Vec<MeshPart>, String> {
    let mut corners: Vec<[f64; 3]> = Vec::new();
    let mut parts: Vec<MeshPart> = vec![MeshPart::default()];
    // The place of each corner of the file in the present part, and the part for which it holds.
    let mut place_of: Vec<(u32, usize)> = Vec::new();
    let mut color = None;
    let mut count = 0;
    for (line, content) in (1..).zip(bytes.split(|byte| *byte == b'\n')) {
        let Ok(content) = std::str::from_utf8(content) else {
            continue;
        };
        let mut words = content.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                let mut number = || words.next()?.parse::<f64>().ok();
                match (number(), number(), number()) {
                    (Some(x), Some(y), Some(z)) => corners.push([x, y, z]),
                    _ => return Err(format!("line {line}: expected v and three numbers")),
                }
            }
            Some("o" | "g") => begin(&mut parts, color),
            Some("usemtl") => {
                let name = content
                    .trim_start()
                    .strip_prefix("usemtl")
                    .unwrap_or_default()
                    .trim();
                color = colors
                    .iter()
                    .find(|(known, _)| known == name)
                    .map(|(_, color)| *color);
                if parts.last().is_none_or(|part| part.color != color) {
                    begin(&mut parts, color);
                }
            }
            Some("f") => {
                let owner = parts.len();
                let Some(part) = parts.last_mut() else {
                    continue;
                };
                place_of.resize(corners.len(), (0, 0));
                let surface = &mut part.surface;
                let mut place = |word: &str| {
                    let number = word.split('/').next()?.parse::<i64>().ok()?;
                    let known = i64::try_from(corners.len()).ok()?;
                    let index = if number < 0 {
                        known + number
                    } else {
                        number - 1
                    };
                    let index = usize::try_from(index).ok()?;
                    let corner = corners.get(index)?;
                    let entry = place_of.get_mut(index)?;
                    if entry.1 != owner {
                        *entry = (surface.corners.len() as u32, owner);
                        surface.corners.push(*corner);
                    }
                    Some(entry.0)
                };
                let mut polygon = Vec::with_capacity(4);
                for word in words {
                    polygon.push(place(word).ok_or_else(|| {
                        format!(
                            "line {line}: {word:?} is no corner; there are {} so far",
                            corners.len()
                        )
                    })?);
                }
                count += polygon.len().saturating_sub(2);
                if count > MAX_TRIANGLES {
                    return Err(too_many(count));
                }
                for i in 2..polygon.len() {
                    surface
                        .triangles
                        .push([polygon[0], polygon[i - 1], polygon[i]]);
                }
            }
            _ => {}
        }
    }
    Ok(parts)
}

/// Begins a part, unless nothing is in the last one, which gets the colour instead.
fn begin(parts: &mut Vec<MeshPart>, color: Option<[f32; 4]>) {
    match parts.last_mut() {
        Some(part) if part.surface.triangles.is_empty() => part.color = color,
        _ => parts.push(MeshPart {
            color,
            ..MeshPart::default()
        }),
    }
}

/// The names of the files of materials that a file names.
pub(super) fn libraries(bytes: &[u8]) -> Vec<String> {
    let lines = bytes.split(|byte| *byte == b'\n');
    let named = lines.filter_map(|line| line.trim_ascii_start().strip_prefix(b"mtllib "));
    let names = named.filter_map(|name| std::str::from_utf8(name).ok());
    let names = names.map(|name| name.trim().to_owned());
    names.filter(|name| !name.is_empty()).take(8).collect()
}

/// The colours of the materials in an MTL file, by name.
pub(super) fn colors(bytes: &[u8]) -> Vec<(String, [f32; 4])> {
    let text = String::from_utf8_lossy(bytes);
    let mut found: Vec<(String, [f32; 4])> = Vec::new();
    for line in text.lines() {
        let line = line.trim();
        let (word, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let mut numbers = rest
            .split_whitespace()
            .map_while(|word| word.parse::<f32>().ok());
        let shade = |number: f32| {
            if number.is_finite() {
                number.clamp(0.0, 1.0)
            } else {
                0.5
            }
        };
        match (word, found.last_mut()) {
            ("newmtl", _) => found.push((rest.trim().to_owned(), [0.6, 0.6, 0.6, 1.0])),
            ("Kd", Some((_, color))) => {
                for (place, number) in color.iter_mut().zip(numbers.by_ref().take(3)) {
                    *place = shade(number);
                }
            }
            ("d", Some((_, color))) => color[3] = numbers.next().map_or(1.0, shade),
            ("Tr", Some((_, color))) => color[3] = 1.0 - numbers.next().map_or(0.0, shade),
            _ => {}
        }
    }
    found
}
