//! Fact groups: rules by the symbol that begins their heads.

use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

use indexmap::IndexMap;

use super::functor::Functor;
use super::tracing::Tracing;
use crate::packages;
use closest_name::closest_name;
use lisp::builtin::{Builtin, Operator};
use lisp::image::Image;
use lisp::image::extension::Extension;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::copy::{Copied, Copier};
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// `(<- head goal…)`: the head holds if the goals do.
#[derive(Clone)]
pub(crate) struct Clause {
    /// The head: a list, or just a symbol.
    pub head: Value,
    /// The list of goals.
    pub body: Value,
}

/// All fact groups of an image, and the functors that need none.
#[derive(Default)]
pub struct Facts {
    groups: RefCell<IndexMap<Sym, Vec<(Sym, Clause)>>>,
    /// The clauses of the groups by functor, once they have been asked for.
    index: RefCell<Option<HashMap<Sym, Rc<[Clause]>>>>,
    handlers: RefCell<IndexMap<Sym, Value>>,
    functors: RefCell<IndexMap<&'static str, &'static Functor>>,
    /// Which arguments of goals must be given, by functor and number of arguments; written once, so that copies share them.
    given: RefCell<Rc<Given>>,
    /// Which goals are traced.
    pub(super) tracing: RefCell<Tracing>,
}

/// The numbers of arguments that cannot be unbound variables, by functor and number of arguments, or of any number.
type Given = BTreeMap<(Sym, Option<usize>), Vec<usize>>;

impl Facts {
    /// The clauses of a functor, in order of definition; `None` if there is none.
    pub(crate) fn clauses(&self, functor: Sym) -> Option<Rc<[Clause]>> {
        let mut index = self.index.borrow_mut();
        let index = index.get_or_insert_with(|| {
            let mut found: HashMap<Sym, Vec<Clause>> = HashMap::new();
            for (name, clause) in self.groups.borrow().values().flatten() {
                found.entry(*name).or_default().push(clause.clone());
            }
            let found = found.into_iter();
            found
                .map(|(name, clauses)| (name, clauses.into()))
                .collect()
        });
        index.get(&functor).cloned()
    }

    /// The functor that is meant by a symbol: itself, or if nothing is known of it, the first functor
    /// with that name of another package.
    pub(super) fn meant(&self, image: &Image, functor: Sym) -> Sym {
        if self.knows(functor) || self.handlers.borrow().contains_key(&functor) {
            return functor;
        }
        let name = image.name(functor);
        if self.functors.borrow().contains_key(name) {
            return functor;
        }
        let groups = self.groups.borrow();
        let handlers = self.handlers.borrow();
        let defined = groups.values().flatten().map(|(name, _)| *name);
        let mut defined = defined.chain(handlers.keys().copied());
        let named = defined.find(|other| image.name(*other) == name);
        named.unwrap_or(functor)
    }

    /// Whether any goal is traced.
    pub(super) fn is_tracing(&self) -> bool {
        !self.tracing.borrow().is_off()
    }

    /// Whether there is a functor of that name, in whatever package.
    pub fn has(&self, image: &Image, name: &str) -> bool {
        let handlers = self.handlers.borrow();
        let groups = self.groups.borrow();
        let defined = groups.values().flatten().map(|(name, _)| *name);
        let mut defined = defined.chain(handlers.keys().copied());
        self.functors.borrow().contains_key(name) || defined.any(|other| image.name(other) == name)
    }

    /// What is known of goals with a symbol as their functor, which may be of another package.
    pub fn known(&self, image: &Image, functor: Sym) -> Known {
        let meant = self.meant(image, functor);
        Known {
            meant,
            heads: self
                .clauses(meant)
                .map(|clauses| clauses.iter().map(|clause| clause.head.clone()).collect()),
            handler: self.handler(meant),
            functor: self.functor(image.name(meant)),
        }
    }

    /// The numbers of those arguments that must be given in a goal with so many.
    pub fn given(&self, functor: Sym, count: usize) -> Vec<usize> {
        let given = self.given.borrow();
        let of_count = given.get(&(functor, Some(count)));
        let found = of_count.or_else(|| given.get(&(functor, None)));
        found.cloned().unwrap_or_default()
    }

    /// The function of `def-prolog-handler` for a functor.
    pub fn handler(&self, functor: Sym) -> Option<Value> {
        self.handlers.borrow().get(&functor).cloned()
    }

    /// The functor with that name that is implemented in Rust.
    pub fn functor(&self, name: &str) -> Option<&'static Functor> {
        self.functors.borrow().get(name).copied()
    }

    /// All functors that are implemented in Rust.
    pub fn functors(&self) -> Vec<&'static Functor> {
        self.functors.borrow().values().copied().collect()
    }

    /// The functor whose name is nearest to a mistyped one.
    pub fn closest(&self, image: &Image, wanted: &str) -> Option<String> {
        let groups = self.groups.borrow();
        let handlers = self.handlers.borrow();
        let functors = self.functors.borrow();
        let defined = groups.values().flatten().map(|(name, _)| *name);
        let defined = defined.chain(handlers.keys().copied());
        let names = defined
            .map(|name| image.name(name))
            .chain(functors.keys().copied());
        closest_name(wanted, names).map(str::to_owned)
    }

    /// Whether a clause of a functor is about a symbol of a name: whether it stands anywhere in its goals.
    pub(crate) fn is_about(&self, image: &Image, functor: Sym, name: &str) -> bool {
        let clauses = self.clauses(functor).unwrap_or_default();
        clauses.iter().any(|clause| {
            let mut pending = vec![clause.body.clone()];
            while let Some(form) = pending.pop() {
                match &form {
                    Value::Cons(_) => pending.extend(form.iter_list()),
                    other => {
                        if other.as_symbol().is_some_and(|sym| image.name(sym) == name) {
                            return true;
                        }
                    }
                }
            }
            false
        })
    }

    /// Whether any fact group has a clause for the functor.
    pub fn knows(&self, functor: Sym) -> bool {
        self.clauses(functor).is_some()
    }
}

impl Copied for Clause {
    fn copied(&self, copier: &mut Copier) -> Clause {
        Clause {
            head: copier.value(&self.head),
            body: copier.value(&self.body),
        }
    }
}

impl Extension for Facts {
    fn copied(self: Rc<Self>, copier: &mut Copier) -> Rc<dyn Extension> {
        let groups = self.groups.borrow();
        let groups = groups.iter().map(|(name, clauses)| {
            let clauses = clauses.iter();
            let clauses = clauses.map(|(functor, clause)| (*functor, clause.copied(copier)));
            (*name, clauses.collect())
        });
        let groups = groups.collect();
        let handlers = self.handlers.borrow();
        let handlers = handlers.iter();
        let handlers = handlers.map(|(name, handler)| (*name, copier.value(handler)));
        Rc::new(Facts {
            groups: RefCell::new(groups),
            index: RefCell::default(),
            handlers: RefCell::new(handlers.collect()),
            functors: self.functors.clone(),
            given: self.given.clone(),
            tracing: self.tracing.clone(),
        })
    }
}

/// Installs an empty collection of facts in an image.
pub fn install(image: &mut Image) {
    image.extend(Facts::default());
}

/// What is known of goals with a functor.
pub struct Known {
    /// The functor that is meant.
    pub meant: Sym,
    /// The heads of its rules, if any fact group has some.
    pub heads: Option<Vec<Value>>,
    /// The function of `def-prolog-handler`.
    pub handler: Option<Value>,
    /// The functor that is implemented in Rust.
    pub functor: Option<&'static Functor>,
}

/// The facts of an image; empty if it has no Prolog.
pub fn of(image: &Image) -> Rc<Facts> {
    image.extension().unwrap_or_default()
}

/// Adds functors.
pub(crate) fn install_functors(image: &Image, table: &'static [Functor]) {
    let facts = of(image);
    let mut functors = facts.functors.borrow_mut();
    functors.extend(table.iter().map(|functor| (functor.name, functor)));
}

/// Has any fact group a rule about the functor, or is there a handler for it?
///
/// `(prolog::functor-defined-p 'no-such-functor)` => `NIL`
#[builtin]
fn functor_defined_p(image: &mut Image, functor: &Value) -> bool {
    let facts = of(image);
    let is_defined = |s: Sym| facts.knows(s) || facts.handler(s).is_some();
    functor.as_symbol().is_some_and(is_defined)
}

/// In goals of a functor with so many arguments, or with any number, those with these numbers, from 0, cannot be
/// unbound variables.
#[builtin("%NOTE-GIVEN", "functor count numbers")]
fn note_given(image: &mut Image, functor: &Value, count: &Value, numbers: &Value) -> Result<Value> {
    let Some(name) = functor.as_symbol() else {
        return Err(Raise::type_error(functor, known::SYMBOL));
    };
    let number = |number: &Value| match number {
        Value::Int(number) => usize::try_from(*number).ok(),
        _ => None,
    };
    let numbers = numbers.iter_list().filter_map(|one| number(&one));
    let facts = of(image);
    let mut given = facts.given.borrow_mut();
    Rc::make_mut(&mut given).insert((name, number(count)), numbers.collect());
    Ok(functor.clone())
}

/// What DEF-PROLOG-HANDLER expands into.
#[builtin(_, "name function")]
fn define_handler(image: &mut Image, name_value: &Value, function: Value) -> Result<Value> {
    let Some(name) = name_value.as_symbol() else {
        return Err(Raise::type_error(name_value, known::SYMBOL));
    };
    let facts = of(image);
    facts.handlers.borrow_mut().insert(name, function);
    Ok(name_value.clone())
}

/// Macros of package `CRAM-PROLOG`.
pub static OPERATORS: &[Operator] = &[
    Operator {
        name: "DEF-FACT-GROUP",
        lambda_list: "name predicates &body rules",
        doc: "Defines facts and rules (<- (head …) goal…); a group of the same name is replaced.",
        examples: &[
            "(progn (prolog:def-fact-group likings () (prolog:<- (likes robot tea))) (cut:force-ll (prolog:prolog '(likes robot ?what)))) => (((?WHAT . TEA)))",
        ],
        expand: Some(def_fact_group),
    },
    Operator {
        name: "DEF-PROLOG-HANDLER",
        lambda_list: "name lambda-list &body body",
        doc: "Defines a functor by a function of the bindings and the goal's arguments; it returns a list of lists of bindings.",
        examples: &[],
        expand: Some(def_handler),
    },
    Operator {
        name: "<-",
        lambda_list: "head &rest goals",
        doc: "A rule of a fact group: the head holds if all goals do.",
        examples: &[],
        expand: Some(|_, _| {
            Err(Raise::program(
                "<- is a rule of a fact group: write it inside (def-fact-group name () …).",
            ))
        }),
    },
];

fn def_fact_group(image: &mut Image, form: &Value) -> Result<Value> {
    let rest = form.cdr_or_nil();
    let name = rest.car_or_nil();
    let predicates = rest.cdr_or_nil().car_or_nil();
    if name.as_symbol().is_none() || name.is_nil() || !predicates.is_list() {
        return Err(Raise::program(
            "DEF-FACT-GROUP takes a name, a list of exported predicates, and rules: (def-fact-group name (predicate…) (<- (head …) goal…)…).",
        ));
    }
    let rules = rest.cdr_or_nil().cdr_or_nil();
    for rule in rules.iter_list() {
        check_rule(image, &rule).map_err(|raise| match &rule {
            Value::Cons(cons) => raise.at(cons.place()),
            _ => raise,
        })?;
    }
    let package = packages::ensure(image, "CRAM-PROLOG", &["PROLOG"]);
    let function = image.intern(package, "DEFINE-FACT-GROUP");
    let quote = |value: Value| Value::list([known::QUOTE.into(), value]);
    Ok(Value::list([function.into(), quote(name), quote(rules)]))
}

fn def_handler(image: &mut Image, form: &Value) -> Result<Value> {
    let rest = form.cdr_or_nil();
    let name = rest.car_or_nil();
    let package = packages::ensure(image, "CRAM-PROLOG", &["PROLOG"]);
    let function = image.intern(package, "DEFINE-HANDLER");
    let quoted = Value::list([known::QUOTE.into(), name.clone()]);
    let lambda = Value::list_with_tail([known::NAMED_LAMBDA.into(), name], rest.cdr_or_nil());
    Ok(Value::list([function.into(), quoted, lambda]))
}

fn is_arrow(image: &Image, head: &Value) -> bool {
    head.as_symbol().is_some_and(|s| image.name(s) == "<-")
}

fn check_rule(image: &Image, rule: &Value) -> Result<()> {
    // A documentation string may be among the rules.
    if matches!(rule, Value::Str(_)) {
        return Ok(());
    }
    let head = rule.cdr_or_nil().car_or_nil();
    let functor = match &head {
        Value::Cons(cons) => cons.car(),
        other => other.clone(),
    };
    let is_rule = is_arrow(image, &rule.car_or_nil())
        && rule.list_to_vec().is_some()
        && functor.as_symbol().is_some()
        && functor.is_true();
    if is_rule {
        return Ok(());
    }
    Err(Raise::program(format!(
        "{} is not a rule: (<- (head …) goal…) was expected.",
        print::to_string(image, rule, true)
    )))
}

/// What DEF-FACT-GROUP expands into.
#[builtin("DEFINE-FACT-GROUP", "name rules")]
fn define_group(image: &mut Image, name_value: &Value, rules: &Value) -> Result<Value> {
    let Some(name) = name_value.as_symbol() else {
        return Err(Raise::type_error(name_value, known::SYMBOL));
    };
    let mut clauses = Vec::new();
    for rule in rules.iter_list() {
        check_rule(image, &rule)?;
        let parts = rule.cdr_or_nil();
        let head = parts.car_or_nil();
        let functor = match &head {
            Value::Cons(cons) => cons.car(),
            other => other.clone(),
        };
        if let Some(functor) = functor.as_symbol().filter(|_| functor.is_true()) {
            let body = parts.cdr_or_nil();
            clauses.push((functor, Clause { head, body }));
        }
    }
    let facts = of(image);
    facts.groups.borrow_mut().insert(name, clauses);
    facts.index.take();
    Ok(name_value.clone())
}

/// Functions of package `CRAM-PROLOG`: those into which its macros expand, and a question.
pub(crate) static TABLE: &[Builtin] = builtins![functor_defined_p, define_group, define_handler,];

/// What the library makes of them.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![note_given,];
