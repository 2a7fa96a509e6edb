//! Help at the prompt: `describe`, `apropos`, `apropos-list`.
//!
//! What is said about builtins and operators comes from their tables, what is said about the user's
//! definitions from their code. Of the user's code, only methods of `describe-object` run.

use std::rc::Rc;

use super::packages;
use super::strings::designated;
use crate::builtin::{Builtin, Entry};
use crate::image::Image;
use crate::image::extension::Extension;
use crate::library::definition_of;
use crate::object::method::extended_function;
use crate::print;
use crate::stream;
use crate::typed::{self, builtin, builtins};
use crate::types::type_of::type_of;
use crate::value::Value;
use crate::value::class::{Class, ClassKind, Instance};
use crate::value::copy::Copier;
use crate::value::function::{Body, Function};
use crate::value::known;
use crate::value::package::{Access, PackageTable};
use crate::value::raise::Raise;
use crate::value::symbol::{FunctionCell, Sym, VariableKind};

use crate::vm::calls::{Args, run};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

type Outcome = Result<Value, Box<Raise>>;

/// Tells what a name means to the layers above the language, which keep it in the image. It holds
/// nothing of an image.
pub struct Topics(pub Box<MeaningsOf>);

impl Extension for Topics {
    fn copied(self: Rc<Self>, _: &mut Copier) -> Rc<dyn Extension> {
        self
    }
}

/// What a name means.
type MeaningsOf = dyn Fn(&Image, Sym) -> Vec<Topic>;

/// A meaning of a name.
pub struct Topic {
    /// What it is, such as `action`.
    pub kind: &'static str,
    /// What is known about it, in lines.
    pub text: String,
}

/// Has a keyword of this name a meaning of a kind to the layers above?
pub fn is_topic(image: &Image, name: &str, kind: &str) -> bool {
    let keyword = image.packages.find_symbol(PackageTable::KEYWORD, name);
    keyword.is_some_and(|(sym, _)| topics(image, sym).iter().any(|topic| topic.kind == kind))
}

/// What a symbol means to the layers above.
fn topics(image: &Image, sym: Sym) -> Vec<Topic> {
    let known = image.extension::<Topics>();
    known.map_or_else(Vec::new, |topics| (topics.0)(image, sym))
}

/// What a symbol means to the layers above, in lines.
pub fn topics_of(image: &Image, sym: Sym) -> String {
    let topics = topics(image, sym).into_iter();
    topics.map(|topic| topic.text).collect()
}

/// Writes what is known about an object: of a symbol what it means as a function, a variable and a
/// class, with examples.
///
/// ```lisp
/// (with-output-to-string (s) (describe :other s)) => ":OTHER: a keyword
/// "
/// ```
///
/// `(null (search "(first list)" (with-output-to-string (s) (describe 'first s))))` => `NIL`
// Calls the methods that a program has added to `describe-object`, if there are any.
#[builtin]
fn describe(
    machine: &mut Machine<'_>,
    object: Value,
    #[default(&Value::NIL)] stream: &Value,
) -> Result<Step, Box<Raise>> {
    let Some(function) = extended_function(machine.image, known::DESCRIBE_OBJECT) else {
        return describe_object(machine.image, &object, stream).map(Step::from);
    };
    let stream = match stream {
        Value::Symbol(known::NIL, ..) => machine.image.special(known::V_STANDARD_OUTPUT),
        Value::Symbol(known::T, ..) => machine.image.special(known::V_TERMINAL_IO),
        stream => stream,
    };
    let stream = stream.clone();
    run(machine, "DESCRIBE", |calls| async move {
        calls.call(&function, Args::Two([object, stream])).await;
        Ok(Value::values(Vec::new()))
    })
}

/// Writes what DESCRIBE tells of an object to a stream. Add methods to describe instances of
/// classes otherwise.
///
/// `(progn (defclass mug () ()) (defmethod describe-object ((m mug) s) (princ "a mug" s)) (with-output-to-string (s) (describe (make-instance 'mug) s)))` => `"a mug"`
#[builtin]
fn describe_object(image: &mut Image, object: &Value, stream: &Value) -> Outcome {
    let text = match object {
        Value::Symbol(sym, ..) => of_symbol(image, *sym) + &topics_of(image, *sym),
        other => of_value(image, other),
    };
    stream::fresh_line(image, stream)?;
    stream::write(image, stream, &text)?;
    Ok(Value::values(Vec::new()))
}

/// A value in readable form.
fn shown(image: &Image, value: &Value) -> String {
    print::to_string(image, value, true)
}

pub fn of_symbol(image: &Image, sym: Sym) -> String {
    let data = image.symbol(sym);
    let value = Value::symbol(sym);
    if image.is_keyword(sym) {
        return format!("{}: a keyword\n", shown(image, &value));
    }
    let home = match data.package {
        None => "in no package".to_owned(),
        Some(id) => {
            let name = &image.packages.get(id).name;
            match image.home_access(sym) {
                Some(Access::External) => format!("exported from {name}"),
                _ => format!("in {name}"),
            }
        }
    };
    let mut text = format!("{}: a symbol {home}\n", shown(image, &value));
    text.push_str(&as_function(image, sym));
    text.push_str(&as_variable(image, sym));
    if let Some(class) = image.class(sym) {
        text.push_str(&format!("\nNames a {}:\n", kind_of_class(class)));
        text.push_str(&of_class(image, class));
    }
    text
}

/// What is known about a symbol's function or operator.
pub struct Signature {
    /// What it is.
    pub kind: &'static str,
    /// The lambda list, without its parentheses, in lower case.
    pub lambda_list: String,
    /// The documentation.
    pub doc: Option<String>,
    /// Examples of calls.
    pub examples: Vec<&'static str>,
    /// File and line of a definition of the language in Lisp.
    pub location: Option<String>,
}

impl Signature {
    /// The shape of a call.
    pub fn call(&self, image: &Image, sym: Sym) -> String {
        call(image, sym, &self.lambda_list)
    }
}

/// What is known about a symbol's function or operator; none if it has none.
pub fn signature(image: &Image, sym: Sym) -> Option<Signature> {
    if let Some(entry) = image.entry(sym) {
        return Some(Signature {
            kind: entry.kind(),
            lambda_list: entry.lambda_list().to_owned(),
            doc: Some(entry.doc().to_owned()),
            examples: entry.examples(),
            location: entry.location(),
        });
    }
    let (kind, function) = match &image.symbol(sym).function {
        FunctionCell::Unbound | FunctionCell::Builtin => return None,
        FunctionCell::Macro(function) => ("macro", function),
        FunctionCell::Function(function) if function.as_generic().is_some() => {
            ("generic function", function)
        }
        FunctionCell::Function(function) => ("function", function),
    };
    let (lambda_list, doc) = of_definition(image, function);
    Some(Signature {
        kind,
        lambda_list,
        doc,
        examples: Vec::new(),
        location: None,
    })
}

fn as_function(image: &Image, sym: Sym) -> String {
    let Some(signature) = signature(image, sym) else {
        return String::new();
    };
    let (kind, call) = (signature.kind, signature.call(image, sym));
    let mut text = format!("\nNames a {kind}:\n  {call}\n");
    add_indented(&mut text, signature.doc.as_deref());
    if !signature.examples.is_empty() {
        text.push_str("Examples:\n");
        let examples = signature.examples.iter();
        examples.for_each(|example| add_indented(&mut text, Some(example)));
    }
    if let Some(location) = &signature.location {
        text.push_str(&format!("Defined at {location}.\n"));
    }
    text
}

/// The shape of a call.
fn call(image: &Image, sym: Sym, lambda_list: &str) -> String {
    let name = image.name(sym).to_lowercase();
    if lambda_list.is_empty() {
        format!("({name})")
    } else {
        format!("({name} {lambda_list})")
    }
}

/// How deeply nested a lambda list is shown, and how many parts of a list.
const MAX_NESTED: usize = 20;
const MAX_PARTS: usize = 200;

/// A lambda list as its author wrote it: symbols without their packages. `None` if it is nested more
/// deeply than that.
fn bare(image: &Image, value: &Value, depth: usize) -> Option<String> {
    let depth = depth.checked_sub(1)?;
    let Value::Cons(_) = value else {
        return Some(match value.as_symbol() {
            Some(sym) if image.is_keyword(sym) => format!(":{}", image.name(sym).to_lowercase()),
            Some(sym) => image.name(sym).to_lowercase(),
            None => print::to_string(image, value, true),
        });
    };
    let mut parts = Vec::new();
    let mut rest = value.clone();
    while let Value::Cons(pair) = &rest {
        if parts.len() >= MAX_PARTS {
            return None;
        }
        parts.push(bare(image, &pair.car(), depth)?);
        let next = pair.cdr();
        rest = next;
    }
    if !rest.is_nil() {
        parts.push(format!(". {}", bare(image, &rest, depth)?));
    }
    Some(format!("({})", parts.join(" ")))
}

/// Lambda list, without parentheses, and documentation of a function.
fn of_definition(image: &Image, function: &Function) -> (String, Option<String>) {
    match &function.body {
        Body::Closure { code, .. } => {
            let Some(content) = image.content_to_look_at(code) else {
                return Default::default();
            };
            let parameters = content.lambda_list.shown();
            let list = bare(image, parameters, MAX_NESTED).unwrap_or_default();
            let inner = list
                .strip_prefix('(')
                .and_then(|rest| rest.strip_suffix(')'))
                .unwrap_or_default();
            (inner.to_owned(), content.doc.as_deref().map(str::to_owned))
        }
        Body::Generic(generic) => {
            let parameters = generic.parameters.borrow();
            let mut names = vec!["argument".to_owned(); parameters.required];
            if parameters.optional > 0 {
                names.push("&optional".to_owned());
                names.extend(vec!["argument".to_owned(); parameters.optional]);
            }
            if parameters.has_rest {
                names.extend(["&rest".to_owned(), "arguments".to_owned()]);
            }
            if let Some(keys) = &parameters.keys {
                names.push("&key".to_owned());
                names.extend(keys.iter().map(|key| image.name(*key).to_lowercase()));
            }
            let doc = generic.doc.borrow().as_deref().map(str::to_owned);
            (names.join(" "), doc)
        }
        Body::Deferred(_) => match definition_of(image, function) {
            Some(definition) => {
                let signature = definition.signature();
                let doc = signature.doc.clone();
                (signature.lambda_list.clone(), Some(doc))
            }
            None => (String::new(), None),
        },
        Body::Native(native) => {
            if let Some(Entry::Builtin(builtin)) = image.entries.get(&native.name) {
                return (builtin.lambda_list.to_owned(), Some(builtin.doc.to_owned()));
            }
            let mut names = vec!["argument".to_owned(); usize::from(native.min)];
            match native.max {
                None => names.extend(["&rest".to_owned(), "arguments".to_owned()]),
                Some(max) if max > native.min => {
                    names.push("&optional".to_owned());
                    let optional = usize::from(max - native.min);
                    names.extend(vec!["argument".to_owned(); optional]);
                }
                Some(_) => {}
            }
            (names.join(" "), None)
        }
    }
}

fn as_variable(image: &Image, sym: Sym) -> String {
    let data = image.symbol(sym);
    let kind = match data.kind {
        VariableKind::Constant => "constant",
        VariableKind::Special => "special variable",
        VariableKind::Lexical if data.value.is_unbound() => return String::new(),
        VariableKind::Lexical => "variable",
    };
    let mut text = if data.value.is_unbound() {
        format!("\nNames a {kind} without a value.\n")
    } else {
        format!(
            "\nNames a {kind} with the value:\n  {}\n",
            shown(image, &data.value)
        )
    };
    add_indented(&mut text, data.variable_doc.as_deref());
    text
}

/// Adds the lines of a text, indented.
fn add_indented(to: &mut String, text: Option<&str>) {
    for line in text.unwrap_or_default().lines() {
        to.push_str("  ");
        to.push_str(line);
        to.push('\n');
    }
}

fn kind_of_class(class: &Class) -> &'static str {
    match class.kind {
        ClassKind::Builtin => "type",
        ClassKind::Standard => "class",
        ClassKind::Structure => "structure",
        ClassKind::Condition => "condition class",
    }
}

fn of_class(image: &Image, class: &Class) -> String {
    let mut text = String::new();
    add_indented(&mut text, class.doc.borrow().as_deref());
    let names = |classes: &[Rc<Class>]| {
        let names: Vec<String> = classes
            .iter()
            .map(|class| shown(image, &class.name.into()))
            .collect();
        names.join(", ")
    };
    let above = names(&class.direct_superclasses.borrow());
    if !above.is_empty() {
        text.push_str(&format!("  Superclasses: {above}\n"));
    }
    let below = names(&class.direct_subclasses.borrow());
    if !below.is_empty() {
        text.push_str(&format!("  Subclasses: {below}\n"));
    }
    let slots = class.slots.borrow();
    if !slots.is_empty() {
        text.push_str("  Slots:\n");
    }
    for slot in slots.iter() {
        let initargs: Vec<String> = slot
            .initargs
            .iter()
            .map(|sym| shown(image, &(*sym).into()))
            .collect();
        let name = shown(image, &slot.name.into());
        let line = format!("    {name} {}", initargs.join(" "));
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

fn of_value(image: &Image, value: &Value) -> String {
    let mut text = format!(
        "{}: of type {}\n",
        shown(image, value),
        shown(image, &type_of(image, value))
    );
    match value {
        Value::Instance(instance) => text.push_str(&slot_values(image, instance)),
        Value::Class(class) => text.push_str(&of_class(image, class)),
        Value::Function(function) => {
            let (lambda_list, doc) = of_definition(image, function);
            text.push_str(&format!("  Arguments: ({lambda_list})\n"));
            add_indented(&mut text, doc.as_deref());
        }
        Value::Package(id) => {
            let package = image.packages.get(*id);
            add_indented(&mut text, package.doc.as_deref());
            if !package.nicknames.is_empty() {
                let nicknames = package.nicknames.join(", ");
                text.push_str(&format!("  Nicknames: {nicknames}\n"));
            }
            let exported = package.symbols.values().filter(|(_, external)| *external);
            text.push_str(&format!("  Exported symbols: {}\n", exported.count()));
        }
        Value::Foreign(object) => {
            add_indented(&mut text, Some(&object.object().describe(image)));
        }
        _ => {}
    }
    text
}

fn slot_values(image: &Image, instance: &Instance) -> String {
    let mut text = String::new();
    let names: Vec<Sym> = instance
        .class()
        .slots
        .borrow()
        .iter()
        .map(|slot| slot.name)
        .collect();
    for name in names {
        let value = match instance.slot(name) {
            Some(value) if !value.is_unbound() => shown(image, &value),
            _ => "no value".to_owned(),
        };
        text.push_str(&format!("  {}: {value}\n", shown(image, &name.into())));
    }
    text
}

/// The symbols whose names contain the text, whatever the case: by name, then by package.
fn found(image: &Image, text: &Value, package: Option<&Value>) -> Result<Vec<Sym>, Box<Raise>> {
    let text = designated(image, text)?.to_uppercase();
    let mut symbols: Vec<Sym> = match package {
        Some(package) if package.is_true() => {
            packages::accessible(image, packages::designated(image, package)?)
        }
        _ => image
            .packages
            .ids()
            .filter(|id| *id != PackageTable::SYSTEM && !image.packages.is_deleted(*id))
            .flat_map(|id| {
                image
                    .packages
                    .get(id)
                    .symbols
                    .values()
                    .map(|(sym, _)| *sym)
                    .collect::<Vec<_>>()
            })
            .collect(),
    };
    symbols.retain(|sym| image.name(*sym).to_uppercase().contains(&text));
    symbols.sort_by(|a, b| {
        let key = |sym: &Sym| (image.name(*sym), image.symbol(*sym).package, *sym);
        key(a).cmp(&key(b))
    });
    symbols.dedup();
    Ok(symbols)
}

/// The symbols whose names contain the text; those of all packages, or those accessible in one.
///
/// `(apropos-list "cdaa" :cl)` => `(CDAAAR CDAADR CDAAR)`
#[builtin]
fn apropos_list(
    image: &mut Image,
    text: &Value,
    package: Option<&Value>,
) -> Result<Vec<Sym>, Box<Raise>> {
    found(image, text, package)
}

/// Writes the symbols whose names contain the text, and what they mean: actions, motions and types of
/// objects first. Those accessible in a package if one is named. Without, what the built-in
/// packages keep to themselves and names without a meaning are left out; `:all` shows these, too.
///
/// ```lisp
/// (with-output-to-string (*standard-output*) (apropos "rotatef")) => "ROTATEF (macro)
/// "
/// ```
#[builtin]
fn apropos(image: &mut Image, text: &Value, package: Option<&Value>) -> Outcome {
    let is_all = |package: &Value| match package {
        Value::Symbol(sym, ..) => image.is_keyword(*sym) && image.name(*sym) == "ALL",
        _ => false,
    };
    let (symbols, shows_all) = match package {
        Some(package) if is_all(package) => (found(image, text, None)?, true),
        Some(package) if package.is_true() => (found(image, text, Some(package))?, true),
        _ => (found(image, text, None)?, !image.has_locks()),
    };
    let mut lines: Vec<(bool, String)> = Vec::new();
    let mut left_out = 0;
    for sym in symbols {
        let told = topics(image, sym);
        let own = own_meanings(image, sym);
        // Actions and the like are those of a name in any package: the keyword stands for all.
        let is_told_elsewhere = told.is_empty() || !image.is_keyword(sym);
        let hides = own.is_empty() && is_told_elsewhere || is_internal(image, sym);
        if hides && !shows_all {
            left_out += 1;
            continue;
        }
        let kinds = told.iter().map(|topic| topic.kind);
        let meanings: Vec<&str> = own.into_iter().chain(kinds).collect();
        let mut line = shown(image, &sym.into());
        if !meanings.is_empty() {
            line.push_str(&format!(" ({})", meanings.join(", ")));
        }
        lines.push((told.is_empty(), line));
    }
    if !shows_all {
        lines.sort_by_key(|(is_other, _)| *is_other);
    }
    let mut listing = String::new();
    for (_, line) in lines {
        listing.push_str(&line);
        listing.push('\n');
    }
    if left_out > 0 {
        let wanted = print::to_string(image, text, true);
        listing.push_str(&format!(
            "; {left_out} more that are internal or mean nothing: (apropos {wanted} :all)\n"
        ));
    }
    stream::fresh_line(image, &Value::NIL)?;
    stream::write(image, &Value::NIL, &listing)?;
    Ok(Value::values(Vec::new()))
}

/// Does a built-in package keep a symbol to itself?
fn is_internal(image: &Image, sym: Sym) -> bool {
    let Some(package) = image.symbol(sym).package else {
        return false;
    };
    image.is_built_in(package)
        && image.home_access(sym) != Some(Access::External)
        && !image.is_accessible(sym)
}

/// What a symbol means in the language, a word or two for each meaning.
fn own_meanings(image: &Image, sym: Sym) -> Vec<&'static str> {
    let data = image.symbol(sym);
    let function = match &data.function {
        FunctionCell::Unbound => None,
        FunctionCell::Function(f) if f.as_generic().is_some() => Some("generic function"),
        FunctionCell::Function(_) => Some("function"),
        FunctionCell::Macro(_) => Some("macro"),
        FunctionCell::Builtin => image.entry(sym).map(Entry::kind),
    };
    let variable = match data.kind {
        _ if image.is_keyword(sym) => None,
        VariableKind::Constant => Some("constant"),
        VariableKind::Special => Some("variable"),
        VariableKind::Lexical if data.value.is_unbound() => None,
        VariableKind::Lexical => Some("variable"),
    };
    let class = image.class(sym).map(|class| kind_of_class(class));
    [function, variable, class].into_iter().flatten().collect()
}

/// The builtins.
pub(crate) static TABLE: &[Builtin] = builtins![describe, describe_object, apropos, apropos_list,];
