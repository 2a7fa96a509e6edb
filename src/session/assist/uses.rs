//! Who uses a function, a variable, a macro, a class or a type of actions: from the code of all
//! functions of programs, and, for what compiling leaves no trace of, from their texts.

use std::rc::Rc;

use super::assistant::Assistant;
use super::definitions::occurrences;
use super::names::ToldNames;
use crate::dialogue::{Relation, Unrecorded, Use};
use lisp::compile;
use lisp::image::Image;
use lisp::print;
use lisp::source::Place;
use lisp::value::code::Code;
use lisp::value::function::{Body, Function};
use lisp::value::generic::Specializer;
use lisp::value::operation::Op;
use lisp::value::symbol::{FunctionCell, Sym};

/// A function with code, or a method.
struct Coded {
    label: String,
    code: Rc<Code>,
    /// The names of the classes that a method is for.
    classes: Vec<Sym>,
}

impl Assistant<'_> {
    /// The places where a name is used, in the order of packages and names.
    pub(crate) fn all_uses(
        &self,
        told: &mut ToldNames,
        relation: Relation,
        package: &str,
        name: &str,
    ) -> Result<Vec<Use>, Unrecorded> {
        let Some(wanted) = self.symbol_in(package, name) else {
            return Ok(Vec::new());
        };
        let image = self.image;
        if relation == Relation::Calls && compile::is_inlined(wanted) {
            return Err(Unrecorded);
        }
        let mut found: Vec<Use> = Vec::new();
        for coded in all_code(image) {
            let label = coded.label.as_str();
            if relation == Relation::Specializes && coded.classes.contains(&wanted) {
                found.push(use_at(image, label, first_place(image, &coded.code)));
            }
            let is_asked = relation == Relation::Callees && names(&coded, image, wanted);
            walk(image, &coded.code, &mut |op, place| match called(op) {
                Some(callee) if is_asked => {
                    let label = print::to_string(image, &callee.into(), true);
                    found.push(use_at(image, &label, place));
                }
                _ if is_such(relation, op, wanted) => found.push(use_at(image, label, place)),
                _ => {}
            });
        }
        let upper = image.name(wanted).to_owned();
        match relation {
            Relation::Expands => found.extend(uses_in_texts(image, told, &[&upper])),
            Relation::Calls if self.is_type_name(&upper) => {
                found.extend(uses_in_texts(image, told, &["TYPE", &upper]));
            }
            _ => {}
        }
        found.dedup();
        Ok(found)
    }

    /// The symbol that a name means in a package, if there is one.
    fn symbol_in(&self, package: &str, name: &str) -> Option<Sym> {
        let packages = &self.image.packages;
        let name = name.trim_start_matches('\'').to_uppercase();
        let (package, name) = match name.rsplit_once(':') {
            Some((package, name)) => (package.trim_end_matches(':'), name),
            None => (package, name.as_str()),
        };
        let found = packages.find(package);
        let id = found.or_else(|| packages.find(&package.to_uppercase()))?;
        packages.find_symbol(id, name).map(|(sym, _)| sym)
    }
}

/// Where lists in definitions begin with these names.
fn uses_in_texts(image: &Image, told: &mut ToldNames, beginning: &[&str]) -> Vec<Use> {
    let definitions = told.definitions(image);
    let all = definitions.values().flatten();
    let uses = all.flat_map(|definition| {
        occurrences(definition, beginning)
            .into_iter()
            .map(|place| Use {
                label: definition.label.clone(),
                place: Some(place),
            })
    });
    uses.collect()
}

fn use_at(image: &Image, label: &str, place: Place) -> Use {
    Use {
        label: label.to_owned(),
        place: image.sources.locate(place),
    }
}

/// All functions with code and all methods, in the order of packages and names.
fn all_code(image: &Image) -> Vec<Coded> {
    let mut found = Vec::new();
    for id in image.packages.ids() {
        for (sym, _) in image.packages.get(id).symbols.values() {
            let data = image.symbol(*sym);
            if data.package != Some(id) {
                continue;
            }
            let name = print::to_string(image, &(*sym).into(), true);
            if let FunctionCell::Function(function) | FunctionCell::Macro(function) = &data.function
            {
                add_code(image, &name, function, &mut found);
            }
            if let Some(setter) = &data.setf_function {
                add_code(image, &format!("(SETF {name})"), setter, &mut found);
            }
        }
    }
    found
}

fn add_code(image: &Image, label: &str, function: &Function, found: &mut Vec<Coded>) {
    match &function.body {
        Body::Closure { code, .. } => found.push(Coded {
            label: label.to_owned(),
            code: Rc::clone(code),
            classes: Vec::new(),
        }),
        Body::Generic(generic) => {
            for method in generic.methods.borrow().iter() {
                let Body::Closure { code, .. } = &method.function.body else {
                    continue;
                };
                let shown = method.specializers.iter().map(|specializer| {
                    let value = match specializer {
                        Specializer::Class(class) => class.name.into(),
                        Specializer::Eql(value) => value.clone(),
                    };
                    print::to_string(image, &value, true)
                });
                let shown: Vec<String> = shown.collect();
                let classes = method.specializers.iter().filter_map(|s| match s {
                    Specializer::Class(class) => Some(class.name),
                    Specializer::Eql(_) => None,
                });
                found.push(Coded {
                    label: format!("(METHOD {label} ({}))", shown.join(" ")),
                    code: Rc::clone(code),
                    classes: classes.collect(),
                });
            }
        }
        Body::Deferred(_) | Body::Native(_) => {}
    }
}

/// Whether it is the function of that name, or a method of it.
fn names(coded: &Coded, image: &Image, wanted: Sym) -> bool {
    let name = print::to_string(image, &wanted.into(), true);
    coded.label == name || coded.label.starts_with(&format!("(METHOD {name} "))
}

/// Goes through the operations of a function and of those inside of it, with their places; what
/// comes before the first call has the place of that.
fn walk(image: &Image, code: &Code, each: &mut dyn FnMut(Op, Place)) {
    let Some(content) = image.content_to_look_at(code) else {
        return;
    };
    for (pc, op) in content.ops.iter().enumerate() {
        let place = content.place_at(pc);
        each(
            *op,
            if place.is_some() {
                place
            } else {
                first_place(image, code)
            },
        );
    }
    for (inner, _) in &content.inner {
        walk(image, inner, each);
    }
}

/// The function that an operation calls or refers to by name.
fn called(op: Op) -> Option<Sym> {
    match op {
        Op::Call(sym, _) | Op::CallMulti(sym, _) | Op::CallSelf(sym, _) | Op::Function(sym) => {
            Some(sym)
        }
        _ => None,
    }
}

fn is_such(relation: Relation, op: Op, wanted: Sym) -> bool {
    match (relation, op) {
        (Relation::Calls, op) => called(op) == Some(wanted),
        (Relation::References, Op::Global(sym))
        | (Relation::Sets, Op::SetGlobal(sym))
        | (Relation::Binds, Op::BindSpecial(sym)) => sym == wanted,
        _ => false,
    }
}

/// The first place in a function that is known.
fn first_place(image: &Image, code: &Code) -> Place {
    let content = image.content_to_look_at(code);
    let first = content.and_then(|content| content.places.first());
    let first = first.map(|(_, place)| *place);
    first.unwrap_or(Place::NONE)
}
