//! Installs the plan language in an image.

use super::names::{Names, Packages};
use super::package::reexport;
use super::state::Plan;
use super::{builtins, failure_table, library};
use lisp::image::Image;
use lisp::object::define::ClassDefinition;
use lisp::value::Value;
use lisp::value::class::ClassKind;
use lisp::value::function::Function;
use lisp::value::known;
use lisp::value::package::{PackageId, PackageTable};
use lisp::value::symbol::Sym;

/// Makes the packages of the plan language and everything in them, in an image that has the
/// standard ones.
pub fn install(image: &mut Image) {
    let packages = Packages::make(image);
    // Arithmetic on fluents is defined before that of Common Lisp is exported from the same
    // package.
    for table in builtins::LANGUAGE {
        image.install(packages.cpl, table);
    }
    let names = Names::make(image, packages);
    image.extend(Plan::new(names));
    for table in builtins::FUNCTIONS {
        image.install(packages.implementation, table);
    }
    for table in builtins::SETTERS {
        image.install_setf(packages.implementation, table);
    }
    for table in builtins::SYSTEM {
        image.install(packages.system, table);
    }
    image.install(PackageTable::CL, builtins::COMMON_LISP);
    image.install(PackageTable::SYSTEM, builtins::CLOCK);
    define_variables(image, &names);
    define_types(image, &names);
    // The tables are consistent: every superclass is defined first.
    let _ = failure_table::define(image, packages);
    lisp::library::install(image, &library::LANGUAGE);
    keep_internal(image, packages.implementation, "DESCRIPTION");
    reexport(image, packages.cpl, "CRAM-LANGUAGE-IMPLEMENTATION");
    reexport(image, packages.cpl, "COMMON-LISP");
}

/// Takes a name from the exported ones: CRAM's package does not export it, and it would conflict
/// with that of another package of CRAM.
fn keep_internal(image: &mut Image, package: PackageId, name: &str) {
    if let Some((sym, _)) = image.packages.find_symbol(package, name) {
        image.packages.unexport(&image.symbols, package, sym);
    }
}

fn define_variables(image: &mut Image, names: &Names) {
    let keywords =
        |list: &[Sym]| Value::list(list.iter().map(|s| Value::from(*s)).collect::<Vec<_>>());
    for (variable, value) in [
        (names.current_task, Value::NIL),
        (names.current_path, Value::NIL),
        (names.break_on_failures, Value::NIL),
        (names.debug_on_errors, Value::T),
        (names.pprint_verbosity, Value::Int(0)),
        (
            names.alive,
            keywords(&[names.created, names.running, names.waiting, names.suspended]),
        ),
        (
            names.dead,
            keywords(&[names.failed, names.succeeded, names.evaporated]),
        ),
        (names.done, keywords(&[names.succeeded, names.evaporated])),
    ] {
        image.define_special(variable, value);
    }
    let plan = Plan::of(image);
    let mut variables = plan.task_variables.borrow_mut();
    variables.push((names.break_on_failures, None));
    variables.push((names.debug_on_errors, None));
    let name = names.inherit_parent_value;
    let inherit = Function::pure_of(name, (3, Some(3)), (), |(), _, args| Ok(args[2].clone()));
    image.set_function(name, inherit);
}

/// Defines the classes of fluents, tasks and other values that are not instances.
fn define_types(image: &mut Image, names: &Names) {
    for (name, parent) in [
        (names.fluent, known::T),
        (names.value_fluent, names.fluent),
        (names.pulse_fluent, names.fluent),
        (names.net_fluent, names.fluent),
        (names.cached_net_fluent, names.fluent),
        (names.abstract_task, known::T),
        (names.task, names.abstract_task),
        (names.toplevel_task, names.abstract_task),
        (names.task_tree_node, known::T),
        (names.policy, known::T),
    ] {
        // Parents come first in the list.
        let _ = image.define_unchecked(ClassDefinition {
            name,
            kind: ClassKind::Builtin,
            superclasses: vec![parent],
            slots: Vec::new(),
            default_initargs: Vec::new(),
            doc: None,
        });
    }
}
