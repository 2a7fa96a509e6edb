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
