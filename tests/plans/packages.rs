//! What the packages of plans export is there.

use cram::prolog::facts;
use lisp::image::Image;
use lisp::value::package::PackageTable;
use lisp::value::symbol::{FunctionCell, Sym};
use session::dialogue::{Evaluate, Event};
use session::{Session, SessionOptions};

/// Words of forms that mean something only inside them, and what rules and plans define for
/// the program to ask.
const WORDS: &[&str] = &[
    // Times of HOLDS.
    "AT",
    "DURING",
    // Process modules of CRAM, which WITH-PROCESS-MODULES-RUNNING may name.
    "MOVE-BASE",
    "WAIT-PM",
    // Inside WITH-FAILURE-HANDLING, WITH-RETRY-COUNTERS, policies and goals.
    "DO-RETRY",
    "GET-COUNTER",
    "GOAL",
    "POLICY-GET",
    "POLICY-SETF",
    "RESET-COUNTER",
    "RETRY",
    "SUCCEED",
    "TAGGED",
    // What rules of fact groups and plans define.
    "ACTION-GROUNDING",
    "AVAILABLE-PROCESS-MODULE",
    "HOLDS",
    "MATCHING-PROCESS-MODULE",
    "MOTION-GROUNDING",
    // Variables that match anything.
    "?_",
    "!?_",
    // The world, in goals.
    "?W",
    // Method combinations.
    "FIRST-IN-ORDER-AND-AROUND",
    "HOOKS",
    "ORDERED-HOOKS",
    // Names that several packages of CRAM share, and what can only be asserted.
    "ACTION",
    "LOCATION",
    "LOCATION-GROUNDING",
    "OBJECT",
    "OBJECT-ID",
    "OBJECT-POSE-ON",
    "THROUGHOUT",
    // What descriptions of other robots, which users load, say of them.
    "ARM-JOINTS",
    "CAMERA-HORIZONTAL-ANGLE",
    "CAMERA-IN-NECK-EE-POSE",
    "CAMERA-MAXIMAL-HEIGHT",
    "CAMERA-MINIMAL-HEIGHT",
    "CAMERA-VERTICAL-ANGLE",
    "GRIPPER-CONVERGENCE-DELTA",
    "GRIPPER-LINK",
    "GRIPPER-METER-TO-JOINT-MULTIPLIER",
    "GRIPPER-MINIMAL-POSITION",
    "HAND-FINGER-LINK",
    "HAND-LINK",
    "HAND-LINKS",
    "NECK",
    "NECK-CAMERA-POSE-UNIT-VECTOR-MULTIPLIER",
    "NECK-CAMERA-RESAMPLING-STEP",
    "NECK-CAMERA-X-AXIS-LIMIT",
    "NECK-CAMERA-Y-AXIS-LIMIT",
    "NECK-CAMERA-Z-AXIS-LIMIT",
    "NECK-CAMERA-Z-OFFSET",
    "ROBOT-ARMS-CARRYING-JOINT-STATES",
    "ROBOT-ARMS-PARKING-JOINT-STATES",
    "ROBOT-BASE-LINK",
    "ROBOT-NECK-BASE-LINK",
    "ROBOT-NECK-JOINTS",
    "ROBOT-NECK-LINKS",
    "ROBOT-NECK-PAN-JOINT-FORWARD-FACING-AXIS-SIGN",
    "ROBOT-NECK-TILT-JOINT-FORWARD-FACING-AXIS-SIGN",
    "ROBOT-PAN-TILT-JOINTS",
    "ROBOT-PAN-TILT-LINKS",
    "STANDARD<-PARTICULAR-GRIPPER-TRANSFORM",
    "TCP-IN-EE-POSE",
    // Slots of errors of designators.
    "REASON",
    "SUGGESTION",
];

fn means_something(image: &Image, functors: &[&str], sym: Sym) -> bool {
    let data = image.symbol(sym);
    let name = image.name(sym);
    let facts = facts::of(image);
    data.package == Some(PackageTable::CL)
        || !data.value.is_unbound()
        || !matches!(data.function, FunctionCell::Unbound)
        || image.classes.contains_key(&sym)
        || image.types.contains_key(&sym)
        || functors.contains(&name)
        || facts.knows(sym)
        || facts.handler(sym).is_some()
        || data.symbol_macro.is_some()
        || WORDS.contains(&name)
}

#[test]
fn every_symbol_that_is_exported_means_something() {
    let session = Session::new(&SessionOptions::default()).expect("a session starts");
    let functors: Vec<&str> = facts::of(session.image())
        .functors()
        .iter()
        .map(|functor| functor.name)
        .collect();
    let image = session.image();
    let internal = ["COMMON-LISP", "KEYWORD", "SYSTEM", "PLAN-SYSTEM"];
    let mut empty = Vec::new();
    let mut seen = 0;
    for id in image.packages.ids() {
        let package = image.packages.get(id);
        if internal.contains(&&*package.name) {
            continue;
        }
        for (name, (sym, is_external)) in package.symbols.iter() {
            seen += usize::from(*is_external);
            if *is_external && !means_something(image, &functors, *sym) {
                empty.push(format!("{}:{name}", package.name));
            }
        }
    }
    assert!(seen > 500, "{seen}");
    empty.sort();
    assert!(empty.is_empty(), "{}", empty.join("\n"));
}

#[test]
fn a_symbol_that_is_not_there_is_told_with_where_it_may_be() {
    let mut session = Session::new(&SessionOptions::default()).expect("a session starts");
    let mut said = |text: &str| {
        let mut report = String::new();
        session.evaluate("test", text, &mut |event| {
            if let Event::Aborted(abort) = event {
                report = abort.report;
            }
        });
        report
    };
    assert_eq!(
        said("(btr:spawn-object 'bottle-1)"),
        "Symbol \"SPAWN-OBJECT\" not found in the CRAM-BULLET-REASONING package. \
         Did you mean CRAM-BULLET-REASONING-UTILITIES:SPAWN-OBJECT?"
    );
    assert_eq!(
        said("(btr-utils:object-psoe 'bottle-1)"),
        "Symbol \"OBJECT-PSOE\" not found in the CRAM-BULLET-REASONING-UTILITIES package. \
         Did you mean CRAM-BULLET-REASONING-UTILITIES:OBJECT-POSE?"
    );
    assert_eq!(
        said("(btr:no-such-thing)"),
        "Symbol \"NO-SUCH-THING\" not found in the CRAM-BULLET-REASONING package."
    );
    let missing = said("(ros-load:load-system \"cram_pick_place_tutrial\")");
    assert!(
        missing.starts_with(
            "There is no system \"cram_pick_place_tutrial\"; did you mean cram_pick_place_tutorial? These are built in: alexandria, "
        ),
        "{missing}"
    );
    assert_eq!(said("(ros-load:load-system :cram-pr2-pick-place-demo)"), "");
    assert_eq!(said("(ros-load:load-system :cram-language)"), "");
}
