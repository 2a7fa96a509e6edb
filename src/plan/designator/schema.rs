//! What types of actions and motions there are, and which keys they take.
//!
//! The one table that resolution, load-time checks, completion and help read. A type may
//! have several rows, told apart by the keys that are required (`opening` a gripper, or a
//! container).

use crate::closest_name::closest_name;

use super::value::Class;

/// What kind of value a key takes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Kind {
    /// A location designator.
    Location,
    /// A location designator, or a pose, which stands for the location there.
    Place,
    /// An object designator.
    Object,
    /// An object designator or a list of them.
    Objects,
    /// A real number.
    Number,
    /// A keyword or a list of keywords.
    Keywords,
    /// A keyword.
    Keyword,
    /// A symbol.
    Symbol,
    /// A string.
    Text,
    /// A list.
    List,
    /// A pose, or a list of poses.
    Poses,
    /// A pose with a frame.
    PoseStamped,
    /// A keyword or an object designator.
    KeywordOrObject,
    /// An action designator.
    Action,
    /// Anything.
    Anything,
}

/// One key.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Key {
    /// The name in upper case.
    pub(crate) name: &'static str,
    /// Other names for it.
    pub(crate) aliases: &'static [&'static str],
    /// What it takes.
    pub(crate) kind: Kind,
    /// Must it be there?
    pub(crate) is_required: bool,
    /// What it means.
    pub(crate) doc: &'static str,
}

/// One type of action or motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TypeRow {
    /// Action or motion.
    pub(crate) class: Class,
    /// The type's name in upper case.
    pub(crate) name: &'static str,
    /// Other names for it.
    pub(crate) aliases: &'static [&'static str],
    /// The plan function in package `PP-PLANS`, or the name of the motion.
    pub(crate) plan: &'static str,
    /// The keys that it reads.
    pub(crate) keys: &'static [Key],
    /// Of these keys at least one must be there; none if the list is empty.
    pub(crate) one_of: &'static [&'static str],
    /// What it does.
    pub(crate) doc: &'static str,
}

impl TypeRow {
    /// Is this the type's name or another name for it?
    pub(crate) fn is_named(&self, name: &str) -> bool {
        self.name == name || self.aliases.contains(&name)
    }

    /// The key of that name.
    pub(crate) fn key(&self, name: &str) -> Option<&'static Key> {
        self.keys
            .iter()
            .find(|k| k.name == name || k.aliases.contains(&name))
    }
}

const fn required(name: &'static str, kind: Kind, doc: &'static str) -> Key {
    Key {
        name,
        aliases: &[],
        kind,
        is_required: true,
        doc,
    }
}

const fn optional(name: &'static str, kind: Kind, doc: &'static str) -> Key {
    Key {
        name,
        aliases: &[],
        kind,
        is_required: false,
        doc,
    }
}

const fn alias(key: Key, aliases: &'static [&'static str]) -> Key {
    Key { aliases, ..key }
}

const fn action(
    name: &'static str,
    aliases: &'static [&'static str],
    plan: &'static str,
    keys: &'static [Key],
    doc: &'static str,
) -> TypeRow {
    TypeRow {
        class: Class::Action,
        name,
        aliases,
        plan,
        keys,
        one_of: &[],
        doc,
    }
}

const fn motion(
    name: &'static str,
    aliases: &'static [&'static str],
    keys: &'static [Key],
    doc: &'static str,
) -> TypeRow {
    TypeRow {
        class: Class::Motion,
        name,
        aliases,
        plan: name,
        keys,
        one_of: &[],
        doc,
    }
}

const fn one_of(row: TypeRow, keys: &'static [&'static str]) -> TypeRow {
    TypeRow {
        one_of: keys,
        ..row
    }
}

const TARGET: Key = alias(
    required("TARGET", Kind::Place, "where to"),
    &["LOCATION", "POSE"],
);
const LOOK_TARGET: Key = alias(
    optional("TARGET", Kind::Place, "the location to look at"),
    &["LOCATION", "POSE"],
);
const FRAME: Key = optional("FRAME", Kind::Text, "the frame to look at");
const DIRECTION: Key = optional(
    "DIRECTION",
    Kind::Keywords,
    "forward, left, right, up or down",
);
const LOOK_OBJECT: Key = optional("OBJECT", Kind::Object, "the object to look at");
const CAMERA: Key = optional("CAMERA", Kind::Keywords, "the camera; the head has one");
const GRIPPER: Key = alias(
    required("GRIPPER", Kind::Keywords, "left, right, or both"),
    &["ARM", "ARMS"],
);
const ARM: Key = alias(optional("ARM", Kind::Keywords, "left or right"), &["ARMS"]);
const LEFT_POSES: Key = optional(
    "LEFT-POSES",
    Kind::Poses,
    "poses of the left hand, in order",
);
const RIGHT_POSES: Key = optional(
    "RIGHT-POSES",
    Kind::Poses,
    "poses of the right hand, in order",
);
const EFFORT: Key = optional("EFFORT", Kind::Number, "the force of the grip (N)");
const JOINT_ANGLE: Key = alias(
    required("JOINT-ANGLE", Kind::Number, "the height of the torso (m)"),
    &["POSITION"],
);
const LEFT_CONFIGURATION: Key = alias(
    optional(
        "LEFT-CONFIGURATION",
        Kind::List,
        "seven joint angles of the left arm (rad)",
    ),
    &["LEFT-JOINT-STATES"],
);
const RIGHT_CONFIGURATION: Key = alias(
    optional(
        "RIGHT-CONFIGURATION",
        Kind::List,
        "seven joint angles of the right arm (rad)",
    ),
    &["RIGHT-JOINT-STATES"],
);
const COLLISION_MODE: Key = optional(
    "COLLISION-MODE",
    Kind::Keywords,
    "what the arm may touch: avoid-all, allow-hand, allow-all",
);
const CONTAINER: Key = required("OBJECT", Kind::Object, "the container");
const DISTANCE: Key = optional("DISTANCE", Kind::Number, "how far to open (m)");
const HAND_POSES: &[Key] = &[LEFT_POSES, RIGHT_POSES, COLLISION_MODE];
const HANDS: &[&str] = &["LEFT-POSES", "RIGHT-POSES"];

/// All types, actions first.
pub(crate) static TYPES: &[TypeRow] = &[
    action(
        "GOING",
        &["NAVIGATING"],
        "GO-TO-TARGET",
        &[TARGET],
        "Drives the base to a location.",
    ),
    action(
        "DETECTING",
        &["PERCEIVING"],
        "PERCEIVE",
        &[
            required("OBJECT", Kind::Object, "a description of the object"),
            CAMERA,
        ],
        "Looks for an object in the camera's picture; its value describes what was found.",
    ),
    one_of(
        action(
            "LOOKING",
            &[],
            "LOOK-AT",
            &[LOOK_TARGET, FRAME, DIRECTION, LOOK_OBJECT, CAMERA],
            "Turns the head.",
        ),
        &["TARGET", "FRAME", "DIRECTION", "OBJECT"],
    ),
    action(
        "MOVING-TORSO",
        &[],
        "MOVE-TORSO",
        &[JOINT_ANGLE],
        "Lifts or lowers the torso.",
    ),
    action(
        "PARKING-ARMS",
        &["PARKING"],
        "PARKING-ARMS",
        &[
            alias(
                optional("ARMS", Kind::Keywords, "left, right, or both"),
                &["ARM"],
            ),
            optional("NOT-NECK", Kind::Anything, "ignored"),
        ],
        "Brings the arms into the posture for carrying.",
    ),
    one_of(
        action(
            "POSITIONING-ARM",
            &["POSITIONING-ARMS"],
            "POSITION-ARMS",
            &[LEFT_CONFIGURATION, RIGHT_CONFIGURATION],
            "Moves the joints of the arms.",
        ),
        &["LEFT-CONFIGURATION", "RIGHT-CONFIGURATION"],
    ),
    one_of(
        action(
            "REACHING",
            &["APPROACHING"],
            "REACH",
            HAND_POSES,
            "Moves hands to where they can grasp from.",
        ),
        HANDS,
    ),
    one_of(
        action(
            "RETRACTING",
            &[],
            "RETRACT",
            HAND_POSES,
            "Moves hands away from what they have let go.",
        ),
        HANDS,
    ),
    one_of(
        action(
            "GRASPING",
            &[],
            "GRASP",
            HAND_POSES,
            "Moves open hands around an object.",
        ),
        HANDS,
    ),
    one_of(
        action(
            "LIFTING",
            &[],
            "LIFT",
            HAND_POSES,
            "Moves hands with what they hold.",
        ),
        HANDS,
    ),
    one_of(
        action(
            "PUTTING",
            &[],
            "PUT",
            HAND_POSES,
            "Lowers held objects until something carries them.",
        ),
        HANDS,
    ),
    one_of(
        action(
            "PULLING",
            &[],
            "MANIPULATE",
            HAND_POSES,
            "Moves hands that pull.",
        ),
        HANDS,
    ),
    one_of(
        action(
            "PUSHING",
            &[],
            "MANIPULATE",
            HAND_POSES,
            "Moves hands that push.",
        ),
        HANDS,
    ),
    action(
        "RELEASING",
        &[],
        "RELEASE",
        &[GRIPPER],
        "Opens a hand and lets go.",
    ),
    action(
        "OPENING",
        &["OPENING-GRIPPER"],
        "OPEN-GRIPPER",
        &[GRIPPER],
        "Opens a hand.",
    ),
    action(
        "CLOSING",
        &["CLOSING-GRIPPER"],
        "CLOSE-GRIPPER",
        &[GRIPPER],
        "Closes a hand.",
    ),
    action(
        "OPENING",
        &[],
        "OPEN-CONTAINER",
        &[CONTAINER, ARM, DISTANCE],
        "Opens a drawer or a door.",
    ),
    action(
        "CLOSING",
        &[],
        "CLOSE-CONTAINER",
        &[CONTAINER, ARM, DISTANCE],
        "Closes a drawer or a door.",
    ),
    action(
        "SETTING-GRIPPER",
        &[],
        "SET-GRIPPER-TO-POSITION",
        &[
            GRIPPER,
            required(
                "POSITION",
                Kind::Number,
                "how far the fingers are apart (m)",
            ),
        ],
        "Opens a hand a little.",
    ),
    action(
        "GRIPPING",
        &[],
        "GRIP",
        &[
            GRIPPER,
            EFFORT,
            optional("OBJECT", Kind::Object, "what is to be held"),
        ],
        "Closes a hand on an object.",
    ),
    action(
        "PICKING-UP",
        &[],
        "PICK-UP",
        &[
            required("OBJECT", Kind::Object, "an object that was detected"),
            ARM,
            optional("GRASP", Kind::Keywords, "the side to grasp from"),
            optional("LEFT-GRASP", Kind::Keywords, "the side for the left hand"),
            optional("RIGHT-GRASP", Kind::Keywords, "the side for the right hand"),
        ],
        "Grasps a detected object and lifts it.",
    ),
    action(
        "PLACING",
        &[],
        "PLACE",
        &[
            optional(
                "OBJECT",
                Kind::Object,
                "what to put down; else what the arm holds",
            ),
            ARM,
            alias(
                optional(
                    "TARGET",
                    Kind::Place,
                    "where to; else where it was detected",
                ),
                &["LOCATION", "POSE"],
            ),
        ],
        "Puts down a held object.",
    ),
    action(
        "TURNING-TOWARDS",
        &[],
        "TURN-TOWARDS",
        &[TARGET],
        "Looks at a location, and turns the base if the neck does not reach.",
    ),
    action(
        "SEARCHING",
        &[],
        "SEARCH",
        &[
            required("OBJECT", Kind::Object, "a description of the object"),
            alias(
                required("LOCATION", Kind::Place, "where it may be"),
                &["TARGET"],
            ),
        ],
        "Drives to where the object may be seen from and detects it.",
    ),
    action(
        "FETCHING",
        &[],
        "FETCH",
        &[
            required("OBJECT", Kind::Object, "an object that was detected"),
            ARM,
            optional("GRASP", Kind::Keywords, "the side to grasp from"),
            optional("ROBOT-LOCATION", Kind::Place, "where the robot is to stand"),
            optional("PICK-UP-ACTION", Kind::Action, "how to pick up"),
        ],
        "Drives to an object and picks it up.",
    ),
    action(
        "DELIVERING",
        &[],
        "DELIVER",
        &[
            required("OBJECT", Kind::Object, "what the robot holds"),
            ARM,
            alias(required("TARGET", Kind::Place, "where to"), &["LOCATION"]),
            optional("ROBOT-LOCATION", Kind::Place, "where the robot is to stand"),
            optional("PLACE-ACTION", Kind::Action, "how to put down"),
        ],
        "Drives to a place and puts a held object down there.",
    ),
    action(
        "TRANSPORTING",
        &[],
        "TRANSPORT",
        &[
            required("OBJECT", Kind::Object, "a description of the object"),
            optional("LOCATION", Kind::Place, "where it may be"),
            required("TARGET", Kind::Place, "where to"),
            ARM,
            optional("GRASP", Kind::Keywords, "the side to grasp from"),
        ],
        "Searches, fetches and delivers an object.",
    ),
    action(
        "ACCESSING",
        &[],
        "ACCESS",
        &[
            required("LOCATION", Kind::Location, "a location in a container"),
            ARM,
            DISTANCE,
        ],
        "Opens the container that a location is in.",
    ),
    action(
        "SEALING",
        &[],
        "SEAL",
        &[
            required("LOCATION", Kind::Location, "a location in a container"),
            ARM,
            DISTANCE,
        ],
        "Closes the container that a location is in.",
    ),
    action(
        "WAITING",
        &[],
        "WAIT",
        &[required("DURATION", Kind::Number, "how long (s)")],
        "Waits.",
    ),
    motion("GOING", &[], &[TARGET], "Drives the base to a location."),
    motion(
        "MOVING-TORSO",
        &[],
        &[JOINT_ANGLE],
        "Lifts or lowers the torso.",
    ),
    one_of(
        motion(
            "LOOKING",
            &[],
            &[LOOK_TARGET, FRAME, DIRECTION, LOOK_OBJECT, CAMERA],
            "Turns the head.",
        ),
        &["TARGET", "FRAME", "DIRECTION", "OBJECT"],
    ),
    motion(
        "DETECTING",
        &[],
        &[required(
            "OBJECT",
            Kind::Objects,
            "a description of the object",
        )],
        "Looks for an object in the camera's picture as it is.",
    ),
    motion("OPENING", &["OPENING-GRIPPER"], &[GRIPPER], "Opens a hand."),
    motion(
        "CLOSING",
        &["CLOSING-GRIPPER"],
        &[GRIPPER],
        "Closes a hand.",
    ),
    motion(
        "GRIPPING",
        &[],
        &[
            GRIPPER,
            EFFORT,
            optional("OBJECT", Kind::Object, "what is to be held"),
        ],
        "Closes a hand on an object.",
    ),
    motion(
        "MOVING-GRIPPER-JOINT",
        &[],
        &[
            GRIPPER,
            alias(
                required(
                    "JOINT-ANGLE",
                    Kind::Number,
                    "how far the fingers are apart (m)",
                ),
                &["POSITION"],
            ),
            EFFORT,
        ],
        "Opens a hand a little.",
    ),
    one_of(
        motion(
            "MOVING-TCP",
            &[],
            &[
                alias(
                    optional("LEFT-TARGET", Kind::Place, "where the left hand goes"),
                    &["LEFT-POSE"],
                ),
                alias(
                    optional("RIGHT-TARGET", Kind::Place, "where the right hand goes"),
                    &["RIGHT-POSE"],
                ),
                COLLISION_MODE,
                optional("COLLISION-OBJECT-A", Kind::Anything, "ignored"),
                optional("COLLISION-OBJECT-B", Kind::Anything, "ignored"),
                optional("COLLISION-OBJECT-B-LINK", Kind::Anything, "ignored"),
            ],
            "Moves hands to poses.",
        ),
        &["LEFT-TARGET", "RIGHT-TARGET"],
    ),
    motion(
        "PUTTING",
        &[],
        &[required("ARM", Kind::Keywords, "left or right"), TARGET],
        "Lowers a held object until something carries it.",
    ),
    one_of(
        motion(
            "MOVING-ARM-JOINTS",
            &[],
            &[LEFT_CONFIGURATION, RIGHT_CONFIGURATION],
            "Moves the joints of the arms.",
        ),
        &["LEFT-CONFIGURATION", "RIGHT-CONFIGURATION"],
    ),
    motion(
        "MOVING-WITH-CONSTRAINTS",
        &[],
        &[optional("CONSTRAINTS", Kind::Anything, "ignored")],
        "Does nothing in simulation.",
    ),
    motion(
        "WAITING",
        &[],
        &[required("DURATION", Kind::Number, "how long (s)")],
        "Waits.",
    ),
];

/// Keys that every designator of a class takes, beside `:type`.
pub(crate) const COMMON_KEYS: &[&str] = &["TYPE", "GOAL", "FOR", "DESCRIPTION"];

/// Keys of object designators.
pub(crate) static OBJECT_KEYS: &[Key] = &[
    optional("TYPE", Kind::Keyword, "the type"),
    optional("NAME", Kind::Symbol, "the name in the world"),
    optional("URDF-NAME", Kind::Symbol, "the name of a link"),
    optional("PART-OF", Kind::Keyword, "what it is a part of"),
    optional("COLOR", Kind::Anything, "the colour"),
    optional("SIZE", Kind::Anything, "the size"),
    optional("POSE", Kind::Anything, "where it was seen"),
    optional("LOCATION", Kind::Anything, "where it is"),
    optional("CAD-MODEL", Kind::Anything, "a model of its shape"),
];

/// Keys of location designators.
pub(crate) static LOCATION_KEYS: &[Key] = &[
    optional("POSE", Kind::PoseStamped, "the pose itself"),
    optional("OBJECT", Kind::Object, "the object to reach or see"),
    optional("ARM", Kind::Keyword, "the arm that is to reach"),
    optional("OF", Kind::Anything, "the object whose location it is"),
    optional("ON", Kind::Anything, "the surface it is on"),
    optional("IN", Kind::Anything, "the container it is in"),
    optional("ABOVE", Kind::Anything, "what it is above of"),
    optional("LOCATION", Kind::Anything, "the location to reach or see"),
    optional("REACHABLE-FOR", Kind::Anything, "who is to reach it"),
    optional("VISIBLE-FOR", Kind::Anything, "who is to see it"),
    optional("SIDE", Kind::Anything, "left, right, front or back"),
    optional("RANGE", Kind::Anything, "how far away at most (m)"),
    optional("RANGE-INVERT", Kind::Anything, "how far away at least (m)"),
    optional(
        "CENTERED-WITH-PADDING",
        Kind::Anything,
        "how far from the edges (m)",
    ),
    optional("LEFT-OF", Kind::Anything, "what it is left of"),
    optional("RIGHT-OF", Kind::Anything, "what it is right of"),
    optional("IN-FRONT-OF", Kind::Anything, "what it is in front of"),
    optional("BEHIND", Kind::Anything, "what it is behind of"),
    optional("NEAR", Kind::Anything, "what it is near to"),
    optional("FAR-FROM", Kind::Anything, "what it is far from"),
    optional("FOR", Kind::Anything, "what it is for"),
    optional("CONTEXT", Kind::Anything, "what it is used for"),
    optional(
        "OBJECT-COUNT",
        Kind::Anything,
        "how many objects are to fit",
    ),
    optional("TYPE", Kind::Anything, "ignored"),
];

/// The rows of a type of that name or alias.
pub(crate) fn rows(class: Class, name: &str) -> impl Iterator<Item = &'static TypeRow> {
    TYPES
        .iter()
        .filter(move |row| row.class == class && row.is_named(name))
}

/// All type names of a class, with aliases.
pub(crate) fn type_names(class: Class) -> impl Iterator<Item = &'static str> {
    TYPES
        .iter()
        .filter(move |row| row.class == class)
        .flat_map(|row| std::iter::once(row.name).chain(row.aliases.iter().copied()))
}

/// All key names of a row, with aliases.
pub(crate) fn key_names(row: &'static TypeRow) -> impl Iterator<Item = &'static str> {
    row.keys
        .iter()
        .flat_map(|key| std::iter::once(key.name).chain(key.aliases.iter().copied()))
}

/// The name of a type that was probably meant.
pub(crate) fn nearest_type(class: Class, name: &str) -> Option<&'static str> {
    let mut seen = Vec::new();
    for known in type_names(class) {
        if !seen.contains(&known) {
            seen.push(known);
        }
    }
    closest_name(name, seen)
}

#[cfg(test)]
mod tests {
    use crate::plan::designator::schema::*;

    #[test]
    fn every_alternative_of_a_type_is_one_of_its_keys() {
        for row in TYPES {
            for name in row.one_of {
                assert!(row.key(name).is_some(), "{} {name}", row.name);
            }
        }
    }

    #[test]
    fn no_key_name_stands_for_two_keys_of_a_type() {
        for row in TYPES {
            let mut names: Vec<&str> = key_names(row).collect();
            names.sort_unstable();
            let count = names.len();
            names.dedup();
            assert_eq!(names.len(), count, "{}", row.name);
        }
    }

    #[test]
    fn a_mistyped_type_finds_its_neighbour() {
        assert_eq!(nearest_type(Class::Action, "PICKNG-UP"), Some("PICKING-UP"));
        assert_eq!(nearest_type(Class::Action, "DANCING-WILDLY"), None);
    }
}
