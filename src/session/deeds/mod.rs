//! What has happened in the world and in plans since a lesson began.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use crate::audience::FollowerId;
use lisp::image::Image;
use lisp::image::extension::Extension;
use lisp::value::copy::Copier;
use robotics::motion::held_objects;
use robotics::robot::Side;
use robotics::world::{CollisionHit, World};
use view::watch::{Cause, Follower, Observation, TaskId, TaskState, WatchEvent};

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

/// A follower that notes what happens.
pub(crate) struct Witness {
    deeds: Rc<Deeds>,
    /// What the hands hold; `None` before the world has been seen.
    held: Option<Vec<(Side, String)>>,
}

impl Witness {
    /// One that notes what happens there.
    pub(crate) fn new(deeds: Rc<Deeds>) -> Witness {
        Witness { deeds, held: None }
    }
}

impl Follower for Witness {
    fn see(&mut self, observation: &Observation<'_>, _: Cause) {
        let held = held(observation.world);
        let Some(before) = self.held.replace(held.clone()) else {
            return;
        };
        for (side, object) in before.iter().filter(|one| !held.contains(one)) {
            let (side, object) = (*side, object.clone());
            self.deeds.note(Deed::Released { object, side });
        }
        for (side, object) in held.into_iter().filter(|one| !before.contains(one)) {
            self.deeds.note(Deed::Held { object, side });
        }
    }

    fn hear(&mut self, _: f64, event: &WatchEvent) {
        let WatchEvent::Task(news) = event else {
            return;
        };
        match (news.id, news.state) {
            (TaskId::Action(_) | TaskId::Motion(_), TaskState::Succeeded) => {
                self.deeds.note(Deed::Performed(news.name.clone()));
            }
            (TaskId::Motion(_), TaskState::Failed) => self.deeds.note(Deed::Failed {
                motion: news.name.clone(),
                class: news.class.clone(),
            }),
            _ => {}
        }
    }

    fn collide(&mut self, _: f64, hit: &CollisionHit) {
        let bodies = [&hit.moving, &hit.other].map(ToString::to_string);
        self.deeds.note(Deed::Collided(bodies));
    }
}

/// The objects that the hands hold.
pub(crate) fn held(world: &World) -> Vec<(Side, String)> {
    let sides = [Side::Left, Side::Right].into_iter();
    let held = sides.flat_map(|side| {
        let objects = held_objects(world, side).into_iter();
        objects.map(move |object| (side, object))
    });
    held.collect()
}
