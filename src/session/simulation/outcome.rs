//! Results of motions as Lisp values and conditions.

use super::Simulation;
use super::names::type_keyword;
use cram::designator::object;
use cram::designator::value::as_designator;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::package::PackageTable;
use lisp::value::raise::Raise;
use robotics::motion::{DetectedObject, MotionFailure, MotionOutcome};

/// Designators of detected objects, each with the name by which users know it: the first one, or
/// a list of all if all were requested.
fn detected(
    image: &mut Image,
    objects: &[(Value, &DetectedObject)],
    query: &Value,
    base: &str,
) -> Value {
    let found: Vec<Value> = objects
        .iter()
        .map(|(name, object)| {
            let kind = type_keyword(image, &object.type_name);
            object::perceived(
                image,
                query,
                name.clone(),
                kind,
                base,
                &object.pose_in_base,
                &object.pose_in_map,
            )
        })
        .collect();
    if as_designator(query).is_some_and(|d| d.is_all()) {
        return Value::list(found);
    }
    found.into_iter().next().unwrap_or(Value::NIL)
}

impl Simulation {
    /// The result of a motion as a value.
    pub(crate) fn outcome(
        &mut self,
        image: &mut Image,
        outcome: &MotionOutcome,
        subject: &Value,
    ) -> Value {
        match outcome {
            MotionOutcome::Arrived | MotionOutcome::Gripped { .. } => Value::NIL,
            MotionOutcome::Put { raised, .. } => Value::Double(*raised),
            MotionOutcome::Released { object, .. } => {
                self.held.shift_remove(object);
                Value::NIL
            }
            MotionOutcome::Detected(objects) => {
                for object in objects {
                    // One that the camera of a robot elsewhere has found has no name yet.
                    if !self.names.contains_key(&object.name) {
                        let package = image.current_package();
                        let symbol = image.intern(package, &object.name);
                        self.names.insert(object.name.clone(), symbol.into());
                    }
                    self.see_grip(&object.name, &object.pose_in_base);
                }
                let named = objects.iter().map(|o| (self.symbol_of(&o.name), o));
                let named: Vec<(Value, &DetectedObject)> = named.collect();
                detected(image, &named, subject, self.base_frame())
            }
        }
    }

    /// The failure condition for a motion's failure; `subject` is the designator it is about.
    pub(crate) fn failure(
        &mut self,
        image: &mut Image,
        failure: &MotionFailure,
        subject: &Value,
    ) -> Box<Raise> {
        self.remember(failure);
        self.tally.failed(failure.class_name());
        let package = image
            .packages
            .find("CRAM-COMMON-FAILURES")
            .unwrap_or(PackageTable::USER);
        let class = image.intern(package, failure.class_name());
        let text = failure.to_string();
        let mut raise = Raise::new(class, text.clone());
        let description = image.keyword("DESCRIPTION");
        raise = raise.with(description, text.as_str().into());
        for initarg in ["OBJECT", "LOCATION", "ACTION"] {
            let initarg = image.keyword(initarg);
            raise = raise.with(initarg, subject.clone());
        }
        raise
    }
}
