//! The state of sweeps in a session: the world at hand with its draws, and how programs run worlds.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use std::time::Duration;

use super::Session;
use super::bounds::Limit;
use super::dialogue::{Evaluate, Event, Outcome, Repeat};
use cram::Handlers;
use lisp::image::Image;
use lisp::image::extension::Extension;
use lisp::value::Value;
use lisp::value::copy::Copier;
use sweep::pairs::Pairs;
use sweep::{Drawn, Draws, Ending, Record};

/// How often a world may look for interrupts until it counts as endless: about a minute of pure
/// computing. A plan that moves looks some thousands of times.
pub const MAX_POLLS: u64 = 1_000_000;
/// Share of them after which cleaning up counts as endless, too.
const CLEANING: u64 = 10;

/// A sweep that a file defines.
#[derive(Clone, Debug, PartialEq)]
pub struct Known {
    /// Its name.
    pub name: String,
    /// How many worlds it asks for.
    pub worlds: u64,
    /// The rate of success that it wants.
    pub goal: Option<f64>,
}

/// The world at hand, and what is known about sweeps.
#[derive(Default)]
pub(super) struct Sweeping(RefCell<State>);

#[derive(Clone, Default)]
struct State {
    seed: u64,
    world: u64,
    /// The numbers of each path.
    draws: BTreeMap<String, Draws>,
    /// What has been drawn, in order.
    drawn: Pairs<Drawn>,
    /// The simplest values that could have been drawn.
    simplest: Pairs<Drawn>,
    /// Values that are set instead of drawn.
    set: Vec<(String, Value)>,
    known: Vec<Known>,
    /// Whether the values of the sweep's variables are being found.
    is_varying: bool,
    /// What came of the world, once it has ended.
    record: Option<Record>,
}

impl Sweeping {
    /// The state that an image keeps.
    pub(super) fn of(image: &mut Image) -> Rc<Sweeping> {
        let state = image.extension::<Sweeping>();
        state.unwrap_or_else(|| image.extend(Sweeping::default()))
    }

    /// Begins a world.
    pub(super) fn begin(&self, seed: u64, world: u64) {
        let mut state = self.0.borrow_mut();
        state.seed = seed;
        state.world = world;
        state.draws.clear();
        state.drawn = Pairs::default();
        state.simplest = Pairs::default();
        state.record = None;
        state.is_varying = false;
    }

    /// Whether the values of the sweep's variables are being found: what fails then is no failure of
    /// the plan.
    pub(super) fn set_varying(&self, is_varying: bool) {
        self.0.borrow_mut().is_varying = is_varying;
    }

    /// 64 bits that belong to a path.
    pub(super) fn bits(&self, path: &str) -> u64 {
        let state = self.0.borrow();
        Draws::new(state.seed, state.world, path).bits()
    }

    /// The next number from 0 to 1 of a path.
    pub(super) fn unit(&self, path: &str) -> f64 {
        let mut state = self.0.borrow_mut();
        let fresh = Draws::new(state.seed, state.world, path);
        state.draws.entry(path.to_owned()).or_insert(fresh).unit()
    }

    /// Notes what was drawn.
    pub(super) fn note(&self, path: &str, drawn: Drawn) {
        self.0.borrow_mut().drawn.set(path, drawn);
    }

    /// Notes the simplest value that could have been drawn.
    pub(super) fn note_simplest(&self, path: &str, drawn: Drawn) {
        self.0.borrow_mut().simplest.set(path, drawn);
    }

    /// Draws are set no more.
    pub(super) fn forget(&self) {
        self.0.borrow_mut().set.clear();
    }

    /// Sets the value of a draw.
    pub(super) fn set(&self, path: &str, value: Value) {
        let mut state = self.0.borrow_mut();
        state.set.retain(|(known, _)| known != path);
        state.set.push((path.to_owned(), value));
    }

    /// The value that is set for a draw.
    pub(super) fn overriding(&self, path: &str) -> Option<Value> {
        let state = self.0.borrow();
        let found = state.set.iter().find(|(known, _)| known == path);
        found.map(|(_, value)| value.clone())
    }

    /// The paths of faults that are switched off: those of injections that are set to NIL.
    pub(super) fn off(&self) -> BTreeSet<String> {
        let state = self.0.borrow();
        let off = state.set.iter();
        let off = off.filter(|(path, value)| path.starts_with("inject.") && !value.is_true());
        off.map(|(path, _)| path.clone()).collect()
    }

    /// Makes a sweep known.
    pub(super) fn know(&self, sweep: Known) {
        let mut state = self.0.borrow_mut();
        state.known.retain(|known| known.name != sweep.name);
        state.known.push(sweep);
    }

    /// The record of the world at hand, as far as its draws and the handlers of the plan go.
    pub(super) fn record(&self, image: &mut Image, ending: Ending) -> Record {
        let state = self.0.borrow();
        let mut record = Record::new(state.world, ending);
        record.draws = state.drawn.clone();
        record.handlers = Pairs(Handlers::of(image).counts(image));
        record
    }

    /// Keeps what came of the world.
    pub(super) fn keep(&self, record: Record) {
        self.0.borrow_mut().record = Some(record);
    }
}

impl Extension for Sweeping {
    fn copied(self: Rc<Self>, copier: &mut Copier) -> Rc<dyn Extension> {
        let state = self.0.borrow();
        let set = state.set.iter();
        let set = set.map(|(path, value)| (path.clone(), copier.value(value)));
        Rc::new(Sweeping(RefCell::new(State {
            set: set.collect(),
            ..state.clone()
        })))
    }
}

impl Session {
    /// The sweeps that have been defined, in order.
    pub fn known_sweeps(&mut self) -> Vec<Known> {
        let ask = "(planwright::%describe-sweeps)";
        self.evaluate("sweep", ask, &mut |_| {});
        Sweeping::of(&mut self.evaluator.image)
            .0
            .borrow()
            .known
            .clone()
    }

    /// The simplest values that the draws of the world at hand could have had.
    pub fn simplest_draws(&mut self) -> Pairs<Drawn> {
        Sweeping::of(&mut self.evaluator.image)
            .0
            .borrow()
            .simplest
            .clone()
    }

    /// Runs the plan of a sweep in one world. `set` are values of draws as the language writes
    /// them. After so many polls of the interrupt flag the world counts as endless; after so much real
    /// time it is given up. Call it in a session that has done nothing but load the file.
    pub fn run_sweep_world(
        &mut self,
        name: &str,
        seed: u64,
        world: u64,
        set: &[(String, String)],
        most_polls: u64,
        time_limit: Option<Duration>,
    ) -> Record {
        let mut form = String::from("(progn ");
        for (path, value) in set {
            form.push_str(&format!("(planwright::%sweep-set {path:?} {value}) "));
        }
        form.push_str(&format!(
            "(planwright::%sweep-one-world {name:?} {seed} {world}))"
        ));
        let state = Sweeping::of(&mut self.evaluator.image);
        state.begin(seed, world);
        self.interrupt_next_at(most_polls);
        self.evaluator
            .image
            .polls()
            .set_again(Some((most_polls / CLEANING).max(1)));
        let mut ending = Ending::Failure;
        let mut class = None;
        let mut mistake = None;
        self.set_time_limit(time_limit);
        let outcome = self.evaluate("sweep", &form, &mut |event| {
            if let Event::Aborted(abort) = event {
                ending = match abort.condition.as_str() {
                    super::dialogue::screen::INTERRUPT => Ending::Endless,
                    super::console::recovery::CONDITION => Ending::Defect,
                    _ => Ending::Failure,
                };
                class = Some(abort.class.clone()).filter(|class| !class.is_empty());
                mistake = Some(match abort.main_place() {
                    Some(place) => format!("{place}: {}", abort.report.trim_end()),
                    None => abort.report.trim_end().to_owned(),
                });
            }
        });
        let is_late =
            time_limit.is_some() && self.evaluator.host.bounds.reached() == Some(Limit::WallClock);
        self.set_time_limit(None);
        self.evaluator.image.polls().set_again(None);
        let mut kept = state.0.borrow_mut().record.take();
        if let Outcome::Quit(_) = outcome {
            // Who leaves has not done what was wanted.
            class = Some("QUIT".to_owned());
            if let Some(record) = &mut kept {
                record.outcome = Ending::Failure;
                record.class.clone_from(&class);
            }
        }
        if state.0.borrow().is_varying && ending == Ending::Failure && !is_late {
            let mut record = Record::new(world, Ending::Mistake);
            record.class = class;
            record.cause = mistake;
            return record;
        }
        if is_late {
            // Whatever it has come to by then depends on the machine.
            ending = Ending::Timeout;
            class = None;
            kept = None;
        }
        kept.unwrap_or_else(|| {
            let mut record = state.record(&mut self.evaluator.image, ending);
            record.class = class;
            let simulation = &mut self.evaluator.host.simulation;
            simulation.end_tally();
            simulation.complete(&mut record);
            record
        })
    }
}
