//! The symbols of the plan language that Rust code uses, and their packages.

use super::package::{PackageDefinition, define};
use lisp::image::Image;
use lisp::value::package::PackageId;
use lisp::value::symbol::Sym;

/// The packages of the plan language.
#[derive(Clone, Copy)]
pub struct Packages {
    /// `CRAM-LANGUAGE`: what programs use.
    pub cpl: PackageId,
    /// `CRAM-LANGUAGE-IMPLEMENTATION`: the home of the symbols.
    pub implementation: PackageId,
    /// `PLAN-SYSTEM`: used in the expansions of macros.
    pub system: PackageId,
    /// `CRAM-COMMON-FAILURES`.
    pub failures: PackageId,
    /// `KEYWORD`.
    pub keyword: PackageId,
}

impl Packages {
    /// Makes the packages; `CRAM-LANGUAGE` gets its symbols later.
    pub fn make(image: &mut Image) -> Packages {
        let implementation = define(image, &IMPLEMENTATION);
        Packages {
            cpl: define(image, &LANGUAGE),
            implementation,
            system: define(image, &SYSTEM),
            failures: define(image, &FAILURES),
            keyword: lisp::value::package::PackageTable::KEYWORD,
        }
    }
}

const IMPLEMENTATION: PackageDefinition = PackageDefinition {
    name: "CRAM-LANGUAGE-IMPLEMENTATION",
    nicknames: &["CPL-IMPL"],
    doc: "The plan language: home of its symbols.",
    uses: &["COMMON-LISP"],
    exports: &[
        "DO-RETRY",
        "GET-COUNTER",
        "GOAL",
        "POLICY-GET",
        "POLICY-SETF",
        "RESET-COUNTER",
        "RETRY",
        "SUCCEED",
        "TIMEOUT-POLICY",
    ],
    reexports: &[],
};

const LANGUAGE: PackageDefinition = PackageDefinition {
    name: "CRAM-LANGUAGE",
    nicknames: &["CPL"],
    doc: "The plan language and all of Common Lisp; arithmetic works on fluents, too.",
    uses: &[],
    exports: &[],
    reexports: &[],
};

const SYSTEM: PackageDefinition = PackageDefinition {
    name: "PLAN-SYSTEM",
    nicknames: &[],
    doc: "What the macros of the plan language expand into.",
    uses: &["COMMON-LISP"],
    exports: &[],
    reexports: &[],
};

const FAILURES: PackageDefinition = PackageDefinition {
    name: "CRAM-COMMON-FAILURES",
    nicknames: &["COMMON-FAIL"],
    doc: "The failures of a robot's actions.",
    uses: &["COMMON-LISP"],
    exports: &[
        "RETRY-WITH-DESIGNATOR-SOLUTIONS",
        "RETRY-WITH-LIST-SOLUTIONS",
        "RETRY-WITH-LOC-DESIGNATOR-SOLUTIONS",
    ],
    reexports: &[],
};

macro_rules! names {
    ($($package:ident { $($id:ident = $name:literal),* $(,)? })*) => {
        /// Symbols of the plan language.
        #[allow(missing_docs)]
        #[derive(Clone, Copy)]
        pub struct Names {
            $($(pub $id: Sym,)*)*
            pub(crate) inherit_parent_value: Sym,
        }

        impl Names {
            /// Makes the symbols and exports them.
            pub fn make(image: &mut Image, packages: Packages) -> Names {
                Names {
                    $($($id: image.export_symbol(packages.$package, $name),)*)*
                    inherit_parent_value: image.intern(packages.implementation, "INHERIT-PARENT-VALUE"),
                }
            }
        }
    };
}

names! {
    implementation {
        plan_failure = "PLAN-FAILURE", simple_plan_failure = "SIMPLE-PLAN-FAILURE",
        composite_failure = "COMPOSITE-FAILURE", envelope = "COMMON-LISP-ERROR-ENVELOPE",
        current_task = "*CURRENT-TASK*", current_path = "*CURRENT-PATH*",
        break_on_failures = "*BREAK-ON-PLAN-FAILURES*",
        debug_on_errors = "*DEBUG-ON-LISP-ERRORS*", pprint_verbosity = "*TASK-PPRINT-VERBOSITY*",
        task = "TASK", abstract_task = "ABSTRACT-TASK", toplevel_task = "TOPLEVEL-TASK",
        task_tree_node = "TASK-TREE-NODE", fluent = "FLUENT", value_fluent = "VALUE-FLUENT",
        pulse_fluent = "PULSE-FLUENT", net_fluent = "FL-NET-FLUENT",
        cached_net_fluent = "FL-NET-CACHEABLE-FLUENT", alive = "+ALIVE+", dead = "+DEAD+",
        done = "+DONE+", tagged = "TAGGED", with_tags = "WITH-TAGS", wait_for = "WAIT-FOR",
        policy = "POLICY",
    }
    keyword {
        tag = "TAG", call = "CALL", error = "ERROR", failures = "FAILURES", never = "NEVER",
        once = "ONCE", always = "ALWAYS", created = "CREATED", running = "RUNNING",
        suspended = "SUSPENDED", succeeded = "SUCCEEDED", failed = "FAILED",
        evaporated = "EVAPORATED", waiting = "WAITING",
    }
    system {
        sys_run_constrained = "RUN-CONSTRAINED", sys_propagate = "PROPAGATE",
        sys_hook = "RUN-SUSPENSION-HOOKS",
    }
}
