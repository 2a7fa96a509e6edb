//! The state of sweeps in a session: the world at hand with its draws, and how programs run worlds.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use std::time::Duration;

use crate::Session;
use crate::bounds::Limit;
use crate::dialogue::{Evaluate, Event, Outcome, Repeat};
use cram::Handlers;
use lisp::image::Image;
use lisp::image::extension::Extension;
use lisp::value::Value;
use lisp::value::copy::Copier;
use lisp::value::known;
use sweep::pairs::Pairs;
use sweep::{Drawn, Draws, Ending, Record};

pub use crate::sweep_file::SweepFile;
pub use crate::sweep_worlds::{Worlds, mistake};

/// What could be simpler in a world.
#[derive(Clone, Debug, Default)]
pub struct Simpler {
    /// The simplest values that the draws could have had.
    pub simplest: Pairs<Drawn>,
    /// Simpler values of parameters of the kitchen, by path, where there is a generated one; those that change
    /// most come first.
    pub kitchen: Vec<(String, Drawn)>,
    /// Parameters of the kitchen that are set, by the sweep or for this world, with their values as `--world` has
    /// them.
    pub settings: Vec<(String, String)>,
}

/// How often a world may look for interrupts until it counts as endless: about a minute of pure
/// computing. A plan that moves looks some thousands of times.
pub const MAX_POLLS: u64 = 1_000_000;
/// Share of them after which cleaning up counts as endless, too.
const CLEANING: u64 = 10;
/// The class of conditions that tell a plan of a limit to memory.
const HEAP_EXHAUSTED: &str = "HEAP-EXHAUSTED-ERROR";
/// Why a world says nothing whose plan has been told of it.
const LACKS_MEMORY: &str = "it takes more memory than --heap allows";
/// Why a world says nothing that has run out of time before its plan.
const LATE: &str = "the time limit passed before the plan began";

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
    /// Simpler values of parameters of the kitchen, by path.
    simpler: Vec<(String, Drawn)>,
    /// Parameters of the kitchen that are set, with their values as texts.
    settings: Vec<(String, String)>,
    /// Values that are set instead of drawn.
    set: Vec<(String, Value)>,
    known: Vec<Known>,
    stage: Stage,
    /// What came of the world, once it has ended.
    record: Option<Record>,
}

/// What is being done in the world at hand. What fails says something about the plan only while that
/// runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Stage {
    /// planwright sets the world up.
    #[default]
    SetUp,
    /// The values of the sweep's variables are found, and the faults that it injects.
    Varying,
    /// The plan runs, and what it has done is looked at.
    Running,
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
        state.simpler.clear();
        state.settings.clear();
        state.record = None;
        state.stage = Stage::SetUp;
    }

    /// Begins a stage of the world.
    pub(super) fn enter(&self, stage: Stage) {
        self.0.borrow_mut().stage = stage;
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

    /// Notes of the kitchen that has been drawn which values of parameters would be simpler, by path, and which
    /// parameters are set.
    pub(super) fn note_kitchen(
        &self,
        simpler: Vec<(String, Drawn)>,
        settings: Vec<(String, String)>,
    ) {
        let mut state = self.0.borrow_mut();
        (state.simpler, state.settings) = (simpler, settings);
    }

    /// What is set for draws right below a path: names and values.
    pub(super) fn overrides(&self, path: &str) -> Vec<(String, Value)> {
        let state = self.0.borrow();
        let below = state.set.iter().filter_map(|(known, value)| {
            let name = known.strip_prefix(path)?.strip_prefix('.')?;
            (!name.contains('.')).then(|| (name.to_owned(), value.clone()))
        });
        below.collect()
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

/// A world in which a plan has been told that memory is exhausted says nothing about the plan: more of
/// it, or fewer threads, could have led to something else.
pub(super) fn excuse_lack_of_memory(image: &Image, record: &mut Record) {
    let is_told = image.limits.heap.take_exhausted();
    if is_told || record.class.as_deref() == Some(HEAP_EXHAUSTED) {
        record.outcome = Ending::Defect;
        record.class = None;
        record.cause = Some(LACKS_MEMORY.to_owned());
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

    /// What has been loaded until now is given to plans: its handlers are not counted as theirs.
    pub fn end_set_up(&mut self) {
        Handlers::of(&mut self.evaluator.image).give();
    }

    /// What could be simpler in the world at hand.
    pub fn simpler_draws(&mut self) -> Simpler {
        let state = Sweeping::of(&mut self.evaluator.image);
        let state = state.0.borrow();
        Simpler {
            simplest: state.simplest.clone(),
            kitchen: state.simpler.clone(),
            settings: state.settings.clone(),
        }
    }

    /// What was performed in the run of a world: the names of relations with their rows, as lines of JSON.
    pub(crate) fn performed_in(&mut self, world: u64) -> Vec<(String, String)> {
        let form = format!("(coe::run-lines {world})");
        self.evaluate("sweep", &form, &mut |_| {});
        let value = self.evaluator.image.special(known::TIMES).clone();
        let texts = value.iter_list().filter_map(|text| text.as_text());
        let texts: Vec<String> = texts.collect();
        let pairs = texts.chunks_exact(2);
        pairs
            .map(|pair| (pair[0].clone(), pair[1].clone()))
            .collect()
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
                    crate::dialogue::screen::INTERRUPT => Ending::Endless,
                    crate::console::recovery::CONDITION => Ending::Defect,
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
        if is_late {
            // Whatever it has come to by then depends on the machine.
            ending = Ending::Timeout;
            class = None;
            kept = None;
        }
        let stage = state.0.borrow().stage;
        let is_judged = kept.is_some() || stage == Stage::Running;
        let mut record = kept.unwrap_or_else(|| {
            let mut record = state.record(&mut self.evaluator.image, ending);
            record.class = class;
            let simulation = &mut self.evaluator.host.simulation;
            simulation.end_tally();
            simulation.complete(&mut record);
            record
        });
        if !is_judged {
            let is_mistake = stage == Stage::Varying && ending != Ending::Defect && !is_late;
            record.outcome = match is_mistake {
                true => Ending::Mistake,
                false if is_late => Ending::Timeout,
                false => Ending::Defect,
            };
            record.class = None;
            record.cause = match is_late {
                true => Some(LATE.to_owned()),
                false => mistake,
            };
        }
        excuse_lack_of_memory(&self.evaluator.image, &mut record);
        record
    }
}
