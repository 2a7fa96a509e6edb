//! Terms and bindings: Lisp values in which the variables of a clause are replaced by fresh ones.

use std::rc::Rc;

use lisp::image::Image;
use lisp::value::Value;
use lisp::value::copy::{Copied, Copier};
use lisp::value::equality;
use lisp::value::foreign::{Foreign, ForeignCopy, PrintContext};
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;

/// Maximum depth of nested terms.
const MAX_NESTED: usize = 500;

/// A variable of a proof.
pub(crate) struct Variable {
    /// Its index in the bindings.
    pub index: usize,
    /// The symbol it was written as.
    pub name: Sym,
}

impl Foreign for Variable {
    fn copied(&self, _: &mut Copier) -> ForeignCopy {
        ForeignCopy::Same
    }

    fn type_symbol(&self) -> Sym {
        known::SYMBOL
    }

    fn print(&self, context: &dyn PrintContext, _: bool) -> String {
        context.name(self.name).to_owned()
    }
}

fn too_deep() -> Box<Raise> {
    Raise::simple("A term of a Prolog goal is nested too deeply.")
}

/// The variables of one clause or query, created on demand.
#[derive(Default)]
pub struct Naming {
    /// Symbols with their variables, in order of first appearance.
    pub variables: Vec<(Sym, Value)>,
}

/// Bindings, in the order in which they were made.
#[derive(Default)]
pub struct Bindings {
    values: Vec<Option<Value>>,
    trail: Vec<usize>,
}

/// A state of the bindings that can be restored.
#[derive(Clone, Copy)]
pub struct Mark {
    values: usize,
    trail: usize,
}

impl Copied for Bindings {
    fn copied(&self, copier: &mut Copier) -> Bindings {
        let values = self.values.iter();
        let values = values.map(|value| value.as_ref().map(|value| copier.value(value)));
        Bindings {
            values: values.collect(),
            trail: self.trail.clone(),
        }
    }
}

impl Bindings {
    /// Visits what variables are bound to.
    pub(super) fn for_each_reference(&self, visit: &mut dyn FnMut(&Value)) {
        self.values.iter().flatten().for_each(visit);
    }

    /// The present state.
    pub fn mark(&self) -> Mark {
        Mark {
            values: self.values.len(),
            trail: self.trail.len(),
        }
    }

    /// Restores an earlier state.
    pub(crate) fn undo(&mut self, mark: Mark) {
        for index in self.trail.drain(mark.trail..) {
            if let Some(slot) = self.values.get_mut(index) {
                *slot = None;
            }
        }
        self.values.truncate(mark.values);
    }

    /// A new unbound variable.
    pub fn fresh(&mut self, name: Sym) -> Value {
        let index = self.values.len();
        self.values.push(None);
        Value::foreign(Variable { index, name })
    }

    /// The term with variables instead of `?symbols`; each `?_` is a new one.
    pub fn rename(
        &mut self,
        image: &Image,
        term: &Value,
        naming: &mut Naming,
    ) -> Result<Value, Box<Raise>> {
        self.rename_at(image, term, naming, 0)
    }

    fn rename_at(
        &mut self,
        image: &Image,
        term: &Value,
        naming: &mut Naming,
        depth: usize,
    ) -> Result<Value, Box<Raise>> {
        if depth > MAX_NESTED {
            return Err(too_deep());
        }
        match term {
            Value::Symbol(sym, ..) if image.name(*sym).starts_with('?') => {
                if image.name(*sym) == "?_" {
                    return Ok(self.fresh(*sym));
                }
                if let Some((_, variable)) = naming.variables.iter().find(|(s, _)| s == sym) {
                    return Ok(variable.clone());
                }
                let variable = self.fresh(*sym);
                naming.variables.push((*sym, variable.clone()));
                Ok(variable)
            }
            Value::Cons(_) => {
                let mut items = Vec::new();
                let mut rest = term.iter_list();
                for item in rest.by_ref() {
                    items.push(self.rename_at(image, &item, naming, depth + 1)?);
                }
                let tail = self.rename_at(image, &rest.rest, naming, depth + 1)?;
                Ok(Value::list_with_tail(items, tail))
            }
            other => Ok(other.clone()),
        }
    }

    /// What a term is bound to; its parts are left as they are.
    pub fn walk(&self, term: &Value) -> Value {
        let mut term = term.clone();
        while let Some(next) = term
            .as_foreign::<Variable>()
            .and_then(|v| self.values.get(v.index).cloned().flatten())
        {
            term = next;
        }
        term
    }

    /// The term with all bound variables replaced; unbound ones remain.
    pub(crate) fn resolve(&self, term: &Value) -> Result<Value, Box<Raise>> {
        self.resolve_at(term, 0)
    }

    fn resolve_at(&self, term: &Value, depth: usize) -> Result<Value, Box<Raise>> {
        if depth > MAX_NESTED {
            return Err(too_deep());
        }
        let term = self.walk(term);
        if !matches!(term, Value::Cons(_)) {
            return Ok(term);
        }
        let mut items = Vec::new();
        let mut rest = term;
        while let Value::Cons(cons) = &rest {
            items.push(self.resolve_at(&cons.car(), depth + 1)?);
            let next = self.walk(&cons.cdr());
            rest = next;
        }
        Ok(Value::list_with_tail(items, rest))
    }

    /// A term in which unbound variables are shown as the symbols that they were written as.
    pub fn shown(&self, term: &Value) -> Result<Value, Box<Raise>> {
        fn named(term: &Value) -> Value {
            match term {
                Value::Foreign(_) => match term.as_foreign::<Variable>() {
                    Some(variable) => variable.name.into(),
                    None => term.clone(),
                },
                // `resolve` limits the depth.
                Value::Cons(_) => {
                    let mut rest = term.iter_list();
                    let items: Vec<Value> = rest.by_ref().map(|t| named(&t)).collect();
                    Value::list_with_tail(items, named(&rest.rest))
                }
                other => other.clone(),
            }
        }
        Ok(named(&self.resolve(term)?))
    }

    /// The term with fresh variables in place of its unbound ones, except those that are kept.
    pub(crate) fn localized(&mut self, term: &Value, kept: &[Value]) -> Result<Value, Box<Raise>> {
        let term = self.resolve(term)?;
        let mut fresh: Vec<(usize, Value)> = kept
            .iter()
            .filter_map(|v| Some((v.as_foreign::<Variable>()?.index, v.clone())))
            .collect();
        Ok(self.replaced(&term, &mut fresh))
    }

    // The depth of a resolved term is limited.
    fn replaced(&mut self, term: &Value, fresh: &mut Vec<(usize, Value)>) -> Value {
        if let Some(variable) = term.as_foreign::<Variable>() {
            if let Some((_, new)) = fresh.iter().find(|(index, _)| *index == variable.index) {
                return new.clone();
            }
            let new = self.fresh(variable.name);
            fresh.push((variable.index, new.clone()));
            return new;
        }
        if !matches!(term, Value::Cons(_)) {
            return term.clone();
        }
        let mut rest = term.iter_list();
        let mut items = Vec::new();
        for item in rest.by_ref() {
            items.push(self.replaced(&item, fresh));
        }
        let tail = self.replaced(&rest.rest, fresh);
        Value::list_with_tail(items, tail)
    }

    /// Adds the variables of a resolved term to a list, each once.
    pub(crate) fn unbound_in(&self, term: &Value, variables: &mut Vec<Value>) {
        let mut pending = vec![term.clone()];
        while let Some(term) = pending.pop() {
            match &term {
                Value::Foreign(_) => {
                    if let Some(variable) = term.as_foreign::<Variable>() {
                        let is_same = |known: &Value| {
                            let known = known.as_foreign::<Variable>();
                            known.is_some_and(|known| known.index == variable.index)
                        };
                        if !variables.iter().any(is_same) {
                            variables.push(term.clone());
                        }
                    }
                }
                Value::Cons(cons) => {
                    pending.push(cons.cdr());
                    pending.push(cons.car());
                }
                _ => {}
            }
        }
    }

    /// Whether the term contains no unbound variables.
    pub(crate) fn is_ground(&self, term: &Value) -> Result<bool, Box<Raise>> {
        let mut pending = vec![self.resolve(term)?];
        while let Some(term) = pending.pop() {
            match &term {
                Value::Foreign(_) if term.as_foreign::<Variable>().is_some() => return Ok(false),
                Value::Cons(cons) => {
                    pending.push(cons.car());
                    pending.push(cons.cdr());
                }
                _ => {}
            }
        }
        Ok(true)
    }

    fn bind(&mut self, variable: &Variable, value: Value) {
        if let Some(slot) = self.values.get_mut(variable.index) {
            *slot = Some(value);
            self.trail.push(variable.index);
        }
    }

    /// Unifies two terms by binding variables; false if that is impossible (bindings made until
    /// then remain and must be undone).
    pub fn unify(&mut self, a: &Value, b: &Value) -> bool {
        let mut pending = vec![(a.clone(), b.clone())];
        while let Some((a, b)) = pending.pop() {
            let (a, b) = (self.walk(&a), self.walk(&b));
            if a.is_eq(&b) {
                continue;
            }
            if let Some(variable) = a.as_foreign::<Variable>() {
                self.bind(variable, b.clone());
                continue;
            }
            if let Some(variable) = b.as_foreign::<Variable>() {
                self.bind(variable, a.clone());
                continue;
            }
            match (&a, &b) {
                (Value::Cons(x), Value::Cons(y)) => {
                    if Rc::ptr_eq(x, y) {
                        continue;
                    }
                    pending.push((x.cdr(), y.cdr()));
                    pending.push((x.car(), y.car()));
                }
                _ if equality::equal(&a, &b) => {}
                _ => return false,
            }
        }
        true
    }
}
