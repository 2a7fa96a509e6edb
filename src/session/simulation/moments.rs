//! Going back in the world: moments that are kept of themselves, and those with a name.
//!
//! A moment holds the world, the robot in it, what the hands hold and how objects are
//! called. Lisp variables and simulated time are not part of it.

use std::collections::VecDeque;
use std::rc::Rc;

use indexmap::IndexMap;

use super::Simulation;
use super::held::Held;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;
use crate::world::Snapshot;

/// Forms at top level that can be taken back.
const MOST_FORMS: usize = 100;
/// Motions of the running form before which the world is remembered.
const MOST_MOTIONS: usize = 64;

/// The world at one moment.
#[derive(Clone)]
pub(super) struct Moment {
    world: Rc<Snapshot>,
    names: IndexMap<String, Value>,
    held: IndexMap<String, Held>,
    axes: Option<super::Axes>,
}

/// The moment before a form at top level.
struct BeforeForm {
    form: Value,
    moment: Moment,
    /// The world's hash then.
    hash: u64,
}

/// All moments that are kept.
#[derive(Default)]
pub(super) struct Moments {
    /// Before forms that changed the world, and before the last form; newest last.
    forms: VecDeque<BeforeForm>,
    named: IndexMap<String, Moment>,
    /// Before motions of the form that runs, by the number of the motion.
    motions: VecDeque<(u64, Moment)>,
    /// Are those of motions kept?
    keeps_motions: bool,
    /// Has anything been asked of the world since the last form began?
    is_touched: bool,
    /// Is what is evaluated on top of a form that stands still?
    is_aside: bool,
}

impl Simulation {
    /// The world as it is now.
    pub(super) fn moment(&self) -> Moment {
        Moment {
            world: Rc::new(self.world.snapshot()),
            names: self.names.clone(),
            held: self.held.clone(),
            axes: self.axes.clone(),
        }
    }

    fn take_back(&mut self, moment: &Moment) {
        self.world.restore(&moment.world);
        self.names.clone_from(&moment.names);
        self.held.clone_from(&moment.held);
        self.axes.clone_from(&moment.axes);
        self.active.clear();
        self.round = None;
        self.waiting.clear();
        self.observe();
    }

    /// From here on, also keeps the moments before motions.
    pub(crate) fn keep_moments_of_motions(&mut self, keeps: bool) {
        self.moments.keeps_motions = keeps;
    }

    /// From here on, what is evaluated is on top of a form that stands still, or not.
    pub(crate) fn set_aside(&mut self, is_aside: bool) {
        self.moments.is_aside = is_aside;
    }

    /// A form at top level is about to be evaluated.
    pub(crate) fn begin_form(&mut self, form: &Value) {
        self.moments.motions.clear();
        if !self.moments.is_touched
            && let Some(last) = self.moments.forms.back_mut()
        {
            last.form = form.clone();
            return;
        }
        let hash = self.world.hash();
        if self
            .moments
            .forms
            .back()
            .is_some_and(|last| last.hash == hash)
        {
            self.moments.forms.pop_back();
        }
        if self.moments.forms.len() == MOST_FORMS {
            self.moments.forms.pop_front();
        }
        self.moments.is_touched = false;
        let before = BeforeForm {
            form: form.clone(),
            moment: self.moment(),
            hash,
        };
        self.moments.forms.push_back(before);
    }

    /// Is the world another one than before the last form at top level?
    pub(crate) fn has_changed_since_form(&self) -> bool {
        let last = self.moments.forms.back();
        last.is_some_and(|before| before.hash != self.world.hash())
    }

    /// Takes the world back to before the last form at top level.
    pub(crate) fn go_back_to_form(&mut self) {
        let last = self.moments.forms.back();
        if let Some(moment) = last.map(|before| before.moment.clone()) {
            self.take_back(&moment);
        }
    }

    /// Something is asked of the world.
    pub(super) fn touch(&mut self) {
        self.moments.is_touched = true;
    }

    /// The next motion is about to be begun.
    pub(super) fn begin_motion(&mut self) {
        if !self.moments.keeps_motions {
            return;
        }
        if self.moments.motions.len() == MOST_MOTIONS {
            self.moments.motions.pop_front();
        }
        let moment = (self.next_ticket, self.moment());
        self.moments.motions.push_back(moment);
    }

    /// Can the world be taken back to before the motion of that number?
    pub(crate) fn has_motion_moment(&self, motion: u64) -> bool {
        self.moments.motions.iter().any(|(n, _)| *n == motion)
    }

    /// Takes the world back to before the motion of that number, if that is known.
    pub(crate) fn go_back_to(&mut self, motion: u64) {
        let found = self.moments.motions.iter().find(|(n, _)| *n == motion);
        if let Some((_, moment)) = found.cloned() {
            self.take_back(&moment);
        }
    }

    /// Takes the world back to before the last `count` forms that changed it; returns the
    /// first of them.
    pub(super) fn rewind(&mut self, count: usize) -> Result<Value, Box<Raise>> {
        self.check_idle()?;
        // The last moment is the one before the form that rewinds, unless that is typed
        // while another form stands still.
        let current = if self.moments.is_aside {
            None
        } else {
            self.moments.forms.pop_back()
        };
        let mut hash = Some(self.world.hash());
        let mut changing = 0;
        let mut found = None;
        for (at, before) in self.moments.forms.iter().enumerate().rev() {
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
            self.moments.forms.extend(current);
            return Err(Raise::simple(match changing {
                0 => "Nothing that has been evaluated here changed the world.".to_owned(),
                n => format!("Only {n} forms that changed the world are remembered."),
            }));
        };
        let target = self.moments.forms.drain(at..).next();
        let Some(target) = target else {
            return Ok(Value::NIL);
        };
        self.take_back(&target.moment);
        self.touch();
        Ok(target.form)
    }

    /// Keeps the world as it is under a name.
    pub(super) fn keep(&mut self, name: &str) {
        let moment = self.moment();
        self.moments.named.insert(name.to_owned(), moment);
    }

    /// Takes the world back to how it was kept under a name.
    pub(super) fn restore_kept(&mut self, name: &str) -> Result<(), Box<Raise>> {
        self.check_idle()?;
        match self.moments.named.get(name).cloned() {
            Some(moment) => {
                self.take_back(&moment);
                self.touch();
                Ok(())
            }
            None => {
                let known: Vec<&str> = self.moments.named.keys().map(String::as_str).collect();
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
        self.moments.named.keys().map(String::as_str)
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
        image.motions = self.next_ticket;
    }
}
