//! Places for the robot from which it reaches or sees something.

use super::properties::{raised, values};
use super::references::References;
use crate::simulation::Simulation;
use crate::simulation::motions::{arms, sides};
use crate::simulation::names::type_text;
use cram::designator::value::{Designator, as_designator, current};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;
use robotics::location::{BaseQuery, Distances, Item, Target, What};
use spatial::Pose;

type Result<T> = std::result::Result<T, Box<Raise>>;

impl Simulation {
    /// A place for the robot from which it reaches or sees something.
    pub(super) fn base_query(
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
                let container = self.handled(image, object)?;
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
                    pose: self.believed_base() * seen.in_base,
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
            None => arms(image),
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
}

/// The distances that users may redefine.
pub(super) fn distances_of(references: &References) -> Distances {
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
