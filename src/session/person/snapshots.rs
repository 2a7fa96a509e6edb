//! Undo: snapshots of the world that are taken automatically, and named ones.
//!
//! A snapshot holds the world, the robot in it, what the hands hold, the names of objects, and
//! where the random numbers of locations have got to. Lisp variables and simulated time are not part of it.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;
use std::sync::Arc;

use indexmap::IndexMap;

use super::shelf::{KeptWorld, Shelf};
use crate::simulation::held::Held;
use crate::simulation::{Axes, Simulation};
use lisp::value::Value;
use lisp::value::copy::{Copied, Copier};
use lisp::value::raise::Raise;
use robotics::robot::ArmPositions;
use robotics::world::Models;

/// Maximum number of forms at top level that can be undone.
const MAX_FORMS: usize = 100;
/// Maximum number of motions of the running form that have snapshots.
const MAX_MOTIONS: usize = 64;
/// The memory (bytes) that snapshots before forms may take, and those before motions, where that is fewer of them: about 40
/// forms in each of which much has moved, such as transports.
const MAX_BYTES: usize = 2 << 20;
/// How many there are whatever memory they take.
pub(super) const MIN_SNAPSHOTS: usize = 8;

/// The state at one time.
#[derive(Clone)]
pub(crate) struct Snapshot(Rc<State>);

/// What a snapshot restores.
struct State {
    /// The kitchen that the world is in.
    models: Arc<Models>,
    world: Rc<RefCell<KeptWorld>>,
    names: IndexMap<String, Value>,
    held: IndexMap<String, Held>,
    carrying: [Option<ArmPositions>; 2],
    axes: Option<Axes>,
    /// How many searches for locations have begun.
    searches: u64,
}

/// The state before a form at top level.
struct BeforeForm {
    form: Value,
    snapshot: Snapshot,
    /// The world's hash at that time.
    hash: u64,
}

/// All snapshots that are kept.
#[derive(Default)]
pub(crate) struct Snapshots {
    /// Before forms that changed the world, and before the last form; newest last.
    forms: VecDeque<BeforeForm>,
    named: IndexMap<String, Snapshot>,
    /// Before motions of the running form, by the number of the motion.
    motions: VecDeque<(u64, Snapshot)>,
    /// Before questions that change the world for themselves, the innermost last.
    trials: Vec<Snapshot>,
    /// Whether snapshots before motions are kept.
    keeps_motions: bool,
    /// Whether anything has been requested from the world since the last form began.
    is_touched: bool,
    /// Whether evaluation is on top of a stopped form.
    is_aside: bool,
}

impl Snapshot {
    /// Takes a snapshot of the present state.
    pub(crate) fn take(simulation: &Simulation) -> Self {
        Self(Rc::new(State {
            models: Arc::clone(&simulation.models),
            world: Rc::new(RefCell::new(KeptWorld::of(&simulation.world))),
            names: simulation.names.clone(),
            held: simulation.held.clone(),
            carrying: simulation.carrying,
            axes: simulation.axes.clone(),
            searches: simulation.searches,
        }))
    }

    /// The world in it.
    pub(super) fn world(&self) -> &Rc<RefCell<KeptWorld>> {
        &self.0.world
    }

    /// How much memory (bytes) all of them take, roughly; those that were taken one after the other share some.
    pub(super) fn bytes_of_all<'a>(all: impl Iterator<Item = &'a Snapshot>) -> usize {
        let mut bytes = 0;
        let mut before = None;
        for snapshot in all {
            let world = snapshot.0.world.borrow();
            bytes += size_of::<State>() + world.bytes();
            if let Some((which, shared)) = world.shared()
                && before != Some(which)
            {
                before = Some(which);
                bytes += shared;
            }
        }
        bytes
    }

    /// Restores the state; ongoing motions end.
    fn restore(&self, simulation: &mut Simulation) {
        self.put_back(simulation);
        simulation.jobs.clear();
    }

    /// Takes the world of another session over, where both are copies of one session, or one of the other. The names of objects
    /// are those that are known here.
    pub(crate) fn adopt(&self, simulation: &mut Simulation) {
        let state = &self.0;
        state.world.borrow().restore(&mut simulation.world);
        simulation.held.clone_from(&state.held);
        simulation.carrying = state.carrying;
        simulation.jobs.clear();
    }

    /// Restores the state, in which nothing has moved by itself meanwhile.
    pub(crate) fn put_back(&self, simulation: &mut Simulation) {
        let state = &self.0;
        let models = &simulation.models;
        if !models.share_kitchen(&state.models) || !models.share_robot(&state.models) {
            simulation.begin_with(&state.models);
        }
        state.world.borrow().restore(&mut simulation.world);
        simulation.names.clone_from(&state.names);
        simulation.held.clone_from(&state.held);
        simulation.carrying = state.carrying;
        simulation.axes.clone_from(&state.axes);
        simulation.searches = state.searches;
    }
}

impl Copied for Snapshot {
    fn copied(&self, copier: &mut Copier) -> Snapshot {
        let state = &self.0;
        if state.names.is_empty() {
            return self.clone();
        }
        let names = state.names.iter();
        let names = names.map(|(name, symbol)| (name.clone(), copier.value(symbol)));
        Snapshot(Rc::new(State {
            models: Arc::clone(&state.models),
            world: Rc::clone(&state.world),
            names: names.collect(),
            held: state.held.clone(),
            carrying: state.carrying,
            axes: state.axes.clone(),
            searches: state.searches,
        }))
    }
}

impl Snapshots {
    /// The same snapshots for a copy of the image.
    pub(super) fn copied(&self, copier: &mut Copier) -> Snapshots {
        let forms = self.forms.iter().map(|before| BeforeForm {
            form: copier.value(&before.form),
            snapshot: before.snapshot.copied(copier),
            hash: before.hash,
        });
        let forms = forms.collect();
        let named = self.named.iter();
        let named = named.map(|(name, snapshot)| (name.clone(), snapshot.copied(copier)));
        let named = named.collect();
        let motions = self.motions.iter();
        let motions = motions.map(|(number, snapshot)| (*number, snapshot.copied(copier)));
        Snapshots {
            forms,
            named,
            motions: motions.collect(),
            trials: self
                .trials
                .iter()
                .map(|trial| trial.copied(copier))
                .collect(),
            keeps_motions: self.keeps_motions,
            is_touched: self.is_touched,
            is_aside: self.is_aside,
        }
    }

    /// Sets whether snapshots before motions are kept.
    pub(crate) fn keep_snapshots_of_motions(&mut self, keeps: bool) {
        self.keeps_motions = keeps;
    }

    /// Sets whether evaluation is on top of a stopped form.
    pub(crate) fn set_aside(&mut self, is_aside: bool) {
        self.is_aside = is_aside;
    }

    /// Call when a form at top level is about to be evaluated.
    pub(super) fn begin_form(&mut self, shelf: &mut Shelf, simulation: &Simulation, form: &Value) {
        self.motions.clear();
        if !self.is_touched
            && let Some(last) = self.forms.back_mut()
        {
            last.form = form.clone();
            return;
        }
        let hash = simulation.world.hash();
        if self.forms.back().is_some_and(|last| last.hash == hash) {
            self.forms.pop_back();
        }
        self.is_touched = false;
        self.forms.push_back(BeforeForm {
            form: form.clone(),
            snapshot: shelf.take(simulation),
            hash,
        });
        forget_oldest(&mut self.forms, MAX_FORMS, |before| &before.snapshot);
    }

    /// Whether the world differs from before the last form at top level.
    pub(crate) fn has_changed_since_form(&self, simulation: &Simulation) -> bool {
        let last = self.forms.back();
        last.is_some_and(|before| before.hash != simulation.world.hash())
    }

    /// Restores the world to before the last form at top level.
    pub(crate) fn go_back_to_form(&self, simulation: &mut Simulation) {
        if let Some(last) = self.forms.back() {
            last.snapshot.restore(simulation);
        }
    }

    /// Call when something is requested from the world.
    pub(crate) fn touch(&mut self) {
        self.is_touched = true;
    }

    /// Whether snapshots before motions are kept.
    pub(super) fn keeps_motions(&self) -> bool {
        self.keeps_motions
    }

    /// Call when the motion with that number is about to begin, with the present state.
    pub(super) fn begin_motion(&mut self, motion: u64, snapshot: Snapshot) {
        self.motions.push_back((motion, snapshot));
        forget_oldest(&mut self.motions, MAX_MOTIONS, |(_, snapshot)| snapshot);
    }

    /// Whether the world can be restored to before the motion with that number.
    pub(crate) fn has_motion_snapshot(&self, motion: u64) -> bool {
        self.motions.iter().any(|(n, _)| *n == motion)
    }

    /// Restores the world to before the motion with that number, if there is a snapshot.
    pub(crate) fn go_back_to(&self, simulation: &mut Simulation, motion: u64) {
        let found = self.motions.iter().find(|(n, _)| *n == motion);
        if let Some((_, snapshot)) = found {
            snapshot.restore(simulation);
        }
    }

    /// Restores the world to before the last `count` forms that changed it; returns the first
    /// of them.
    pub(crate) fn rewind(
        &mut self,
        simulation: &mut Simulation,
        count: usize,
    ) -> Result<Value, Box<Raise>> {
        check_idle(simulation)?;
        // The last snapshot is the one before the form that rewinds, unless that form was typed
        // while another one is stopped.
        let current = if self.is_aside {
            None
        } else {
            self.forms.pop_back()
        };
        let mut hash = Some(simulation.world.hash());
        let mut changing = 0;
        let mut found = None;
        for (at, before) in self.forms.iter().enumerate().rev() {
            if hash == Some(before.hash) {
                continue;
            }
            changing += 1;
            hash = Some(before.hash);
            if changing == count {
                found = Some(at);
                break;
            }
        }
        let Some(at) = found else {
            self.forms.extend(current);
            return Err(Raise::simple(match changing {
                0 => "Nothing that has been evaluated here changed the world.".to_owned(),
                1 => "Only 1 form that changed the world is remembered.".to_owned(),
                n => format!("Only {n} forms that changed the world are remembered."),
            }));
        };
        let target = self.forms.drain(at..).next();
        let Some(target) = target else {
            return Ok(Value::NIL);
        };
        target.snapshot.restore(simulation);
        self.touch();
        Ok(target.form)
    }

    /// Takes a named snapshot of the world.
    pub(super) fn keep(&mut self, shelf: &mut Shelf, simulation: &Simulation, name: &str) {
        let snapshot = shelf.take(simulation);
        self.named.insert(name.to_owned(), snapshot);
    }

    /// From now on the world is a trial, until [`Self::end_trial`]. Returns how many trials there are.
    pub(crate) fn begin_trial(&mut self, simulation: &Simulation) -> usize {
        self.trials.push(Snapshot::take(simulation));
        self.trials.len()
    }

    /// Is the world a trial?
    pub(crate) fn is_trial(&self) -> bool {
        !self.trials.is_empty()
    }

    /// The world is again as before the trial with that number, and those inside it.
    pub(crate) fn end_trial(&mut self, simulation: &mut Simulation, number: usize) {
        let first = number.saturating_sub(1);
        if let Some(snapshot) = self.trials.get(first) {
            snapshot.put_back(simulation);
        }
        self.trials.truncate(first);
    }

    /// Restores a named snapshot of the world.
    pub(crate) fn restore_kept(
        &mut self,
        simulation: &mut Simulation,
        name: &str,
    ) -> Result<(), Box<Raise>> {
        check_idle(simulation)?;
        match self.named.get(name).cloned() {
            Some(snapshot) => self.go_to(simulation, &snapshot),
            None => {
                let known: Vec<&str> = self.named.keys().map(String::as_str).collect();
                let remedy = if known.is_empty() {
                    "there are none: use (snapshot 'name)".to_owned()
                } else {
                    format!("there are {}", known.join(", "))
                };
                Err(Raise::simple(format!(
                    "There is no snapshot {name}; {remedy}."
                )))
            }
        }
    }

    /// Restores a snapshot of the world.
    pub(crate) fn go_to(
        &mut self,
        simulation: &mut Simulation,
        snapshot: &Snapshot,
    ) -> Result<(), Box<Raise>> {
        check_idle(simulation)?;
        snapshot.restore(simulation);
        self.touch();
        Ok(())
    }

    /// The names of the named snapshots.
    pub(crate) fn kept_names(&self) -> impl Iterator<Item = &str> {
        self.named.keys().map(String::as_str)
    }
}

/// Forgets the oldest while there are too many, or while they take too much memory.
fn forget_oldest<T>(kept: &mut VecDeque<T>, most: usize, snapshot: impl Fn(&T) -> &Snapshot) {
    let bytes = |kept: &VecDeque<T>| Snapshot::bytes_of_all(kept.iter().map(&snapshot));
    while kept.len() > most || (kept.len() > MIN_SNAPSHOTS && bytes(kept) > MAX_BYTES) {
        kept.pop_front();
    }
}

fn check_idle(simulation: &Simulation) -> Result<(), Box<Raise>> {
    if simulation.jobs.is_idle() {
        return Ok(());
    }
    Err(Raise::simple(
        "The world cannot be taken back while the robot moves.",
    ))
}
