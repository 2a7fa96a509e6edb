//! Judges the arguments of calls of functions as written: keywords, names of things in the world, types,
//! and what control strings of FORMAT need. What a program computes is not judged.

use super::judge::{Mistake, strong};
use super::known::KnownNames;
use super::signature::Signature;
use super::types;
use cram::designator::vocabulary::Domain;
use lisp::image::Image;
use lisp::print;
use lisp::print::format::Control;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::package::PackageTable;
use lisp::value::raise::{keys_hint, sentence};
use lisp::value::symbol::Sym;

/// The mistakes in the arguments of a call.
pub(super) fn judge(
    image: &Image,
    names: &KnownNames,
    function: Sym,
    call: &Value,
) -> Vec<Mistake> {
    let Some(args) = call.cdr_or_nil().list_to_vec() else {
        return Vec::new();
    };
    let mut mistakes = Vec::new();
    mistakes.extend(format_arguments(image, function, &args));
    if image.is_built_in_function(function) {
        mistakes.extend(of_types(image, names, function, &args));
    }
    let Some(signature) = Signature::of(image, function) else {
        return mistakes;
    };
    mistakes.extend(keys(image, function, &signature, &args));
    if is_of_robot(image, function) {
        mistakes.extend(things(image, names, function, &signature, &args));
    }
    mistakes
}

/// The value that a form is written as, if it is.
fn literal(image: &Image, form: &Value) -> Option<Value> {
    match form {
        Value::Symbol(sym, ..) => image.is_keyword(*sym).then(|| form.clone()),
        Value::Cons(cons) if cons.car().as_symbol() == Some(known::QUOTE) => {
            Some(cons.cdr().car_or_nil())
        }
        Value::Cons(_) => None,
        other => Some(other.clone()),
    }
}

fn shown(image: &Image, value: &Value) -> String {
    print::to_string(image, value, true)
}

/// Keywords that a function does not take.
fn keys(image: &Image, function: Sym, signature: &Signature, args: &[Value]) -> Option<Mistake> {
    let known = signature.keys.as_ref()?;
    let args = signature.key_arguments(args);
    let mut first = None;
    for pair in args.chunks(2) {
        let sym = literal(image, &pair[0])?.as_symbol()?;
        let name = image.name(sym).to_owned();
        if !image.is_keyword(sym) || name == "ALLOW-OTHER-KEYS" {
            return None;
        }
        let of = shown(image, &function.into());
        if !signature.takes_others && !known.contains(&name) && first.is_none() {
            let hint = keys_hint(&name, known.iter().map(String::as_str));
            let text = sentence(format!("{of} has no key :{name}{hint}"));
            first = Some(strong(text, Some(&name)));
        }
        if pair.len() == 1 && first.is_none() {
            first = Some(strong(
                format!("The key :{name} of {of} has no value."),
                Some(&name),
            ));
        }
    }
    first
}

/// Is it a function of the robot or the plans, not one of the language?
fn is_of_robot(image: &Image, function: Sym) -> bool {
    let package = image.symbol(function).package;
    package.is_some_and(|package| package != PackageTable::CL && package != PackageTable::SYSTEM)
        && image.is_built_in_function(function)
}

/// What a parameter of that name takes names of.
fn domain(parameter: &str) -> Option<Domain> {
    Some(match parameter {
        "ARM" | "ARMS" => Domain::Arm,
        "FRAME" | "FRAME-ID" | "PARENT" | "CHILD" => Domain::Frame,
        "GRASP" | "GRASPS" => Domain::Grasp,
        "TYPE" | "TYPES" | "OBJECT-TYPE" => Domain::ObjectType,
        "JOINT-NAME" => Domain::KitchenJoint,
        _ => return None,
    })
}

/// Names of things that there are not.
fn things(
    image: &Image,
    names: &KnownNames,
    function: Sym,
    signature: &Signature,
    args: &[Value],
) -> Vec<Mistake> {
    let is_definition = image.name(function).starts_with("DEF");
    let by_key = signature.key_arguments(args).chunks_exact(2);
    let by_key = by_key.filter_map(|pair| Some((image.name(pair[0].as_symbol()?), &pair[1])));
    let arguments = signature.arguments(args).into_iter().chain(by_key);
    let mut mistakes = Vec::new();
    for (parameter, form) in arguments {
        let Some(domain) = domain(parameter) else {
            continue;
        };
        if is_definition && domain == Domain::Grasp {
            continue;
        }
        let Some(value) = literal(image, form) else {
            continue;
        };
        for item in value.list_to_vec().unwrap_or_else(|| vec![value.clone()]) {
            let is_text = matches!(domain, Domain::Frame | Domain::KitchenJoint);
            let name = match &item {
                Value::Symbol(sym, ..) if image.is_keyword(*sym) && !is_text => {
                    image.name(*sym).to_owned()
                }
                Value::Str(text) if is_text => text.text(),
                _ => continue,
            };
            if names.in_rules.contains(&name.to_uppercase()) {
                continue;
            }
            if let Some(text) = domain.mistake(image, &name) {
                mistakes.push(strong(text, Some(&name)));
            }
        }
    }
    mistakes
}

/// The arguments of the functions of the language that are types, by their indices.
fn type_arguments(name: &str) -> &'static [usize] {
    match name {
        "TYPEP" | "COERCE" => &[1],
        "SUBTYPEP" => &[0, 1],
        "CONCATENATE" | "MAP" | "MAKE-SEQUENCE" => &[0],
        _ => &[],
    }
}

/// Types, classes and conditions that there are not.
fn of_types(image: &Image, names: &KnownNames, function: Sym, args: &[Value]) -> Vec<Mistake> {
    let quoted = |at: usize| {
        let form = args.get(at)?;
        let is_quoted = form.car_or_nil().as_symbol() == Some(known::QUOTE);
        is_quoted.then(|| form.cdr_or_nil().car_or_nil())
    };
    let name = image.name(function);
    let class = match name {
        "MAKE-INSTANCE" => Some((0, "class")),
        "FIND-CLASS" if args.len() == 1 => Some((0, "class")),
        "MAKE-CONDITION" | "ERROR" | "SIGNAL" | "WARN" | "FAIL" => Some((0, "condition")),
        "CERROR" => Some((1, "condition")),
        _ => None,
    };
    if let Some((at, what)) = class {
        let name = quoted(at).and_then(|class| class.as_symbol());
        let name = name.filter(|name| *name != known::NIL);
        return name
            .and_then(|name| types::unknown_class(image, names, name, what))
            .into_iter()
            .collect();
    }
    let types = type_arguments(name).iter().filter_map(|at| quoted(*at));
    types
        .flat_map(|specifier| types::unknown(image, names, &specifier, "type"))
        .collect()
}

/// Too few or too many arguments of a control string.
fn format_arguments(image: &Image, function: Sym, args: &[Value]) -> Option<Mistake> {
    if image.symbol(function).package != Some(PackageTable::CL) {
        return None;
    }
    let at = match image.name(function) {
        "FORMAT" => 1,
        "ERROR" | "WARN" | "SIGNAL" | "BREAK" => 0,
        _ => return None,
    };
    let Value::Str(control) = args.get(at)? else {
        return None;
    };
    let given = args.len() - at - 1;
    let wrong = |text: String, is_style| {
        Some(Mistake {
            text,
            name: None,
            is_style,
        })
    };
    let control = match Control::parse(&control.text()) {
        Ok(control) => control,
        Err(error) => return wrong(error.to_string(), false),
    };
    let (min, max) = control.arguments()?;
    let counted = |count: usize| match count {
        1 => "1 argument".to_owned(),
        count => format!("{count} arguments"),
    };
    if given < min {
        let text = format!(
            "The control string needs {}, but there {}.",
            counted(min),
            match given {
                0 => "is none".to_owned(),
                1 => "is 1".to_owned(),
                given => format!("are {given}"),
            }
        );
        return wrong(text, false);
    }
    let max = max.filter(|max| given > *max)?;
    let uses = match max {
        0 => "no argument".to_owned(),
        max => format!("at most {}", counted(max)),
    };
    let text = format!(
        "The control string uses {uses}, but there {} {given}.",
        if given == 1 { "is" } else { "are" }
    );
    wrong(text, true)
}
