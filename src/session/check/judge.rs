//! Judges whether a compiler's note is a mistake, once the whole text has been seen, so
//! that the order of definitions does not matter.

use std::collections::{HashMap, HashSet};

use super::arguments;
use super::goals;
use super::known::KnownNames;
use super::meant::{self, Meant};
use super::types;
use crate::package_name::short_name;
use cram::designator::schema;
use cram::designator::value::Class;
use lisp::image::Image;
use lisp::image::notes::{Note, NoteKind};
use lisp::library::definition_of;
use lisp::print;
use lisp::source::Place;
use lisp::value::Value;
use lisp::value::function::{Body, Function};
use lisp::value::known;
use lisp::value::symbol::{FunctionCell, Sym, VariableKind};

/// For how many names it is found out what may be meant: each takes a walk through all symbols, and a text
/// with more unknown names is not misspelt.
const MAX_SUGGESTIONS: usize = 100;

/// A mistake: what is wrong, and the name concerned in upper case, unless the whole form is
/// wrong.
#[derive(Debug, PartialEq)]
pub(super) struct Mistake {
    pub text: String,
    pub name: Option<String>,
    /// Can the program work all the same?
    pub is_style: bool,
}

/// Judges notes about a text.
pub(super) struct Judge<'a> {
    image: &'a Image,
    names: &'a KnownNames,
    /// What may be meant by names of functions and of variables.
    meant: HashMap<(Sym, bool), Option<String>>,
}

impl<'a> Judge<'a> {
    pub(super) fn new(image: &'a Image, names: &'a KnownNames) -> Judge<'a> {
        Judge {
            image,
            names,
            meant: HashMap::new(),
        }
    }

    /// The mistakes that notes are about, with their places.
    pub(super) fn judge_all(&mut self, notes: &[Note]) -> Vec<(Place, Mistake)> {
        let wrong = notes.iter().filter_map(|note| match &note.kind {
            NoteKind::Mistake { name, .. } => Some(name.as_str()),
            _ => None,
        });
        let wrong: HashSet<&str> = wrong.collect();
        let mut all = Vec::new();
        for note in notes {
            // A variable without its question mark is not read either.
            if let NoteKind::Unused(name, _) = &note.kind
                && wrong.contains(self.image.name(*name))
            {
                continue;
            }
            let mistakes = self.judge(note).into_iter();
            all.extend(mistakes.map(|mistake| (note.place, mistake)));
            all.extend(goals::judge(self.image, self.names, note));
        }
        all
    }

    /// The mistakes that a note is about.
    fn judge(&mut self, note: &Note) -> Vec<Mistake> {
        let (image, names) = (self.image, self.names);
        match &note.kind {
            NoteKind::Call(name, form) => {
                let count = form.cdr_or_nil().iter_list().count();
                let of_name = self.function(*name, Some(count), article(image, form));
                let mut mistakes: Vec<Mistake> = of_name.into_iter().collect();
                mistakes.extend(arguments::judge(image, names, *name, form));
                mistakes
            }
            NoteKind::Function(name) => self.function(*name, None, None).into_iter().collect(),
            NoteKind::Variable(name, near) => self.variable(*name, *near).into_iter().collect(),
            NoteKind::Handled(specifier) => types::unknown(image, names, specifier, "type"),
            NoteKind::Definition(form) => definition(image, names, form),
            NoteKind::Mistake { name, text } => {
                let is_known = names.in_rules.contains(name);
                let mistake = (!is_known).then(|| strong(text.clone(), Some(name)));
                mistake.into_iter().collect()
            }
            NoteKind::Assigned(_) | NoteKind::Goal(_) => Vec::new(),
            NoteKind::Unused(name, is_assigned) => {
                let what = match is_assigned {
                    true => "is assigned but never read",
                    false => "is never used",
                };
                vec![weak(
                    format!("The variable {} {what}.", shown(image, *name)),
                    Some(image.name(*name)),
                )]
            }
            NoteKind::Unreachable => vec![weak(
                "This is never reached: the form before it never returns.".to_owned(),
                None,
            )],
            // Macros make exits of their own.
            NoteKind::CaughtReturn(_) if !is_return(image, note.place) => Vec::new(),
            NoteKind::CaughtReturn(operator) => vec![weak(
                format!(
                    "This leaves only {}, and the LOOP around it never ends: write \
                     (block NAME (loop …)) and (return-from NAME …).",
                    image.name(*operator)
                ),
                None,
            )],
        }
    }

    /// What is wrong with the name of a function, and the number of its arguments; `article` is what a
    /// designator would begin with in place of it.
    fn function(
        &mut self,
        name: Sym,
        count: Option<usize>,
        article: Option<&str>,
    ) -> Option<Mistake> {
        let (image, names) = (self.image, self.names);
        match &image.symbol(name).function {
            FunctionCell::Function(function) => {
                let (count, (min, max)) = (count?, arity(image, function)?);
                if count >= min && max.is_none_or(|max| count <= max) {
                    return None;
                }
                let text = format!(
                    "{} takes {}, but is called with {count}.",
                    shown(image, name),
                    taken(min, max)
                );
                Some(strong(text, None))
            }
            FunctionCell::Unbound if !names.is_open && !names.defined.contains(&name) => {
                let is_function =
                    |sym| meant::has_function(image, sym) || names.defined.contains(&sym);
                let text = format!("The function {} is not defined", shown(image, name));
                if image.name(name) == "RETRY" {
                    let text =
                        "(retry) has a meaning only in the handlers of with-failure-handling.";
                    return Some(strong(text.to_owned(), Some("RETRY")));
                }
                let text = match (action(image, name), article) {
                    (Some(action), _) => format!("{text}; {action}"),
                    (None, Some(article)) => format!("{text}; did you mean {article}?"),
                    (None, None) => self.asking(&text, name, true, is_function),
                };
                Some(weak(text, Some(image.name(name))))
            }
            FunctionCell::Unbound | FunctionCell::Macro(_) | FunctionCell::Builtin => None,
        }
    }

    fn variable(&mut self, name: Sym, near: Option<Sym>) -> Option<Mistake> {
        let (image, names) = (self.image, self.names);
        let data = image.symbol(name);
        // Symbols without a home are made by macros.
        let is_known = data.kind != VariableKind::Lexical
            || !data.value.is_unbound()
            || data.symbol_macro.is_some()
            || data.package.is_none()
            || names.is_open
            || names.defined.contains(&name);
        if is_known {
            return None;
        }
        let text = format!("The variable {} is unbound", shown(image, name));
        let text = match near {
            Some(near) => format!("{text}; did you mean {}?", shown(image, near)),
            None if meant::is_value(image, &data.name) => {
                format!("{text}; did you mean the keyword :{}?", data.name)
            }
            None => self.asking(&text, name, false, |sym| {
                let other = image.symbol(sym);
                names.defined.contains(&sym) && matches!(other.function, FunctionCell::Unbound)
                    || other.kind == VariableKind::Special
            }),
        };
        Some(strong(text, Some(&data.name)))
    }

    /// The finding with a suggestion, if there is one.
    fn asking(
        &mut self,
        text: &str,
        name: Sym,
        is_function: bool,
        is_kind: impl Fn(Sym) -> bool,
    ) -> String {
        let image = self.image;
        let is_full = self.meant.len() >= MAX_SUGGESTIONS;
        let meant = self.meant.entry((name, is_function)).or_insert_with(|| {
            // The search goes through all symbols.
            if is_full {
                return None;
            }
            match Meant::by(image, name, is_kind)? {
                Meant::InPackage(package) => {
                    let package = short_name(image, package);
                    Some(format!("{package}:{}", image.name(name)))
                }
                Meant::Similar(near) => Some(near),
            }
        });
        match meant {
            Some(meant) => format!("{text}; did you mean {meant}?"),
            None => format!("{text}."),
        }
    }
}

/// A mistake that keeps the program from working.
pub(super) fn strong(text: String, name: Option<&str>) -> Mistake {
    Mistake {
        text,
        name: name.map(str::to_uppercase),
        is_style: false,
    }
}

/// A mistake in spite of which the program may work.
pub(super) fn weak(text: String, name: Option<&str>) -> Mistake {
    Mistake {
        is_style: true,
        ..strong(text, name)
    }
}

/// Does a person leave something there?
fn is_return(image: &Image, place: Place) -> bool {
    let text = image.sources.text(place).unwrap_or_default();
    let operator = text.trim_start_matches('(').split([' ', ')', '\n']).next();
    let operator = operator.and_then(|name| name.rsplit(':').next());
    operator.is_some_and(|name| {
        name.eq_ignore_ascii_case("return") || name.eq_ignore_ascii_case("return-from")
    })
}

/// What begins a designator, if a form looks like one but for its first name.
fn article(image: &Image, form: &Value) -> Option<&'static str> {
    let class = form.cdr_or_nil().car_or_nil().as_symbol()?;
    let class = Class::named(image.name(class))?;
    let properties = form.cdr_or_nil().cdr_or_nil();
    let is_designator =
        properties.is_true() && properties.iter_list().all(|part| part.as_cons().is_some());
    is_designator.then_some(match class.name().starts_with(['A', 'O']) {
        true => "AN",
        false => "A",
    })
}

/// What to write for a name that is that of an action.
fn action(image: &Image, name: Sym) -> Option<String> {
    let is_action = schema::is_type(image, Class::Action, image.name(name));
    let name = image.name(name).to_lowercase();
    is_action.then(|| format!("{name} is an action: (perform (an action (type {name}) …))."))
}

/// Classes that a definition names and that there are not.
fn definition(image: &Image, names: &KnownNames, form: &Value) -> Vec<Mistake> {
    let operator = form.car_or_nil().as_symbol();
    let rest = form.cdr_or_nil().cdr_or_nil();
    let (classes, what): (Vec<Sym>, &str) = match operator {
        Some(known::DEFCLASS) => (symbols(&rest.car_or_nil()), "class"),
        Some(known::DEFINE_CONDITION) => (symbols(&rest.car_or_nil()), "condition"),
        Some(known::DEFMETHOD) => {
            let list = rest.iter_list().find(|part| part.is_list());
            let parameters = list.unwrap_or(Value::NIL);
            let of = |parameter: Value| parameter.cdr_or_nil().car_or_nil().as_symbol();
            let classes = parameters
                .iter_list()
                .take_while(|parameter| {
                    let sym = parameter.as_symbol();
                    sym.is_none_or(|sym| !image.name(sym).starts_with('&'))
                })
                .filter_map(of);
            (classes.filter(|sym| *sym != known::NIL).collect(), "class")
        }
        _ => return Vec::new(),
    };
    let unknown = classes
        .into_iter()
        .filter_map(|class| types::unknown_class(image, names, class, what));
    unknown.collect()
}

fn symbols(list: &Value) -> Vec<Sym> {
    list.iter_list()
        .filter_map(|item| item.as_symbol())
        .collect()
}

/// Minimum and maximum number of arguments; `None` if not fixed.
pub(super) fn arity(image: &Image, function: &Function) -> Option<(usize, Option<usize>)> {
    match &function.body {
        Body::Deferred(_) => {
            let lambda_list = &definition_of(image, function)?.signature().lambda_list;
            let (min, max) = lisp::builtin::arity(lambda_list);
            Some((min.into(), max.map(usize::from)))
        }
        Body::Native(native) => Some((native.min.into(), native.max.map(usize::from))),
        Body::Closure { code, .. } => {
            let p = &code.parameters;
            let min = usize::from(p.required);
            let takes_more = p.rest || p.has_keys;
            let max = (!takes_more).then_some(min + usize::from(p.optional));
            Some((min, max))
        }
        Body::Generic(_) => None,
    }
}

fn taken(min: usize, max: Option<usize>) -> String {
    let arguments = |n: usize| match n {
        0 => "no arguments".to_owned(),
        1 => "1 argument".to_owned(),
        n => format!("{n} arguments"),
    };
    match max {
        Some(max) if max == min => arguments(min),
        Some(max) if min == 0 => format!("at most {}", arguments(max)),
        Some(max) => format!("{min} to {}", arguments(max)),
        None => format!("at least {}", arguments(min)),
    }
}

fn shown(image: &Image, sym: Sym) -> String {
    print::to_string(image, &sym.into(), true)
}
