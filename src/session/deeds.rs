//! What has happened in the world and in plans since a lesson began.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use crate::audience::FollowerId;
use crate::face::{Observer, PlanEvent, PlanEventKind};
use lisp::image::Image;
use lisp::image::extension::Extension;
use lisp::value::copy::Copier;
use robotics::robot::Side;
use view::watch::{TaskId, TaskState};

/// Maximum number of deeds that are kept.
const MAX_DEEDS: usize = 100_000;

/// Something that has happened.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Deed {
    /// A hand holds an object from now on.
    Held {
        /// The object.
        object: String,
        /// The hand.
        side: Side,
    },
    /// A hand holds an object no more.
    Released {
        /// The object.
        object: String,
        /// The hand.
        side: Side,
    },
    /// An action or a motion of a type has begun.
    Began(String),
    /// An action or a motion of a type has been performed.
    Performed(String),
    /// A motion of a type has failed, with a failure of a class.
    Failed {
        /// The type.
        motion: String,
        /// The class.
        class: String,
    },
    /// Two bodies were, or would have been, in each other, so that a motion has failed.
    Collided([String; 2]),
    /// A form or a submission has ended, with a condition of that class if one has left it.
    Ended(Option<String>),
}

/// What has happened since a lesson began, kept in an image.
#[derive(Default)]
pub(crate) struct Deeds {
    all: RefCell<Vec<Deed>>,
    /// Who notes them in this session.
    witness: Cell<Option<FollowerId>>,
}

impl Deeds {
    /// Those of an image.
    pub(crate) fn of(image: &mut Image) -> Rc<Deeds> {
        let deeds = image.extension::<Deeds>();
        deeds.unwrap_or_else(|| image.extend(Deeds::default()))
    }

    /// All of them, in order.
    pub(crate) fn all(&self) -> Vec<Deed> {
        self.all.borrow().clone()
    }

    /// Takes others in their place.
    pub(crate) fn set(&self, deeds: Vec<Deed>) {
        *self.all.borrow_mut() = deeds;
    }

    /// One more.
    pub(crate) fn note(&self, deed: Deed) {
        let mut all = self.all.borrow_mut();
        if all.len() < MAX_DEEDS {
            all.push(deed);
        }
    }

    /// What notes those that happen from now on. What functions do to the world is none.
    pub(crate) fn observer(self: Rc<Self>) -> Observer {
        let note = move |event: &PlanEvent| {
            if let Some(deed) = deed_of(event) {
                self.note(deed);
            }
        };
        Observer::new(Box::new(note)).of_robot()
    }

    /// Who notes them, if anybody does.
    pub(crate) fn witness(&self) -> Option<FollowerId> {
        self.witness.get()
    }

    /// Somebody notes them from now on.
    pub(crate) fn set_witness(&self, witness: Option<FollowerId>) {
        self.witness.set(witness);
    }
}

impl Extension for Deeds {
    fn copied(self: Rc<Self>, _: &mut Copier) -> Rc<dyn Extension> {
        // Followers are not copied.
        Rc::new(Deeds {
            all: self.all.clone(),
            witness: Cell::new(None),
        })
    }
}

/// What an event is as a deed, if it is one.
fn deed_of(event: &PlanEvent) -> Option<Deed> {
    Some(match &event.kind {
        PlanEventKind::Held { object, side } => Deed::Held {
            object: object.clone(),
            side: *side,
        },
        PlanEventKind::Released { object, side } => Deed::Released {
            object: object.clone(),
            side: *side,
        },
        PlanEventKind::Collided(bodies) => Deed::Collided(bodies.clone()),
        PlanEventKind::Began(begin) if !matches!(begin.id, TaskId::Task(_)) => {
            Deed::Began(begin.name.clone())
        }
        PlanEventKind::Ended(end) => match (end.id, &end.failure) {
            (TaskId::Task(_), _) => return None,
            (_, None) if end.state == TaskState::Succeeded => Deed::Performed(end.name.clone()),
            (TaskId::Motion(_), Some((class, _))) => Deed::Failed {
                motion: end.name.clone(),
                class: class.clone(),
            },
            _ => return None,
        },
        _ => return None,
    })
}
