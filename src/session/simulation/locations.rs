//! From location designators to descriptions of places, and the search for them.

use std::cell::RefCell;
use std::sync::Arc;

use super::Simulation;
use super::location_references::References;
use super::motions::sides;
use super::names::{name_text, type_text};
use super::properties::property;
use crate::closest_name::closest_name;
use crate::lisp::image::Image;
use crate::lisp::print;
use crate::lisp::value::Value;
use crate::lisp::value::foreign::{Foreign, PrintContext};
use crate::lisp::value::number;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::Sym;
use crate::location::{
    BaseQuery, Beside, Constraint, Direction, Distances, Item, Level, Orientation, PlaceQuery,
    Position, Query, Relation, Scene, Stream, Support, Target, What, link_named,
};
use crate::motion::interruption::interruptible;
use crate::picture::LocationMap;
use crate::plan::designator::value::{Class, Designator, as_class, as_designator, current, first};
use crate::plan::pose::value::as_placement;
use crate::robot::{LinkId, Side};
use crate::session::LogLevel;
use crate::spatial::Pose;
use crate::world::{BodyName, Load, WorldError};

/// Cosine of the angle to the wanted direction, at least, unless the location says another.
const THRESHOLD: f64 = 0.2;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// The poses of a location, as its designator keeps them.
pub(in crate::session) struct LocationStream {
    pub(crate) stream: RefCell<Stream>,
    class_symbol: Sym,
}

impl Foreign for LocationStream {
    fn type_symbol(&self) -> Sym {
        self.class_symbol
    }

    fn print(&self, _: &dyn PrintContext, _: bool) -> String {
        "#<LOCATION-SEARCH>".to_owned()
    }

    fn describe(&self, _: &dyn PrintContext) -> String {
        self.stream.borrow().summary()
    }
}

fn raised(error: &WorldError) -> Box<Raise> {
    let text = error.to_string();
    let end = if text.ends_with('?') { "" } else { "." };
    Raise::simple(text + end)
}

/// All values of a property, of all properties with that key, also those in lists.
fn values(image: &Image, designator: &Designator, key: &str) -> Vec<Value> {
    let properties = designator.properties().into_iter();
    properties
        .filter(|(k, _)| k.as_symbol().is_some_and(|s| image.name(s) == key))
        .flat_map(|(_, values)| values.iter_list().collect::<Vec<_>>())
        .flat_map(|value| match &value {
            Value::Cons(_) => value.iter_list().collect(),
            _ => vec![value],
        })
        .collect()
}

/// A property as users write it.
fn written(image: &Image, key: &str, value: &Value) -> String {
    let value = match value.as_symbol() {
        Some(sym) => image.name(sym).to_lowercase(),
        None => print::to_string(image, value, false),
    };
    format!("({} {value})", key.to_lowercase())
}

/// The distance (m) that a property gives.
fn metres(image: &Image, key: &str, value: &Value) -> Result<f64> {
    let number = number::to_f64(value).filter(|x| x.is_finite() && *x >= 0.0);
    number.ok_or_else(|| {
        Raise::simple(format!(
            "{} is no distance: a number of metres, not below 0, was expected.",
            written(image, key, value)
        ))
    })
}

/// One of several names that a property takes.
fn one_of<T: Copy>(
    image: &Image,
    (key, value): (&str, &Value),
    choices: &[T],
    name: fn(T) -> &'static str,
) -> std::result::Result<T, String> {
    let text = name_text(image, value).unwrap_or_default().to_lowercase();
    let found = choices.iter().find(|choice| name(**choice) == text);
    found.copied().ok_or_else(|| {
        let names: Vec<&str> = choices.iter().map(|choice| name(*choice)).collect();
        let near = closest_name(&text, names.iter().copied());
        let near = near.map_or_else(String::new, |near| format!("; did you mean {near}?"));
        let end = if near.is_empty() { "." } else { &near };
        format!(
            "{}: one of {} was expected{end}",
            written(image, key, value),
            names.join(", ")
        )
    })
}

impl Simulation {
    /// What searches look at.
    pub(in crate::session) fn location_scene(&self) -> Scene<'_> {
        Scene {
            world: &self.world,
            grasps: &self.grasps,
        }
    }

    /// The poses of a location as its chain of designators keeps them, begun if necessary; `None`
    /// if its properties do not describe a place. `references` are what Lisp has worked out: a list
    /// of `(key pose number…)`.
    pub(in crate::session) fn location_stream(
        &mut self,
        image: &mut Image,
        location: &Value,
        references: &Value,
    ) -> Result<Option<Value>> {
        let oldest = first(location);
        let Some(designator) = as_class(&oldest, Class::Location) else {
            let shown = print::to_string(image, location, false);
            return Err(Raise::simple(format!("{shown} is no location.")));
        };
        if let Some(memory) = designator.memory.borrow().clone()
            && memory.as_foreign::<LocationStream>().is_some()
        {
            // What is offered from it is gone, and no tape takes it away.
            self.tape.note_lasting_effect();
            return Ok(Some(memory));
        }
        let references = References::read(self, image, references)?;
        let Some(query) = self.location_query(image, designator, &references)? else {
            return Ok(None);
        };
        self.tape.note_lasting_effect();
        self.searches += 1;
        // Any odd number tells apart the searches of sessions with different seeds.
        let seed = self.seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ self.searches;
        let class_symbol = image.keyword("LOCATION-SEARCH");
        let memory = Value::foreign(LocationStream {
            stream: RefCell::new(Stream::new(query, seed)),
            class_symbol,
        });
        *designator.memory.borrow_mut() = Some(memory.clone());
        Ok(Some(memory))
    }

    /// Works on the poses of a location; `None` if the user has interrupted it.
    pub(in crate::session) fn with_stream<T>(
        &self,
        image: &mut Image,
        memory: &Value,
        work: impl FnOnce(&mut Stream, Scene<'_>) -> std::result::Result<T, WorldError>,
    ) -> Result<Option<T>> {
        let Some(stream) = memory.as_foreign::<LocationStream>() else {
            return Ok(None);
        };
        let done = interruptible(image.interrupt(), || {
            work(&mut stream.stream.borrow_mut(), self.location_scene())
        });
        match done {
            Some(done) => done.map(Some).map_err(|error| raised(&error)),
            None => {
                image.polls().seen_since_last();
                Ok(None)
            }
        }
    }

    /// What can be shown of the search for a location, if there is anything.
    pub(in crate::session) fn location_map_of(
        &self,
        image: &mut Image,
        memory: &Value,
    ) -> Result<Option<Arc<LocationMap>>> {
        let view = self.with_stream(image, memory, |stream, scene| stream.view(scene))?;
        Ok(view.flatten().map(|view| {
            Arc::new(LocationMap {
                resolution: view.map.resolution,
                cells: view.map.cells,
                height: view.height,
                offered: view.offered,
                arrow: if view.is_for_robot { 0.3 } else { 0.12 },
            })
        }))
    }

    /// What the properties describe; `None` if that is no place on something nor one for the robot.
    fn location_query(
        &self,
        image: &mut Image,
        location: &Designator,
        references: &References,
    ) -> Result<Option<Query>> {
        let given = |image: &Image, key: &str| {
            let value = location.property_named(image, key);
            value.filter(Value::is_true)
        };
        let reaches = given(image, "REACHABLE-FOR").is_some();
        let sees = given(image, "VISIBLE-FOR").is_some();
        if reaches || sees {
            let query = self.base_query(image, location, references, (reaches, sees))?;
            return Ok(Some(Query::Base(query)));
        }
        let places = ["ON", "ABOVE", "IN"].map(|key| given(image, key).map(|value| (key, value)));
        let mut places = places.into_iter().flatten();
        let constraints = self.constraints(image, location, references)?;
        let (key, support) = match (places.next(), places.next()) {
            (Some((one, _)), Some((other, _))) => {
                let [one, other] = [one, other].map(str::to_lowercase);
                return Err(Raise::simple(format!(
                    "A location is ({one} …) something or ({other} …) it, not both."
                )));
            }
            (Some((key, value)), None) => (key, self.location_support(image, key, &value)?),
            (None, _) => match self.support_of_neighbour(image, location)? {
                Some(support) => ("ON", support),
                None => return Ok(None),
            },
        };
        if let Some(value) = ["ATTACHMENT", "ATTACHMENTS"]
            .iter()
            .find_map(|k| given(image, k))
        {
            let shown = print::to_string(image, &value, false);
            return Err(Raise::simple(format!(
                "There is no attachment {shown}: none are known for this furniture."
            )));
        }
        let position = match key {
            "ON" => Position::On,
            "ABOVE" => {
                let offset = given(image, "Z-OFFSET");
                let offset = offset.map(|z| metres(image, "Z-OFFSET", &z)).transpose()?;
                Position::Above(offset.unwrap_or(0.0))
            }
            _ => Position::In(level(image, location)?),
        };
        Ok(Some(Query::Place(PlaceQuery {
            support,
            position,
            constraints,
            what: self.what_for(image, location)?,
            orientation: self.orientation(image, location),
        })))
    }

    /// What something stands on beside which the location is, if it does not say itself on what.
    fn support_of_neighbour(
        &self,
        image: &mut Image,
        location: &Designator,
    ) -> Result<Option<Support>> {
        let keys = Beside::ALL.map(Beside::key).into_iter();
        let mut keys = keys.chain(["NEAR", "FAR-FROM"]);
        let value = keys.find_map(|key| location.property_named(image, key));
        let Some(value) = value.map(|v| current(&v)) else {
            return Ok(None);
        };
        let Some(name) = self.named_object(image, &value) else {
            return Ok(None);
        };
        let pose = self.world.object_pose(&name).map_err(|e| raised(&e))?;
        let below = self.world.below(&name, &pose).map_err(|e| raised(&e))?;
        Ok(match below.map(|(_, body)| body) {
            Some(BodyName::Furniture(link)) => Some(Support::Furniture(link.id)),
            Some(BodyName::Object(name)) => Some(Support::Object(name)),
            _ => None,
        })
    }

    /// The name in the world of the object that a value describes or names.
    fn named_object(&self, image: &Image, value: &Value) -> Option<String> {
        let name = match as_designator(value) {
            Some(_) => property(image, value, "NAME")?,
            None => value.clone(),
        };
        let name = name_text(image, &name)?;
        self.world.object(&name).is_ok().then_some(name)
    }

    /// The link of the kitchen that a value describes or names.
    pub(in crate::session) fn furniture_of(&self, image: &Image, value: &Value) -> Option<LinkId> {
        let value = current(value);
        let name = match as_designator(&value) {
            Some(_) => {
                property(image, &value, "URDF-NAME").or_else(|| property(image, &value, "NAME"))?
            }
            None => value.clone(),
        };
        link_named(&self.models, &name_text(image, &name)?).ok()
    }

    /// The horizontal edges (m) of an object, a type of objects or furniture.
    pub(in crate::session) fn size_of(&self, image: &mut Image, value: &Value) -> Option<[f64; 2]> {
        let value = current(value);
        if let Some(name) = self.named_object(image, &value) {
            let size = self.world.object_extent(&name).ok()?.size();
            return Some([size[0], size[1]]);
        }
        if let Some(link) = self.furniture_of(image, &value) {
            let size = self.world.furniture_extent(link)?.size();
            return Some([size[0], size[1]]);
        }
        let kind = match as_designator(&value) {
            Some(_) => property(image, &value, "TYPE")?,
            None => value.clone(),
        };
        let kind = self.models.objects.get(&type_text(image, &kind)?)?;
        let size = Load::of_shapes(&kind.shapes).size(&Pose::identity());
        Some([size[0], size[1]])
    }

    /// Where something is (m, map frame) to which a property refers.
    fn referred(
        &self,
        image: &mut Image,
        (key, value): (&str, &Value),
        references: &References,
    ) -> Result<[f64; 2]> {
        let planar = |pose: &Pose| [pose.translation.x, pose.translation.y];
        if let Some(pose) = references.pose(key) {
            return Ok(planar(&pose));
        }
        let value = current(value);
        if let Some(name) = self.named_object(image, &value) {
            let pose = self.world.object_pose(&name).map_err(|e| raised(&e))?;
            return Ok(planar(&pose));
        }
        match self.location_support(image, key, &value)? {
            Support::Furniture(link) => Ok(planar(&self.world.furniture_pose(link))),
            Support::Object(name) => {
                let pose = self.world.object_pose(&name).map_err(|e| raised(&e))?;
                Ok(planar(&pose))
            }
        }
    }

    /// What the properties demand of a point on a support.
    fn constraints(
        &self,
        image: &mut Image,
        location: &Designator,
        references: &References,
    ) -> Result<Vec<Constraint>> {
        let mut all = plain_constraints(image, location)?;
        let threshold = match location.property_named(image, "THRESHOLD") {
            Some(value) => metres(image, "THRESHOLD", &value)?,
            None => THRESHOLD,
        };
        let mut add = |image: &Image, key: &str, value: &Value, relation: Relation| {
            all.push(Constraint {
                key: written(image, key, value),
                relation,
            });
        };
        for side in Beside::ALL {
            for value in values(image, location, side.key()) {
                let of = self.referred(image, (side.key(), &value), references)?;
                let beside = Relation::Beside {
                    of,
                    side,
                    threshold,
                };
                add(image, side.key(), &self.short(image, &value), beside);
            }
        }
        for (key, ring) in [("NEAR", "NEAR-RING"), ("FAR-FROM", "FAR-FROM-RING")] {
            for value in values(image, location, key) {
                let of = self.referred(image, (key, &value), references)?;
                let [least, most] = *references.numbers(ring) else {
                    continue;
                };
                let distances = [least, most];
                let value = self.short(image, &value);
                add(image, key, &value, Relation::Ring { of, distances });
            }
        }
        if let Some(context) = location
            .property_named(image, "CONTEXT")
            .filter(Value::is_true)
        {
            let slots = references.numbers("SLOTS");
            let slots: Vec<[f64; 2]> = slots.as_chunks().0.to_vec();
            if !slots.is_empty() {
                add(image, "CONTEXT", &context, Relation::Slots(slots));
            }
        }
        if let Some(from) = location.property_named(image, "REACHABLE-FROM")
            && from.is_true()
        {
            let base = match references.pose("REACHABLE-FROM") {
                Some(pose) => pose,
                None if as_placement(&from).is_some() => self.pose_in_map(image, &from)?,
                None => self.base(),
            };
            let of = [base.translation.x, base.translation.y];
            let distances = distances_of(references).reach;
            let value = self.short(image, &from);
            add(
                image,
                "REACHABLE-FROM",
                &value,
                Relation::Ring { of, distances },
            );
        }
        Ok(all)
    }

    /// A value as reports name it: an object by its name, a location not at all.
    fn short(&self, image: &Image, value: &Value) -> Value {
        match self.named_object(image, &current(value)) {
            Some(name) => Value::from(name.as_str()),
            None if as_designator(value).is_some() => Value::from("…"),
            None => value.clone(),
        }
    }

    /// What a property such as `(on …)` names: furniture or an object.
    fn location_support(&self, image: &mut Image, key: &str, value: &Value) -> Result<Support> {
        let thing = current(value);
        let (name, is_link) = match as_designator(&thing) {
            Some(_) => match property(image, &thing, "URDF-NAME") {
                Some(name) => (Some(name), true),
                None => (property(image, &thing, "NAME"), false),
            },
            None => (Some(thing.clone()), false),
        };
        let text = name.and_then(|name| name_text(image, &name));
        let Some(text) = text else {
            let shown = print::to_string(image, value, false);
            return Err(Raise::simple(format!(
                "({} {shown}) does not say which one: write ({} (an object (urdf-name …) (part-of kitchen))); (list-surfaces) tells the names.",
                key.to_lowercase(),
                key.to_lowercase()
            )));
        };
        if !is_link && self.world.object(&text).is_ok() {
            return Ok(Support::Object(text));
        }
        match link_named(&self.models, &text) {
            Ok(link) => Ok(Support::Furniture(link)),
            Err(unknown) => {
                let near = closest_name(&text, self.names.keys().map(String::as_str));
                let known = match (&unknown.closest, near) {
                    (None, Some(near)) if !is_link => {
                        format!("There is no object named {text}; did you mean {near}?")
                    }
                    _ => {
                        let end = if unknown.closest.is_some() { "" } else { "." };
                        let text = unknown.to_string();
                        format!("{}{end}", text.replacen("the", "The", 1))
                    }
                };
                Err(Raise::simple(known))
            }
        }
    }

    /// What the property `for` of a location names.
    fn what_for(&self, image: &mut Image, location: &Designator) -> Result<What> {
        let Some(what) = location.property_named(image, "FOR").filter(Value::is_true) else {
            return Ok(What::Point);
        };
        let thing = current(&what);
        let (name, kind) = match as_designator(&thing) {
            Some(_) => (
                property(image, &thing, "NAME"),
                property(image, &thing, "TYPE"),
            ),
            None => (Some(thing.clone()), Some(thing.clone())),
        };
        let name = name.and_then(|name| name_text(image, &name));
        if let Some(name) = name.filter(|name| self.world.object(name).is_ok()) {
            return Ok(What::Object(name));
        }
        let Some(kind) = kind.and_then(|kind| type_text(image, &kind)) else {
            let shown = print::to_string(image, &what, false);
            return Err(Raise::simple(format!(
                "(for {shown}) does not say what for: write (for (an object (type …))) or (for ?object)."
            )));
        };
        let objects = &self.models.objects;
        if objects.get(&kind).is_none() {
            return Err(raised(&WorldError::UnknownType {
                closest: objects.closest_name(&kind).map(str::to_owned),
                name: kind,
            }));
        }
        Ok(What::Kind(kind))
    }

    fn orientation(&self, image: &mut Image, location: &Designator) -> Orientation {
        let Some(value) = location.property_named(image, "ORIENTATION") else {
            return Orientation::default();
        };
        let wanted = ("ORIENTATION", &value);
        let found = one_of(image, wanted, &Orientation::ALL, Orientation::name);
        found.unwrap_or_else(|text| {
            self.log(image, LogLevel::Warn, "(COSTMAP ORIENTATION)", &text);
            Orientation::default()
        })
    }

    /// A place for the robot from which it reaches or sees something.
    fn base_query(
        &self,
        image: &mut Image,
        location: &Designator,
        references: &References,
        (reaches, sees): (bool, bool),
    ) -> Result<BaseQuery> {
        let object = location.property_named(image, "OBJECT");
        let object = object.filter(Value::is_true).map(|o| current(&o));
        let target = match (&object, references.pose("LOCATION")) {
            (Some(object), Some(pose)) => {
                let what = self.object_or_kind(image, object)?;
                target_of(what, pose, reaches)
            }
            (None, Some(pose)) => {
                let place = location.property_named(image, "LOCATION");
                let place = place.unwrap_or(Value::NIL);
                let what = match as_designator(&place) {
                    Some(place) => self.what_for(image, place)?,
                    None => What::Point,
                };
                target_of(what, pose, reaches)
            }
            (Some(object), None) if self.describes_furniture(image, object) => {
                let container = self.container(image, object)?;
                let distance = location.property_named(image, "DISTANCE");
                let position = self.wanted_opening(&container, distance.as_ref())?;
                self.handle_target(&container, position)
            }
            (Some(object), None) => {
                let seen = self.perceived(image, object)?;
                if let Some(side) = self.hand_of(&seen.name) {
                    return Err(Raise::simple(format!(
                        "{} is in the {side} hand: add (location …), where it is to be put.",
                        seen.name
                    )));
                }
                Target {
                    pose: self.base() * seen.in_base,
                    name: seen.name.clone(),
                    item: Item::Object(seen.name),
                }
            }
            (None, None) => {
                return Err(Raise::simple(
                    "A location that the robot is to reach or see from needs (object …) or (location …).",
                ));
            }
        };
        let mut arms = match location.property_named(image, "ARM").filter(Value::is_true) {
            Some(arm) => sides(image, &arm)?,
            None => Side::BOTH.to_vec(),
        };
        let named = ["GRASP", "GRASPS"]
            .map(|key| values(image, location, key))
            .concat();
        let named = named.iter().filter_map(|name| type_text(image, name));
        let grasps = Some(named.collect::<Vec<_>>()).filter(|names| !names.is_empty());
        let held = match &target.item {
            Item::Moved(name) if reaches => self.hand_of(name).map(|side| (name, side)),
            _ => None,
        };
        let held = held.map(|(name, side)| self.grip_on(name, side).map(Box::new));
        let held = held.transpose().map_err(|e| raised(&e))?;
        if let Some(grip) = &held {
            arms = vec![grip.side];
        }
        Ok(BaseQuery {
            target,
            arms: reaches.then_some(arms),
            grasps,
            held,
            sees,
            distances: distances_of(references),
            from: [self.base().translation.x, self.base().translation.y],
        })
    }

    /// The object of the world that a designator names, or else its type.
    fn object_or_kind(&self, image: &mut Image, object: &Value) -> Result<What> {
        let name = property(image, object, "NAME");
        let name = name.and_then(|name| name_text(image, &name));
        if let Some(name) = name.filter(|name| self.world.object(name).is_ok()) {
            return Ok(What::Object(name));
        }
        let kind = property(image, object, "TYPE");
        let kind = kind.and_then(|kind| type_text(image, &kind));
        let known = kind.filter(|kind| self.models.objects.get(kind).is_some());
        Ok(known.map_or(What::Point, What::Kind))
    }
}

/// The distances that users may redefine.
fn distances_of(references: &References) -> Distances {
    let usual = Distances::default();
    let number = |key: &str, otherwise: f64| {
        references
            .numbers(key)
            .first()
            .copied()
            .unwrap_or(otherwise)
    };
    Distances {
        reach: [
            number("COSTMAP-REACH-MINIMAL-DISTANCE", usual.reach[0]),
            number("COSTMAP-IN-REACH-DISTANCE", usual.reach[1]),
        ],
        sight: number("VISIBILITY-COSTMAP-SIZE", usual.sight),
    }
}

/// Which board a location is on.
fn level(image: &Image, location: &Designator) -> Result<Level> {
    for (key, is_inverted) in [("LEVEL", false), ("LEVEL-INVERT", true)] {
        let Some(value) = location.property_named(image, key).filter(Value::is_true) else {
            continue;
        };
        if let Value::Int(n) = value
            && let Ok(n) = usize::try_from(n)
        {
            return Ok(match is_inverted {
                true => Level::FromAbove(n),
                false => Level::FromBelow(n),
            });
        }
        let name = |level: Level| match level {
            Level::Topmost => "topmost",
            Level::Middle => "middle",
            _ => "bottommost",
        };
        let choices = [Level::Topmost, Level::Middle, Level::FromBelow(1)];
        let found = one_of(image, (key, &value), &choices, name).map_err(Raise::simple)?;
        return Ok(match (found, is_inverted) {
            (Level::Topmost, true) => Level::FromBelow(1),
            (Level::FromBelow(_), true) => Level::Topmost,
            (found, _) => found,
        });
    }
    Ok(Level::Any)
}

/// The target at a pose. What is only to be seen need not be there yet.
fn target_of(what: What, pose: Pose, reaches: bool) -> Target {
    let t = pose.translation;
    let place = format!("({:.2} {:.2} {:.2})", t.x, t.y, t.z);
    let (item, name) = match what {
        What::Object(name) => (Item::Moved(name.clone()), format!("{name} at {place}")),
        What::Kind(kind) if reaches => {
            let name = format!("a {kind} at {place}");
            (Item::Kind(kind), name)
        }
        What::Kind(_) | What::Point => (Item::Point, place),
    };
    Target { item, pose, name }
}

/// The demands that refer to nothing else.
fn plain_constraints(image: &Image, location: &Designator) -> Result<Vec<Constraint>> {
    let mut all = Vec::new();
    let mut add = |key: &str, value: &Value, relation: Relation| {
        all.push(Constraint {
            key: written(image, key, value),
            relation,
        });
    };
    for side in values(image, location, "SIDE") {
        let direction = one_of(image, ("SIDE", &side), &Direction::ALL, Direction::name)
            .map_err(Raise::simple)?;
        add("SIDE", &side, Relation::Side(direction));
    }
    type Make = fn(f64) -> Relation;
    let distances: [(&str, Make); 3] = [
        ("RANGE", Relation::Within),
        ("RANGE-INVERT", Relation::Beyond),
        ("CENTERED-WITH-PADDING", Relation::Padding),
    ];
    for (key, relation) in distances {
        for value in values(image, location, key) {
            add(key, &value, relation(metres(image, key, &value)?));
        }
    }
    Ok(all)
}
