//! Reading a kitchen's description from s-expressions.

use super::kitchen_description::{
    CLOSE_UPS, CloseUp, KitchenDescription, PlaceProperty, PlaceRule, PlaceValue, Store,
};
use crate::robot::{JointKind, KinematicTree, aliases};
use crate::sexp::{DataError, DataFile, DataProblem, Node, Record};
use closest_name::closest_name;

/// The records of a description, each with its keys.
const RECORDS: &[(&str, &[&str])] = &[
    ("kitchen", &["urdf-name", "usual-joint"]),
    ("alias", &[]),
    ("start", &["heading"]),
    ("behind", &[]),
    ("place", PLACE_KEYS),
    ("usually", &["contexts", "types"]),
    ("belongs", &["contexts", "types"]),
    ("store", &["in", "position", "heading"]),
    ("surface", &["margins"]),
    ("view", &["link", "at", "eye"]),
];

/// The properties that a place may have.
const PLACE_KEYS: &[&str] = &[
    "on",
    "in",
    "above",
    "side",
    "level",
    "level-invert",
    "orientation",
    "range",
    "range-invert",
    "context",
    "object-count",
];

/// What of a description has to fit a kitchen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fit {
    /// All of it.
    Whole,
    /// A record that names furniture which is not there is left out.
    WhatIsThere,
}

/// Reads a description.
pub(super) fn read(
    text: &str,
    file_name: &str,
    tree: &KinematicTree,
    fit: Fit,
) -> Result<KitchenDescription, DataError> {
    let file = DataFile::read(text, file_name)?;
    let records: Vec<Record> = file
        .nodes()
        .map(|node| node.record("record", RECORDS))
        .collect::<Result<_, _>>()?;
    let reader = Reader {
        tree,
        fit,
        records: &records,
    };
    let Some(kitchen) = reader.all("kitchen").next() else {
        return Err(file.error(DataProblem::MissingRecord("kitchen".to_owned())));
    };
    reader.description(kitchen)
}

/// The records of a file, and the tree that they refer to.
struct Reader<'a> {
    tree: &'a KinematicTree,
    fit: Fit,
    records: &'a [Record<'a>],
}

impl<'a> Reader<'a> {
    fn description(&self, kitchen: &Record<'a>) -> Result<KitchenDescription, DataError> {
        let name = kitchen.thing("name")?.symbol()?;
        let urdf_name = kitchen.optional("urdf-name");
        let usual_joint = kitchen.optional("usual-joint");
        let usual_joint = usual_joint.map(|node| self.joint(node));
        let places = self.each("place", |record| self.place(record))?;
        for (i, (name, _)) in places.iter().enumerate() {
            if places.iter().take(i).any(|(earlier, _)| earlier == name) {
                let again = self.all("place").filter_map(|r| r.thing("name").ok());
                let again = again.filter(|node| node.symbol() == Ok(name.as_str()));
                let problem = DataProblem::Repeated(format!("(place {name} …)"));
                return Err(again.last().unwrap_or(*kitchen.node()).error(problem));
            }
        }
        let rule = |record: &Record<'a>| self.rule(record, &places);
        Ok(KitchenDescription {
            name: name.to_owned(),
            urdf_name: match urdf_name {
                Some(node) => node.symbol()?.to_owned(),
                None => self.tree.name().to_owned(),
            },
            usual_joint: match usual_joint {
                Some(Err(_)) if self.fit == Fit::WhatIsThere => None,
                other => other.transpose()?,
            },
            start: self.start()?,
            behind: self.each("behind", |record| {
                let [door, inside] = record.things() else {
                    return Err(record.node().expected("(behind DOOR LINK)"));
                };
                Ok([self.door(*door)?, self.link(*inside)?])
            })?,
            usually: self.each("usually", rule)?,
            belongs: self.each("belongs", rule)?,
            stores: self.each("store", |record| self.store(record))?,
            margins: self.each("surface", |record| {
                let margins = record.required("margins")?.numbers::<4>()?;
                Ok((self.link(record.thing("link")?)?, margins))
            })?,
            close_ups: self.each("view", |record| self.close_up(record))?,
            aliases: match self.fit {
                Fit::Whole => aliases(self.tree, self.all("alias"))?,
                Fit::WhatIsThere => Vec::new(),
            },
            places,
        })
    }

    /// Where the robot starts: x and y (m) and heading (degrees).
    fn start(&self) -> Result<Option<[f64; 3]>, DataError> {
        let mut starts = self.all("start");
        let Some(record) = starts.next() else {
            return Ok(None);
        };
        if let Some(again) = starts.next() {
            let problem = DataProblem::Repeated("(start …)".to_owned());
            return Err(again.node().error(problem));
        }
        let [x, y] = record.things() else {
            return Err(record.node().expected("(start X Y :heading DEGREES)"));
        };
        let heading = record.optional("heading").map(|node| node.number());
        let heading = heading.transpose()?.unwrap_or(0.0);
        Ok(Some([x.number()?, y.number()?, heading]))
    }

    fn all(&self, head: &'static str) -> impl Iterator<Item = &'a Record<'a>> + use<'a> {
        self.records.iter().filter(move |r| r.head() == head)
    }

    /// What the records with that head say; without those that name what is not there, if only a
    /// part has to fit.
    fn each<T>(
        &self,
        head: &'static str,
        value: impl Fn(&Record<'a>) -> Result<T, DataError>,
    ) -> Result<Vec<T>, DataError> {
        let names_nothing = |error: &DataError| {
            self.fit == Fit::WhatIsThere
                && matches!(*error.problem, DataProblem::UnknownName { .. })
        };
        let values = self.all(head).map(value);
        let values = values.filter(|value| !value.as_ref().is_err_and(names_nothing));
        values.collect()
    }

    fn link(&self, node: Node<'_>) -> Result<String, DataError> {
        let name = node.symbol()?;
        let links = || self.tree.links().map(|(_, link)| link.name.as_str());
        match links().find(|link| *link == name) {
            Some(name) => Ok(name.to_owned()),
            None => Err(node.unknown("link", name, closest_name(name, links()))),
        }
    }

    /// The link of a drawer or door: a joint moves it.
    fn door(&self, node: Node<'_>) -> Result<String, DataError> {
        let name = self.link(node)?;
        let mut joints = self.tree.joints();
        let is_moved = joints.any(|(_, joint)| {
            joint.kind != JointKind::Fixed && self.tree.link(joint.child).name == name
        });
        match is_moved {
            true => Ok(name),
            false => Err(node.expected("the link of a drawer or door, which a joint moves")),
        }
    }

    fn joint(&self, node: Node<'_>) -> Result<crate::robot::JointId, DataError> {
        let name = node.symbol()?;
        self.tree.joint_named(name).ok_or_else(|| {
            let names = self.tree.joints().map(|(_, joint)| joint.name.as_str());
            node.unknown("joint", name, closest_name(name, names))
        })
    }

    /// A place, with its properties in the order of the file.
    fn place(&self, record: &Record<'a>) -> Result<(String, Vec<PlaceProperty>), DataError> {
        let name = record.thing("name")?.symbol()?;
        let mut properties = Vec::new();
        for (key, node) in record.fields() {
            let Some(key) = PLACE_KEYS.iter().find(|known| *known == key) else {
                continue;
            };
            let value = match *key {
                "on" | "in" | "above" => PlaceValue::Furniture(self.link(*node)?),
                "range" | "range-invert" => PlaceValue::Number(node.positive()?),
                "object-count" => PlaceValue::Count(node.count()?),
                _ => match node.symbols() {
                    Ok(words) => PlaceValue::Words(words.into_iter().map(str::to_owned).collect()),
                    Err(_) => PlaceValue::Word(node.symbol()?.to_owned()),
                },
            };
            properties.push(PlaceProperty { key, value });
        }
        if properties.is_empty() {
            let problem = format!("(place {name}) says nothing; add :on, :in or :above");
            return Err(record.node().error(DataProblem::Invalid(problem)));
        }
        Ok((name.to_owned(), properties))
    }

    fn rule(
        &self,
        record: &Record<'a>,
        places: &[(String, Vec<PlaceProperty>)],
    ) -> Result<PlaceRule, DataError> {
        let node = record.thing("place")?;
        let place = node.symbol()?;
        if !places.iter().any(|(name, _)| name == place) {
            let names = places.iter().map(|(name, _)| name.as_str());
            return Err(node.unknown("place", place, closest_name(place, names)));
        }
        let words = |node: Node<'a>| -> Result<Vec<String>, DataError> {
            Ok(node.symbols()?.into_iter().map(str::to_owned).collect())
        };
        Ok(PlaceRule {
            place: place.to_owned(),
            contexts: words(record.required("contexts")?)?,
            types: record
                .optional("types")
                .map(words)
                .transpose()?
                .unwrap_or_default(),
        })
    }

    fn store(&self, record: &Record<'a>) -> Result<Store, DataError> {
        Ok(Store {
            kind: record.thing("type")?.symbol()?.to_owned(),
            link: self.link(record.required("in")?)?,
            position: record.required("position")?.numbers()?,
            heading: record.required("heading")?.number()?,
        })
    }

    fn close_up(&self, record: &Record<'a>) -> Result<CloseUp, DataError> {
        let node = record.thing("view")?;
        let name = node.symbol()?;
        if !CLOSE_UPS.contains(&name) {
            return Err(node.unknown("view", name, closest_name(name, CLOSE_UPS)));
        }
        let link = record.required("link")?;
        Ok(CloseUp {
            name: name.to_owned(),
            link: match self.fit {
                Fit::Whole => self.link(link)?,
                // Whoever asks for the view is told what is missing.
                Fit::WhatIsThere => link.symbol()?.to_owned(),
            },
            at: record.required("at")?.numbers()?,
            eye: record.required("eye")?.numbers()?,
        })
    }
}
