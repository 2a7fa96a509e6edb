//! Frames as JSON for the page.
//!
//! A frame is written as its difference from the one before: lengths in tenths of a millimetre,
//! quaternions in hundred-thousandths.

use std::fmt::Write;
use std::sync::Arc;

use crate::watch::{Frame, Path, Placed, Press};

/// Units per metre, and units per one in quaternions.
const METRE: f32 = 1e4;
const UNIT: f32 = 1e5;

/// The frame as a JSON object that holds the difference from the frame that the page has.
pub(crate) fn frame_json(frame: &Frame, before: Option<&Frame>) -> String {
    let mut text = String::with_capacity(4096);
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "{{\"t\":{:.4},\"whole\":{}",
        frame.time,
        before.is_none()
    );
    let known = before.map_or(&[][..], |b| &b.placed);
    let placed = frame.placed.iter();
    let moved = placed.filter(|p| {
        let then = known.binary_search_by_key(&p.node, |k| k.node);
        // An index found by the search is valid.
        then.map_or(true, |i| numbers(&known[i]) != numbers(p))
    });
    list(&mut text, "p", moved, |text, p| {
        let _ = write!(text, "{}", p.node);
        for number in numbers(p) {
            let _ = write!(text, ",{number}");
        }
    });
    let is_here = |p: &&Placed| {
        frame
            .placed
            .binary_search_by_key(&p.node, |k| k.node)
            .is_ok()
    };
    let gone = known.iter().filter(|p| !is_here(p));
    list(&mut text, "gone", gone, |text, p| {
        let _ = write!(text, "{}", p.node);
    });
    // Positions of joints that have changed, each after its index.
    let joints = before.map_or(&[][..], |b| &b.joints);
    let changed = frame.joints.iter().enumerate().filter_map(|(i, position)| {
        let now = joint_units(*position);
        let is_same = joints.get(i).is_some_and(|then| joint_units(*then) == now);
        (!is_same).then_some((i, now))
    });
    list(&mut text, "j", changed, |text, (i, position)| {
        let _ = write!(text, "{i},{position}");
    });
    list(&mut text, "held", &frame.holds, |text, hold| {
        let (object, link) = (hold.object, quoted(&hold.link));
        let _ = write!(text, "[{object},{link},{}]", hold.force);
    });
    if before.is_none_or(|b| b.presses != frame.presses) {
        list(&mut text, "touch", &frame.presses, press);
    }
    list(&mut text, "hits", &frame.hits, |text, hit| {
        let _ = write!(
            text,
            "{{\"nodes\":{:?},\"at\":{:?}}}",
            hit.nodes,
            units(hit.at, METRE)
        );
    });
    list(&mut text, "axes", &frame.axes, |text, (place, size)| {
        for number in numbers(place) {
            let _ = write!(text, "{number},");
        }
        let _ = write!(text, "{}", rounded(*size, METRE));
    });
    if before.is_none_or(|b| !Arc::ptr_eq(&b.paths, &frame.paths)) {
        list(&mut text, "paths", frame.paths.iter(), path);
    }
    text.push('}');
    text
}

/// Frames in order of time as a JSON list, each as its difference from the one before.
pub(crate) fn frames_json(frames: &[Arc<Frame>]) -> String {
    let mut before = None;
    let frames: Vec<String> = frames
        .iter()
        .map(|frame| frame_json(frame, before.replace(frame.as_ref())))
        .collect();
    format!("[{}]", frames.join(","))
}

/// The nodes of the body, -1 for the floor, and of the object, then the place and the force, in
/// tenths of a newton.
fn press(text: &mut String, press: &Press) {
    let body = press.body.map_or(-1, i64::from);
    let _ = write!(text, "[{body},{}", press.object);
    for number in units(press.at, METRE)
        .into_iter()
        .chain(units(press.force, 10.0))
    {
        let _ = write!(text, ",{number}");
    }
    text.push(']');
}

fn path(text: &mut String, path: &Path) {
    let frame = path.frame.map_or(-1, i64::from);
    let _ = write!(text, "{{\"what\":{:?},\"frame\":{frame}", path.what);
    list(text, "points", &path.points, |text, point| {
        let [x, y, z] = units(*point, METRE);
        let _ = write!(text, "{x},{y},{z}");
    });
    text.push('}');
}

/// Adds a list as a member of an object.
fn list<T>(
    text: &mut String,
    name: &str,
    items: impl IntoIterator<Item = T>,
    mut write_item: impl FnMut(&mut String, T),
) {
    let _ = write!(text, ",\"{name}\":[");
    for (i, item) in items.into_iter().enumerate() {
        if i > 0 {
            text.push(',');
        }
        write_item(text, item);
    }
    text.push(']');
}

/// Origin and quaternion in the page's units.
pub(super) fn numbers(placed: &Placed) -> [i32; 7] {
    let [x, y, z] = units(placed.at, METRE);
    let [i, j, k, w] = units(placed.turn, UNIT);
    [x, y, z, i, j, k, w]
}

fn units<const N: usize>(values: [f32; N], unit: f32) -> [i32; N] {
    values.map(|value| rounded(value, unit))
}

/// A joint's position in the page's units: ten-thousandths of a radian or of a metre.
fn joint_units(position: f64) -> i64 {
    // The cast saturates.
    (position * f64::from(METRE)).round() as i64
}

fn rounded(value: f32, unit: f32) -> i32 {
    // The cast saturates.
    (value * unit).round() as i32
}

/// The text as a JSON string.
pub(super) fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

#[cfg(test)]
mod tests {
    use crate::watch::Hold;
    use crate::watch::live::frame_json::*;
    use spatial::Pose;

    fn frame(x: f64) -> Frame {
        let still = Placed::new(1, &Pose::identity());
        Frame {
            time: 2.0,
            placed: vec![still, Placed::new(4, &Pose::translation(x, 0.0, -0.5))],
            holds: vec![Hold {
                object: 4,
                link: "a\"b".into(),
                force: 1.5,
            }],
            presses: vec![Press {
                body: None,
                object: 4,
                at: [0.5, 0.0, 0.1],
                force: [0.0, -0.2, 2.0],
            }],
            ..Frame::default()
        }
    }

    fn parsed(frame: &Frame, before: Option<&Frame>) -> serde_json::Value {
        serde_json::from_str(&frame_json(frame, before)).unwrap()
    }

    #[test]
    fn a_first_frame_is_whole() {
        let frame = parsed(&frame(1.0), None);
        assert_eq!(frame["whole"], true);
        let places = [
            1, 0, 0, 0, 0, 0, 0, 100_000, 4, 10_000, 0, -5_000, 0, 0, 0, 100_000,
        ];
        assert_eq!(frame["p"], serde_json::json!(places));
        assert_eq!(frame["held"], serde_json::json!([[4, "a\"b", 1.5]]));
        let press = [-1, 4, 5_000, 0, 1_000, 0, -2, 20];
        assert_eq!(frame["touch"], serde_json::json!([press]));
    }

    #[test]
    fn a_later_frame_tells_what_moved_and_what_is_gone() {
        let before = frame(1.0);
        assert_eq!(
            parsed(&frame(1.00001), Some(&before))["p"],
            serde_json::json!([])
        );
        let moved = parsed(&frame(1.001), Some(&before));
        assert_eq!(moved["touch"], serde_json::Value::Null, "as before");
        assert_eq!(moved["p"][0], 4);
        let mut empty = frame(1.0);
        empty.placed.pop();
        assert_eq!(
            parsed(&empty, Some(&before))["gone"],
            serde_json::json!([4])
        );
    }
}
