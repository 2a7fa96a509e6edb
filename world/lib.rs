//! The descriptions that come with planwright, as texts.

/// The PR2: links, joints and shapes.
pub const PR2_URDF: &str = include_str!("pr2.urdf");

/// The roles of the PR2's links and joints.
pub const PR2_DESCRIPTION: &str = include_str!("pr2.sexp");

/// Fetch: links, joints and shapes.
pub const FETCH_URDF: &str = include_str!("fetch.urdf");

/// The roles of Fetch's links and joints.
pub const FETCH_DESCRIPTION: &str = include_str!("fetch.sexp");

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
