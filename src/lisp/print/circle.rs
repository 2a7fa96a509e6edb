//! Which parts of a value occur more than once, or contain themselves.

use std::collections::HashMap;
use std::rc::Rc;

use super::settings::Settings;
use crate::lisp::guard::Pace;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::class::ClassKind;

/// A value with fewer parts than this is first walked without bookkeeping: if the walk
/// ends, nothing in it is circular.
const QUICK: usize = 20_000;

/// The parts that are printed with labels.
#[derive(Default)]
pub(super) struct Labels {
    /// By address; the label's number once it has been printed.
    marked: HashMap<usize, Option<usize>>,
    given: usize,
}

/// What a part's label says.
pub(super) enum Label {
    /// It has none.
    None,
    /// `#n=`: printed for the first time.
    First(usize),
    /// `#n#`: printed before.
    Again(usize),
}

fn address(value: &Value) -> Option<usize> {
    Some(match value {
        Value::Cons(r) => Rc::as_ptr(r).cast::<()>() as usize,
        Value::Vector(r) => Rc::as_ptr(r).cast::<()>() as usize,
        Value::Array(r) => Rc::as_ptr(r).cast::<()>() as usize,
        Value::Instance(r) => Rc::as_ptr(r).cast::<()>() as usize,
        // Odd, as no address of an object is.
        Value::Symbol(sym, ..) => sym.0 as usize * 2 + 1,
        _ => return None,
    })
}

/// Can parts of another value be this one? Symbols count if only the same symbol of those with its name
/// has a label.
fn is_shareable(value: &Value, symbols: Option<&Image>) -> bool {
    match value {
        Value::Symbol(sym, ..) => symbols.is_some_and(|image| image.symbol(*sym).package.is_none()),
        _ => address(value).is_some(),
    }
}

/// The parts that are printed, the first one last.
fn parts(value: &Value, symbols: Option<&Image>, out: &mut Vec<Value>) {
    let keep = |v: &Value| is_shareable(v, symbols);
    match value {
        Value::Cons(c) => out.extend([c.cdr(), c.car()].into_iter().filter(keep)),
        Value::Vector(v) => out.extend(v.to_vec().into_iter().filter(keep).rev()),
        Value::Array(a) => out.extend(a.items.to_vec().into_iter().filter(keep).rev()),
        Value::Instance(i) if i.class().kind == ClassKind::Structure => {
            out.extend(i.slots.borrow().iter().filter(|v| keep(v)).rev().cloned());
        }
        _ => {}
    }
}

/// Is the value a tree of moderate size, and therefore certainly not circular?
fn is_small_tree(value: &Value) -> bool {
    let mut pending = vec![value.clone()];
    let mut budget = QUICK;
    while let Some(value) = pending.pop() {
        parts(&value, None, &mut pending);
        budget = budget.saturating_sub(1);
        if budget == 0 || pending.len() > QUICK {
            return false;
        }
    }
    true
}

enum Visit {
    Enter(Value),
    Leave(usize),
}

impl Labels {
    /// The labels of a value: of all shared parts where `*print-circle*` asks for them, or only of those
    /// that contain themselves.
    pub(super) fn of(image: &Image, value: &Value, settings: &Settings) -> Labels {
        let mut labels = Labels::default();
        let all_shared = settings.circle;
        let symbols = (all_shared && settings.escape && settings.gensym).then_some(image);
        if address(value).is_none() || !all_shared && is_small_tree(value) {
            return labels;
        }
        let mut seen: HashMap<usize, bool> = HashMap::new();
        let mut pending = vec![Visit::Enter(value.clone())];
        let mut inner = Vec::new();
        let mut pace = Pace::default();
        while let Some(visit) = pending.pop() {
            pace.step();
            match visit {
                Visit::Leave(address) => {
                    seen.insert(address, false);
                }
                Visit::Enter(value) => {
                    let Some(address) = address(&value) else {
                        continue;
                    };
                    match seen.get(&address) {
                        Some(is_open) => {
                            if all_shared || *is_open {
                                labels.marked.insert(address, None);
                            }
                        }
                        None => {
                            seen.insert(address, true);
                            pending.push(Visit::Leave(address));
                            inner.clear();
                            parts(&value, symbols, &mut inner);
                            pending.extend(inner.drain(..).map(Visit::Enter));
                        }
                    }
                }
            }
        }
        labels
    }

    /// Is the part to be printed with a label?
    pub(super) fn is_marked(&self, value: &Value) -> bool {
        !self.marked.is_empty() && address(value).is_some_and(|a| self.marked.contains_key(&a))
    }

    /// The label of a part that is about to be printed.
    pub(super) fn next(&mut self, value: &Value) -> Label {
        if self.marked.is_empty() {
            return Label::None;
        }
        match address(value).and_then(|a| self.marked.get_mut(&a)) {
            None => Label::None,
            Some(Some(number)) => Label::Again(*number),
            Some(unnumbered) => {
                self.given += 1;
                *unnumbered = Some(self.given);
                Label::First(self.given)
            }
        }
    }
}
