//! The descriptions that come with planwright, as texts.

/// The PR2: links, joints and shapes.
pub const PR2_URDF: &str = include_str!("pr2.urdf");

/// The roles of the PR2's links and joints.
pub const PR2_DESCRIPTION: &str = include_str!("pr2.sexp");

/// Fetch: links, joints and shapes.
pub const FETCH_URDF: &str = include_str!("fetch.urdf");

/// The roles of Fetch's links and joints.
pub const FETCH_DESCRIPTION: &str = include_str!("fetch.sexp");

/// The HSR: links, joints and shapes.
pub const HSR_URDF: &str = include_str!("hsr.urdf");

/// The roles of the HSR's links and joints.
pub const HSR_DESCRIPTION: &str = include_str!("hsr.sexp");

/// A robot that comes with planwright.
#[derive(Clone, Copy, Debug)]
pub struct Robot {
    /// What `--robot` and `use-robot` call it.
    pub name: &'static str,
    /// Its URDF: links, joints and shapes.
    pub urdf: &'static str,
    /// The roles of its links and joints.
    pub description: &'static str,
}

/// The robots that come with planwright, the usual one first.
pub const ROBOTS: &[Robot] = &[
    Robot {
        name: "pr2",
        urdf: PR2_URDF,
        description: PR2_DESCRIPTION,
    },
    Robot {
        name: "fetch",
        urdf: FETCH_URDF,
        description: FETCH_DESCRIPTION,
    },
    Robot {
        name: "hsr",
        urdf: HSR_URDF,
        description: HSR_DESCRIPTION,
    },
];

/// The robot of that name, in letters of any case.
pub fn robot_named(name: &str) -> Option<&'static Robot> {
    ROBOTS
        .iter()
        .find(|robot| robot.name.eq_ignore_ascii_case(name))
}

/// The kitchen; its root is the map frame.
pub const KITCHEN_URDF: &str = include_str!("kitchen.urdf");

/// What the furniture of the kitchen is for.
pub const KITCHEN_DESCRIPTION: &str = include_str!("kitchen.sexp");

/// The types of objects.
pub const OBJECTS: &str = include_str!("objects.sexp");

/// The grasps of the types of objects.
pub const GRASPS: &str = include_str!("grasps.sexp");

/// How robot, furniture and objects look.
pub const LOOKS: &str = include_str!("looks.sexp");
