//! A record: `(head thing … :key value …)`.

use super::{DataError, DataProblem, Node};
use closest_name::closest_name;

/// A list that begins with a name, continues with values and ends with keys and their values.
#[derive(Clone, Debug)]
pub struct Record<'a> {
    node: Node<'a>,
    head: &'a str,
    things: Vec<Node<'a>>,
    fields: Vec<(&'a str, Node<'a>)>,
}

impl<'a> Node<'a> {
    /// A record of one of the kinds, each given by its head and the keys that it may have; `what`
    /// such a record is, for errors.
    pub fn record(&self, what: &str, kinds: &[(&str, &[&str])]) -> Result<Record<'a>, DataError> {
        let head = self.head()?;
        match kinds.iter().find(|(name, _)| *name == head) {
            Some((_, keys)) => Record::read(*self, keys),
            None => {
                let closest = closest_name(head, kinds.iter().map(|kind| kind.0));
                Err(self.unknown(what, head, closest))
            }
        }
    }
}

impl<'a> Record<'a> {
    fn read(node: Node<'a>, keys: &[&str]) -> Result<Self, DataError> {
        let head = node.head()?;
        let mut rest = node.list()?.into_iter().skip(1).peekable();
        let mut things = Vec::new();
        while let Some(thing) = rest.next_if(|n| n.as_keyword().is_none()) {
            things.push(thing);
        }
        let mut fields: Vec<(&str, Node<'a>)> = Vec::new();
        while let Some(key_node) = rest.next() {
            let key = key_node.as_keyword();
            let key = key.ok_or_else(|| key_node.expected("a key such as :name"))?;
            if !keys.contains(&key) {
                return Err(key_node.error(DataProblem::UnknownKey {
                    record: head.to_owned(),
                    key: key.to_owned(),
                    known: keys.iter().map(|k| (*k).to_owned()).collect(),
                    closest: closest_name(key, keys.iter().copied()).map(|k| format!(":{k}")),
                }));
            }
            if fields.iter().any(|(k, _)| *k == key) {
                return Err(key_node.error(DataProblem::Repeated(format!(":{key}"))));
            }
            let value = rest.next().filter(|n| n.as_keyword().is_none());
            let value = value.ok_or_else(|| {
                key_node.error(DataProblem::Invalid(format!(
                    ":{key} has no value; add one"
                )))
            })?;
            fields.push((key, value));
        }
        Ok(Self {
            node,
            head,
            things,
            fields,
        })
    }

    /// The record as a value.
    pub fn node(&self) -> &Node<'a> {
        &self.node
    }

    /// The name that the record begins with.
    pub fn head(&self) -> &'a str {
        self.head
    }

    /// The values before the first key.
    pub fn things(&self) -> &[Node<'a>] {
        &self.things
    }

    /// The single value before the first key; `what` describes it in errors.
    pub fn thing(&self, what: &str) -> Result<Node<'a>, DataError> {
        match self.things.as_slice() {
            [thing] => Ok(*thing),
            _ => Err(self.node.error(DataProblem::Invalid(format!(
                "({} …) needs exactly one {what} before its keys",
                self.head
            )))),
        }
    }

    /// The keys and their values, in order.
    pub fn fields(&self) -> &[(&'a str, Node<'a>)] {
        &self.fields
    }

    /// The value of an optional key.
    pub fn optional(&self, key: &str) -> Option<Node<'a>> {
        let field = self.fields.iter().find(|(k, _)| *k == key);
        field.map(|(_, value)| *value)
    }

    /// The value of a required key.
    pub fn required(&self, key: &str) -> Result<Node<'a>, DataError> {
        self.optional(key).ok_or_else(|| {
            self.node.error(DataProblem::MissingKey {
                record: self.head.to_owned(),
                key: key.to_owned(),
            })
        })
    }
}
