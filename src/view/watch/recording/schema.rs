//! The schemas of the messages, as tables of their fields: names, numbers and types are those of
//! Foxglove's published Protobuf schemas; messages of package `planwright` are our own.
//!
//! The tables make the descriptors in the file, and translate messages between Protobuf and the
//! JSON of [`super::message`].

/// A type of messages.
pub(crate) struct MessageType {
    /// Its full name, as in `foxglove.Pose`.
    pub name: &'static str,
    pub(crate) fields: &'static [Field],
    /// The enumeration that it defines.
    pub names: Option<&'static Names>,
}

/// An enumeration inside a message.
pub(super) struct Names {
    pub name: &'static str,
    /// The names of the values from zero on.
    pub values: &'static [&'static str],
}

/// A field of a message.
pub(crate) struct Field {
    pub name: &'static str,
    /// Its name in JSON, if that is another one.
    pub json: &'static str,
    pub number: u32,
    pub kind: Kind,
    pub count: Count,
}

/// The type of a field.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    Double,
    Int64,
    Int32,
    Fixed32,
    Bool,
    Text,
    /// Bytes; in JSON, base64.
    Bytes,
    Names(&'static Names),
    Message(&'static MessageType),
}

/// How often a field occurs.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Count {
    One,
    /// Whether it is there matters.
    Optional,
    Many,
}

impl MessageType {
    /// Package and simple name.
    pub(super) fn parts(&self) -> (&'static str, &'static str) {
        self.name.rsplit_once('.').unwrap_or(("", self.name))
    }
}

const fn one(number: u32, name: &'static str, kind: Kind) -> Field {
    Field {
        name,
        json: name,
        number,
        kind,
        count: Count::One,
    }
}

const fn many(number: u32, name: &'static str, kind: Kind) -> Field {
    Field {
        count: Count::Many,
        ..one(number, name, kind)
    }
}

const fn optional(number: u32, name: &'static str, kind: Kind) -> Field {
    Field {
        count: Count::Optional,
        ..one(number, name, kind)
    }
}

/// A field with another name in JSON.
const fn called(json: &'static str, field: Field) -> Field {
    Field { json, ..field }
}

const fn message(name: &'static str, fields: &'static [Field]) -> MessageType {
    MessageType {
        name,
        fields,
        names: None,
    }
}

static TIMESTAMP: MessageType = message(
    "google.protobuf.Timestamp",
    &[
        called("sec", one(1, "seconds", Kind::Int64)),
        called("nsec", one(2, "nanos", Kind::Int32)),
    ],
);

static DURATION: MessageType = message(
    "google.protobuf.Duration",
    &[
        called("sec", one(1, "seconds", Kind::Int64)),
        called("nsec", one(2, "nanos", Kind::Int32)),
    ],
);

const TIME: Kind = Kind::Message(&TIMESTAMP);

static VECTOR3: MessageType = message(
    "foxglove.Vector3",
    &[
        one(1, "x", Kind::Double),
        one(2, "y", Kind::Double),
        one(3, "z", Kind::Double),
    ],
);

static POINT3: MessageType = message(
    "foxglove.Point3",
    &[
        one(1, "x", Kind::Double),
        one(2, "y", Kind::Double),
        one(3, "z", Kind::Double),
    ],
);

static QUATERNION: MessageType = message(
    "foxglove.Quaternion",
    &[
        one(1, "x", Kind::Double),
        one(2, "y", Kind::Double),
        one(3, "z", Kind::Double),
        one(4, "w", Kind::Double),
    ],
);

static COLOR: MessageType = message(
    "foxglove.Color",
    &[
        one(1, "r", Kind::Double),
        one(2, "g", Kind::Double),
        one(3, "b", Kind::Double),
        one(4, "a", Kind::Double),
    ],
);

static POSE: MessageType = message(
    "foxglove.Pose",
    &[
        one(1, "position", Kind::Message(&VECTOR3)),
        one(2, "orientation", Kind::Message(&QUATERNION)),
    ],
);

static KEY_VALUE_PAIR: MessageType = message(
    "foxglove.KeyValuePair",
    &[one(1, "key", Kind::Text), one(2, "value", Kind::Text)],
);

static FRAME_TRANSFORM: MessageType = message(
    "foxglove.FrameTransform",
    &[
        one(1, "timestamp", TIME),
        one(2, "parent_frame_id", Kind::Text),
        one(3, "child_frame_id", Kind::Text),
        one(4, "translation", Kind::Message(&VECTOR3)),
        one(5, "rotation", Kind::Message(&QUATERNION)),
    ],
);

/// Transforms between frames.
pub(crate) static FRAME_TRANSFORMS: MessageType = message(
    "foxglove.FrameTransforms",
    &[many(1, "transforms", Kind::Message(&FRAME_TRANSFORM))],
);

static ARROW: MessageType = message(
    "foxglove.ArrowPrimitive",
    &[
        one(1, "pose", Kind::Message(&POSE)),
        one(2, "shaft_length", Kind::Double),
        one(3, "shaft_diameter", Kind::Double),
        one(4, "head_length", Kind::Double),
        one(5, "head_diameter", Kind::Double),
        one(6, "color", Kind::Message(&COLOR)),
    ],
);

static CUBE: MessageType = message(
    "foxglove.CubePrimitive",
    &[
        one(1, "pose", Kind::Message(&POSE)),
        one(2, "size", Kind::Message(&VECTOR3)),
        one(3, "color", Kind::Message(&COLOR)),
    ],
);

static SPHERE: MessageType = message(
    "foxglove.SpherePrimitive",
    &[
        one(1, "pose", Kind::Message(&POSE)),
        one(2, "size", Kind::Message(&VECTOR3)),
        one(3, "color", Kind::Message(&COLOR)),
    ],
);

static CYLINDER: MessageType = message(
    "foxglove.CylinderPrimitive",
    &[
        one(1, "pose", Kind::Message(&POSE)),
        one(2, "size", Kind::Message(&VECTOR3)),
        one(3, "bottom_scale", Kind::Double),
        one(4, "top_scale", Kind::Double),
        one(5, "color", Kind::Message(&COLOR)),
    ],
);

static LINE_TYPE: Names = Names {
    name: "Type",
    values: &["LINE_STRIP", "LINE_LOOP", "LINE_LIST"],
};

static LINE: MessageType = MessageType {
    names: Some(&LINE_TYPE),
    ..message(
        "foxglove.LinePrimitive",
        &[
            one(1, "type", Kind::Names(&LINE_TYPE)),
            one(2, "pose", Kind::Message(&POSE)),
            one(3, "thickness", Kind::Double),
            one(4, "scale_invariant", Kind::Bool),
            many(5, "points", Kind::Message(&POINT3)),
            one(6, "color", Kind::Message(&COLOR)),
            many(7, "colors", Kind::Message(&COLOR)),
            many(8, "indices", Kind::Fixed32),
        ],
    )
};

static TRIANGLES: MessageType = message(
    "foxglove.TriangleListPrimitive",
    &[
        one(1, "pose", Kind::Message(&POSE)),
        many(2, "points", Kind::Message(&POINT3)),
        one(3, "color", Kind::Message(&COLOR)),
        many(4, "colors", Kind::Message(&COLOR)),
        many(5, "indices", Kind::Fixed32),
    ],
);

static TEXT: MessageType = message(
    "foxglove.TextPrimitive",
    &[
        one(1, "pose", Kind::Message(&POSE)),
        one(2, "billboard", Kind::Bool),
        one(3, "font_size", Kind::Double),
        one(4, "scale_invariant", Kind::Bool),
        one(5, "color", Kind::Message(&COLOR)),
        one(6, "text", Kind::Text),
    ],
);

static MODEL: MessageType = message(
    "foxglove.ModelPrimitive",
    &[
        one(1, "pose", Kind::Message(&POSE)),
        one(2, "scale", Kind::Message(&VECTOR3)),
        one(3, "color", Kind::Message(&COLOR)),
        one(4, "override_color", Kind::Bool),
        one(5, "url", Kind::Text),
        one(6, "media_type", Kind::Text),
        one(7, "data", Kind::Bytes),
    ],
);

static SCENE_ENTITY: MessageType = message(
    "foxglove.SceneEntity",
    &[
        one(1, "timestamp", TIME),
        one(2, "frame_id", Kind::Text),
        one(3, "id", Kind::Text),
        one(4, "lifetime", Kind::Message(&DURATION)),
        one(5, "frame_locked", Kind::Bool),
        many(6, "metadata", Kind::Message(&KEY_VALUE_PAIR)),
        many(7, "arrows", Kind::Message(&ARROW)),
        many(8, "cubes", Kind::Message(&CUBE)),
        many(9, "spheres", Kind::Message(&SPHERE)),
        many(10, "cylinders", Kind::Message(&CYLINDER)),
        many(11, "lines", Kind::Message(&LINE)),
        many(12, "triangles", Kind::Message(&TRIANGLES)),
        many(13, "texts", Kind::Message(&TEXT)),
        many(14, "models", Kind::Message(&MODEL)),
    ],
);

static DELETION_TYPE: Names = Names {
    name: "Type",
    values: &["MATCHING_ID", "ALL"],
};

static SCENE_ENTITY_DELETION: MessageType = MessageType {
    names: Some(&DELETION_TYPE),
    ..message(
        "foxglove.SceneEntityDeletion",
        &[
            one(1, "timestamp", TIME),
            one(2, "type", Kind::Names(&DELETION_TYPE)),
            one(3, "id", Kind::Text),
        ],
    )
};

/// Bodies, lines and texts.
pub(crate) static SCENE_UPDATE: MessageType = message(
    "foxglove.SceneUpdate",
    &[
        many(1, "deletions", Kind::Message(&SCENE_ENTITY_DELETION)),
        many(2, "entities", Kind::Message(&SCENE_ENTITY)),
    ],
);

static JOINT_STATE: MessageType = message(
    "foxglove.JointState",
    &[
        one(1, "name", Kind::Text),
        optional(2, "position", Kind::Double),
        optional(3, "velocity", Kind::Double),
        optional(4, "acceleration", Kind::Double),
        optional(5, "effort", Kind::Double),
    ],
);

/// Positions and velocities of joints.
pub(crate) static JOINT_STATES: MessageType = message(
    "foxglove.JointStates",
    &[
        one(1, "timestamp", TIME),
        many(2, "joints", Kind::Message(&JOINT_STATE)),
    ],
);

/// A picture.
pub(crate) static COMPRESSED_IMAGE: MessageType = message(
    "foxglove.CompressedImage",
    &[
        one(1, "timestamp", TIME),
        one(4, "frame_id", Kind::Text),
        one(2, "data", Kind::Bytes),
        one(3, "format", Kind::Text),
    ],
);

/// The calibration of a camera.
pub(crate) static CAMERA_CALIBRATION: MessageType = message(
    "foxglove.CameraCalibration",
    &[
        one(1, "timestamp", TIME),
        one(9, "frame_id", Kind::Text),
        one(2, "width", Kind::Fixed32),
        one(3, "height", Kind::Fixed32),
        one(4, "distortion_model", Kind::Text),
        many(5, "D", Kind::Double),
        many(6, "K", Kind::Double),
        many(7, "R", Kind::Double),
        many(8, "P", Kind::Double),
    ],
);

static LOG_LEVEL: Names = Names {
    name: "Level",
    values: &["UNKNOWN", "DEBUG", "INFO", "WARNING", "ERROR", "FATAL"],
};

/// A log line.
pub(super) static LOG: MessageType = MessageType {
    names: Some(&LOG_LEVEL),
    ..message(
        "foxglove.Log",
        &[
            one(1, "timestamp", TIME),
            one(2, "level", Kind::Names(&LOG_LEVEL)),
            one(3, "message", Kind::Text),
            one(4, "name", Kind::Text),
            one(5, "file", Kind::Text),
            one(6, "line", Kind::Fixed32),
        ],
    )
};

/// A task of a plan, an action, or a motion.
pub(crate) static TASK: MessageType = message(
    "planwright.Task",
    &[
        one(1, "timestamp", TIME),
        one(2, "id", Kind::Text),
        one(3, "parent", Kind::Text),
        one(4, "name", Kind::Text),
        one(5, "state", Kind::Text),
        one(6, "failure", Kind::Text),
        one(7, "result", Kind::Text),
        many(8, "parameters", Kind::Message(&KEY_VALUE_PAIR)),
        one(9, "place", Kind::Text),
        one(10, "line", Kind::Text),
        one(11, "module", Kind::Text),
        one(12, "class", Kind::Text),
    ],
);

static HELD: MessageType = message(
    "planwright.Held",
    &[
        one(1, "object", Kind::Text),
        one(2, "link", Kind::Text),
        one(3, "force", Kind::Double),
    ],
);

static TOUCHING: MessageType = message(
    "planwright.Touching",
    &[
        one(1, "link", Kind::Text),
        one(2, "object", Kind::Text),
        one(3, "position", Kind::Message(&VECTOR3)),
        one(4, "force", Kind::Message(&VECTOR3)),
    ],
);

static STOP: MessageType = message(
    "planwright.Stop",
    &[
        many(1, "frames", Kind::Text),
        one(2, "position", Kind::Message(&VECTOR3)),
    ],
);

static AXES: MessageType = message(
    "planwright.Axes",
    &[
        one(1, "pose", Kind::Message(&POSE)),
        one(2, "length", Kind::Double),
    ],
);

static PATH: MessageType = message(
    "planwright.Path",
    &[
        one(1, "what", Kind::Text),
        one(2, "frame_id", Kind::Text),
        many(3, "points", Kind::Message(&POINT3)),
    ],
);

/// What is shown besides bodies.
pub(super) static SHOWN: MessageType = message(
    "planwright.Shown",
    &[
        one(1, "timestamp", TIME),
        many(2, "held", Kind::Message(&HELD)),
        many(3, "touching", Kind::Message(&TOUCHING)),
        many(4, "stops", Kind::Message(&STOP)),
        many(5, "axes", Kind::Message(&AXES)),
        many(6, "paths", Kind::Message(&PATH)),
    ],
);
