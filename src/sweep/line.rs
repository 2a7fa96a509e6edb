//! A line of JSON Lines, and the rows of relations that it becomes: of a record of a sweep, rows of several.

use std::borrow::Cow;
use std::fmt;

use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value as Json};

use super::relations::Cell;

/// A value of an object.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Field<'a> {
    /// Nothing.
    Null,
    /// Yes or no.
    Bool(bool),
    /// A whole number.
    Int(i64),
    /// Another number, or a whole one that is larger.
    Number(f64),
    /// A text.
    Text(Cow<'a, str>),
    /// A list or an object.
    Nested(Json),
}

impl Field<'_> {
    /// As a value in a row.
    pub(crate) fn cell(self) -> Cell {
        match self {
            Field::Null => Cell::Null,
            Field::Bool(is) => Cell::Bool(is),
            Field::Int(int) => Cell::Int(int),
            Field::Number(number) => Cell::Number(number),
            Field::Text(text) => Cell::Text(text.into()),
            Field::Nested(json) => Cell::Text(json.to_string().into()),
        }
    }

    fn of(json: &Json) -> Field<'_> {
        match json {
            Json::Null => Field::Null,
            Json::Bool(is) => Field::Bool(*is),
            Json::Number(number) => match number.as_i64() {
                Some(int) => Field::Int(int),
                None => number.as_f64().map_or(Field::Null, Field::Number),
            },
            Json::String(text) => Field::Text(Cow::Borrowed(text)),
            Json::Array(_) | Json::Object(_) => Field::Nested(json.clone()),
        }
    }
}

/// An object in a line, in the order in which it is written.
pub(crate) struct Line<'a>(Vec<(Cow<'a, str>, Field<'a>)>);

/// What is done with a row: the name of its relation, and its columns.
pub(crate) type TakeRow<'t> = dyn FnMut(&str, Vec<(&str, Field<'_>)>) + 't;

/// A name, which need not be copied if nothing in it is escaped.
struct Name<'a>(Cow<'a, str>);

/// What a record of a sweep says by name, and the relation and the column that it becomes.
const OF_RECORD: &[(&str, &str, &str)] = &[
    ("expectations", "expectation", "held"),
    ("draws", "draw", "value"),
    ("measures", "measure", "value"),
    ("failures", "failed", "count"),
    ("handlers", "handled", "count"),
];

/// What a record lists, and the relation that it becomes.
const LISTED: &[(&str, &str)] = &[("faults", "fault"), ("bodies", "body")];

/// The columns by which rows belong to runs and tasks.
const KEYS: &[&str] = &["run", "task"];

impl<'a> Line<'a> {
    /// Reads an object; or says what is wrong.
    pub(crate) fn read(line: &'a str) -> Result<Line<'a>, String> {
        serde_json::from_str(line).map_err(|error| error.to_string())
    }

    fn get(&self, wanted: &str) -> Option<&Field<'a>> {
        let found = self.0.iter().rfind(|(name, _)| name == wanted);
        found.map(|(_, field)| field)
    }

    /// Hands the rows that it becomes to a function, each with the name of its relation.
    pub(crate) fn rows(mut self, relation: &str, take: &mut TakeRow<'_>) {
        if let Some(world) = self.get("world").filter(|_| self.get("outcome").is_some()) {
            return self.rows_of_record(world, take);
        }
        // What rows are found by comes first.
        let rank = |name: &str| KEYS.iter().position(|key| *key == name);
        let is_sorted = self
            .0
            .is_sorted_by_key(|(name, _)| rank(name).unwrap_or(KEYS.len()));
        if !is_sorted {
            self.0
                .sort_by_key(|(name, _)| rank(name).unwrap_or(KEYS.len()));
        }
        let Line(fields) = self;
        let (names, fields): (Vec<_>, Vec<_>) = fields.into_iter().unzip();
        let names = names.iter().map(|name| &**name);
        take(relation, names.zip(fields).collect());
    }

    fn rows_of_record(&self, world: &Field<'_>, take: &mut TakeRow<'_>) {
        let run = || ("run", world.clone());
        let single = self
            .0
            .iter()
            .filter(|(name, field)| name != "world" && !matches!(field, Field::Nested(_)));
        let single = single.map(|(name, field)| (&**name, field.clone()));
        take("run", std::iter::once(run()).chain(single).collect());
        let nested = |part: &str| match self.get(part) {
            Some(Field::Nested(json)) => Some(json),
            _ => None,
        };
        for (part, relation, column) in OF_RECORD {
            let named: Option<&Map<String, Json>> = nested(part).and_then(Json::as_object);
            for (name, json) in named.into_iter().flatten() {
                let name = ("name", Field::Text(Cow::Borrowed(name)));
                take(relation, vec![run(), name, (column, Field::of(json))]);
            }
        }
        for (part, relation) in LISTED {
            let listed = nested(part).and_then(Json::as_array);
            for json in listed.into_iter().flatten() {
                take(relation, vec![run(), ("name", Field::of(json))]);
            }
        }
    }
}

impl<'de> Deserialize<'de> for Line<'de> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Object;

        impl<'de> Visitor<'de> for Object {
            type Value = Line<'de>;

            fn expecting(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
                to.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Line<'de>, A::Error> {
                let mut fields = Vec::with_capacity(map.size_hint().unwrap_or(12));
                while let Some((Name(name), field)) = map.next_entry()? {
                    fields.push((name, field));
                }
                Ok(Line(fields))
            }
        }

        from.deserialize_map(Object)
    }
}

impl<'de> Deserialize<'de> for Name<'de> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Text;

        impl<'de> Visitor<'de> for Text {
            type Value = Name<'de>;

            fn expecting(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
                to.write_str("a name")
            }

            fn visit_borrowed_str<E>(self, text: &'de str) -> Result<Name<'de>, E> {
                Ok(Name(Cow::Borrowed(text)))
            }

            fn visit_str<E>(self, text: &str) -> Result<Name<'de>, E> {
                Ok(Name(Cow::Owned(text.to_owned())))
            }
        }

        from.deserialize_str(Text)
    }
}

impl<'de> Deserialize<'de> for Field<'de> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Any;

        impl<'de> Visitor<'de> for Any {
            type Value = Field<'de>;

            fn expecting(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
                to.write_str("a value")
            }

            fn visit_unit<E>(self) -> Result<Field<'de>, E> {
                Ok(Field::Null)
            }

            fn visit_bool<E>(self, is: bool) -> Result<Field<'de>, E> {
                Ok(Field::Bool(is))
            }

            fn visit_i64<E>(self, int: i64) -> Result<Field<'de>, E> {
                Ok(Field::Int(int))
            }

            fn visit_u64<E>(self, int: u64) -> Result<Field<'de>, E> {
                Ok(match i64::try_from(int) {
                    Ok(int) => Field::Int(int),
                    Err(_) => Field::Number(int as f64),
                })
            }

            fn visit_f64<E>(self, number: f64) -> Result<Field<'de>, E> {
                Ok(Field::Number(number))
            }

            fn visit_borrowed_str<E>(self, text: &'de str) -> Result<Field<'de>, E> {
                Ok(Field::Text(Cow::Borrowed(text)))
            }

            fn visit_str<E>(self, text: &str) -> Result<Field<'de>, E> {
                Ok(Field::Text(Cow::Owned(text.to_owned())))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Field<'de>, A::Error> {
                let mut items = Vec::new();
                while let Some(item) = list.next_element()? {
                    items.push(item);
                }
                Ok(Field::Nested(Json::Array(items)))
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Field<'de>, A::Error> {
                let mut object = Map::new();
                while let Some((name, value)) = map.next_entry()? {
                    object.insert(name, value);
                }
                Ok(Field::Nested(Json::Object(object)))
            }
        }

        from.deserialize_any(Any)
    }
}
