//! Rows of relations, as a recording gives them.

/// A value in a row.
#[derive(Clone, Debug, PartialEq)]
pub enum Datum {
    /// Nothing.
    Null,
    /// A whole number.
    Int(i64),
    /// Another number.
    Number(f64),
    /// A text.
    Text(Box<str>),
}

impl Datum {
    /// A text, or nothing if it is empty.
    pub(super) fn text(text: &str) -> Datum {
        match text {
            "" => Datum::Null,
            text => Datum::Text(text.into()),
        }
    }
}

impl From<f64> for Datum {
    fn from(number: f64) -> Datum {
        Datum::Number(number)
    }
}

impl From<usize> for Datum {
    fn from(count: usize) -> Datum {
        // No recording has more than can be counted so.
        Datum::Int(i64::try_from(count).unwrap_or(i64::MAX))
    }
}

impl From<&str> for Datum {
    fn from(text: &str) -> Datum {
        Datum::Text(text.into())
    }
}

impl From<String> for Datum {
    fn from(text: String) -> Datum {
        Datum::Text(text.into())
    }
}

impl<T: Into<Datum>> From<Option<T>> for Datum {
    fn from(value: Option<T>) -> Datum {
        value.map_or(Datum::Null, T::into)
    }
}

/// The rows of a relation.
#[derive(Clone, Debug, PartialEq)]
pub struct Rows {
    /// The names of the columns.
    pub columns: &'static [&'static str],
    /// Rows with a value for each of them.
    pub rows: Vec<Vec<Datum>>,
}

/// The relations that a recording has, in the order in which they are given, and their columns.
pub(super) const RELATIONS: [(&str, &[&str]); 8] = [
    (
        "task",
        &[
            "task", "parent", "nth", "kind", "type", "path", "place", "created", "started",
            "ended", "status", "result",
        ],
    ),
    ("param", &["task", "key", "text", "num"]),
    ("failure", &["task", "time", "class", "text"]),
    ("event", &["time", "kind", "object", "other"]),
    ("contact", &["a", "b", "began", "ended", "force"]),
    ("log", &["time", "level", "tag", "text"]),
    (
        "object",
        &[
            "time", "object", "type", "x", "y", "z", "qx", "qy", "qz", "qw", "on", "in-hand",
        ],
    ),
    ("robot", &["time", "x", "y", "yaw"]),
];

/// Rows of one of these relations.
pub(super) fn of(name: &'static str, rows: Vec<Vec<Datum>>) -> (&'static str, Rows) {
    let known = RELATIONS.iter().find(|(known, _)| *known == name);
    let columns = known.map_or(&[][..], |(_, columns)| columns);
    (name, Rows { columns, rows })
}
