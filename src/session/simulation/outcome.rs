//! Results of motions as Lisp values and conditions.

use super::Simulation;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::package::PackageTable;
use crate::lisp::value::raise::Raise;
use crate::motion::{MotionFailure, MotionOutcome};

impl Simulation {
    /// The result of a motion as a value.
    pub(in crate::session) fn outcome(
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
            MotionOutcome::Detected(objects) => self.detected(image, objects, subject),
        }
    }

    /// The failure condition for a motion's failure; `subject` is the designator it is about.
    pub(in crate::session) fn failure(
        &mut self,
        image: &mut Image,
        failure: &MotionFailure,
        subject: &Value,
    ) -> Box<Raise> {
        self.remember(failure);
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
