//! Objects and furniture that the properties of a location describe or name.

use super::properties::raised;
use crate::simulation::Simulation;
use crate::simulation::names::{name_text, type_text};
use crate::simulation::properties::property;
use closest_name::closest_name;
use cram::designator::value::{Designator, as_designator, current};
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::raise::Raise;
use robotics::location::{Support, What, link_named};
use robotics::robot::LinkId;
use robotics::world::{Load, WorldError};
use spatial::Pose;

type Result<T> = std::result::Result<T, Box<Raise>>;

impl Simulation {
    /// The name in the world of the object that a value describes or names.
    pub(crate) fn named_object(&self, image: &Image, value: &Value) -> Option<String> {
        let name = match as_designator(value) {
            Some(_) => property(image, value, "NAME")?,
            None => value.clone(),
        };
        let name = name_text(image, &name)?;
        self.world.object(&name).is_ok().then_some(name)
    }

    /// The link of the kitchen that a value describes or names.
    pub(crate) fn furniture_of(&self, image: &Image, value: &Value) -> Option<LinkId> {
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
    pub(crate) fn size_of(&self, image: &mut Image, value: &Value) -> Option<[f64; 2]> {
        let value = current(value);
        if let Some(name) = self.named_object(image, &value) {
            let size = self.world.object_extent(&name).ok()?.size();
            return Some([size[0], size[1]]);
        }
        if let Some(link) = self.furniture_of(image, &value) {
            let size = self.world.assembly_extent(link)?.size();
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

    /// What a property such as `(on …)` names: furniture or an object.
    pub(super) fn location_support(
        &self,
        image: &mut Image,
        key: &str,
        value: &Value,
    ) -> Result<Support> {
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
                Err(match (&unknown.closest, near) {
                    (None, Some(near)) if !is_link => Raise::simple(format!(
                        "There is no object named {text}; did you mean {near}?"
                    )),
                    _ => Raise::reporting(unknown.to_string().replacen("the", "The", 1)),
                })
            }
        }
    }

    /// What the property `for` of a location names.
    pub(super) fn what_for(&self, image: &mut Image, location: &Designator) -> Result<What> {
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

    /// The object of the world that a designator names, or else its type.
    pub(super) fn object_or_kind(&self, image: &mut Image, object: &Value) -> Result<What> {
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
