//! Going back in the world: snapshots that are kept of themselves, and those with a name.
//!
//! A snapshot holds the world, the robot in it, what the hands hold and how objects are
//! called. Lisp variables and simulated time are not part of it.

use std::collections::VecDeque;
use std::rc::Rc;

use indexmap::IndexMap;

use super::Simulation;
use super::held::Held;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;
use crate::plan::designator::perform::MotionsBegun;
use crate::world;

/// Forms at top level that can be taken back.
const MOST_FORMS: usize = 100;
/// Motions of the running form before which the world is remembered.
const MOST_MOTIONS: usize = 64;

/// How everything was at one time.
#[derive(Clone)]
pub(super) struct Snapshot {
    world: Rc<world::Snapshot>,
    names: IndexMap<String, Value>,
    held: IndexMap<String, Held>,
    axes: Option<super::Axes>,
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
pub(super) struct Snapshots {
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

impl Simulation {
    /// The world as it is now.
    pub(super) fn take_snapshot(&self) -> Snapshot {
        Snapshot {
            world: Rc::new(self.world.snapshot()),
            names: self.names.clone(),
            held: self.held.clone(),
            axes: self.axes.clone(),
        }
    }

    fn take_back(&mut self, snapshot: &Snapshot) {
        self.world.restore(&snapshot.world);
        self.names.clone_from(&snapshot.names);
        self.held.clone_from(&snapshot.held);
        self.axes.clone_from(&snapshot.axes);
        self.active.clear();
        self.partial_step = None;
        self.waiting.clear();
        self.observe();
    }

    /// From here on, also keeps the snapshots before motions.
    pub(crate) fn keep_snapshots_of_motions(&mut self, keeps: bool) {
        self.snapshots.keeps_motions = keeps;
    }

    /// From here on, what is evaluated is on top of a form that stands still, or not.
    pub(crate) fn set_aside(&mut self, is_aside: bool) {
        self.snapshots.is_aside = is_aside;
    }

    /// A form at top level is about to be evaluated.
    pub(crate) fn begin_form(&mut self, form: &Value) {
        self.snapshots.motions.clear();
        if !self.snapshots.is_touched
            && let Some(last) = self.snapshots.forms.back_mut()
        {
            last.form = form.clone();
            return;
        }
        let hash = self.world.hash();
        if self
            .snapshots
            .forms
            .back()
            .is_some_and(|last| last.hash == hash)
        {
            self.snapshots.forms.pop_back();
        }
        if self.snapshots.forms.len() == MOST_FORMS {
            self.snapshots.forms.pop_front();
        }
        self.snapshots.is_touched = false;
        let before = BeforeForm {
            form: form.clone(),
            snapshot: self.take_snapshot(),
            hash,
        };
        self.snapshots.forms.push_back(before);
    }

    /// Is the world another one than before the last form at top level?
    pub(crate) fn has_changed_since_form(&self) -> bool {
        let last = self.snapshots.forms.back();
        last.is_some_and(|before| before.hash != self.world.hash())
    }

    /// Takes the world back to before the last form at top level.
    pub(crate) fn go_back_to_form(&mut self) {
        let last = self.snapshots.forms.back();
        if let Some(snapshot) = last.map(|before| before.snapshot.clone()) {
            self.take_back(&snapshot);
        }
    }

    /// Something is asked of the world.
    pub(super) fn touch(&mut self) {
        self.snapshots.is_touched = true;
    }

    /// The next motion is about to be begun.
    pub(super) fn begin_motion(&mut self) {
        if !self.snapshots.keeps_motions {
            return;
        }
        if self.snapshots.motions.len() == MOST_MOTIONS {
            self.snapshots.motions.pop_front();
        }
        let snapshot = (self.next_ticket, self.take_snapshot());
        self.snapshots.motions.push_back(snapshot);
    }

    /// Can the world be taken back to before the motion of that number?
    pub(crate) fn has_motion_snapshot(&self, motion: u64) -> bool {
        self.snapshots.motions.iter().any(|(n, _)| *n == motion)
    }

    /// Takes the world back to before the motion of that number, if that is known.
    pub(crate) fn go_back_to(&mut self, motion: u64) {
        let found = self.snapshots.motions.iter().find(|(n, _)| *n == motion);
        if let Some((_, snapshot)) = found.cloned() {
            self.take_back(&snapshot);
        }
    }

    /// Takes the world back to before the last `count` forms that changed it; returns the
    /// first of them.
    pub(super) fn rewind(&mut self, count: usize) -> Result<Value, Box<Raise>> {
        self.check_idle()?;
        // The last snapshot is the one before the form that rewinds, unless that is typed
        // while another form stands still.
        let current = if self.snapshots.is_aside {
            None
        } else {
            self.snapshots.forms.pop_back()
        };
        let mut hash = Some(self.world.hash());
        let mut changing = 0;
        let mut found = None;
        for (at, before) in self.snapshots.forms.iter().enumerate().rev() {
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
            self.snapshots.forms.extend(current);
            return Err(Raise::simple(match changing {
                0 => "Nothing that has been evaluated here changed the world.".to_owned(),
                n => format!("Only {n} forms that changed the world are remembered."),
            }));
        };
        let target = self.snapshots.forms.drain(at..).next();
        let Some(target) = target else {
            return Ok(Value::NIL);
        };
        self.take_back(&target.snapshot);
        self.touch();
        Ok(target.form)
    }

    /// Keeps the world as it is under a name.
    pub(super) fn keep(&mut self, name: &str) {
        let snapshot = self.take_snapshot();
        self.snapshots.named.insert(name.to_owned(), snapshot);
    }

    /// Takes the world back to how it was kept under a name.
    pub(super) fn restore_kept(&mut self, name: &str) -> Result<(), Box<Raise>> {
        self.check_idle()?;
        match self.snapshots.named.get(name).cloned() {
            Some(snapshot) => {
                self.take_back(&snapshot);
                self.touch();
                Ok(())
            }
            None => {
                let known: Vec<&str> = self.snapshots.named.keys().map(String::as_str).collect();
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
        self.snapshots.named.keys().map(String::as_str)
    }

    fn check_idle(&self) -> Result<(), Box<Raise>> {
        if self.active.is_empty() && self.waiting.is_empty() {
            return Ok(());
        }
        Err(Raise::simple(
            "The world cannot be taken back while the robot moves.",
        ))
    }

    /// The number of motions that were begun, for the image: what happens later is told
    /// from what happened before by it.
    pub(super) fn note_motions(&self, image: &mut Image) {
        image.extend(MotionsBegun(self.next_ticket));
    }
}
