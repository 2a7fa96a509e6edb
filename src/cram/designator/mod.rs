//! Designators: actions, motions, objects and locations described by properties.
//!
//! This folder defines their syntax, their types and keys, and how they are resolved; it moves
//! nothing. A motion becomes a request to the host.

pub(crate) mod access;
pub mod check;
pub(crate) mod def_action;
pub mod failure;
mod functors;
pub(crate) mod ground;
pub mod literal;
mod literal_values;
pub mod location;
mod location_registry;
pub mod names;
pub mod object;
pub mod perform;
pub mod reference;
pub mod request;
pub mod schema;
pub(crate) mod syntax;
pub mod value;
pub mod vocabulary;

pub use request::MotionRequest;

use super::{library, packages, prolog as prolog_rules};
use lisp::image::Image;
use lisp::object::define::ClassDefinition;
use lisp::value::Value;
use lisp::value::class::ClassKind;
use lisp::value::known;
use lisp::value::package::PackageTable;
use lisp::value::symbol::Sym;

/// Defines the packages, classes, variables, functions and macros. Install the plan language first.
pub fn install(image: &mut Image) {
    packages::install(image);
    schema::install(image);
    prolog_rules::facts::install(image);
    let desig = packages::ensure(image, "CRAM-DESIGNATORS", &["DESIG"]);
    let root = image.export_symbol(desig, "DESIGNATOR");
    define_class(image, root, known::T);
    for class in value::Class::ALL {
        let name = image.export_symbol(desig, class.class_name());
        define_class(image, name, root);
    }
    let pprint = image.export_symbol(desig, "*DESIGNATOR-PPRINT-DESCRIPTION*");
    image.define_special(pprint, Value::T);
    image.install_operators(desig, syntax::OPERATORS);
    image.install_operators(desig, access::OPERATORS);
    image.install_operators(desig, def_action::OPERATORS);
    image.install(desig, def_action::TABLE);
    image.install(desig, access::TABLE);
    image.install(desig, object::TABLE);
    let data = image.export_symbol(desig, "OBJECT-DESIGNATOR-DATA");
    define_class(image, data, known::T);
    failure::define(image);
    let executive = packages::ensure(image, "CRAM-EXECUTIVE", &["EXE"]);
    image.install(executive, perform::TABLE);
    image.install(PackageTable::SYSTEM, perform::SYSTEM_TABLE);
    image.install(executive, reference::EXECUTIVE_TABLE);
    image.install(desig, reference::TABLE);
    image.install(PackageTable::SYSTEM, location_registry::SYSTEM_TABLE);
    image.install(desig, location_registry::TABLE);
    image.install(desig, location_registry::CONTROL_TABLE);
    location_registry::define(image);
    lisp::library::install(image, &library::UTILITIES);
    let prolog = packages::ensure(image, "CRAM-PROLOG", &["PROLOG"]);
    image.install(prolog, prolog_rules::builtins::TABLE);
    image.install(PackageTable::SYSTEM, prolog_rules::builtins::SYSTEM_TABLE);
    image.install(prolog, prolog_rules::facts::TABLE);
    image.install(PackageTable::SYSTEM, prolog_rules::facts::SYSTEM_TABLE);
    image.install(PackageTable::SYSTEM, prolog_rules::tracing::SYSTEM_TABLE);
    image.install_operators(prolog, prolog_rules::facts::OPERATORS);
    prolog_rules::facts::install_functors(image, prolog_rules::functors::TABLE);
    prolog_rules::facts::install_functors(image, functors::TABLE);
    let names = packages::ensure(image, "ROSLISP-UTILITIES", &[]);
    image.install(names, names::TABLE);
    if image.packages.find("CRAM-LANGUAGE").is_some() {
        packages::ensure(image, "CRAM-PROCESS-MODULES", &[]);
        lisp::library::install(image, &library::DESIGNATORS);
    }
}

/// The first value of a property, by the key's name in upper case; `None` if it is missing or
/// `NIL`, or if the value is not a designator.
pub fn property(image: &Image, designator: &Value, key: &str) -> Option<Value> {
    value::as_designator(designator)?
        .property_named(image, key)
        .filter(Value::is_true)
}

fn define_class(image: &mut Image, name: Sym, superclass: Sym) {
    // The superclass has been defined.
    let _ = image.define_unchecked(ClassDefinition {
        name,
        kind: ClassKind::Builtin,
        superclasses: vec![superclass],
        slots: Vec::new(),
        default_initargs: Vec::new(),
        doc: None,
    });
}

#[cfg(test)]
pub mod tests;
