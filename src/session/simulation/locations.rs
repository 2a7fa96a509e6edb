//! From location designators to descriptions of places, and the search for them.

use std::cell::RefCell;
use std::sync::Arc;

use super::Simulation;
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
    BaseQuery, Constraint, Direction, Item, Orientation, PlaceQuery, Query, Relation, Scene,
    Stream, Support, Target, What, link_named,
};
use crate::motion::interruption::interruptible;
use crate::picture::LocationMap;
use crate::plan::designator::value::{Class, Designator, as_class, as_designator, current, first};
use crate::robot::Side;
use crate::session::LogLevel;
use crate::spatial::Pose;
use crate::world::WorldError;

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
    /// if its properties do not describe a place. `target` is where the location is that is to be
    /// reached or seen.
    pub(in crate::session) fn location_stream(
        &mut self,
        image: &mut Image,
        location: &Value,
        target: &Value,
    ) -> Result<Option<Value>> {
        let oldest = first(location);
        let Some(designator) = as_class(&oldest, Class::Location) else {
            let shown = print::to_string(image, location, false);
            return Err(Raise::simple(format!("{shown} is no location.")));
        };
        if let Some(memory) = designator.memory.borrow().clone()
            && memory.as_foreign::<LocationStream>().is_some()
        {
            return Ok(Some(memory));
        }
        let target = match target.is_true() {
            true => Some(self.pose_in_map(image, target)?),
            false => None,
        };
        let Some(query) = self.location_query(image, designator, target)? else {
            return Ok(None);
        };
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
        target: Option<Pose>,
    ) -> Result<Option<Query>> {
        let given = |image: &Image, key: &str| {
            let value = location.property_named(image, key);
            value.filter(Value::is_true)
        };
        let reaches = given(image, "REACHABLE-FOR").is_some();
        let sees = given(image, "VISIBLE-FOR").is_some();
        if reaches || sees {
            let query = self.base_query(image, location, target, (reaches, sees))?;
            return Ok(Some(Query::Base(query)));
        }
        let (on, above) = (given(image, "ON"), given(image, "ABOVE"));
        let (key, support) = match (&on, &above) {
            (Some(_), Some(_)) => {
                return Err(Raise::simple(
                    "A location is (on …) something or (above …) it, not both.",
                ));
            }
            (Some(on), None) => ("ON", on.clone()),
            (None, Some(above)) => ("ABOVE", above.clone()),
            (None, None) => return Ok(None),
        };
        let offset = given(image, "Z-OFFSET");
        let offset = offset.map(|z| metres(image, "Z-OFFSET", &z)).transpose()?;
        Ok(Some(Query::Place(PlaceQuery {
            support: self.location_support(image, key, &support)?,
            above: above.map(|_| offset.unwrap_or(0.0)),
            constraints: constraints(image, location)?,
            what: self.what_for(image, location)?,
            orientation: self.orientation(image, location),
        })))
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
        target: Option<Pose>,
        (reaches, sees): (bool, bool),
    ) -> Result<BaseQuery> {
        let object = location.property_named(image, "OBJECT");
        let object = object.filter(Value::is_true).map(|o| current(&o));
        let target = match (&object, target) {
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
        let mut grasps = None;
        if let Item::Moved(name) = &target.item
            && let Some(side) = self.hand_of(name)
        {
            arms = vec![side];
            let held = self.held.get(name).and_then(|held| held.grasp.clone());
            grasps = held.map(|grasp| vec![grasp]);
        }
        Ok(BaseQuery {
            target,
            arms: reaches.then_some(arms),
            grasps,
            sees,
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

/// What the properties demand of a point on a support.
fn constraints(image: &Image, location: &Designator) -> Result<Vec<Constraint>> {
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
