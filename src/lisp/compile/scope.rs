//! What names mean at a point in a program: lexical variables, functions, macros, blocks and tags.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use super::exits::Exits;
use crate::value::Value;
use crate::value::function::Function;
use crate::value::symbol::Sym;

/// A lexical variable (or local function, or identity of a block).
pub(crate) struct Var {
    pub name: Sym,
    /// The function that binds it.
    pub owner: usize,
    /// Does an inner function refer to it?
    pub(crate) captured: Cell<bool>,
    /// Is it ever assigned after its binding?
    pub assigned: Cell<bool>,
    /// Its slot in the owner's frame, once code is emitted.
    pub slot: Cell<u32>,
    /// Does the program refer to it?
    pub used: Cell<bool>,
    /// Does the program read it?
    pub read: Cell<bool>,
}

impl Var {
    /// Must the variable live in a box?
    pub(crate) fn is_boxed(&self) -> bool {
        self.captured.get() && self.assigned.get()
    }
}

/// What a name in variable position means.
#[derive(Clone)]
pub(crate) enum VariableMeaning {
    /// A lexical variable.
    Lexical(Rc<Var>),
    /// A dynamic variable, declared so in this scope.
    Special,
    /// A symbol macro.
    SymbolMacro(Value),
}

/// What a name in function position means.
#[derive(Clone)]
pub(crate) enum FunctionMeaning {
    /// A local function: a variable that holds it.
    Local(Rc<Var>),
    /// A local macro.
    Macro(Rc<Function>),
}

/// Kinds of dynamic entries that are open while code of one function runs.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum DynamicKind {
    /// A binding, handlers, restarts or catch: undone by dropping it.
    Plain,
    /// Cleanup forms that must run.
    Unwind,
}

pub(crate) struct Block {
    pub name: Sym,
    /// The function it is in.
    pub owner: usize,
    /// Open dynamic entries outside it, in that function.
    pub depth: usize,
    /// The variable that holds its identity.
    pub identity: Rc<Var>,
    /// Must it be left by unwinding?
    pub dynamic: Cell<bool>,
    /// Is it ever left by `return-from`?
    pub used: Cell<bool>,
    /// What it is noticed for.
    pub(super) exits: Exits,
}

pub(crate) struct Tagbody {
    /// The tags: symbols or integers.
    pub tags: Vec<Value>,
    /// The function it is in.
    pub owner: usize,
    /// Open dynamic entries outside it, in that function.
    pub depth: usize,
    /// The variable that holds its identity.
    pub identity: Rc<Var>,
    /// Must its tags be reached by unwinding?
    pub dynamic: Cell<bool>,
}

/// One link of the chain of scopes, innermost first.
pub(crate) enum Entry {
    /// A name in variable position.
    Variable(Sym, VariableMeaning),
    /// A name in function position; the flag distinguishes `(setf name)` from `name`.
    Function(Sym, bool, FunctionMeaning),
    /// A block.
    Block(Rc<Block>),
    /// A tagbody.
    Tagbody(Rc<Tagbody>),
}

/// An immutable chain of scopes.
#[derive(Clone, Default)]
pub(crate) struct Scope(Option<Rc<Link>>);

struct Link {
    entry: Entry,
    outer: Scope,
}

impl Drop for Link {
    fn drop(&mut self) {
        let mut outer = self.outer.0.take();
        while let Some(link) = outer {
            match Rc::try_unwrap(link) {
                Ok(mut inner) => outer = inner.outer.0.take(),
                Err(_) => break,
            }
        }
    }
}

impl Scope {
    /// The scope with one more entry.
    pub(crate) fn with(&self, entry: Entry) -> Scope {
        Scope(Some(Rc::new(Link {
            entry,
            outer: self.clone(),
        })))
    }

    /// The scope as the functions of its macros see it: macros and symbol macros, as far as no
    /// variable or function hides them.
    pub(super) fn of_macros(&self) -> Scope {
        let mut seen: Vec<(Sym, u8)> = Vec::new();
        let mut kept = Vec::new();
        for entry in self.entries() {
            let name = match entry {
                Entry::Variable(name, _) => (*name, 0),
                Entry::Function(name, is_setf, _) => (*name, 1 + u8::from(*is_setf)),
                Entry::Block(_) | Entry::Tagbody(_) => continue,
            };
            if seen.contains(&name) {
                continue;
            }
            seen.push(name);
            match entry {
                Entry::Variable(name, meaning @ VariableMeaning::SymbolMacro(_)) => {
                    kept.push(Entry::Variable(*name, meaning.clone()));
                }
                Entry::Function(name, is_setf, meaning @ FunctionMeaning::Macro(_)) => {
                    kept.push(Entry::Function(*name, *is_setf, meaning.clone()));
                }
                _ => {}
            }
        }
        let scope = Scope::default();
        kept.into_iter()
            .rev()
            .fold(scope, |scope, entry| scope.with(entry))
    }

    pub(super) fn entries(&self) -> impl Iterator<Item = &Entry> {
        let mut scope = self;
        std::iter::from_fn(move || {
            let link = scope.0.as_ref()?;
            scope = &link.outer;
            Some(&link.entry)
        })
    }

    /// The meaning of a variable name, if it is not global.
    pub(crate) fn variable(&self, name: Sym) -> Option<&VariableMeaning> {
        self.entries().find_map(|e| match e {
            Entry::Variable(n, meaning) if *n == name => Some(meaning),
            _ => None,
        })
    }

    /// The names of lexical variables, innermost first.
    pub(crate) fn variables(&self) -> impl Iterator<Item = Sym> {
        self.entries().filter_map(|e| match e {
            Entry::Variable(name, VariableMeaning::Lexical(_)) => Some(*name),
            _ => None,
        })
    }

    /// The meaning of a function name, if it is not global.
    pub(crate) fn function(&self, name: Sym, is_setf: bool) -> Option<&FunctionMeaning> {
        self.entries().find_map(|e| match e {
            Entry::Function(n, s, meaning) if *n == name && *s == is_setf => Some(meaning),
            _ => None,
        })
    }

    /// The blocks, innermost first.
    pub(super) fn blocks(&self) -> impl Iterator<Item = &Rc<Block>> {
        self.entries().filter_map(|e| match e {
            Entry::Block(block) => Some(block),
            _ => None,
        })
    }

    /// The innermost block of that name.
    pub(crate) fn block(&self, name: Sym) -> Option<&Rc<Block>> {
        self.entries().find_map(|e| match e {
            Entry::Block(b) if b.name == name => Some(b),
            _ => None,
        })
    }

    /// The innermost tagbody with that tag, and the tag's number.
    pub(crate) fn tag(&self, tag: &Value) -> Option<(&Rc<Tagbody>, usize)> {
        self.entries().find_map(|e| match e {
            Entry::Tagbody(t) => {
                let index = t.tags.iter().position(|other| other.is_eql(tag))?;
                Some((t, index))
            }
            _ => None,
        })
    }
}

/// A function that is being compiled.
pub(crate) struct FunctionContext {
    /// The number of the function around it.
    pub outer: Option<usize>,
    /// Variables of outer functions that it refers to, in order of first use.
    pub free: RefCell<Vec<Rc<Var>>>,
    /// Dynamic entries that are open at this point.
    pub dynamic: RefCell<Vec<DynamicKind>>,
}
