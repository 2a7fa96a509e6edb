//! The failures of the plan language and of the robot's actions, in one table.

use lisp::image::Image;
use lisp::object::defclass;
use lisp::stream;
use lisp::typed;
use lisp::value::Value;
use lisp::value::function::Function;
use lisp::value::known;
use lisp::value::package::PackageId;
use lisp::value::symbol::Sym;
use lisp::vm::step::Step;

use super::Result;
use super::names::Packages;

/// A class of failures.
struct Failure {
    name: &'static str,
    /// Direct superclasses, from this table or from Common Lisp.
    parents: &'static [&'static str],
    slots: &'static [Slot],
    /// The default text.
    description: Option<&'static str>,
}

/// A slot: its name, the keyword that initialises it, and its reader.
struct Slot {
    name: &'static str,
    initarg: &'static str,
    reader: &'static str,
}

const fn slot(name: &'static str, initarg: &'static str, reader: &'static str) -> Slot {
    Slot {
        name,
        initarg,
        reader,
    }
}

const fn failure(
    name: &'static str,
    parents: &'static [&'static str],
    slots: &'static [Slot],
) -> Failure {
    Failure {
        name,
        parents,
        slots,
        description: None,
    }
}

/// Failures of the plan language itself.
const LANGUAGE: &[Failure] = &[
    failure("PLAN-FAILURE", &["SERIOUS-CONDITION"], &[]),
    failure(
        "SIMPLE-PLAN-FAILURE",
        &["SIMPLE-CONDITION", "PLAN-FAILURE"],
        &[],
    ),
    failure(
        "COMPOSITE-FAILURE",
        &["PLAN-FAILURE"],
        &[slot("FAILURES", "FAILURES", "COMPOSITE-FAILURES")],
    ),
    failure(
        "COMMON-LISP-ERROR-ENVELOPE",
        &["PLAN-FAILURE"],
        &[slot("ERROR", "ERROR", "ENVELOP-ERROR")],
    ),
    failure(
        "POLICY-CONDITION",
        &["CONDITION"],
        &[slot("NAME", "NAME", "POLICY-NAME")],
    ),
    failure("POLICY-NOT-FOUND", &["POLICY-CONDITION"], &[]),
    failure(
        "POLICY-FAILURE",
        &["POLICY-CONDITION"],
        &[slot("PARAMETERS", "PARAMETERS", "POLICY-PARAMETERS")],
    ),
    failure("POLICY-INIT-FAILED", &["POLICY-FAILURE"], &[]),
    failure("POLICY-CHECK-CONDITION-MET", &["POLICY-FAILURE"], &[]),
];

/// Failures of the robot's actions.
const COMMON: &[Failure] = &[
    Failure {
        name: "LOW-LEVEL-FAILURE",
        parents: &["SIMPLE-PLAN-FAILURE"],
        slots: &[slot("DESCRIPTION", "DESCRIPTION", "ERROR-DESCRIPTION")],
        description: Some("Low-level failure happened"),
    },
    failure("ACTIONLIB-ACTION-TIMED-OUT", &["LOW-LEVEL-FAILURE"], &[]),
    failure(
        "MANIPULATION-LOW-LEVEL-FAILURE",
        &["LOW-LEVEL-FAILURE"],
        &[],
    ),
    failure(
        "MANIPULATION-GOAL-NOT-REACHED",
        &["MANIPULATION-LOW-LEVEL-FAILURE"],
        &[],
    ),
    failure(
        "MANIPULATION-POSE-UNREACHABLE",
        &["MANIPULATION-LOW-LEVEL-FAILURE"],
        &[],
    ),
    failure(
        "ENVIRONMENT-MANIPULATION-GOAL-NOT-REACHED",
        &["MANIPULATION-LOW-LEVEL-FAILURE"],
        &[],
    ),
    failure(
        "POURING-SPILLED",
        &["MANIPULATION-LOW-LEVEL-FAILURE"],
        &[
            // In ml.
            slot("SPILLED", "SPILLED", "POURING-FAILURE-SPILLED"),
            slot("POURED", "POURED", "POURING-FAILURE-POURED"),
        ],
    ),
    failure(
        "CONTAINER-EMPTY",
        &["MANIPULATION-LOW-LEVEL-FAILURE"],
        &[slot("OBJECT", "OBJECT", "CONTAINER-EMPTY-OBJECT")],
    ),
    failure(
        "CONTAINER-FULL",
        &["MANIPULATION-LOW-LEVEL-FAILURE"],
        &[slot("OBJECT", "OBJECT", "CONTAINER-FULL-OBJECT")],
    ),
    failure(
        "TOOL-MISSING",
        &["MANIPULATION-LOW-LEVEL-FAILURE"],
        &[slot("OBJECT", "OBJECT", "TOOL-MISSING-OBJECT")],
    ),
    failure(
        "WRONG-TOOL",
        &["MANIPULATION-LOW-LEVEL-FAILURE"],
        &[slot("OBJECT", "OBJECT", "WRONG-TOOL-OBJECT")],
    ),
    failure(
        "WIPING-INCOMPLETE",
        &["MANIPULATION-LOW-LEVEL-FAILURE"],
        &[
            // The share of the free part that was wiped, up to 1, and points of what was not.
            slot("SHARE", "SHARE", "WIPING-FAILURE-SHARE"),
            slot("MISSED", "MISSED", "WIPING-FAILURE-MISSED"),
        ],
    ),
    failure(
        "CUTTING-FAILED",
        &["MANIPULATION-LOW-LEVEL-FAILURE"],
        &[slot("REASON", "REASON", "CUTTING-FAILURE-REASON")],
    ),
    failure(
        "HANDOVER-FAILED",
        &["MANIPULATION-LOW-LEVEL-FAILURE"],
        // The arm that holds the object, or NIL.
        &[slot("HOLDER", "HOLDER", "HANDOVER-FAILED-HOLDER")],
    ),
    failure(
        "GRIPPER-LOW-LEVEL-FAILURE",
        &["MANIPULATION-LOW-LEVEL-FAILURE"],
        &[slot("ACTION", "OBJECT", "GRIPPER-FAILURE-ACTION")],
    ),
    failure(
        "GRIPPER-CLOSED-COMPLETELY",
        &["GRIPPER-LOW-LEVEL-FAILURE"],
        &[],
    ),
    failure(
        "GRIPPER-GOAL-NOT-REACHED",
        &["GRIPPER-LOW-LEVEL-FAILURE"],
        &[],
    ),
    failure(
        "TORSO-LOW-LEVEL-FAILURE",
        &["MANIPULATION-LOW-LEVEL-FAILURE"],
        &[slot("TORSO", "LOCATION", "TORSO-FAILURE-TARGET")],
    ),
    failure("TORSO-GOAL-UNREACHABLE", &["TORSO-LOW-LEVEL-FAILURE"], &[]),
    failure("TORSO-GOAL-NOT-REACHED", &["TORSO-LOW-LEVEL-FAILURE"], &[]),
    failure(
        "NAVIGATION-LOW-LEVEL-FAILURE",
        &["LOW-LEVEL-FAILURE"],
        &[slot("LOCATION", "LOCATION", "NAVIGATION-FAILURE-LOCATION")],
    ),
    failure(
        "NAVIGATION-POSE-UNREACHABLE",
        &["NAVIGATION-LOW-LEVEL-FAILURE"],
        &[],
    ),
    failure(
        "NAVIGATION-GOAL-NOT-REACHED",
        &["NAVIGATION-LOW-LEVEL-FAILURE"],
        &[],
    ),
    failure("PERCEPTION-LOW-LEVEL-FAILURE", &["LOW-LEVEL-FAILURE"], &[]),
    failure(
        "PERCEPTION-OBJECT-NOT-FOUND",
        &["PERCEPTION-LOW-LEVEL-FAILURE"],
        &[slot("OBJECT", "OBJECT", "OBJECT-NOT-FOUND-OBJECT")],
    ),
    failure(
        "PERCEPTION-OBJECT-NOT-IN-WORLD",
        &["PERCEPTION-LOW-LEVEL-FAILURE"],
        &[slot("OBJECT", "OBJECT", "OBJECT-NOT-IN-WORLD-OBJECT")],
    ),
    failure(
        "PTU-LOW-LEVEL-FAILURE",
        &["LOW-LEVEL-FAILURE"],
        &[slot("TARGET", "LOCATION", "PTU-FAILURE-TARGET")],
    ),
    failure("PTU-GOAL-UNREACHABLE", &["PTU-LOW-LEVEL-FAILURE"], &[]),
    failure("PTU-GOAL-NOT-REACHED", &["PTU-LOW-LEVEL-FAILURE"], &[]),
    Failure {
        name: "HIGH-LEVEL-FAILURE",
        parents: &["SIMPLE-PLAN-FAILURE"],
        slots: &[
            slot("DESCRIPTION", "DESCRIPTION", "ERROR-DESCRIPTION"),
            // What was tried: a list of (what cause count).
            slot("ATTEMPTS", "ATTEMPTS", "FAILURE-ATTEMPTS"),
        ],
        description: Some("High-level failure happened"),
    },
    failure(
        "NAVIGATION-HIGH-LEVEL-FAILURE",
        &["HIGH-LEVEL-FAILURE"],
        &[],
    ),
    failure(
        "NAVIGATION-GOAL-IN-COLLISION",
        &["NAVIGATION-HIGH-LEVEL-FAILURE"],
        &[slot(
            "POSE-STAMPED",
            "POSE-STAMPED",
            "NAVIGATION-GOAL-IN-COLLISION-POSE-STAMPED",
        )],
    ),
    failure("LOOKING-HIGH-LEVEL-FAILURE", &["HIGH-LEVEL-FAILURE"], &[]),
    failure(
        "OBJECT-UNREACHABLE",
        &["HIGH-LEVEL-FAILURE"],
        &[slot("OBJECT", "OBJECT", "OBJECT-UNREACHABLE-OBJECT")],
    ),
    failure(
        "OBJECT-UNFETCHABLE",
        &["HIGH-LEVEL-FAILURE"],
        &[slot("OBJECT", "OBJECT", "OBJECT-UNFETCHABLE-OBJECT")],
    ),
    failure(
        "OBJECT-UNDELIVERABLE",
        &["HIGH-LEVEL-FAILURE"],
        &[slot("OBJECT", "OBJECT", "OBJECT-UNDELIVERABLE-OBJECT")],
    ),
    failure(
        "OBJECT-NOWHERE-TO-BE-FOUND",
        &["HIGH-LEVEL-FAILURE"],
        &[slot(
            "OBJECT",
            "OBJECT",
            "OBJECT-NOWHERE-TO-BE-FOUND-OBJECT",
        )],
    ),
    failure(
        "MANIPULATION-GOAL-IN-COLLISION",
        &["HIGH-LEVEL-FAILURE"],
        &[],
    ),
    failure("ENVIRONMENT-UNREACHABLE", &["HIGH-LEVEL-FAILURE"], &[]),
    failure(
        "ENVIRONMENT-MANIPULATION-IMPOSSIBLE",
        &["HIGH-LEVEL-FAILURE"],
        &[],
    ),
    failure(
        "SEARCHING-FAILED",
        &["OBJECT-NOWHERE-TO-BE-FOUND"],
        &[slot("OBJECT", "OBJECT", "SEARCHING-FAILED-OBJECT")],
    ),
    failure(
        "FETCHING-FAILED",
        &["OBJECT-UNFETCHABLE"],
        &[slot("OBJECT", "OBJECT", "FETCHING-FAILED-OBJECT")],
    ),
    failure(
        "DELIVERING-FAILED",
        &["OBJECT-UNDELIVERABLE"],
        &[slot("OBJECT", "OBJECT", "DELIVERING-FAILED-OBJECT")],
    ),
];

/// Defines the failures in an image.
pub(super) fn define(image: &mut Image, packages: Packages) -> Result<()> {
    for failure in LANGUAGE {
        define_one(image, failure, packages.implementation, packages)?;
    }
    for failure in COMMON {
        define_one(image, failure, packages.failures, packages)?;
    }
    report_by(
        image,
        packages.implementation,
        "COMPOSITE-FAILURE",
        report_composite,
    );
    report_by(
        image,
        packages.implementation,
        "COMMON-LISP-ERROR-ENVELOPE",
        report_envelope,
    );
    for (name, text) in [
        ("POLICY-NOT-FOUND", "Policy ~a not found.~%"),
        (
            "POLICY-INIT-FAILED",
            "Initialization of policy ~a failed.~%Parameters: ~a~%",
        ),
        (
            "POLICY-CHECK-CONDITION-MET",
            "Policy check condition met for policy ~a.~%Parameters: ~a.~%",
        ),
    ] {
        report_policy(image, packages.implementation, name, text);
    }
    for name in ["LOW-LEVEL-FAILURE", "HIGH-LEVEL-FAILURE"] {
        report_by(image, packages.failures, name, report_description);
    }
    Ok(())
}

/// The symbol of a parent, from the package of failures, the plan language or Common Lisp.
fn parent(image: &mut Image, name: &str, home: PackageId, packages: Packages) -> Sym {
    for package in [home, packages.implementation] {
        if let Some((sym, _)) = image.packages.find_symbol(package, name) {
            return sym;
        }
    }
    image.intern(home, name)
}

fn define_one(
    image: &mut Image,
    failure: &Failure,
    home: PackageId,
    packages: Packages,
) -> Result<()> {
    let name = image.export_symbol(home, failure.name);
    let parents: Vec<Value> = failure
        .parents
        .iter()
        .map(|p| parent(image, p, home, packages).into())
        .collect();
    let mut slots = Vec::new();
    for slot in failure.slots {
        let init = match failure.description {
            Some(text) if slot.name == "DESCRIPTION" => Value::from(text),
            _ => Value::NIL,
        };
        let slot_name = image.intern(home, slot.name);
        let initarg = image.keyword(slot.initarg);
        let reader = image.export_symbol(home, slot.reader);
        slots.push(Value::list([
            slot_name.into(),
            Value::list([Value::from(initarg)]),
            Value::cons(known::K_VALUE.into(), init),
            Value::list([Value::from(reader)]),
            Value::NIL,
            Value::T,
            Value::NIL,
            Value::NIL,
        ]));
    }
    defclass::define_condition(
        image,
        name,
        &Value::list(parents),
        &Value::list(slots),
        &Value::NIL,
        &Value::NIL,
        &Value::NIL,
    )?;
    Ok(())
}

/// Lets a function of the condition and the stream write the report of a class.
fn report_by(
    image: &mut Image,
    home: PackageId,
    name: &str,
    report: impl Fn(&mut Image, &Value, Value) -> Result<Step> + Copy + 'static,
) {
    let name = image.export_symbol(home, name);
    let function = Function::control_of(name, (2, Some(2)), (), move |(), machine, args| {
        let [condition, stream] = args.try_into().map_err(|_| typed::wrong_count())?;
        report(machine.image, &condition, stream)
    });
    if let Some(class) = image.class(name) {
        *class.report.borrow_mut() = Some(function);
    }
}

/// The value of the slot with that name, in whatever package.
fn slot_value(image: &Image, condition: &Value, name: &str) -> Value {
    let Value::Instance(instance) = condition else {
        return Value::NIL;
    };
    let class = instance.class();
    let sym = class
        .slots
        .borrow()
        .iter()
        .find(|s| image.name(s.name) == name)
        .map(|s| s.name);
    sym.and_then(|sym| instance.slot(sym))
        .filter(|v| !v.is_unbound())
        .unwrap_or(Value::NIL)
}

fn format(stream: Value, control: Value, args: Vec<Value>) -> Step {
    let mut all = vec![stream, control];
    all.extend(args);
    Step::TailCall {
        function: known::FORMAT.into(),
        args: all,
    }
}

fn report_policy(image: &mut Image, home: PackageId, name: &str, text: &'static str) {
    report_by(image, home, name, move |image, condition, stream| {
        let values = ["NAME", "PARAMETERS"].map(|slot| slot_value(image, condition, slot));
        Ok(format(stream, text.into(), values.to_vec()))
    });
}

/// The format control given to the failure, or else its description.
fn report_description(image: &mut Image, failure: &Value, stream: Value) -> Result<Step> {
    let control = slot_value(image, failure, "FORMAT-CONTROL");
    if control.is_true() {
        let arguments = slot_value(image, failure, "FORMAT-ARGUMENTS");
        return Ok(format(stream, control, arguments.iter_list().collect()));
    }
    let description = slot_value(image, failure, "DESCRIPTION");
    match description.as_text() {
        // A description is a format control, of which only the directives that texts need are
        // supported.
        Some(text) => {
            let text = text.replace("~%", "\n").replace("~~", "~");
            stream::write(image, &stream, &text)?;
            Ok(Step::Return(Value::NIL))
        }
        None => Ok(format(stream, "~a".into(), vec![description])),
    }
}

fn report_envelope(image: &mut Image, failure: &Value, stream: Value) -> Result<Step> {
    let inner = slot_value(image, failure, "ERROR");
    let text = "A Lisp error in a task: ~a";
    Ok(format(stream, text.into(), vec![inner]))
}

fn report_composite(image: &mut Image, failure: &Value, stream: Value) -> Result<Step> {
    let failures = slot_value(image, failure, "FAILURES");
    if failures.is_nil() {
        let text = "All alternatives failed: there were none.";
        return Ok(format(stream, text.into(), Vec::new()));
    }
    let text = "All alternatives failed:~{~%  ~a~}";
    Ok(format(stream, text.into(), vec![failures]))
}
