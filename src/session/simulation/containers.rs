//! Drawers and doors as plans name them.

use super::Simulation;
use super::names::name_text;
use super::properties::property;
use cram::designator::value::{as_designator, current};
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;
use robotics::location::{Container, Item, Target, container_of, link_named};
use robotics::robot::Limits;
use robotics::world::Knob;
use spatial::pose;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Travel (m or rad) below which a part counts as fixed.
const FIXED: f64 = 1e-6;

impl Simulation {
    /// The drawer or door that a value describes or names, as itself, as the furniture that it is
    /// in, or as one of its parts; an error if there is none.
    pub(crate) fn container(&self, image: &Image, value: &Value) -> Result<Container> {
        let value = current(value);
        let shown = print::to_string(image, &value, false);
        let refused =
            |why: &str| Raise::simple(format!("{shown} cannot be opened or closed: {why}"));
        let name = match as_designator(&value) {
            Some(_) => property(image, &value, "URDF-NAME")
                .or_else(|| property(image, &value, "NAME"))
                .ok_or_else(|| {
                    refused("it does not say which one it is; write (urdf-name …), as (list-containers) tells.")
                })?,
            None => value.clone(),
        };
        let Some(text) = name_text(image, &name) else {
            return Err(refused("it has no name."));
        };
        if self.world.object(&text).is_ok() {
            return Err(refused(&format!(
                "{} is an object, and no drawer or door of the kitchen.",
                text.to_lowercase()
            )));
        }
        let link = link_named(&self.models, &text).map_err(Raise::reporting)?;
        if self.models.knob(link).is_some() {
            return Err(refused(
                "it is a knob, which (an action (type turning-knob) …) turns.",
            ));
        }
        let found = container_of(&self.models, link).ok_or_else(|| {
            refused(
                "it is no drawer or door with a handle; (list-containers) tells which there are.",
            )
        })?;
        if !self.moves(&found) {
            return Err(refused("its joint is fixed."));
        }
        Ok(found)
    }

    /// The knob that a value describes or names; an error if there is none of that name.
    pub(crate) fn knob(&self, image: &Image, value: &Value) -> Result<Knob> {
        let shown = print::to_string(image, &current(value), false);
        let Some(text) = self.furniture_text(image, value) else {
            return Err(Raise::simple(format!(
                "{shown} does not say which knob it is; write (urdf-name …), as (list-knobs) tells."
            )));
        };
        let link = link_named(&self.models, &text).map_err(Raise::reporting)?;
        self.models.knob(link).ok_or_else(|| {
            let what = match self.models.knobs().is_empty() {
                true => "the kitchen has none",
                false => "(list-knobs) tells which there are",
            };
            Raise::simple(format!("{} is no knob; {what}.", text.to_lowercase()))
        })
    }

    /// What a hand can take and move: a drawer or door by its handle, or a knob; an error if the value
    /// describes or names neither.
    pub(crate) fn handled(&self, image: &Image, value: &Value) -> Result<Container> {
        let text = self.furniture_text(image, value);
        let link = text.and_then(|text| link_named(&self.models, &text).ok());
        match link.and_then(|link| self.models.knob(link)) {
            Some(knob) => Ok(Container {
                link: knob.link,
                joint: knob.joint,
                handle: knob.link,
            }),
            None => self.container(image, value),
        }
    }

    /// The name of furniture that a value describes or names.
    fn furniture_text(&self, image: &Image, value: &Value) -> Option<String> {
        let value = current(value);
        let name = match as_designator(&value) {
            Some(_) => {
                property(image, &value, "URDF-NAME").or_else(|| property(image, &value, "NAME"))?
            }
            None => value,
        };
        name_text(image, &name)
    }

    /// Whether furniture that a value describes or names can be opened or closed; an error if there
    /// is no such furniture.
    pub(crate) fn is_container(&self, image: &Image, value: &Value) -> Result<bool> {
        let value = current(value);
        let name = match as_designator(&value) {
            Some(_) => property(image, &value, "URDF-NAME"),
            None => Some(value.clone()),
        };
        let Some(text) = name.and_then(|name| name_text(image, &name)) else {
            return Ok(false);
        };
        let link = link_named(&self.models, &text).map_err(Raise::reporting)?;
        Ok(container_of(&self.models, link).is_some())
    }

    /// Whether a designator describes furniture rather than an object.
    pub(crate) fn describes_furniture(&self, image: &Image, object: &Value) -> bool {
        as_designator(object).is_some() && property(image, object, "URDF-NAME").is_some()
    }

    /// Whether the joint of a container can move: some files have joints from 0 to 0.
    pub(crate) fn moves(&self, container: &Container) -> bool {
        let limits = self.travel(container);
        limits.upper - limits.lower > FIXED
    }

    /// The limits (rad or m) of a container's joint.
    pub(crate) fn travel(&self, container: &Container) -> Limits {
        let limits = self.models.kitchen.joint(container.joint).limits;
        limits.unwrap_or(Limits {
            lower: -std::f64::consts::PI,
            upper: std::f64::consts::PI,
        })
    }

    /// Where a container's joint is (rad or m).
    pub(crate) fn opening_of(&self, container: &Container) -> f64 {
        let kitchen = &self.models.kitchen;
        kitchen.position(self.world.kitchen_positions(), container.joint)
    }

    /// The position (rad or m) to which a container's joint is to be brought: the given one, within
    /// the limits, or else the end that is farther away.
    pub(crate) fn wanted_opening(
        &self,
        container: &Container,
        distance: Option<&Value>,
    ) -> Result<f64> {
        let Limits { lower, upper } = self.travel(container);
        let Some(distance) = distance.filter(|d| d.is_true()) else {
            let now = self.opening_of(container);
            return Ok(if now - lower < upper - now {
                upper
            } else {
                lower
            });
        };
        let number = number::to_f64(distance).filter(|x| x.is_finite());
        let number = number.ok_or_else(|| {
            Raise::simple(
                "A distance to open something is a number of metres or radians.".to_owned(),
            )
        })?;
        Ok(number.clamp(lower, upper))
    }

    /// The handle of a container as something to be reached from all along its way.
    pub(crate) fn handle_target(&self, container: &Container, position: f64) -> Target {
        let kitchen = &self.models.kitchen;
        let now = self.world.furniture_pose(container.handle);
        let (_, then) = self.world.kitchen_with(container.joint, position);
        let then = then.get(container.handle.index()).copied().unwrap_or(now);
        Target {
            pose: pose::between(&now, &then, 0.5),
            name: kitchen.link(container.handle).name.clone(),
            item: Item::Handle {
                container: container.clone(),
                position,
            },
        }
    }
}
