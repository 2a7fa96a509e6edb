//! The packages that plans name, with their nicknames and exported symbols.
//!
//! One table; which layer gives the symbols their meaning does not matter here. A package
//! that exists already gets the missing nicknames, uses and exports.

use crate::lisp::image::Image;
use crate::lisp::value::package::{PackageId, PackageTable};
use crate::lisp::value::symbol::Sym;

/// One package.
pub(crate) struct PackageRow {
    /// The name.
    pub(crate) name: &'static str,
    /// Other names.
    pub(crate) nicknames: &'static [&'static str],
    /// Packages whose exported symbols are inherited.
    pub(crate) uses: &'static [&'static str],
    /// Symbols made and exported, separated by blanks.
    pub(crate) exports: &'static str,
}

const fn row(
    name: &'static str,
    nicknames: &'static [&'static str],
    exports: &'static str,
) -> PackageRow {
    PackageRow {
        name,
        nicknames,
        uses: &["COMMON-LISP"],
        exports,
    }
}

/// All packages of plans, except those of the plan language itself and of its failures.
pub(crate) static PACKAGES: &[PackageRow] = &[
    row(
        "CRAM-UTILITIES",
        &["CUT"],
        "VAR-VALUE IS-VAR LAZY-CAR LAZY-CDR LAZY-LIST LAZY-MAPCAR LAZY-FILTER FORCE-LL WITH-VARS-BOUND",
    ),
    row(
        "CRAM-PROLOG",
        &["PROLOG"],
        "PROLOG PROVE-ONE PROVE-ALL <- DEF-FACT-GROUP DEF-PROLOG-HANDLER *BREAK-ON-LISP-ERRORS* \
         LISP-FUN LISP-PRED LISP-TYPE ASSERT-TYPE BOUND GROUND == EQUAL MEMBER ONCE FORALL FINDALL \
         SETOF BAGOF -> *-> TRUE TAKE LENGTH APPEND",
    ),
    row(
        "CRAM-DESIGNATORS",
        &["DESIG"],
        "ACTION-GROUNDING MOTION-GROUNDING LOCATION-GROUNDING DESIG-PROP CURRENT-DESIGNATOR \
         DESIGNATOR-GROUNDINGS DESIGNATOR-ERROR",
    ),
    row(
        "CRAM-DESIGNATOR-SPECIFICATION",
        &["SPEC"],
        "PROPERTY PROPERTY-MEMBER",
    ),
    row(
        "CRAM-EXECUTIVE",
        &["EXE"],
        "PERFORM GENERIC-PERFORM DESIGNATOR-REFERENCE-FAILURE DESIGNATOR-GOAL-PARSING-FAILURE \
         TRY-REFERENCE-DESIGNATOR",
    ),
    row("CL-TRANSFORMS", &[], ""),
    row("CL-TRANSFORMS-STAMPED", &["CL-TF", "CL-TF2"], ""),
    row(
        "CRAM-TF",
        &[],
        "*FIXED-FRAME* *ODOM-FRAME* *ROBOT-BASE-FRAME* *ROBOT-TORSO-FRAME* \
         *ROBOT-LEFT-TOOL-FRAME* *ROBOT-RIGHT-TOOL-FRAME* *TRANSFORMER* *TF-DEFAULT-TIMEOUT* \
         ROBOT-CURRENT-POSE ENSURE-POSE-IN-FRAME VISUALIZE-MARKER",
    ),
    row(
        "CRAM-PICK-PLACE-TUTORIAL",
        &["PP-TUT"],
        "MAKE-POSE SPAWN-OBJECT LIST-AVAILABLE-OBJECTS PARK-ARMS PARK-ARM HANDLE-FAILURE \
         LIST-DEFINED-GRASPS VISUALIZE-COORDINATES GET-KITCHEN-URDF MOVE-KITCHEN-JOINT \
         INVERSE-TRANSFORMATION APPLY-TRANSFORMATION GET-ROBOT-TRANSFORMATION \
         GET-CURRENT-POSE-OF-OBJECT GET-OBJ-NAME GET-OBJECT-NAME GET-X-OF-POSE GET-Y-OF-POSE \
         LOOK-UP-TRANSFORMATION INIT-PROJECTION",
    ),
    row(
        "CRAM-PR2-PROJECTION",
        &["PR2-PROJ"],
        "WITH-SIMULATED-ROBOT WITH-PROJECTED-ROBOT PR2-BULLET-PROJECTION-ENVIRONMENT \
         *DEBUG-SHORT-SLEEP-DURATION* *DEBUG-LONG-SLEEP-DURATION*",
    ),
    PackageRow {
        name: "CRAM-URDF-PROJECTION",
        nicknames: &["URDF-PROJ"],
        uses: &["COMMON-LISP"],
        exports: "*BE-STRICT-WITH-COLLISIONS*",
    },
    row("CRAM-PR2-PROCESS-MODULES", &["PR2-PMS"], "WITH-REAL-ROBOT"),
    row(
        "CRAM-MOBILE-PICK-PLACE-PLANS",
        &["PP-PLANS"],
        "PERCEIVE PICK-UP PLACE GO-TO-TARGET LOOK-AT PARK-ARMS",
    ),
    row(
        "CRAM-PR2-FETCH-DELIVER-PLANS",
        &["PR2-FD-PLANS", "FD-PLANS"],
        "",
    ),
    row(
        "CRAM-PR2-ENVIRONMENT-MANIPULATION",
        &["PR2-EM", "ENV-MAN"],
        "",
    ),
    row(
        "CRAM-BULLET-REASONING",
        &["BTR"],
        "*CURRENT-BULLET-WORLD* OBJECT OBJECTS NAME ITEM-TYPES POSE AABB RIGID-BODIES ADD-OBJECT \
         REMOVE-OBJECT GET-ROBOT-OBJECT GET-ROBOT-NAME GET-ENVIRONMENT-OBJECT JOINT-STATE \
         JOINT-STATES LINK-POSE LINK-NAMES SET-ROBOT-STATE-FROM-JOINTS ATTACH-OBJECT \
         DETACH-OBJECT DETACH-ALL-OBJECTS ATTACHED-OBJECTS SIMULATE FIND-OBJECTS-IN-CONTACT \
         CONTACT-P OBJECT-VISIBLE-P CALCULATE-OBJECT-VISIBILITY STABLE-P ABOVE-P \
         ROBOT-COLLIDING-OBJECTS-WITHOUT-ATTACHED GET-STATE WITH-COPIED-WORLD \
         ADD-VIS-AXIS-OBJECT CLEAR-COSTMAP-VIS-OBJECT ADD-DEBUG-WINDOW ADD-OBJECTS-TO-MESH-LIST \
         BULLET-WORLD CONTACT VISIBLE ABOVE BELOW SUPPORTED-BY STABLE ATTACHED OBJECT-POSE \
         ITEM-TYPE ITEM ROBOT-OBJECT BT-REASONING-WORLD VISIBLE-FROM REACHABLE POSE-REACHABLE \
         RETRACT ASSERT HOUSEHOLD-OBJECT-TYPE LINK-CONTACTS OCCLUDING-OBJECT OCCLUDING-OBJECTS",
    ),
    row(
        "CRAM-BULLET-REASONING-UTILITIES",
        &["BTR-UTILS"],
        "SPAWN-OBJECT KILL-OBJECT KILL-ALL-OBJECTS MOVE-OBJECT TRANSLATE-OBJECT RESPAWN-OBJECT \
         MOVE-ROBOT PARK-ROBOT OBJECT-POSE OBJECT-INSTANCE OBJECT-EXISTS ITEM-EXISTS ROBOT-NAME",
    ),
    row(
        "CRAM-BULLET-REASONING-BELIEF-STATE",
        &["BTR-BELIEF"],
        "*ROBOT-PARAMETER* *KITCHEN-PARAMETER* *SPAWN-DEBUG-WINDOW* UPDATE-BULLET-TRANSFORMS \
         OBJECT-DESIGNATOR-NAME",
    ),
    row(
        "CRAM-OBJECT-INTERFACES",
        &["OBJ-INT"],
        "DEF-OBJECT-TYPE-TO-GRIPPER-TRANSFORMS GET-OBJECT-TYPE-TO-GRIPPER-TRANSFORM \
         GET-OBJECT-TYPE-TO-GRIPPER-PREGRASP-TRANSFORM GET-OBJECT-TYPE-TO-GRIPPER-LIFT-TRANSFORM \
         GET-OBJECT-TYPE-GRIPPING-EFFORT GET-OBJECT-TYPE-GRIPPER-OPENING GET-OBJECT-TYPE-GRASPS \
         OBJECT-TYPE-GRASP GET-OBJECT-TRANSFORM GET-OBJECT-POSE GET-OBJECT-GRASPING-POSES \
         CALCULATE-OBJECT-FACES",
    ),
    row(
        "CRAM-MANIPULATION-INTERFACES",
        &["MAN-INT"],
        "GET-ACTION-GRIPPING-EFFORT GET-ACTION-GRIPPER-OPENING GET-ACTION-GRASPS \
         GET-OBJECT-TYPE-CARRY-CONFIG GET-ARMS-FOR-OBJECT-TYPE OBJECT-TYPE-SUBTYPE",
    ),
    row("CRAM-KNOWROB-PICK-PLACE", &["KR-PP"], ""),
    row("CRAM-OBJECT-KNOWLEDGE", &["OBJECTS"], ""),
    row(
        "CRAM-ROBOT-INTERFACES",
        &["ROB-INT"],
        "ROBOT ARM ARM-JOINTS GRIPPER-JOINT END-EFFECTOR-LINK ROBOT-ARMS-PARKING-JOINT-STATES",
    ),
    row(
        "CRAM-OCCASIONS-EVENTS",
        &["COE", "CET"],
        "HOLDS ON-EVENT CLEAR-BELIEF",
    ),
    row(
        "CRAM-PLAN-OCCASIONS-EVENTS",
        &["CPOE"],
        "OBJECT-IN-HAND OBJECT-ATTACHED OBJECT-DETACHED ROBOT-STATE-CHANGED \
         OBJECT-PERCEIVED-EVENT OBJECT-AT-LOCATION ROBOT-AT-LOCATION LOOKING-AT TORSO-AT \
         GRIPPER-OPENED GRIPPER-CLOSED ARMS-PARKED",
    ),
    row(
        "CRAM-PROCESS-MODULES",
        &["CPM"],
        "DEF-PROCESS-MODULE PM-EXECUTE PM-EXECUTE-MATCHING WITH-PROCESS-MODULES-RUNNING \
         MATCHING-PROCESS-MODULE AVAILABLE-PROCESS-MODULE PROJECTION-RUNNING",
    ),
    row(
        "CRAM-PROJECTION",
        &["PROJ"],
        "WITH-PROJECTION-ENVIRONMENT DEFINE-PROJECTION-ENVIRONMENT \
         PROJECTION-ENVIRONMENT-RESULT-RESULT *PROJECTION-ENVIRONMENT*",
    ),
    row(
        "CRAM-LOCATION-COSTMAP",
        &["COSTMAP", "LOCATION-COSTMAP"],
        "COSTMAP-SIZE COSTMAP-ORIGIN COSTMAP-RESOLUTION COSTMAP-PADDING \
         COSTMAP-MANIPULATION-PADDING COSTMAP-IN-REACH-DISTANCE COSTMAP-REACH-MINIMAL-DISTANCE \
         DESIG-COSTMAP VISUALIZE VISIBILITY-COSTMAP-SIZE",
    ),
    row(
        "ROSLISP",
        &[],
        "ROS-INFO ROS-WARN ROS-ERROR ROS-DEBUG ROS-FATAL ROS-TIME WAIT-DURATION",
    ),
    row(
        "ROSLISP-UTILITIES",
        &[],
        "STARTUP-ROS SHUTDOWN-ROS REGISTER-ROS-INIT-FUNCTION REGISTER-ROS-CLEANUP-FUNCTION",
    ),
    row("ROS-LOAD", &["ROS-LOAD-MANIFEST"], "LOAD-SYSTEM"),
    row("ASDF", &[], "LOAD-SYSTEM"),
    row("QUICKLISP-CLIENT", &["QL", "QUICKLISP"], "QUICKLOAD"),
    row("SWANK", &[], ""),
    row("CRAM-BULLET-WORLD-TUTORIAL", &["BTW-TUT"], ""),
    row("CRAM-PR2-PICK-PLACE-DEMO", &[], ""),
    row("CRAM-BEGINNER-TUTORIAL", &[], ""),
    row("PLANWRIGHT", &["PW"], ""),
];

/// Packages that inherit from others than `COMMON-LISP`.
const USES: &[(&str, &[&str])] = &[
    (
        "CRAM-PICK-PLACE-TUTORIAL",
        &["CRAM-PROLOG", "CRAM-COMMON-FAILURES", "PLANWRIGHT"],
    ),
    ("COMMON-LISP-USER", &["PLANWRIGHT"]),
    ("CRAM-MOBILE-PICK-PLACE-PLANS", &["CRAM-COMMON-FAILURES"]),
    ("CRAM-BULLET-WORLD-TUTORIAL", &["CRAM-PROLOG"]),
];

/// Symbols of one package that another one imports, and exports if the flag says so.
const IMPORTS: &[(&str, &str, &str, bool)] = &[
    (
        "CRAM-PICK-PLACE-TUTORIAL",
        "CRAM-DESIGNATORS",
        "A AN ALL EQUATE DESIG-PROP-VALUE REFERENCE CURRENT-DESIG MAKE-DESIGNATOR NEXT-SOLUTION",
        false,
    ),
    (
        "CRAM-PICK-PLACE-TUTORIAL",
        "CRAM-EXECUTIVE",
        "PERFORM",
        false,
    ),
    (
        "CRAM-MOBILE-PICK-PLACE-PLANS",
        "CRAM-DESIGNATORS",
        "A AN ALL DESIG-PROP-VALUE CURRENT-DESIG",
        false,
    ),
    (
        "CRAM-MOBILE-PICK-PLACE-PLANS",
        "CRAM-EXECUTIVE",
        "PERFORM",
        false,
    ),
    (
        "CRAM-PICK-PLACE-TUTORIAL",
        "CRAM-PR2-PROJECTION",
        "WITH-SIMULATED-ROBOT WITH-PROJECTED-ROBOT",
        false,
    ),
    (
        "CRAM-URDF-PROJECTION",
        "CRAM-PR2-PROJECTION",
        "WITH-SIMULATED-ROBOT WITH-PROJECTED-ROBOT",
        true,
    ),
    ("CRAM-DESIGNATORS", "COMMON-LISP", "WHEN THE SOME", true),
    (
        "CRAM-DESIGNATORS",
        "CRAM-DESIGNATOR-SPECIFICATION",
        "PROPERTY",
        false,
    ),
    ("CRAM-PROLOG", "COMMON-LISP", "AND OR NOT", false),
    (
        "CRAM-MANIPULATION-INTERFACES",
        "CRAM-OBJECT-INTERFACES",
        "DEF-OBJECT-TYPE-TO-GRIPPER-TRANSFORMS GET-OBJECT-TYPE-TO-GRIPPER-TRANSFORM \
         GET-OBJECT-TYPE-GRIPPING-EFFORT GET-OBJECT-TYPE-GRIPPER-OPENING GET-OBJECT-TYPE-GRASPS \
         OBJECT-TYPE-GRASP GET-OBJECT-TRANSFORM GET-OBJECT-POSE GET-OBJECT-GRASPING-POSES \
         CALCULATE-OBJECT-FACES",
        true,
    ),
];

/// The package of that name, made if need be, with the nicknames.
pub(crate) fn ensure(image: &mut Image, name: &str, nicknames: &[&str]) -> PackageId {
    let id = match image.packages.find(name) {
        Some(id) => id,
        // The name is free, so `make` fails only when 65536 packages exist.
        None => image.packages.make(name, &[]).unwrap_or(PackageTable::USER),
    };
    for nickname in nicknames {
        image.packages.add_nickname(id, nickname);
    }
    id
}

/// The symbol of a package, exported; package and symbol are made if need be.
pub(crate) fn symbol(image: &mut Image, package: &str, name: &str) -> Sym {
    let id = ensure(image, package, &[]);
    image.export_symbol(id, name)
}

/// Gives a symbol that has none a name and its place in a package, exported.
pub(crate) fn name_symbol(image: &mut Image, sym: Sym, package: PackageId, name: &str) {
    let data = image.symbols.get_mut(sym);
    data.name = name.into();
    data.package = Some(package);
    image.packages.export(&mut image.symbols, package, sym);
}

/// Makes all packages of the table with their symbols.
pub(crate) fn install(image: &mut Image) {
    for row in PACKAGES {
        let id = ensure(image, row.name, row.nicknames);
        use_packages(image, id, row.uses);
    }
    for (package, from, names, exported) in IMPORTS {
        let (id, from) = (ensure(image, package, &[]), ensure(image, from, &[]));
        for name in names.split_whitespace() {
            let sym = image.export_symbol(from, name);
            image.packages.import(&mut image.symbols, id, sym);
            if *exported {
                image.packages.export(&mut image.symbols, id, sym);
            }
        }
    }
    for row in PACKAGES {
        let id = ensure(image, row.name, &[]);
        for name in row.exports.split_whitespace() {
            image.export_symbol(id, name);
        }
    }
    for (package, used) in USES {
        let id = ensure(image, package, &[]);
        use_packages(image, id, used);
    }
}

/// Lets a package inherit from those of the named ones that exist.
fn use_packages(image: &mut Image, id: PackageId, names: &[&str]) {
    for name in names {
        if let Some(used) = image.packages.find(name) {
            image.packages.use_package(id, used);
        }
    }
}
