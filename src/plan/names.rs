//! The symbols of the plan language that Rust code names, and the packages they live in.

use super::package::{PackageDefinition, define};
use crate::lisp::image::Image;
use crate::lisp::value::package::PackageId;
use crate::lisp::value::symbol::Sym;

/// The packages of the plan language.
#[derive(Clone, Copy)]
pub(crate) struct Packages {
    /// `CRAM-LANGUAGE`: what programs use.
    pub(crate) cpl: PackageId,
    /// `CRAM-LANGUAGE-IMPLEMENTATION`: where the symbols are at home.
    pub(crate) implementation: PackageId,
    /// `PLAN-SYSTEM`: what the macros expand into.
    pub(crate) system: PackageId,
    /// `CRAM-COMMON-FAILURES`.
    pub(crate) failures: PackageId,
    /// `KEYWORD`.
    pub(crate) keyword: PackageId,
}

impl Packages {
    /// Makes the packages; `CRAM-LANGUAGE` gets its symbols later.
    pub(crate) fn make(image: &mut Image) -> Packages {
        let implementation = define(image, &IMPLEMENTATION);
        Packages {
            cpl: define(image, &LANGUAGE),
            implementation,
            system: define(image, &SYSTEM),
            failures: define(image, &FAILURES),
            keyword: crate::lisp::value::package::PackageTable::KEYWORD,
        }
    }
}

const IMPLEMENTATION: PackageDefinition = PackageDefinition {
    name: "CRAM-LANGUAGE-IMPLEMENTATION",
    nicknames: &["CPL-IMPL"],
    doc: "The plan language: home of its symbols.",
    uses: &["COMMON-LISP"],
    exports: &["TIMEOUT-POLICY"],
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
    exports: &[],
    reexports: &[],
};

macro_rules! names {
    ($($package:ident { $($id:ident = $name:literal),* $(,)? })*) => {
        /// Symbols of the plan language by what they name.
        #[allow(missing_docs)]
        #[derive(Clone, Copy)]
        pub(crate) struct Names {
            $($(pub(crate) $id: Sym,)*)*
            pub(crate) inherit_parent_value: Sym,
        }

        impl Names {
            /// Makes the symbols and exports them.
            pub(crate) fn make(image: &mut Image, packages: Packages) -> Names {
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
        envelop_error = "ENVELOP-ERROR",
        current_task = "*CURRENT-TASK*", current_path = "*CURRENT-PATH*",
        break_on_failures = "*BREAK-ON-PLAN-FAILURES*", debug_on_errors = "*DEBUG-ON-LISP-ERRORS*",
        pprint_verbosity = "*TASK-PPRINT-VERBOSITY*",
        task = "TASK", abstract_task = "ABSTRACT-TASK", sleep_star = "SLEEP*", toplevel_task = "TOPLEVEL-TASK", task_tree_node = "TASK-TREE-NODE",
        fluent = "FLUENT", value_fluent = "VALUE-FLUENT", pulse_fluent = "PULSE-FLUENT",
        net_fluent = "FL-NET-FLUENT", cached_net_fluent = "FL-NET-CACHEABLE-FLUENT",
        alive = "+ALIVE+", dead = "+DEAD+", done = "+DONE+",
        tagged = "TAGGED", goal = "GOAL", top_level = "TOP-LEVEL", retry = "RETRY", succeed = "SUCCEED",
        do_retry = "DO-RETRY", get_counter = "GET-COUNTER", reset_counter = "RESET-COUNTER",
        with_tags = "WITH-TAGS", wait_for = "WAIT-FOR", fail = "FAIL",
        suspend = "SUSPEND", wake_up = "WAKE-UP",
        with_policy = "WITH-POLICY", named_policy = "NAMED-POLICY",
        policy = "POLICY", policy_not_found = "POLICY-NOT-FOUND",
        policy_init_failed = "POLICY-INIT-FAILED", policy_met = "POLICY-CHECK-CONDITION-MET",
        policy_setf = "POLICY-SETF", policy_get = "POLICY-GET",
    }
    keyword {
        tag = "TAG", call = "CALL", order = "ORDER", path_part = "PATH-PART", name = "NAME",
        error = "ERROR", failures = "FAILURES", timeout = "TIMEOUT", value_key = "VALUE",
        test = "TEST", key = "KEY", handle_missed_pulses = "HANDLE-MISSED-PULSES",
        never = "NEVER", once = "ONCE", always = "ALWAYS", sync = "SYNC", reason = "REASON",
        created = "CREATED", running = "RUNNING", suspended = "SUSPENDED", succeeded = "SUCCEEDED",
        failed = "FAILED", evaporated = "EVAPORATED", waiting = "WAITING",
        allow_tracing = "ALLOW-TRACING", max_tracing_freq = "MAX-TRACING-FREQ", class = "CLASS",
        pulse_count = "PULSE-COUNT", init = "INIT", check = "CHECK", recover = "RECOVER", clean_up = "CLEAN-UP",
        init_function = "INIT-FUNCTION", parameters = "PARAMETERS",
        wait_status = "WAIT-STATUS", lambda_list = "LAMBDA-LIST",
    }
    system {
        sys_top_level = "START", sys_par = "PAR", sys_pursue = "PURSUE", sys_try_all = "TRY-ALL",
        sys_par_loop = "PAR-LOOP", sys_partial_order = "PARTIAL-ORDER", sys_check_plan = "CHECK-PLAN",
        sys_all_failed = "ALL-FAILED", sys_make_tag = "MAKE-TAG", sys_fresh_tag = "FRESH-TAG",
        sys_run_tag = "RUN-TAG", sys_tag_outside = "TAG-OUTSIDE", sys_in_node = "CALL-IN-NODE", sys_push_hook = "PUSH-SUSPENSION-HOOK",
        sys_pop_hook = "POP-SUSPENSION-HOOK", sys_scheduling = "ALLOW-SCHEDULING",
        sys_define_task_variable = "DEFINE-TASK-VARIABLE",
        sys_declare_goal = "DECLARE-GOAL", sys_register_goal = "REGISTER-GOAL", sys_call_goal = "CALL-GOAL",
        sys_make_policy = "MAKE-POLICY", sys_register_policy = "REGISTER-POLICY", sys_policy_part = "POLICY-PART",
        sys_policy_name = "POLICY-NAME",
        sys_expand_do_retry = "EXPAND-DO-RETRY", sys_expand_get_counter = "EXPAND-GET-COUNTER",
        sys_expand_reset_counter = "EXPAND-RESET-COUNTER",
        sys_wait_until_suspended = "WAIT-UNTIL-SUSPENDED", sys_run_constrained = "RUN-CONSTRAINED",
        sys_propagate = "PROPAGATE", sys_hook = "RUN-SUSPENSION-HOOKS", sys_storage = "STORAGE",
    }
}
