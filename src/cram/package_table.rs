//! The packages used in plans, with their nicknames and exported symbols.
//!
//! The table exports symbols that are not functions, variables or classes: functors, hooks for
//! rules, what the built-in plans define. Tables of builtins export their own names. A package that
//! exists already gets the missing nicknames, uses and exports.

/// One package.
pub struct PackageRow {
    /// The name.
    pub name: &'static str,
    /// Other names.
    pub nicknames: &'static [&'static str],
    /// Packages whose exported symbols are inherited.
    pub uses: &'static [&'static str],
    /// Symbols made and exported, separated by blanks.
    pub exports: &'static str,
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

/// All packages for plans, except those of the plan language itself and of its failures.
pub static PACKAGES: &[PackageRow] = &[
    row("CRAM-UTILITIES", &["CUT"], "?_ !?_"),
    // Functors are recognised by name in any package; these are those that CRAM exports.
    row(
        "CRAM-PROLOG",
        &["PROLOG"],
        "LISP-FUN LISP-PRED LISP-TYPE ASSERT-TYPE BOUND GROUND == EQUAL MEMBER ONCE FORALL \
         FINDALL SETOF BAGOF -> *-> TRUE LENGTH APPEND CUT CALL GENERATE-VALUES INSTANCE-OF \
         GET-SLOT-VALUE SET-SYMBOL-VALUE STRING-CONCAT FILTER-BINDINGS <- FAIL OBJECT-ID \
         *BREAK-ON-LISP-ERRORS*",
    ),
    row(
        "CRAM-DESIGNATORS",
        &["DESIG"],
        "ACTION-GROUNDING MOTION-GROUNDING DESIG-PROP CURRENT-DESIGNATOR DESIGNATOR-ERROR \
         ACTION LOCATION OBJECT",
    ),
    row(
        "CRAM-DESIGNATOR-SPECIFICATION",
        &["SPEC"],
        "PROPERTY PROPERTY-MEMBER",
    ),
    row(
        "CRAM-EXECUTIVE",
        &["EXE"],
        "DESIGNATOR-REFERENCE-FAILURE DESIGNATOR-GOAL-PARSING-FAILURE",
    ),
    row("CL-TRANSFORMS", &[], ""),
    row(
        "CL-TRANSFORMS-STAMPED",
        &["CL-TF", "CL-TF2", "TF-TYPES"],
        "",
    ),
    row(
        "CRAM-TF",
        &[],
        "*FIXED-FRAME* *ODOM-FRAME* *ROBOT-BASE-FRAME* *ROBOT-TORSO-FRAME* \
         *ROBOT-LEFT-TOOL-FRAME* *ROBOT-RIGHT-TOOL-FRAME*",
    ),
    row(
        "CRAM-PICK-PLACE-TUTORIAL",
        &["PP-TUT"],
        "PARK-ARMS PARK-ARM HANDLE-FAILURE",
    ),
    row("CRAM-PR2-PROJECTION", &["PR2-PROJ"], ""),
    row("CRAM-URDF-PROJECTION", &["URDF-PROJ"], ""),
    row(
        "CRAM-PR2-PROCESS-MODULES",
        &["PR2-PMS"],
        "WITH-REAL-ROBOT *PROSPECTION*",
    ),
    row(
        "CRAM-MOBILE-PICK-PLACE-PLANS",
        &["PP-PLANS"],
        "PERCEIVE PICK-UP PLACE GO-TO-TARGET LOOK-AT PARK-ARMS",
    ),
    row(
        "CRAM-PR2-FETCH-DELIVER-PLANS",
        &["PR2-FD-PLANS", "CRAM-FETCH-DELIVER-PLANS", "FD-PLANS"],
        "",
    ),
    row(
        "CRAM-PR2-ENVIRONMENT-MANIPULATION",
        &[
            "PR2-EM",
            "PR2-ENV-MAN",
            "CRAM-URDF-ENVIRONMENT-MANIPULATION",
            "ENV-MAN",
        ],
        "",
    ),
    row("CRAM-BULLET-REASONING", &["BTR"], ""),
    row(
        "CRAM-BULLET-REASONING-UTILITIES",
        &["BTR-UTILS", "BULLET-REASONING-UTILITIES"],
        "VISUALIZE-DESIGNATOR-COSTMAPS",
    ),
    row("CRAM-BULLET-REASONING-BELIEF-STATE", &["BTR-BELIEF"], ""),
    row("CRAM-OBJECT-INTERFACES", &["OBJ-INT"], ""),
    row(
        "CRAM-MANIPULATION-INTERFACES",
        &["MAN-INT"],
        "ROBOT-FREE-HAND",
    ),
    row("CRAM-KNOWROB-PICK-PLACE", &["KR-PP"], ""),
    row("CRAM-OBJECT-KNOWLEDGE", &["OBJECTS"], ""),
    row(
        "CRAM-ROBOT-INTERFACES",
        &["ROB-INT"],
        "ROBOT ARM ARMS ROBOT-BASE-FRAME ROBOT-ODOM-FRAME ROBOT-TORSO-LINK-JOINT \
         ROBOT-TOOL-FRAME END-EFFECTOR-LINK CAMERA-FRAME JOINT-LOWER-LIMIT JOINT-UPPER-LIMIT \
         ROBOT-JOINT-STATES ENVIRONMENT-NAME",
    ),
    // Test the goal of an action, and tell how it stands.
    row(
        "CRAM-OCCASIONS-EVENTS",
        &["COE", "OCCASIONS-EVENTS"],
        "HOLDS NOTE-GOAL ON-EVENT CLEAR-BELIEF EVENT \
         TOP-LEVEL TASK GOAL-TASK TASK-PATH TASK-GOAL TASK-NAME TASK-DESIGNATOR SUBTASK SUBTASK+ \
         TASK-SIBLING TASK-NEXT-SIBLING TASK-PREVIOUS-SIBLING TASK-STATUS TASK-OUTCOME TASK-RESULT \
         TASK-PARAMETER TASK-ERROR ERROR-TYPE TASK-CREATED-AT TASK-STARTED-AT TASK-ENDED-AT \
         TASK-DURATION TASK-PLACE TOP-LEVEL-TASK TASK-OF-TOP-LEVEL PERFORM-TASK-OF-TOP-LEVEL \
         TASK-SPECIFIC-ACTION TASK-NAVIGATING-ACTION TASK-FETCHING-ACTION TASK-DELIVERING-ACTION \
         TASK-PICKING-UP-ACTION TASK-PLACING-ACTION TASK-TRANSPORTING-ACTION \
         TASK-NEXT-ACTION-SIBLING TASK-PREVIOUS-ACTION-SIBLING \
         OCCURS DURATION-INCLUDES AT DURING",
    ),
    row(
        "CRAM-PLAN-OCCASIONS-EVENTS",
        &["CPOE"],
        "OBJECT-IN-HAND OBJECT-AT-LOCATION OBJECT-PLACED ROBOT-AT-LOCATION TORSO-AT \
         GRIPPER-JOINT-AT GRIPPER-OPENED GRIPPER-CLOSED ARMS-POSITIONED-AT TOOL-FRAMES-AT \
         LOOKING-AT \
         OBJECT-PERCEIVED-EVENT OBJECT-ATTACHED-ROBOT OBJECT-ATTACHED OBJECT-DETACHED-ROBOT \
         OBJECT-DETACHED OBJECT-LOCATION-CHANGED ROBOT-STATE-CHANGED CONTAINER-STATE \
         CONTAINER-OPENING-EVENT CONTAINER-CLOSING-EVENT KNOB-TURNED-EVENT LOCATION-RESET LOCATION-ACCESSIBLE",
    ),
    row(
        "CRAM-PROCESS-MODULES",
        &["CPM"],
        "DEF-PROCESS-MODULE PM-EXECUTE PM-EXECUTE-MATCHING WITH-PROCESS-MODULES-RUNNING \
         MATCHING-PROCESS-MODULE AVAILABLE-PROCESS-MODULE PROJECTION-RUNNING",
    ),
    row("CRAM-PROJECTION", &["PROJ"], ""),
    row("SWANK", &[], "*READTABLE-ALIST*"),
    row(
        "CRAM-LOCATION-COSTMAP",
        &["COSTMAP", "LOCATION-COSTMAP"],
        "COSTMAP-IN-REACH-DISTANCE COSTMAP-REACH-MINIMAL-DISTANCE VISIBILITY-COSTMAP-SIZE",
    ),
    row("ROSLISP", &[], "ROS-INFO ROS-WARN ROS-ERROR ROS-DEBUG"),
    row("ROSLISP-UTILITIES", &[], ""),
    row("ROS-LOAD", &["ROS-LOAD-MANIFEST"], ""),
    row(
        "ASDF",
        &[],
        "*CENTRAL-REGISTRY* OPERATE PERFORM OPERATION LOAD-OP COMPILE-OP LOAD-SOURCE-OP PREPARE-OP TEST-OP PROGRAM-OP COMPONENT \
         COMPONENT-NAME MODULE SYSTEM SOURCE-FILE CL-SOURCE-FILE STATIC-FILE DOC-FILE HTML-FILE",
    ),
    // What the symbols in descriptions of systems belong to.
    row("ASDF-USER", &[], ""),
    row("UIOP", &["UIOP/DRIVER"], "*COMMAND-LINE-ARGUMENTS*"),
    row("BORDEAUX-THREADS", &["BT"], ""),
    row("NET.DIDIERVERNA.ASDF-FLV", &["ASDF-FLV"], ""),
    row("QUICKLISP-CLIENT", &["QL", "QUICKLISP"], ""),
    row("CRAM-BULLET-WORLD-TUTORIAL", &["BTW-TUT"], ""),
    row("CRAM-BEGINNER-TUTORIAL", &["TUT"], ""),
    // What else CRAM's code names: `plans/lib` has what of it means something here.
    row("CRAM-WALKER", &["WALKER"], ""),
    row("CRAM-LANGUAGE-DESIGNATOR-SUPPORT", &["CPL-DESIG-SUPP"], ""),
    row("CRAM-USER", &["CPL-USER"], ""),
    row(
        "CRAM-EXECUTION-TRACE",
        &["CET"],
        "THROUGHOUT ENABLE-FLUENT-TRACING DISABLE-FLUENT-TRACING FLUENT-TRACING-ENABLED",
    ),
    row(
        "CRAM-URDF-PROJECTION-REASONING",
        &[
            "PROJ-REASONING",
            "CRAM-PR2-PROJECTION-REASONING",
            "PR2-PROJ-REASONING",
        ],
        "",
    ),
    row("CRAM-COMMON-DESIGNATORS", &["COMMON-DESIG"], ""),
    row("CRAM-DESIGNATOR-PROPERTIES", &["DESIG-PROPS"], ""),
    row("CRAM-CUT-PLANS", &["C-PLANS"], ""),
    row("CRAM-MATH", &["CMA"], ""),
    row("CRAM-PHYSICS-UTILS", &["PHYSICS-UTILS"], ""),
    row("CRAM-SEMANTIC-MAP", &["SEMANTIC-MAP", "SEM-MAP"], ""),
    row("CRAM-IK-INTERFACE", &["IK"], ""),
    row("CRAM-TASK-TREE-EXPORTER", &["TT-EXPORT"], ""),
    row("CRAM-BTR-VISIBILITY-COSTMAP", &["BTR-VIS-CM"], ""),
    row(
        "CRAM-BTR-SPATIAL-RELATIONS-COSTMAP",
        &["BTR-SPATIAL-CM"],
        "",
    ),
    row(
        "CRAM-ROBOT-POSE-GUASSIAN-COSTMAP",
        &["GAUSSIAN-COSTMAP"],
        "",
    ),
    row(
        "CRAM-OCCUPANCY-GRID-COSTMAP",
        &["OCCUPANCY-GRID-COSTMAP"],
        "",
    ),
    row("CRAM-SEMANTIC-MAP-COSTMAP", &["SEMANTIC-MAP-COSTMAP"], ""),
    row("CRAM-TESTS", &[], ""),
    row("CL-BULLET", &["BULLET"], "POSE POINTS AABB NAME RIGID-BODY"),
    row("CL-BULLET-VIS", &["BT-VIS"], ""),
    row("CL-URDF", &[], ""),
    row("SB-EXT", &[], ""),
    row("SB-KERNEL", &[], ""),
    row("LISP-UNIT", &[], ""),
    row("GISKARD", &[], ""),
    row("CRAM-CLOUD-LOGGER", &["CCL"], ""),
    row("JSON-PROLOG", &[], ""),
    row("ACTIONLIB", &[], ""),
    row("CRAM-SIMPLE-ACTIONLIB-CLIENT", &["ACTIONLIB-CLIENT"], ""),
    row("CRAM-MOVEIT", &[], ""),
    row("TURTLESIM", &[], ""),
    row("TURTLESIM-MSG", &[], ""),
    row("TURTLESIM-SRV", &[], ""),
    row("STD_SRVS-SRV", &[], ""),
    row("STD_MSGS-MSG", &[], ""),
    row("GEOMETRY_MSGS-MSG", &[], ""),
    row("SENSOR_MSGS-MSG", &[], ""),
    row(
        "PLANWRIGHT",
        &["PW"],
        "VISUALIZE-COSTMAP WITH-NOISE DEF-OBJECT-TYPE LOAD-OBJECT-TYPES DEFSWEEP SWEEP SWEEP-WORLD RUN-SWEEP-WORLD INJECTED-FAULTS ON-SURFACE-P UPRIGHT-P \
         ARMS-PARKED-P NOTHING-ON-FLOOR-P NO-PENETRATION-P \
         WITH-INJECTED-FAILURES DEFLESSON LESSON HINT TOUR TELL-SESSION PICKED-UP-P PUT-DOWN-P NO-COLLISION-P PERFORMED-P \
         AT-ONCE-P ENDED-WITH-P VALUE-NAMED VALUE-OF-CALL ROBOT-NEAR-P TURNED-P AXES-SHOWN-P SWEPT-P SWEEP-WORLD-P \
         MOTION-FAILED-P FAILURES-HANDLED-P EXPORT-EPISODE EXPORT-SQLITE READ-FACTS ASK",
    ),
];

/// Packages that inherit from packages other than `COMMON-LISP`: as in CRAM, where a package is CRAM's.
pub(crate) const USES: &[(&str, &[&str])] = &[
    ("ASDF-USER", &["ASDF", "UIOP"]),
    ("COMMON-LISP-USER", &["PLANWRIGHT"]),
    ("CRAM-UTILITIES", &["ALEXANDRIA"]),
    ("CRAM-PROLOG", &["CRAM-UTILITIES"]),
    (
        "CRAM-LANGUAGE-IMPLEMENTATION",
        &[
            "CRAM-WALKER",
            "CRAM-UTILITIES",
            "TRIVIAL-GARBAGE",
            "ALEXANDRIA",
        ],
    ),
    ("CRAM-USER", &["CRAM-LANGUAGE"]),
    ("CRAM-DESIGNATORS", &["CRAM-UTILITIES", "CRAM-PROLOG"]),
    (
        "CRAM-LANGUAGE-DESIGNATOR-SUPPORT",
        &["CRAM-LANGUAGE", "CRAM-DESIGNATORS"],
    ),
    ("CRAM-DESIGNATOR-SPECIFICATION", &["CRAM-PROLOG"]),
    (
        "CRAM-EXECUTIVE",
        &["CRAM-LANGUAGE", "CRAM-DESIGNATORS", "ALEXANDRIA"],
    ),
    (
        "CRAM-PROCESS-MODULES",
        &["CRAM-LANGUAGE", "CRAM-DESIGNATORS", "ALEXANDRIA"],
    ),
    (
        "CRAM-EXECUTION-TRACE",
        &[
            "CRAM-UTILITIES",
            "CRAM-LANGUAGE-IMPLEMENTATION",
            "ALEXANDRIA",
        ],
    ),
    (
        "CRAM-OCCASIONS-EVENTS",
        &[
            "CRAM-PROLOG",
            "CRAM-LANGUAGE-IMPLEMENTATION",
            "ALEXANDRIA",
            "CRAM-DESIGNATORS",
            "CRAM-UTILITIES",
        ],
    ),
    (
        "CRAM-PLAN-OCCASIONS-EVENTS",
        &["CRAM-OCCASIONS-EVENTS", "CRAM-PROLOG"],
    ),
    ("CRAM-COMMON-FAILURES", &["CRAM-LANGUAGE"]),
    (
        "CRAM-TF",
        &[
            "CRAM-DESIGNATORS",
            "CRAM-UTILITIES",
            "CRAM-PROLOG",
            "CL-TRANSFORMS-STAMPED",
            "CL-TRANSFORMS",
            "CRAM-ROBOT-INTERFACES",
        ],
    ),
    (
        "CRAM-ROBOT-INTERFACES",
        &["CRAM-PROLOG", "CRAM-DESIGNATORS"],
    ),
    ("CRAM-MANIPULATION-INTERFACES", &["CRAM-PROLOG"]),
    ("CRAM-OBJECT-INTERFACES", &["CRAM-PROLOG"]),
    ("CRAM-OBJECT-KNOWLEDGE", &["CRAM-PROLOG"]),
    (
        "CRAM-KNOWROB-PICK-PLACE",
        &["CRAM-OBJECT-INTERFACES", "CRAM-PROLOG"],
    ),
    ("JSON-PROLOG", &["CRAM-UTILITIES", "ROSLISP"]),
    ("CRAM-CLOUD-LOGGER", &["CRAM-LANGUAGE"]),
    ("CRAM-TESTS", &["LISP-UNIT"]),
    (
        "CRAM-ROBOT-POSE-GUASSIAN-COSTMAP",
        &["CRAM-DESIGNATORS", "CRAM-LOCATION-COSTMAP", "CRAM-PROLOG"],
    ),
    (
        "CRAM-OCCUPANCY-GRID-COSTMAP",
        &["CRAM-DESIGNATORS", "CRAM-LOCATION-COSTMAP", "CRAM-PROLOG"],
    ),
    (
        "CRAM-SEMANTIC-MAP-COSTMAP",
        &[
            "CRAM-PROLOG",
            "CRAM-LOCATION-COSTMAP",
            "CRAM-DESIGNATORS",
            "CRAM-SEMANTIC-MAP",
        ],
    ),
    ("CRAM-BTR-SPATIAL-RELATIONS-COSTMAP", &["CRAM-PROLOG"]),
    (
        "CRAM-BTR-VISIBILITY-COSTMAP",
        &["CRAM-PROLOG", "CRAM-BULLET-REASONING"],
    ),
    (
        "CRAM-COMMON-DESIGNATORS",
        &[
            "CRAM-PROLOG",
            "CRAM-DESIGNATORS",
            "CRAM-DESIGNATOR-SPECIFICATION",
        ],
    ),
    (
        "CRAM-LOCATION-COSTMAP",
        &[
            "CRAM-PROLOG",
            "CRAM-UTILITIES",
            "ROSLISP-UTILITIES",
            "ALEXANDRIA",
            "ROSLISP",
            "CRAM-TF",
            "CRAM-DESIGNATORS",
            "CL-TRANSFORMS-STAMPED",
        ],
    ),
    (
        "CRAM-BULLET-REASONING",
        &[
            "CRAM-PROLOG",
            "CL-BULLET",
            "CL-BULLET-VIS",
            "CRAM-UTILITIES",
            "CRAM-ROBOT-INTERFACES",
            "CL-TRANSFORMS-STAMPED",
            "CRAM-TF",
        ],
    ),
    // As in older versions, where it uses more.
    (
        "CRAM-BULLET-REASONING-UTILITIES",
        &[
            "CRAM-PROLOG",
            "CRAM-BULLET-REASONING",
            "CRAM-DESIGNATORS",
            "CRAM-UTILITIES",
            "CRAM-ROBOT-INTERFACES",
            "CRAM-TF",
        ],
    ),
    ("CRAM-BULLET-REASONING-BELIEF-STATE", &["CRAM-PROLOG"]),
    ("CRAM-URDF-PROJECTION", &["CRAM-PROLOG"]),
    ("CRAM-PR2-PROJECTION", &["CRAM-PROLOG"]),
    ("CRAM-URDF-PROJECTION-REASONING", &["CRAM-PROLOG"]),
    (
        "CRAM-PR2-PROCESS-MODULES",
        &["CRAM-PROLOG", "CRAM-PROCESS-MODULES", "CRAM-DESIGNATORS"],
    ),
    (
        "CRAM-PR2-ENVIRONMENT-MANIPULATION",
        &["CRAM-PROLOG", "CRAM-EXECUTIVE", "CRAM-DESIGNATORS"],
    ),
    (
        "CRAM-MOBILE-PICK-PLACE-PLANS",
        &["CRAM-PROLOG", "CRAM-COMMON-FAILURES"],
    ),
    (
        "CRAM-PR2-FETCH-DELIVER-PLANS",
        &["CRAM-PROLOG", "CRAM-COMMON-FAILURES"],
    ),
    (
        "CRAM-PICK-PLACE-TUTORIAL",
        &["CRAM-PROLOG", "CRAM-COMMON-FAILURES", "PLANWRIGHT"],
    ),
    ("CRAM-BULLET-WORLD-TUTORIAL", &["CRAM-PROLOG"]),
    ("CL-BULLET-VIS", &["CL-BULLET"]),
    ("CRAM-TASK-TREE-EXPORTER", &["CRAM-LANGUAGE-IMPLEMENTATION"]),
    (
        "CRAM-SEMANTIC-MAP",
        &["CRAM-PLAN-OCCASIONS-EVENTS", "CRAM-OCCASIONS-EVENTS"],
    ),
    ("CRAM-CUT-PLANS", &["CRAM-PROLOG"]),
    ("CRAM-MATH", &["ALEXANDRIA"]),
];

/// Symbols of one package that another one imports, and exports if the flag is true.
pub(crate) const IMPORTS: &[(&str, &str, &str, bool)] = &[
    (
        "CRAM-PICK-PLACE-TUTORIAL",
        "CRAM-DESIGNATORS",
        "A AN ALL EQUATE DESIG-PROP-VALUE REFERENCE CURRENT-DESIG MAKE-DESIGNATOR NEXT-SOLUTION",
        false,
    ),
    ("PLANWRIGHT", "CRAM-DESIGNATORS", "DEF-ACTION", true),
    // Programs leave by the names that SBCL has for it.
    ("SB-EXT", "PLANWRIGHT", "QUIT EXIT", true),
    ("UIOP", "PLANWRIGHT", "QUIT", true),
    // What sweeps and lessons, which are written in Lisp, ask of the session.
    (
        "PLANWRIGHT",
        "PLAN-SYSTEM",
        "%SWEEP-BEGIN %SWEEP-RUN-BEGINS %SWEEP-RUN-ENDS %INJECT %INJECT-SCHEDULE %END-FAULTS %INJECTED-FAULTS \
         %BEGIN-FAULTS %SWEEP-RECORD %RESTORE-QUIETLY %SWEEP-VARYING %MUTE-OUTPUT \
         %SWEEP-UNIT %SWEEP-OVERRIDE %SWEEP-SET %SWEEP-NOTE %SWEEP-FORGET %NORMAL-DEVIATE \
         %SWEEP-KNOWN %TYPE-OF-OBJECT %SWEEP-KITCHEN %SWEEP-OVERRIDES %NEW-KITCHEN %OPEN-IF-FREE %KITCHEN-PARAMETER-P \
         %SWEEP-SUMMARY %SURFACE-POINT %PLACE-ON-SURFACE %PLACE-ON-FLOOR %SETTLE-WORLD \
         %OBJECTS-OF-WORLD %TILT %OBSTACLE-P %ON-FLOOR-P %NO-PENETRATION-P \
         %DEEDS %BEGIN-DEEDS %LESSON-NAMES %TITLE-OF-LESSON %LESSON-PROGRESS %KEEP-PROGRESS %AXES",
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
        "A AN ALL DEF-ACTION DESIG-PROP-VALUE CURRENT-DESIG",
        false,
    ),
    (
        "CRAM-MOBILE-PICK-PLACE-PLANS",
        "CRAM-EXECUTIVE",
        "PERFORM",
        false,
    ),
    (
        "CRAM-PR2-FETCH-DELIVER-PLANS",
        "CRAM-DESIGNATORS",
        "A AN ALL DEF-ACTION DESIG-PROP-VALUE CURRENT-DESIG",
        false,
    ),
    (
        "CRAM-PR2-FETCH-DELIVER-PLANS",
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
        "CRAM-PICK-PLACE-TUTORIAL",
        "CRAM-PR2-PROCESS-MODULES",
        "WITH-REAL-ROBOT",
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
        "CRAM-OCCASIONS-EVENTS",
        "CRAM-EXECUTION-TRACE",
        "THROUGHOUT",
        true,
    ),
    (
        "CRAM-MANIPULATION-INTERFACES",
        "CRAM-OBJECT-INTERFACES",
        "DEF-OBJECT-TYPE-TO-GRIPPER-TRANSFORMS",
        true,
    ),
];

/// Packages that hold no more than what published code names of a system that is not here.
pub const STAND_INS: &[&str] = &[
    "ACTIONLIB",
    "CL-BULLET",
    "CL-BULLET-VIS",
    "CL-URDF",
    "CRAM-BTR-SPATIAL-RELATIONS-COSTMAP",
    "CRAM-BTR-VISIBILITY-COSTMAP",
    "CRAM-CLOUD-LOGGER",
    "CRAM-CUT-PLANS",
    "CRAM-IK-INTERFACE",
    "CRAM-KNOWROB-PICK-PLACE",
    "CRAM-MOVEIT",
    "CRAM-OCCUPANCY-GRID-COSTMAP",
    "CRAM-ROBOT-POSE-GUASSIAN-COSTMAP",
    "CRAM-SEMANTIC-MAP",
    "CRAM-SEMANTIC-MAP-COSTMAP",
    "CRAM-SIMPLE-ACTIONLIB-CLIENT",
    "CRAM-TASK-TREE-EXPORTER",
    "CRAM-TESTS",
    "CRAM-USER",
    "CRAM-WALKER",
    "GEOMETRY_MSGS-MSG",
    "GISKARD",
    "JSON-PROLOG",
    "LISP-UNIT",
    "SB-EXT",
    "SB-KERNEL",
    "SENSOR_MSGS-MSG",
    "STD_MSGS-MSG",
    "STD_SRVS-SRV",
    "TURTLESIM",
    "TURTLESIM-MSG",
    "TURTLESIM-SRV",
];
