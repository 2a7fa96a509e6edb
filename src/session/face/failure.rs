//! Why an evaluation has no values.

use std::path::PathBuf;

use thiserror::Error;

use super::{Datum, from_value};
use crate::bounds::Limit;
use crate::dialogue::Abort;
use lisp::image::Image;
use lisp::value::Value;

/// Why an evaluation has no values.
#[derive(Clone, PartialEq, Debug, Error)]
#[non_exhaustive]
pub enum Failure {
    /// A condition that no handler took.
    #[error("{}", .0.abort.report)]
    Unhandled(Box<Unhandled>),
    /// It has reached a limit.
    #[error("{0} has been reached")]
    LimitReached(Limit),
    /// It was interrupted.
    #[error("the evaluation was interrupted")]
    Interrupted,
    /// The program has asked to exit with this status.
    #[error("the program has asked to exit with status {0}")]
    Quit(u8),
    /// A defect of planwright, not of the program: the world is as it was before the form.
    #[error("{0}")]
    Defect(String),
    /// A package, a function or an argument that cannot be; nothing has been evaluated.
    #[error("{0}")]
    Invalid(String),
    /// The file cannot be read.
    #[error("cannot read {}: {reason}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The reason.
        reason: String,
    },
}

/// A condition that no handler took.
#[derive(Clone, PartialEq, Default, Debug)]
pub struct Unhandled {
    /// Its class, its report, where it was signalled, and the actions being performed.
    pub abort: Abort,
    /// The names of its class and of all superclasses, most specific first.
    pub classes: Vec<String>,
    /// Its slots, such as the attempts of an action, by name.
    pub slots: Vec<(String, Datum)>,
}

impl Unhandled {
    /// What is known about a condition besides its report.
    pub(super) fn of(image: &Image, abort: Abort, condition: Option<&Value>) -> Unhandled {
        let Some(Value::Instance(instance)) = condition else {
            return Unhandled {
                classes: vec![abort.class.clone()],
                abort,
                slots: Vec::new(),
            };
        };
        let class = instance.class();
        let classes = class.precedence.borrow();
        let classes = classes
            .iter()
            .map(|class| image.name(class.name).to_owned());
        let classes = classes.collect();
        let names: Vec<_> = class.slots.borrow().iter().map(|slot| slot.name).collect();
        let slots = names.into_iter().filter_map(|name| {
            let value = instance.slot(name).filter(|value| !value.is_unbound())?;
            Some((
                image.name(name).to_owned(),
                from_value::datum(image, &value),
            ))
        });
        Unhandled {
            abort,
            classes,
            slots: slots.collect(),
        }
    }

    /// Whether it is of a class, or of one of its subclasses.
    pub fn is_a(&self, class: &str) -> bool {
        self.classes.iter().any(|known| known == class)
    }

    /// The value of a slot that has one.
    pub fn slot(&self, name: &str) -> Option<&Datum> {
        let slot = self.slots.iter().find(|(known, _)| known == name);
        slot.map(|(_, value)| value)
    }
}

impl Failure {
    /// The condition, if there was one.
    pub fn unhandled(&self) -> Option<&Unhandled> {
        match self {
            Failure::Unhandled(unhandled) => Some(unhandled),
            _ => None,
        }
    }
}
