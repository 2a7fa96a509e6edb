//! The schemas of the messages, as JSON Schema. Fields, types and titles are those by which
//! Foxglove recognises its schemas.

use serde_json::{Value, json};

fn object(fields: &[(&str, Value)]) -> Value {
    let names: Vec<&str> = fields.iter().map(|(name, _)| *name).collect();
    let properties = fields
        .iter()
        .map(|(name, kind)| (name.to_string(), kind.clone()));
    json!({
        "type": "object",
        "properties": properties.collect::<serde_json::Map<_, _>>(),
        "required": names,
    })
}

fn titled(title: &str, mut schema: Value) -> Value {
    if let Some(map) = schema.as_object_mut() {
        map.insert("title".to_owned(), title.into());
    }
    schema
}

fn list(of: Value) -> Value {
    json!({"type": "array", "items": of})
}

fn numbers(count: usize) -> Value {
    json!({"type": "array", "items": number(), "minItems": count, "maxItems": count})
}

fn number() -> Value {
    json!({"type": "number"})
}

fn integer() -> Value {
    json!({"type": "integer", "minimum": 0})
}

fn text() -> Value {
    json!({"type": "string"})
}

fn truth() -> Value {
    json!({"type": "boolean"})
}

fn time(title: &str) -> Value {
    let nanoseconds = json!({"type": "integer", "minimum": 0, "maximum": 999_999_999});
    titled(title, object(&[("sec", integer()), ("nsec", nanoseconds)]))
}

fn stamp() -> (&'static str, Value) {
    ("timestamp", time("time"))
}

fn components(title: &str, names: &[&'static str]) -> Value {
    let fields: Vec<_> = names.iter().map(|name| (*name, number())).collect();
    titled(title, object(&fields))
}

fn vector() -> Value {
    components("foxglove.Vector3", &["x", "y", "z"])
}

fn point() -> Value {
    components("foxglove.Point3", &["x", "y", "z"])
}

fn quaternion() -> Value {
    components("foxglove.Quaternion", &["x", "y", "z", "w"])
}

fn color() -> Value {
    components("foxglove.Color", &["r", "g", "b", "a"])
}

fn pose() -> Value {
    let fields = [("position", vector()), ("orientation", quaternion())];
    titled("foxglove.Pose", object(&fields))
}

/// Transforms between frames.
pub(crate) fn frame_transforms() -> Value {
    let transform = object(&[
        stamp(),
        ("parent_frame_id", text()),
        ("child_frame_id", text()),
        ("translation", vector()),
        ("rotation", quaternion()),
    ]);
    object(&[(
        "transforms",
        list(titled("foxglove.FrameTransform", transform)),
    )])
}

/// Bodies and lines.
pub(crate) fn scene_update() -> Value {
    let deletion = object(&[stamp(), ("type", integer()), ("id", text())]);
    let pair = object(&[("key", text()), ("value", text())]);
    let line = object(&[
        ("type", integer()),
        ("pose", pose()),
        ("thickness", number()),
        ("scale_invariant", truth()),
        ("points", list(point())),
        ("color", color()),
        ("colors", list(color())),
        ("indices", list(integer())),
    ]);
    let triangles = object(&[
        ("pose", pose()),
        ("points", list(point())),
        ("color", color()),
        ("colors", list(color())),
        ("indices", list(integer())),
    ]);
    // We write none of these.
    let other = |title: &str| list(titled(title, json!({"type": "object"})));
    let entity = object(&[
        stamp(),
        ("frame_id", text()),
        ("id", text()),
        ("lifetime", time("duration")),
        ("frame_locked", truth()),
        ("metadata", list(titled("foxglove.KeyValuePair", pair))),
        ("arrows", other("foxglove.ArrowPrimitive")),
        ("cubes", other("foxglove.CubePrimitive")),
        ("spheres", other("foxglove.SpherePrimitive")),
        ("cylinders", other("foxglove.CylinderPrimitive")),
        ("lines", list(titled("foxglove.LinePrimitive", line))),
        (
            "triangles",
            list(titled("foxglove.TriangleListPrimitive", triangles)),
        ),
        ("texts", other("foxglove.TextPrimitive")),
        ("models", other("foxglove.ModelPrimitive")),
    ]);
    object(&[
        (
            "deletions",
            list(titled("foxglove.SceneEntityDeletion", deletion)),
        ),
        ("entities", list(titled("foxglove.SceneEntity", entity))),
    ])
}

/// Positions of joints.
pub(crate) fn joint_states() -> Value {
    let joint = object(&[("name", text()), ("position", number())]);
    object(&[
        stamp(),
        ("joints", list(titled("foxglove.JointState", joint))),
    ])
}

/// A picture.
pub(crate) fn compressed_image() -> Value {
    let bytes = json!({"type": "string", "contentEncoding": "base64"});
    object(&[
        stamp(),
        ("frame_id", text()),
        ("data", bytes),
        ("format", text()),
    ])
}

/// The calibration of a camera.
pub(crate) fn camera_calibration() -> Value {
    object(&[
        stamp(),
        ("frame_id", text()),
        ("width", integer()),
        ("height", integer()),
        ("distortion_model", text()),
        ("D", list(number())),
        ("K", numbers(9)),
        ("R", numbers(9)),
        ("P", numbers(12)),
    ])
}

/// A log line.
pub(crate) fn log() -> Value {
    let names = ["UNKNOWN", "DEBUG", "INFO", "WARNING", "ERROR", "FATAL"];
    let level = |(value, name): (usize, &str)| json!({"title": name, "const": value});
    let levels: Vec<Value> = names.into_iter().enumerate().map(level).collect();
    let level = json!({"title": "foxglove.LogLevel", "oneOf": levels});
    object(&[
        stamp(),
        ("level", level),
        ("message", text()),
        ("name", text()),
        ("file", text()),
        ("line", integer()),
    ])
}

/// A task of a plan, or a motion.
pub(crate) fn task() -> Value {
    object(&[
        stamp(),
        ("id", text()),
        ("parent", text()),
        ("name", text()),
        ("state", text()),
        ("failure", text()),
    ])
}

/// What is shown besides bodies.
pub(crate) fn shown() -> Value {
    let held = object(&[("object", text()), ("link", text())]);
    let stop = object(&[("frames", list(text())), ("position", vector())]);
    let axes = object(&[("pose", pose()), ("length", number())]);
    let path = object(&[
        ("what", text()),
        ("frame_id", text()),
        ("points", list(point())),
    ]);
    object(&[
        stamp(),
        ("held", list(held)),
        ("touching", list(list(text()))),
        ("stops", list(stop)),
        ("axes", list(axes)),
        ("paths", list(path)),
    ])
}
