//! Going back in the world: snapshots that are kept of themselves, and those with a name.
//!
//! A snapshot holds the world, the robot in it, what the hands hold and how objects are
//! called. Lisp variables and simulated time are not part of it.

use std::collections::VecDeque;
use std::rc::Rc;

use indexmap::IndexMap;

use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;
use crate::session::simulation::held::Held;
use crate::session::simulation::{Axes, Simulation};
use crate::world;

/// Forms at top level that can be taken back.
const MOST_FORMS: usize = 100;
/// Motions of the running form before which the world is remembered.
const MOST_MOTIONS: usize = 64;

/// How everything was at one time.
#[derive(Clone)]
pub(crate) struct Snapshot {
    world: Rc<world::Snapshot>,
    names: IndexMap<String, Value>,
    held: IndexMap<String, Held>,
    axes: Option<Axes>,
}

/// How everything was before a form at top level.
struct BeforeForm {
    form: Value,
    snapshot: Snapshot,
    /// The world's hash then.
    hash: u64,
}

/// All snapshots that are kept.
#[derive(Default)]
pub(crate) struct Snapshots {
    /// Before forms that changed the world, and before the last form; newest last.
    forms: VecDeque<BeforeForm>,
    named: IndexMap<String, Snapshot>,
    /// Before motions of the form that runs, by the number of the motion.
    motions: VecDeque<(u64, Snapshot)>,
    /// Are those of motions kept?
    keeps_motions: bool,
    /// Has anything been asked of the world since the last form began?
    is_touched: bool,
    /// Is what is evaluated on top of a form that stands still?
    is_aside: bool,
}

impl Snapshot {
    /// Everything as it is now.
    fn take(simulation: &Simulation) -> Self {
        Self {
            world: Rc::new(simulation.world.snapshot()),
            names: simulation.names.clone(),
            held: simulation.held.clone(),
            axes: simulation.axes.clone(),
        }
    }

    /// Makes everything as it was; motions under way end.
    fn restore(&self, simulation: &mut Simulation) {
        simulation.world.restore(&self.world);
        simulation.names.clone_from(&self.names);
        simulation.held.clone_from(&self.held);
        simulation.axes.clone_from(&self.axes);
        simulation.jobs.clear();
    }
}

impl Snapshots {
    /// From here on, also keeps the snapshots before motions.
    pub(crate) fn keep_snapshots_of_motions(&mut self, keeps: bool) {
        self.keeps_motions = keeps;
    }

    /// From here on, what is evaluated is on top of a form that stands still, or not.
    pub(crate) fn set_aside(&mut self, is_aside: bool) {
        self.is_aside = is_aside;
    }

    /// A form at top level is about to be evaluated.
    pub(crate) fn begin_form(&mut self, simulation: &Simulation, form: &Value) {
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
        if self.forms.len() == MOST_FORMS {
            self.forms.pop_front();
        }
        self.is_touched = false;
        let before = BeforeForm {
            form: form.clone(),
            snapshot: Snapshot::take(simulation),
            hash,
        };
        self.forms.push_back(before);
    }

    /// Is the world another one than before the last form at top level?
    pub(crate) fn has_changed_since_form(&self, simulation: &Simulation) -> bool {
        let last = self.forms.back();
        last.is_some_and(|before| before.hash != simulation.world.hash())
    }

    /// Takes the world back to before the last form at top level.
    pub(crate) fn go_back_to_form(&mut self, simulation: &mut Simulation) {
        let last = self.forms.back();
        if let Some(snapshot) = last.map(|before| before.snapshot.clone()) {
            snapshot.restore(simulation);
        }
    }

    /// Something is asked of the world.
    pub(crate) fn touch(&mut self) {
        self.is_touched = true;
    }

    /// The next motion is about to be begun.
    pub(crate) fn begin_motion(&mut self, simulation: &Simulation) {
        if !self.keeps_motions {
            return;
        }
        if self.motions.len() == MOST_MOTIONS {
            self.motions.pop_front();
        }
        let snapshot = (simulation.jobs.begun, Snapshot::take(simulation));
        self.motions.push_back(snapshot);
    }

    /// Can the world be taken back to before the motion of that number?
    pub(crate) fn has_motion_snapshot(&self, motion: u64) -> bool {
        self.motions.iter().any(|(n, _)| *n == motion)
    }

    /// Takes the world back to before the motion of that number, if that is known.
    pub(crate) fn go_back_to(&mut self, simulation: &mut Simulation, motion: u64) {
        let found = self.motions.iter().find(|(n, _)| *n == motion);
        if let Some((_, snapshot)) = found.cloned() {
            snapshot.restore(simulation);
        }
    }

    /// Takes the world back to before the last `count` forms that changed it; returns the
    /// first of them.
    pub(crate) fn rewind(
        &mut self,
        simulation: &mut Simulation,
        count: usize,
    ) -> Result<Value, Box<Raise>> {
        check_idle(simulation)?;
        // The last snapshot is the one before the form that rewinds, unless that is typed
        // while another form stands still.
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

    /// Keeps the world as it is under a name.
    pub(crate) fn keep(&mut self, simulation: &Simulation, name: &str) {
        let snapshot = Snapshot::take(simulation);
        self.named.insert(name.to_owned(), snapshot);
    }

    /// Takes the world back to how it was kept under a name.
    pub(crate) fn restore_kept(
        &mut self,
        simulation: &mut Simulation,
        name: &str,
    ) -> Result<(), Box<Raise>> {
        check_idle(simulation)?;
        match self.named.get(name).cloned() {
            Some(snapshot) => {
                snapshot.restore(simulation);
                self.touch();
                Ok(())
            }
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

    /// The names under which the world was kept.
    pub(crate) fn kept_names(&self) -> impl Iterator<Item = &str> {
        self.named.keys().map(String::as_str)
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
