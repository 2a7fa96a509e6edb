//! Faults that are injected below plans, at motions.
//!
//! A fault is physical where it can be: a grip that slips lets the object fall, what blocks a way is a
//! body. Others end a motion with a failure of its own. Nobody but the record of a sweep learns that a
//! fault was injected.
//!
//! Whether a fault strikes depends on the world, the kind of fault, the object and how often the two
//! have met, and on nothing else: an additional retry of one thing shifts no fault of another.

mod fault;
mod faulty;
mod faulty_sight;

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

pub(crate) use fault::{Fault, FaultKind};
use faulty::{Faulty, Strike};
use faulty_sight::FaultySight;

use super::Simulation;
use super::motions::sides;
use super::names::name_text;
use cram::designator::MotionRequest;
use lisp::image::Image;
use robotics::motion::{Motion, ProcessModule, held_objects};
use robotics::world::World;
use sweep::Draws;

/// All faults that may strike, and those that have.
#[derive(Clone, Default)]
pub(crate) struct Injection {
    faults: Vec<Fault>,
    seed: u64,
    world: u64,
    /// Faults that are not to strike, by path.
    off: BTreeSet<String>,
    /// How often a kind of fault and an object have met.
    met: BTreeMap<String, u64>,
    /// Until when (s since the plan began) a fault that has struck goes on, by kind and object.
    lasting: BTreeMap<String, f64>,
    /// Obstacles, and when (s) they go away.
    obstacles: Vec<(String, f64)>,
    /// The paths of faults that have struck.
    struck: Vec<String>,
}

/// The faults of a session, shared with the motions that they may strike.
pub(crate) type SharedInjection = Rc<RefCell<Injection>>;

/// The numbers with which a fault strikes.
pub(super) struct Blow {
    /// The path of its draws.
    path: String,
    numbers: Draws,
}

impl Injection {
    /// Forgets everything; draws are those of a world.
    pub(crate) fn begin(&mut self, seed: u64, world: u64, off: BTreeSet<String>) {
        *self = Self {
            seed,
            world,
            off,
            ..Self::default()
        };
    }

    /// No fault strikes any more.
    pub(crate) fn end(&mut self) {
        self.faults.clear();
    }

    /// A fault may strike from now on.
    pub(crate) fn add(&mut self, fault: Fault) {
        self.faults.push(fault);
    }

    /// The paths of faults that have struck, in order.
    pub(crate) fn struck(&self) -> Vec<String> {
        self.struck.clone()
    }

    /// Whether a fault strikes an object, or a motion that is about none. `now` is the time (s) since
    /// the plan began.
    fn strikes(&mut self, fault: &Fault, object: Option<&str>, now: f64) -> Option<Blow> {
        let kind = fault.kind.name();
        let key = match object {
            Some(object) => format!("inject.{kind}.{object}"),
            None => format!("inject.{kind}"),
        };
        let count = self.met.entry(key.clone()).or_default();
        *count += 1;
        let path = format!("{key}.{count}");
        let mut numbers = Draws::new(self.seed, self.world, &path);
        let is_drawn = numbers.unit() < fault.probability;
        let strikes = match fault.after {
            _ if !fault.at.is_empty() => fault.at.contains(count),
            Some(after) => {
                let end = fault
                    .duration
                    .map_or(f64::INFINITY, |duration| after + duration);
                (after..end).contains(&now) && is_drawn
            }
            None => is_drawn || self.lasting.get(&key).is_some_and(|end| now < *end),
        };
        if !strikes || self.off.contains(&path) {
            return None;
        }
        if let (Some(duration), None) = (fault.duration, fault.after)
            && is_drawn
            && fault.at.is_empty()
        {
            self.lasting.insert(key, now + duration);
        }
        Some(Blow { path, numbers })
    }

    /// Notes that a fault has struck.
    fn note(&mut self, path: &str) {
        self.struck.push(path.to_owned());
    }
}

impl Simulation {
    /// The motion with the faults that strike it.
    pub(crate) fn with_faults(
        &mut self,
        image: &Image,
        motion: Box<dyn Motion>,
        request: &MotionRequest,
    ) -> Box<dyn Motion> {
        if self.injection.borrow().faults.is_empty() {
            return motion;
        }
        let shared = Rc::clone(&self.injection);
        let now = self.now - self.tally.began;
        self.remove_obstacles(now);
        let faults = shared.borrow().faults.clone();
        if motion.module() == ProcessModule::Perception {
            let query = self.sought.clone().unwrap_or_default();
            return Box::new(FaultySight::new(motion, query, shared, faults, now));
        }
        let mut motion = motion;
        for fault in &faults {
            if let Some((strike, blow)) =
                self.strike_of(image, fault, motion.as_ref(), request, now)
            {
                motion = Box::new(Faulty::new(motion, strike, blow, Rc::clone(&shared)));
            }
        }
        motion
    }

    /// What a fault does to the motion, if it strikes.
    fn strike_of(
        &self,
        image: &Image,
        fault: &Fault,
        motion: &dyn Motion,
        request: &MotionRequest,
        now: f64,
    ) -> Option<(Strike, Blow)> {
        let mut injection = self.injection.borrow_mut();
        let module = motion.module();
        let suits = match fault.kind {
            FaultKind::GripperSlip => {
                matches!(module, ProcessModule::Arms | ProcessModule::Navigation)
            }
            FaultKind::GripperMisses => request.motion_type == "GRIPPING",
            FaultKind::NavigationBlocked | FaultKind::NavigationStopsShort => {
                module == ProcessModule::Navigation
            }
            FaultKind::ArmStuck => module == ProcessModule::Arms,
            FaultKind::TorsoStuck => module == ProcessModule::Torso,
            FaultKind::PerceptionMiss
            | FaultKind::PerceptionNoise
            | FaultKind::PerceptionConfusion => false,
        };
        if !suits {
            return None;
        }
        match fault.kind {
            FaultKind::GripperSlip => {
                let held = (self.models.description.sides())
                    .flat_map(|side| held_objects(&self.world, side));
                let mut held = held.filter(|name| fault.concerns(&self.world, name));
                held.find_map(|name| {
                    let blow = injection.strikes(fault, Some(&name), now)?;
                    Some((Strike::Slip(name), blow))
                })
            }
            FaultKind::GripperMisses => {
                let given = request.property("OBJECT");
                let object = given.and_then(|object| {
                    let name = super::properties::property(image, object, "NAME")?;
                    name_text(image, &name)
                });
                let is_meant = match (&fault.of, &object) {
                    (None, _) => true,
                    (Some(_), Some(name)) => fault.concerns(&self.world, name),
                    (Some(_), None) => false,
                };
                let hand = request.property("GRIPPER");
                let side = hand.and_then(|hand| sides(image, hand).ok());
                let side = side.and_then(|sides| sides.first().copied())?;
                let blow = injection.strikes(fault, object.as_deref(), now);
                blow.filter(|_| is_meant)
                    .map(|blow| (Strike::Miss(side), blow))
            }
            FaultKind::NavigationBlocked => {
                let blow = injection.strikes(fault, None, now)?;
                let until = fault.duration.map(|duration| now + duration);
                Some((Strike::Block(until), blow))
            }
            _ => {
                let blow = injection.strikes(fault, None, now)?;
                Some((Strike::Stall, blow))
            }
        }
    }

    /// Removes obstacles whose time (s) is over.
    fn remove_obstacles(&mut self, now: f64) {
        let mut injection = self.injection.borrow_mut();
        let (gone, left) = std::mem::take(&mut injection.obstacles)
            .into_iter()
            .partition(|(_, end)| *end <= now);
        injection.obstacles = left;
        drop(injection);
        let gone: Vec<(String, f64)> = gone;
        for (name, _) in gone {
            // It may be gone already: then nothing is to be done.
            let _gone = self.world.remove(&name);
        }
    }
}

/// Whether an object has that name, or is of that type.
fn is_named(world: &World, object: &str, wanted: &str) -> bool {
    object.eq_ignore_ascii_case(wanted)
        || world.object(object).is_ok_and(|known| {
            let types = &world.models().objects;
            types.is_kind_of(known.type_name(), &wanted.to_lowercase())
        })
}
