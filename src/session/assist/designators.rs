//! Completions in designators: the keys that a type takes, and the values that a key takes.

use super::assistant::Assistant;
use super::context::{Context, Open, bare};
use super::wording::{first_sentence, lower};
use crate::dialogue::Candidate;
use cram::designator::schema;
use cram::designator::schema::{Key, Kind};
use cram::designator::value::Class;
use lisp::image::Image;
use robotics::location::{Direction, Orientation, containers, surfaces};

/// A designator form around the cursor.
pub(super) struct Described<'c, 't> {
    pub class: Class,
    list: &'c Open<'t>,
}

/// The position of the cursor in a designator form.
pub(super) enum Spot<'c, 't> {
    /// At the name of the class.
    Class,
    /// At a key.
    Key(Described<'c, 't>),
    /// At a value of a key.
    Value(Described<'c, 't>, &'t str),
}

fn is_article(name: &str) -> bool {
    matches!(lower(bare(name)).as_str(), "a" | "an" | "all")
}

fn class_of(name: &str) -> Option<Class> {
    Class::named(bare(name)).or_else(|| Class::named(bare(name).trim_end_matches(['s', 'S'])))
}

/// The designator form around the cursor.
pub(super) fn spot<'c, 't>(context: &'c Context<'t>) -> Option<Spot<'c, 't>> {
    let (last, outer) = context.lists.split_last()?;
    if last.operator.is_some_and(is_article) && last.elements == 1 {
        return Some(Spot::Class);
    }
    // `(desig:when ?x (key …))` may come in between.
    let is_when = |name: &str| lower(bare(name)) == "when";
    let outer = outer
        .iter()
        .rev()
        .find(|list| list.operator.is_none_or(|name| !is_when(name)))?;
    let is_designator = outer.operator.is_some_and(is_article);
    let class = outer.second.and_then(class_of).filter(|_| is_designator)?;
    let described = Described { class, list: outer };
    Some(match last.operator {
        None => Spot::Key(described),
        Some(key) => Spot::Value(described, key),
    })
}

impl Described<'_, '_> {
    fn value_of(&self, key: &str) -> Option<&str> {
        let mut lists = self.list.lists.iter();
        lists
            .find(|(name, _)| bare(name).eq_ignore_ascii_case(key))
            .and_then(|(_, value)| *value)
    }

    /// The keys that it takes.
    pub(super) fn keys(&self, image: &Image) -> Vec<Key> {
        let name = self.value_of("type").map(|name| bare(name).to_uppercase());
        keys_of(image, self.class, name.as_deref())
    }

    /// The key of that name.
    pub(super) fn key(&self, image: &Image, name: &str) -> Option<Key> {
        let name = bare(name).to_uppercase();
        let mut keys = self.keys(image);
        keys.sort_by_key(|key| key.name != name);
        keys.into_iter().find(|key| key.is_named(&name))
    }
}

/// The keys that designators of a class and a type take, the latter in upper case.
pub(super) fn keys_of(image: &Image, class: Class, type_name: Option<&str>) -> Vec<Key> {
    match class {
        Class::Object => schema::OBJECT_KEYS.to_vec(),
        Class::Location => schema::LOCATION_KEYS.to_vec(),
        _ => {
            let rows = type_name.map(|name| schema::rows(image, class, name));
            let mut keys: Vec<Key> = Vec::new();
            for key in rows.iter().flatten().flat_map(|row| &row.keys) {
                if keys.iter().all(|known| known.name != key.name) {
                    keys.push(key.clone());
                }
            }
            keys
        }
    }
}

fn candidate(text: impl Into<String>, doc: impl Into<String>) -> Candidate {
    Candidate {
        text: text.into(),
        doc: doc.into(),
    }
}

/// The classes of designators.
pub(super) fn classes() -> Vec<Candidate> {
    vec![
        candidate("action", "something that a plan does"),
        candidate("motion", "one movement of the robot"),
        candidate("object", "a thing"),
        candidate("location", "a place"),
    ]
}

/// The keys that could stand there, those that are there already left out.
pub(super) fn keys(image: &Image, described: &Described<'_, '_>) -> Vec<Candidate> {
    let mut keys: Vec<Candidate> = Vec::new();
    if described.value_of("type").is_none() && described.class != Class::Location {
        keys.push(candidate("type", "what kind it is"));
    }
    let is_new = |key: &Key| key.name != "TYPE" && described.value_of(&key.name).is_none();
    for key in described.keys(image).into_iter().filter(is_new) {
        let mark = if key.is_required { " (needed)" } else { "" };
        keys.push(candidate(lower(&key.name), format!("{}{mark}", key.doc)));
    }
    keys
}

impl Assistant<'_> {
    /// The known values of a key.
    pub(super) fn values_of_key(
        &self,
        described: &Described<'_, '_>,
        key: &str,
        context: &Context<'_>,
    ) -> Vec<Candidate> {
        let name = lower(bare(key));
        match (name.as_str(), described.class) {
            ("type", Class::Action | Class::Motion) => types(self.image, described.class),
            ("type", _) => self.object_types(),
            ("name", _) => self.object_names(),
            ("arm" | "arms" | "gripper" | "camera", _) => vec![
                candidate("left", "the left one"),
                candidate("right", "the right one"),
            ],
            ("grasp" | "left-grasp" | "right-grasp", _) => self.grasps(context),
            ("direction", _) => ["forward", "left", "right", "up", "down"]
                .map(|direction| candidate(direction, "where to look"))
                .to_vec(),
            ("urdf-name", Class::Object) => self.furniture_names(),
            ("part-of", Class::Object) => {
                let kitchen = &self.simulation.models.kitchen_description.name;
                vec![candidate(kitchen.as_str(), "the furniture")]
            }
            ("side", Class::Location) => Direction::ALL
                .map(|side| candidate(side.name(), "in the frame of the furniture"))
                .to_vec(),
            ("orientation", Class::Location) => Orientation::ALL
                .map(|orientation| candidate(orientation.name(), "how it is turned"))
                .to_vec(),
            ("level" | "level-invert", Class::Location) => ["topmost", "middle", "bottommost"]
                .map(|level| candidate(level, "which board"))
                .to_vec(),
            ("context", Class::Location) => {
                vec![candidate("table-setting", "slots along the edges")]
            }
            ("reachable-for" | "visible-for", Class::Location) => {
                let robot = &self.simulation.models.description.name;
                vec![candidate(robot.to_lowercase(), "the robot")]
            }
            (
                "on" | "in" | "above" | "for" | "left-of" | "right-of" | "in-front-of" | "behind"
                | "near" | "far-from",
                Class::Location,
            ) => {
                vec![candidate("(an object ", "a description of an object")]
            }
            ("object" | "of", _) => vec![candidate("(an object ", "a description of an object")],
            _ => match described
                .key(self.image, key)
                .map(|key| (key.kind, key.doc))
            {
                Some((Kind::Member(members), doc)) => members
                    .iter()
                    .map(|member| candidate(lower(member), doc.clone()))
                    .collect(),
                Some((Kind::Location | Kind::Place, _)) => {
                    vec![candidate("(a location ", "a description of a place")]
                }
                Some((Kind::Object | Kind::DetectedObject | Kind::Objects, _)) => {
                    vec![candidate("(an object ", "a description of an object")]
                }
                _ => Vec::new(),
            },
        }
    }

    /// The types of objects.
    pub(super) fn object_types(&self) -> Vec<Candidate> {
        let types = self.simulation.object_types().types();
        types
            .map(|kind| candidate(kind.name.clone(), format!("an object of {} kg", kind.mass)))
            .collect()
    }

    /// The furniture: surfaces and what can be opened first, then all else that has a shape.
    pub(super) fn furniture_names(&self) -> Vec<Candidate> {
        let world = self.simulation.world();
        let models = world.models();
        let surfaces = surfaces(world).into_iter();
        let surfaces = surfaces.map(|(link, _)| (link, "things can be put on it"));
        let opened = containers(models).into_iter();
        let opened = opened.map(|container| (container.link, "it can be opened"));
        let links = models.kitchen.links();
        let others = links.filter(|(_, link)| !link.collisions.is_empty());
        let others = others.map(|(link, _)| (link, "furniture"));
        let mut found: Vec<Candidate> = Vec::new();
        for (link, doc) in surfaces.chain(opened).chain(others) {
            let name = models.kitchen.link(link).name.replace('_', "-");
            if !found.iter().any(|known| known.text == name) {
                found.push(candidate(name, doc));
            }
        }
        found
    }

    /// The objects in the world.
    pub(super) fn object_names(&self) -> Vec<Candidate> {
        let objects = self.simulation.world().objects();
        objects
            .map(|object| {
                let kind = object.type_name();
                candidate(lower(object.name()), format!("a {kind} in the world"))
            })
            .collect()
    }

    /// The grasps defined for the object type that the text names, or all grasps.
    pub(super) fn grasps(&self, context: &Context<'_>) -> Vec<Candidate> {
        let named = context.lists.iter().flat_map(|list| &list.lists);
        let kind = named
            .filter(|(key, _)| bare(key).eq_ignore_ascii_case("type"))
            .filter_map(|(_, value)| *value)
            .map(|value| lower(bare(value)))
            .find(|value| self.simulation.object_types().get(value).is_some());
        let library = self.simulation.grasp_library();
        let mut found: Vec<Candidate> = Vec::new();
        for known in self.simulation.object_types().types() {
            if kind.as_ref().is_some_and(|kind| *kind != known.name) {
                continue;
            }
            for grasp in library.grasps(&known.name) {
                let name = lower(grasp);
                match found.iter_mut().find(|c| c.text == name) {
                    Some(c) => c.doc = format!("{}, {}", c.doc, known.name),
                    None => found.push(candidate(name, format!("defined for {}", known.name))),
                }
            }
        }
        found
    }
}

/// The types of a class, without aliases.
fn types(image: &Image, class: Class) -> Vec<Candidate> {
    let mut found: Vec<Candidate> = Vec::new();
    for row in schema::all(image, class) {
        let name = lower(&row.name);
        if !found.iter().any(|c| c.text == name) {
            found.push(candidate(name, first_sentence(&row.doc)));
        }
    }
    found
}
