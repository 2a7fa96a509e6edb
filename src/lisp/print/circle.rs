//! Which parts of a value occur more than once, or contain themselves.

use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

use super::settings::Settings;
use crate::guard::Pace;
use crate::image::Image;
use crate::value::Value;
use crate::value::class::ClassKind;
use crate::value::copy::Copier;
use crate::value::foreign::{Foreign, ForeignCopy, PrintContext};
use crate::value::known;
use crate::value::symbol::Sym;

/// A value with fewer parts than this is first walked without bookkeeping: if the walk
/// ends, nothing in it is circular.
const QUICK: usize = 20_000;

/// The parts that are printed with labels.
#[derive(Clone, Default, Debug)]
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

/// Labels that the elements of a logical block share, although they are printed one by one.
#[derive(Clone, Debug)]
pub struct SharedLabels {
    labels: Rc<RefCell<Labels>>,
    /// Do they belong to one attempt to print, which is repeated if it needs calls?
    is_of_attempt: bool,
}

impl PartialEq for SharedLabels {
    fn eq(&self, other: &SharedLabels) -> bool {
        Rc::ptr_eq(&self.labels, &other.labels)
    }
}

impl Eq for SharedLabels {}

impl SharedLabels {
    /// The labels of a list that a block prints.
    pub fn of(image: &Image, list: &Value, settings: &Settings) -> SharedLabels {
        SharedLabels {
            labels: Rc::new(RefCell::new(Labels::of(image, list, &settings.effective()))),
            is_of_attempt: false,
        }
    }

    /// A copy for an attempt to print.
    pub(super) fn for_attempt(&self) -> SharedLabels {
        SharedLabels {
            labels: Rc::new(RefCell::new(self.labels.borrow().clone())),
            is_of_attempt: true,
        }
    }

    /// The labels, and those of a value that has parts from elsewhere.
    pub(super) fn with(&self, own: Labels) -> Labels {
        let mut labels = self.labels.borrow().clone();
        for address in own.marked.into_keys() {
            labels.marked.entry(address).or_insert(None);
        }
        labels
    }

    /// Notes what has been printed; after an attempt that needs calls, nothing has been.
    pub(super) fn note(&self, printed: &Labels, is_complete: bool) {
        if !is_complete && !self.is_of_attempt {
            return;
        }
        let mut labels = self.labels.borrow_mut();
        for (address, number) in &mut labels.marked {
            if let Some(given) = printed.marked.get(address) {
                *number = *given;
            }
        }
        labels.given = printed.given;
    }

    /// Notes what an attempt has printed.
    pub(super) fn note_attempt(&self, attempt: &SharedLabels, is_complete: bool) {
        self.note(&attempt.labels.borrow(), is_complete);
    }

    /// Is the part to be printed with a label?
    pub(crate) fn is_marked(&self, value: &Value) -> bool {
        self.labels.borrow().is_marked(value)
    }

    /// The label of a part that is about to be printed, and whether it takes the part's place.
    pub fn next(&self, value: &Value) -> Option<(String, bool)> {
        match self.labels.borrow_mut().next(value) {
            Label::None => None,
            Label::First(number) => Some((format!("#{number}="), false)),
            Label::Again(number) => Some((format!("#{number}#"), true)),
        }
    }
}

impl Foreign for SharedLabels {
    fn type_symbol(&self) -> Sym {
        known::T
    }

    fn print(&self, _: &dyn PrintContext, _: bool) -> String {
        "#<labels>".to_owned()
    }

    fn copied(&self, _: &mut Copier) -> ForeignCopy {
        // The parts have other addresses in a copy.
        ForeignCopy::New(Box::new(SharedLabels {
            labels: Rc::default(),
            is_of_attempt: false,
        }))
    }
}

enum Visit {
    /// With the index of a list's rest in the list.
    Enter(Value, usize),
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
        let mut pending = vec![Visit::Enter(value.clone(), 0)];
        let mut inner = Vec::new();
        let mut pace = Pace::default();
        while let Some(visit) = pending.pop() {
            pace.step();
            match visit {
                Visit::Leave(address) => {
                    seen.insert(address, false);
                }
                Visit::Enter(value, index) => {
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
                            let is_list = matches!(value, Value::Cons(_));
                            // The first part of a pair that comes is the rest of the list.
                            let has_rest = is_list && is_shareable(&value.cdr_or_nil(), symbols);
                            let is_cut =
                                all_shared && settings.length.is_some_and(|most| index + 1 >= most);
                            let visits = inner.drain(..).enumerate();
                            let visits = visits.filter(|(i, _)| !(has_rest && is_cut && *i == 0));
                            pending.extend(visits.map(|(i, part)| {
                                let is_rest = has_rest && i == 0;
                                Visit::Enter(part, if is_rest { index + 1 } else { 0 })
                            }));
                        }
                    }
                }
            }
        }
        labels
    }

    /// Has no part a label?
    pub(super) fn is_empty(&self) -> bool {
        self.marked.is_empty()
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
