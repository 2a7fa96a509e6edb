//! The tables of a file and their columns: those that facts have, in the same order, with the number of the run first.

use super::record::Affinity::{self, Any, Integer, Numeric, Real, Text};

/// The number of this schema: `PRAGMA user_version`. It grows when a column is renamed or removed.
pub(super) const VERSION: u32 = 1;

type Columns = &'static [(&'static str, Affinity)];

/// The tables that every file has.
pub(super) const TABLES: &[(&str, Columns)] = &[
    (
        "run",
        &[
            ("run", Integer),
            ("outcome", Text),
            ("class", Text),
            ("cause", Text),
            ("time", Real),
            ("distance", Real),
            ("steps", Integer),
            ("hash", Text),
        ],
    ),
    ("draw", &[("run", Integer), ("name", Text), ("value", Any)]),
    (
        "measure",
        &[("run", Integer), ("name", Text), ("value", Numeric)],
    ),
    (
        "expectation",
        &[("run", Integer), ("name", Text), ("held", Integer)],
    ),
    (
        "failed",
        &[("run", Integer), ("name", Text), ("count", Integer)],
    ),
    (
        "handled",
        &[("run", Integer), ("name", Text), ("count", Integer)],
    ),
    ("fault", &[("run", Integer), ("name", Text)]),
    ("body", &[("run", Integer), ("name", Text)]),
    (
        "task",
        &[
            ("run", Integer),
            ("task", Integer),
            ("parent", Integer),
            ("nth", Integer),
            ("kind", Text),
            ("type", Text),
            ("path", Text),
            ("place", Text),
            ("created", Real),
            ("started", Real),
            ("ended", Real),
            ("status", Text),
            ("result", Text),
        ],
    ),
    (
        "param",
        &[
            ("run", Integer),
            ("task", Integer),
            ("key", Text),
            ("text", Text),
            ("num", Numeric),
        ],
    ),
    (
        "failure",
        &[
            ("run", Integer),
            ("task", Integer),
            ("time", Real),
            ("class", Text),
            ("text", Text),
        ],
    ),
    (
        "object",
        &[
            ("run", Integer),
            ("time", Real),
            ("object", Text),
            ("type", Text),
            ("x", Real),
            ("y", Real),
            ("z", Real),
            ("qx", Real),
            ("qy", Real),
            ("qz", Real),
            ("qw", Real),
            ("on", Text),
            ("in_hand", Text),
        ],
    ),
    (
        "robot",
        &[
            ("run", Integer),
            ("time", Real),
            ("x", Real),
            ("y", Real),
            ("yaw", Real),
            ("torso", Real),
        ],
    ),
    (
        "contact",
        &[
            ("run", Integer),
            ("a", Text),
            ("b", Text),
            ("link", Text),
            ("began", Real),
            ("ended", Real),
            ("force", Real),
        ],
    ),
    (
        "event",
        &[
            ("run", Integer),
            ("time", Real),
            ("kind", Text),
            ("object", Text),
            ("other", Text),
            ("arm", Text),
            ("grasp", Text),
        ],
    ),
    (
        "log",
        &[
            ("run", Integer),
            ("time", Real),
            ("level", Text),
            ("tag", Text),
            ("text", Text),
        ],
    ),
];

/// Columns whose texts are names, as they are in questions: records write some of them in upper case, and episodes in
/// lower case.
pub(super) const NAMES: &[&str] = &[
    "outcome", "class", "kind", "type", "status", "name", "key", "level",
];
