//! The layouts of all messages of a distribution.

use std::sync::Arc;

use indexmap::IndexMap;

use super::reading::{self, LayoutError};
use crate::Distribution;

/// The table of all distributions.
const INTERFACES: &str = include_str!("interfaces.txt");

/// What surrounds the parts of an action on the wire.
const AROUND_ACTIONS: &str = include_str!("action_parts.txt");

/// A field of a message.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Its name.
    pub name: Arc<str>,
    /// What one of it is.
    pub kind: FieldType,
    /// How many it holds.
    pub multiplicity: Multiplicity,
}

/// What a field holds.
#[derive(Clone, Debug, PartialEq)]
pub enum FieldType {
    /// A number or a truth value.
    Scalar(Scalar),
    /// A text.
    Text,
    /// A message.
    Message(Arc<str>),
}

/// Numbers, and truth values, which are numbers of one byte.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scalar {
    /// Zero or one, in one byte.
    Bool,
    /// A whole number of so many bytes, with or without a sign.
    Integer {
        /// How many bytes.
        bytes: usize,
        /// Whether it can be negative.
        signed: bool,
    },
    /// 32 bits.
    Single,
    /// 64 bits.
    Double,
}

impl Scalar {
    /// Its size (bytes), which is its alignment, too.
    pub fn bytes(self) -> usize {
        match self {
            Self::Bool => 1,
            Self::Integer { bytes, .. } => bytes,
            Self::Single => 4,
            Self::Double => 8,
        }
    }
}

/// How many a field holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Multiplicity {
    /// One.
    One,
    /// As many as this.
    Array(usize),
    /// Any number; the number stands before them.
    Sequence,
}

/// The layouts of all messages of a distribution. Every message that a field names is there, and none
/// contains itself.
#[derive(Clone, Debug)]
pub struct Layouts {
    distribution: Distribution,
    messages: IndexMap<Arc<str>, Vec<Field>>,
}

impl Layouts {
    /// The layouts of a distribution.
    pub fn of(distribution: Distribution) -> Result<Self, LayoutError> {
        Self::read(INTERFACES, distribution)
    }

    /// The layouts that a distribution has in a table.
    pub(crate) fn read(table: &str, distribution: Distribution) -> Result<Self, LayoutError> {
        let mut messages = reading::messages(table, distribution)?;
        let actions: Vec<String> = messages
            .keys()
            .filter_map(|name| name.strip_suffix("_Goal"))
            .map(str::to_owned)
            .collect();
        for action in actions {
            let around = AROUND_ACTIONS.replace("ACTION", &action);
            messages.extend(reading::messages(&around, distribution)?);
        }
        reading::check(&messages)?;
        Ok(Self {
            distribution,
            messages,
        })
    }

    /// The distribution.
    pub fn distribution(&self) -> Distribution {
        self.distribution
    }

    /// The fields of a message, in the order of the wire.
    pub fn fields(&self, message: &str) -> Option<&[Field]> {
        self.messages.get(message).map(Vec::as_slice)
    }

    /// The names of all messages.
    pub fn messages(&self) -> impl Iterator<Item = &str> {
        self.messages.keys().map(AsRef::as_ref)
    }
}
