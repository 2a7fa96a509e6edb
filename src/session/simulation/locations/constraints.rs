//! What the properties of a location demand of a point on its support.

use super::bases::distances_of;
use super::properties::{metres, one_of, raised, values, written};
use super::references::References;
use crate::simulation::Simulation;
use cram::designator::value::{Designator, as_designator, current};
use cram::pose::value::as_placement;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;
use robotics::location::{Beside, Constraint, Direction, Relation, Support};
use spatial::Pose;

/// Cosine of the angle to the wanted direction, at least, unless the location says another.
const THRESHOLD: f64 = 0.2;

type Result<T> = std::result::Result<T, Box<Raise>>;

impl Simulation {
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
    pub(super) fn constraints(
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
