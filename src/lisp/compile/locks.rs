//! Forms that would give a locked name another meaning: they ask before. Forms that redefine a
//! function of the tutorial's packages, or one that the same text has defined, say so.

use std::collections::HashMap;
use std::rc::Rc;

use super::analyze::{Compiled, Compiler, keep_place};
use super::node::Node;
use super::scope::Scope;
use crate::image::Image;
use crate::image::locks::Meaning;
use crate::source::Place;
use crate::value::Value;
use crate::value::cons::Cons;
use crate::value::form::{form, quoted};
use crate::value::known;
use crate::value::symbol::{FunctionCell, Sym};

/// The names that a form gives a meaning to.
struct Definition {
    names: Vec<Sym>,
    meaning: Meaning,
    /// What the form makes of them.
    what: &'static str,
}

/// What a form defines, if its operator is one of the language that defines something.
fn definition(image: &Image, operator: Sym, form: &Value) -> Option<Definition> {
    use Meaning::{Function, LocalFunction, Setter, Type, Variable};
    let (meaning, what) = match image.name(operator) {
        "DEFUN" => (Function, "a function"),
        "DEFGENERIC" => (Function, "a generic function"),
        "DEFMACRO" | "DEFINE-MODIFY-MACRO" => (Function, "a macro"),
        "DEFSETF" | "DEFINE-SETF-EXPANDER" => (Setter, "a place"),
        "DEFCLASS" => (Type, "a class"),
        "DEFSTRUCT" => (Type, "a structure"),
        "DEFTYPE" => (Type, "a type"),
        "DEFINE-CONDITION" => (Type, "a condition"),
        "DEFVAR" | "DEFPARAMETER" => (Variable, "a variable"),
        "DEFCONSTANT" => (Variable, "a constant"),
        "DEFINE-SYMBOL-MACRO" => (Variable, "a symbol macro"),
        "FLET" | "LABELS" => (LocalFunction, "a local function"),
        "MACROLET" => (LocalFunction, "a local macro"),
        _ => return None,
    };
    let second = form.cdr_or_nil().car_or_nil();
    let (names, meaning): (Vec<Sym>, Meaning) = match meaning {
        LocalFunction => {
            let specs = second.iter_list();
            let names = specs.filter_map(|spec| spec.car_or_nil().as_symbol());
            (names.collect(), meaning)
        }
        Function if second.setf_name().is_some() => {
            (second.setf_name().into_iter().collect(), Setter)
        }
        // The name and options of a structure.
        Type if matches!(second, Value::Cons(_)) => {
            let name = second.car_or_nil().as_symbol();
            (name.into_iter().collect(), meaning)
        }
        _ => (second.as_symbol().into_iter().collect(), meaning),
    };
    Some(Definition {
        names,
        meaning,
        what,
    })
}

/// The form to be evaluated instead of one that defines something, if that has to ask or to tell.
pub(crate) fn guarded_definition(image: &mut Image, form: &Value, place: Place) -> Option<Value> {
    let operator = form.car_or_nil().as_symbol()?;
    let is_of_language = match &image.symbol(operator).function {
        FunctionCell::Builtin => true,
        FunctionCell::Macro(function) => function.as_deferred().is_some(),
        _ => false,
    };
    let is_ignored = image.special(known::V_LOCKS_IGNORED).is_true();
    if !is_of_language || is_ignored || !image.has_locks() {
        return None;
    }
    let definition = definition(image, operator, form)?;
    let names = definition.names.iter().copied();
    let locked: Vec<Sym> = names
        .filter(|name| *name != known::NIL && image.is_locked(*name, definition.meaning))
        .collect();
    let guarded = if locked.is_empty() {
        telling(image, &definition, form, place)?
    } else {
        asking(image, &locked, definition.what, form)
    };
    keep_place(form, &guarded);
    Some(guarded)
}

/// Asks whether to shadow the names or to redefine them: both forms are there, each for one answer.
fn asking(image: &mut Image, locked: &[Sym], what: &'static str, form: &Value) -> Value {
    let mut others = HashMap::new();
    let mut pairs = Vec::new();
    for name in locked {
        let text = image.name(*name).to_owned();
        let other = image.symbols.make_for_program(text.into());
        pairs.push(Value::cons((*name).into(), other.clone()));
        others.insert(*name, other);
    }
    let ask = form![
        known::SYS_ASK_ABOUT_LOCKS,
        quoted(Value::list(pairs)),
        Value::string(what)
    ];
    let instead = replaced(form, &others);
    let nevertheless = form![known::WITHOUT_PACKAGE_LOCKS, form.clone()];
    form![known::IF, ask, instead, nevertheless]
}

/// A definition of a function that tells of itself when it is evaluated.
fn telling(image: &Image, definition: &Definition, form: &Value, place: Place) -> Option<Value> {
    let (Meaning::Function, [name]) = (definition.meaning, definition.names.as_slice()) else {
        return None;
    };
    if !image.sources.is_of_program(place) && !image.is_open(*name) {
        return None;
    }
    let tell = form![
        known::SYS_TELL_OF_DEFINITION,
        quoted(*name),
        Value::Int(i64::from(place.0))
    ];
    let definition = form![known::WITHOUT_PACKAGE_LOCKS, form.clone()];
    Some(form![known::PROGN, tell, definition])
}

/// `(without-package-locks forms…)`: locks hold neither while the forms are compiled nor while they
/// are evaluated.
pub(super) fn without_package_locks(
    c: &mut Compiler<'_>,
    rest: &Value,
    scope: &Scope,
) -> Compiled<Node> {
    let outside = c.image.special(known::V_LOCKS_IGNORED).clone();
    c.image.set_special(known::V_LOCKS_IGNORED, Value::T);
    let form = form![
        known::LET,
        form![form![known::V_LOCKS_IGNORED, Value::T]],
        form![known::LOCALLY; rest.clone()]
    ];
    let node = c.analyze(&form, scope);
    c.image.set_special(known::V_LOCKS_IGNORED, outside);
    node
}

/// A form with other symbols in the places of some; every part keeps its place.
fn replaced(form: &Value, others: &HashMap<Sym, Value>) -> Value {
    let mut made: HashMap<*const Cons, Rc<Cons>> = HashMap::new();
    let mut open = Vec::new();
    let mut copy = |value: &Value, open: &mut Vec<(Rc<Cons>, Rc<Cons>)>| match value {
        Value::Symbol(name, ..) => others.get(name).unwrap_or(value).clone(),
        Value::Cons(cons) => {
            let copied = made.entry(Rc::as_ptr(cons)).or_insert_with(|| {
                let copied = Rc::new(Cons::new(Value::NIL, Value::NIL));
                copied.set_place(cons.place());
                open.push((cons.clone(), copied.clone()));
                copied
            });
            Value::Cons(copied.clone())
        }
        other => other.clone(),
    };
    let root = copy(form, &mut open);
    while let Some((cons, copied)) = open.pop() {
        copied.set_car(copy(&cons.car(), &mut open));
        copied.set_cdr(copy(&cons.cdr(), &mut open));
    }
    root
}
