//! Judges Prolog goals as written, in calls of what proves them, in rules of fact groups and as goals of actions: functors that there are
//! not, wrong numbers of arguments, and variables that cannot be bound yet where something must be given. What a
//! program computes is not judged, and what it may bind is taken to be bound.

use std::collections::BTreeSet;
use std::rc::Rc;

use super::judge::{Mistake, arity, strong, weak};
use super::known::KnownNames;
use closest_name::closest_name;
use cram::prolog::facts::{self, Facts, Known};
use cram::prolog::warnings;
use lisp::image::Image;
use lisp::image::notes::{Note, NoteKind};
use lisp::print;
use lisp::source::Place;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::package::PackageTable;
use lisp::value::symbol::Sym;

/// How deep goals are looked into.
const MAX_NESTED: usize = 100;

/// The mistakes in the goals that a note is about, with their places.
pub(super) fn judge(image: &Image, names: &KnownNames, note: &Note) -> Vec<(Place, Mistake)> {
    let mut goals = Goals {
        image,
        names,
        facts: facts::of(image),
        bound: BTreeSet::new(),
        is_open: false,
        depth: 0,
        mistakes: Vec::new(),
    };
    match &note.kind {
        NoteKind::Call(function, form) => {
            let Some(takes_bindings) = takes_goal(image, *function) else {
                return Vec::new();
            };
            let mut arguments = form.cdr_or_nil().iter_list();
            let goal = arguments.next().map(|form| written(image, &form));
            let bindings = arguments.next().filter(|_| takes_bindings);
            goals.is_open = bindings.is_some_and(|form| !form.is_nil());
            if let Some(goal) = goal {
                goals.prove(&goal, note.place);
            }
        }
        NoteKind::Goal(goal) => {
            goals.is_open = true;
            goals.prove(goal, note.place);
        }
        NoteKind::Definition(form) if is_named(image, &form.car_or_nil(), "DEF-FACT-GROUP") => {
            let rules = form.cdr_or_nil().cdr_or_nil().cdr_or_nil();
            for rule in rules.iter_list() {
                let parts = rule.cdr_or_nil();
                goals.bound.clear();
                goals.is_open = false;
                goals.bind(&parts.car_or_nil());
                for goal in parts.cdr_or_nil().iter_list() {
                    goals.prove(&goal, note.place);
                }
            }
        }
        _ => {}
    }
    goals.mistakes
}

/// Whether a function proves the goal that is its first argument; and if so, whether its second one is bindings.
fn takes_goal(image: &Image, function: Sym) -> Option<bool> {
    let package = image.symbol(function).package?;
    let package = &*image.packages.get(package).name;
    match (package, image.name(function)) {
        ("CRAM-PROLOG", "PROLOG" | "PROVE-ALL" | "PROVE-ONE") => Some(true),
        ("CRAM-OCCASIONS-EVENTS", "HOLDS") | ("PLANWRIGHT", "ASK") => Some(false),
        _ => None,
    }
}

fn is_named(image: &Image, term: &Value, name: &str) -> bool {
    term.as_symbol().is_some_and(|sym| image.name(sym) == name)
}

/// The value of a form as far as it can be seen; what cannot is unbound.
fn written(image: &Image, form: &Value) -> Value {
    let parts = || form.cdr_or_nil().iter_list().collect::<Vec<Value>>();
    match form {
        Value::Symbol(sym, ..) => {
            let is_itself = image.is_keyword(*sym) || matches!(*sym, known::NIL | known::T);
            match is_itself {
                true => form.clone(),
                false => Value::Unbound,
            }
        }
        Value::Cons(cons) => match cons.car().as_symbol() {
            // In what is left of a template, the parts that are computed show by their operators.
            Some(known::QUOTE | known::QUASIQUOTE) => form.cdr_or_nil().car_or_nil(),
            Some(head) if image.symbol(head).package == Some(PackageTable::CL) => {
                match image.name(head) {
                    "LIST" => Value::list(
                        parts()
                            .iter()
                            .map(|part| written(image, part))
                            .collect::<Vec<_>>(),
                    ),
                    "LIST*" | "CONS" => {
                        let mut parts = parts();
                        let tail = parts.pop().map_or(Value::NIL, |tail| written(image, &tail));
                        let items: Vec<Value> =
                            parts.iter().map(|part| written(image, part)).collect();
                        Value::list_with_tail(items, tail)
                    }
                    _ => Value::Unbound,
                }
            }
            _ => Value::Unbound,
        },
        other => other.clone(),
    }
}

/// Is a part of a goal computed?
fn is_computed(term: &Value) -> bool {
    let head = || term.as_cons().and_then(|cons| cons.car().as_symbol());
    term.is_unbound() || matches!(head(), Some(known::UNQUOTE | known::UNQUOTE_SPLICING))
}

/// The elements of a list, and whether these are all.
pub(super) fn elements(list: &Value) -> (Vec<Value>, bool) {
    let mut items = Vec::new();
    let mut rest = list.clone();
    while let Some(cons) = rest.clone().as_cons() {
        let item = cons.car();
        let is_spliced = item
            .as_cons()
            .is_some_and(|item| matches!(item.car().as_symbol(), Some(known::UNQUOTE_SPLICING)));
        // `(a . ,b)` is read as `(a unquote b)`.
        if is_spliced || item.as_symbol() == Some(known::UNQUOTE) {
            return (items, false);
        }
        items.push(item);
        rest = cons.cdr();
    }
    (items, rest.is_nil())
}

/// What is known while the goals of a query or of a rule are looked at, from the first to the last.
struct Goals<'a> {
    image: &'a Image,
    names: &'a KnownNames,
    facts: Rc<Facts>,
    /// Variables that an earlier goal, or whoever asks, may have bound.
    bound: BTreeSet<Sym>,
    /// May any variable be bound?
    is_open: bool,
    depth: usize,
    mistakes: Vec<(Place, Mistake)>,
}

impl Goals<'_> {
    /// Looks at a goal; `place` is that of what it is in.
    fn prove(&mut self, term: &Value, place: Place) {
        let place = match term.as_cons().map(|cons| cons.place()) {
            Some(own) if own.is_some() => own,
            _ => place,
        };
        let functor = match term.as_cons() {
            Some(_) if is_computed(term) => None,
            Some(cons) => cons.car().as_symbol(),
            None => term.as_symbol(),
        };
        let functor = functor.filter(|functor| !self.is_variable(*functor));
        let Some(functor) = functor.filter(|functor| *functor != known::NIL) else {
            // Whatever is proved there may bind anything.
            self.is_open = true;
            return;
        };
        if self.depth >= MAX_NESTED {
            self.is_open = true;
            return;
        }
        self.depth += 1;
        let (args, is_whole) = match term.as_cons() {
            Some(cons) => elements(&cons.cdr()),
            None => (Vec::new(), true),
        };
        let known = self.facts.known(self.image, functor);
        let count = is_whole.then_some(args.len());
        let mistake = self
            .unknown(functor, &known)
            .or_else(|| self.miscounted(&known, count?));
        match mistake {
            Some(mistake) => self.mistakes.push((place, mistake)),
            None => self.not_given(&known, &args, count, place),
        }
        self.prove_parts(functor, &args, place);
        let binds_nothing = matches!(self.image.name(functor), "NOT" | "FORALL")
            && known.heads.is_none()
            && known.functor.is_some();
        if !binds_nothing {
            args.iter().for_each(|arg| self.bind(arg));
        }
        self.is_open |= !is_whole;
        self.depth -= 1;
    }

    /// Looks at the goals that are arguments of a goal.
    fn prove_parts(&mut self, functor: Sym, args: &[Value], place: Place) {
        let one = |at: usize| args.get(at).map_or(&[][..], std::slice::from_ref);
        match self.image.name(functor) {
            "AND" | "ONCE" => self.prove_all(args, place),
            "CALL" if args.len() == 1 => self.prove_all(args, place),
            "WITH-COPIED-WORLD" | "WITH-STORED-WORLD" | "WITH-WORLD" | "FILTER-BINDINGS" => {
                self.prove_all(args.get(1..).unwrap_or_default(), place);
            }
            "HOLDS" => {
                let at = usize::from(args.len() == 3);
                self.prove_apart(&[one(at)], place);
            }
            "OR" => {
                let ways: Vec<&[Value]> = args.iter().map(std::slice::from_ref).collect();
                self.prove_apart(&ways, place);
            }
            "NOT" => self.prove_apart(&[one(0)], place),
            "FORALL" => self.prove_apart(&[args], place),
            "FINDALL" | "BAGOF" | "SETOF" => self.prove_apart(&[one(1)], place),
            "->" | "*->" => {
                let then = args.get(..2).unwrap_or(args);
                self.prove_apart(&[then, one(2)], place);
            }
            _ => {}
        }
    }

    fn prove_all(&mut self, goals: &[Value], place: Place) {
        for goal in goals {
            self.prove(goal, place);
        }
    }

    /// Looks at lists of goals none of which knows what another one binds.
    fn prove_apart(&mut self, ways: &[&[Value]], place: Place) {
        let bound = self.bound.clone();
        let was_open = self.is_open;
        let mut is_open = was_open;
        for way in ways {
            self.prove_all(way, place);
            is_open |= self.is_open;
            (self.bound, self.is_open) = (bound.clone(), was_open);
        }
        self.is_open = is_open;
    }

    /// A goal with a functor that there is not.
    fn unknown(&self, functor: Sym, known: &Known) -> Option<Mistake> {
        let (image, names) = (self.image, self.names);
        let name = image.name(functor);
        let is_known = known.heads.is_some() || known.handler.is_some() || known.functor.is_some();
        if is_known || names.is_open || names.functors.contains_key(name) {
            return None;
        }
        let near = self.facts.closest(image, name);
        let all = near.iter().chain(names.functors.keys()).map(String::as_str);
        let text = format!("There is no Prolog functor {name}");
        let text = match closest_name(name, all) {
            Some(near) => format!("{text}; did you mean {near}?"),
            None => format!("{text}."),
        };
        Some(weak(text, Some(name)))
    }

    /// A goal with more or fewer arguments than its functor has.
    fn miscounted(&self, known: &Known, count: usize) -> Option<Mistake> {
        let image = self.image;
        let name = image.name(known.meant);
        let is_own = match self.names.functors.get(name) {
            Some(counts) => counts.as_ref().is_none_or(|counts| counts.contains(&count)),
            None => false,
        };
        let text = match (&known.heads, &known.handler) {
            // Other texts may have rules with other numbers of arguments.
            (Some(_), _) if self.names.is_open || is_own => None,
            (Some(_), Some(_)) => None,
            (None, Some(handler)) => self.of_handler(known.meant, handler, count),
            (_, None) => warnings::of_count(image, known, count),
        };
        text.map(|text| strong(text, Some(name)))
    }

    /// Why a functor of `def-prolog-handler` does not take so many arguments.
    fn of_handler(&self, functor: Sym, handler: &Value, count: usize) -> Option<String> {
        let Value::Function(function) = handler else {
            return None;
        };
        // The first argument is the bindings so far.
        let (min, max) = arity(self.image, function)?;
        let (min, max) = (min.saturating_sub(1), max.map(|max| max.saturating_sub(1)));
        if count >= min && max.is_none_or(|max| count <= max) {
            return None;
        }
        let number = match max {
            Some(max) if max == min => min.to_string(),
            Some(max) => format!("{min} to {max}"),
            None => format!("{min} or more"),
        };
        Some(format!(
            "The Prolog goal {} does not take {count} argument{}; it has {number}.",
            print::to_string(self.image, &functor.into(), true),
            if count == 1 { "" } else { "s" },
        ))
    }

    /// Variables that cannot be bound yet where the goal needs something.
    fn not_given(&mut self, known: &Known, args: &[Value], count: Option<usize>, place: Place) {
        if self.is_open {
            return;
        }
        let image = self.image;
        let mut given = match (count, known.functor, &known.heads) {
            (Some(count), ..) => self.facts.given(known.meant, count),
            (None, ..) => Vec::new(),
        };
        if let (Some(functor), None, None) = (known.functor, &known.heads, &known.handler) {
            given.extend(functor.given());
        }
        for at in given {
            let Some(variable) = args.get(at).and_then(Value::as_symbol) else {
                continue;
            };
            if !self.is_variable(variable) || self.bound.contains(&variable) {
                continue;
            }
            let name = image.name(variable);
            let text = format!(
                "The variable {name} is not bound here: in the goal ({} …), argument {} must be given.",
                print::to_string(image, &known.meant.into(), true),
                at + 1
            );
            self.mistakes.push((place, strong(text, Some(name))));
        }
    }

    fn is_variable(&self, sym: Sym) -> bool {
        self.image.name(sym).starts_with('?')
    }

    /// The variables of a term may be bound from now on; what is computed may be any term.
    fn bind(&mut self, term: &Value) {
        let mut pending = vec![term.clone()];
        while let Some(term) = pending.pop() {
            if is_computed(&term) {
                self.is_open = true;
                continue;
            }
            match &term {
                Value::Symbol(sym, ..)
                    if self.is_variable(*sym) && self.image.name(*sym) != "?_" =>
                {
                    self.bound.insert(*sym);
                }
                Value::Cons(cons) => pending.extend([cons.car(), cons.cdr()]),
                _ => {}
            }
        }
    }
}
