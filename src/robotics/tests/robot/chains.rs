//! Chains of joints with the dimensions of real arms, as URDFs without shapes.

use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write;

use crate::robot::{KinematicTree, LinkId};

/// One joint: kind, origin's position, its roll, pitch and yaw, axis, lower and upper limit.
pub(super) type Row = (&'static str, [f64; 3], [f64; 3], [f64; 3], [f64; 2]);

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];
const O: [f64; 3] = [0.0; 3];

/// The URDF of a chain `link0`, `link1`, ….
pub(super) fn chain_urdf(rows: &[Row]) -> String {
    let mut text = String::from("<robot name=\"chain\"><link name=\"link0\"/>");
    for (i, (kind, [x, y, z], [roll, pitch, yaw], [a, b, c], [lower, upper])) in
        rows.iter().enumerate()
    {
        let _ = write!(
            text,
            "<link name=\"link{}\"/><joint name=\"joint{i}\" type=\"{kind}\">\
             <parent link=\"link{i}\"/><child link=\"link{}\"/>\
             <origin xyz=\"{x} {y} {z}\" rpy=\"{roll} {pitch} {yaw}\"/><axis xyz=\"{a} {b} {c}\"/>",
            i + 1,
            i + 1
        );
        if *kind == "revolute" || *kind == "prismatic" {
            let _ = write!(
                text,
                "<limit lower=\"{lower}\" upper=\"{upper}\" effort=\"1\" velocity=\"1\"/>"
            );
        }
        text.push_str("</joint>");
    }
    text.push_str("</robot>");
    text
}

/// A chain with its first and its last link.
pub(super) fn chain(rows: &[Row]) -> (KinematicTree, LinkId, LinkId) {
    read(&chain_urdf(rows), "link0", &format!("link{}", rows.len()))
}

/// The tree of a text, and two of its links.
pub(super) fn read(text: &str, base: &str, tip: &str) -> (KinematicTree, LinkId, LinkId) {
    let tree = KinematicTree::from_urdf(text, "chain.urdf").expect("the chain is right");
    let link = |name: &str| tree.link_named(name).expect("the chain has the link");
    let (base, tip) = (link(base), link(tip));
    (tree, base, tip)
}

pub(super) const FETCH: &[Row] = &[
    ("revolute", [0.12, 0.0, 0.349], O, Z, [-1.606, 1.606]),
    ("revolute", [0.117, 0.0, 0.06], O, Y, [-1.221, 1.518]),
    ("continuous", [0.219, 0.0, 0.0], O, X, [0.0; 2]),
    ("revolute", [0.133, 0.0, 0.0], O, Y, [-2.251, 2.251]),
    ("continuous", [0.197, 0.0, 0.0], O, X, [0.0; 2]),
    ("revolute", [0.1245, 0.0, 0.0], O, Y, [-2.16, 2.16]),
    ("continuous", [0.1385, 0.0, 0.0], O, X, [0.0; 2]),
    ("fixed", [0.166, 0.0, 0.0], O, X, [0.0; 2]),
];

const TORSO: Row = ("prismatic", [-0.087, 0.0, 0.377], O, Z, [0.0, 0.386]);

pub(super) fn fetch_with_torso() -> Vec<Row> {
    [&[TORSO], FETCH].concat()
}

pub(super) const UR5: &[Row] = &[
    ("revolute", [0.0, 0.0, 0.089], O, Z, [-2.0 * PI, 2.0 * PI]),
    (
        "revolute",
        [0.0, 0.136, 0.0],
        [0.0, FRAC_PI_2, 0.0],
        Y,
        [-2.0 * PI, 2.0 * PI],
    ),
    ("revolute", [0.0, -0.12, 0.425], O, Y, [-PI, PI]),
    (
        "revolute",
        [0.0, 0.0, 0.392],
        [0.0, FRAC_PI_2, 0.0],
        Y,
        [-2.0 * PI, 2.0 * PI],
    ),
    ("revolute", [0.0, 0.093, 0.0], O, Z, [-2.0 * PI, 2.0 * PI]),
    ("revolute", [0.0, 0.0, 0.095], O, Y, [-2.0 * PI, 2.0 * PI]),
    (
        "fixed",
        [0.0, 0.082, 0.0],
        [0.0, 0.0, FRAC_PI_2],
        X,
        [0.0; 2],
    ),
];

pub(super) const PANDA: &[Row] = &[
    ("revolute", [0.0, 0.0, 0.333], O, Z, [-2.9, 2.9]),
    ("revolute", O, [-FRAC_PI_2, 0.0, 0.0], Z, [-1.76, 1.76]),
    (
        "revolute",
        [0.0, -0.316, 0.0],
        [FRAC_PI_2, 0.0, 0.0],
        Z,
        [-2.9, 2.9],
    ),
    (
        "revolute",
        [0.0825, 0.0, 0.0],
        [FRAC_PI_2, 0.0, 0.0],
        Z,
        [-3.07, -0.07],
    ),
    (
        "revolute",
        [-0.0825, 0.384, 0.0],
        [-FRAC_PI_2, 0.0, 0.0],
        Z,
        [-2.9, 2.9],
    ),
    ("revolute", O, [FRAC_PI_2, 0.0, 0.0], Z, [-0.018, 3.75]),
    (
        "revolute",
        [0.088, 0.0, 0.0],
        [FRAC_PI_2, 0.0, 0.0],
        Z,
        [-2.9, 2.9],
    ),
    ("fixed", [0.0, 0.0, 0.107], O, X, [0.0; 2]),
];

pub(super) const STRETCH: &[Row] = &[
    (
        "prismatic",
        [-0.037, 0.167, 0.0],
        [0.0, 0.0, FRAC_PI_2],
        Z,
        [0.0, 1.1],
    ),
    (
        "prismatic",
        [-0.25, 0.0, 0.0],
        [FRAC_PI_2, 0.0, -FRAC_PI_2],
        Z,
        [0.0, 0.13],
    ),
    ("prismatic", [0.0, 0.0, 0.013], O, Z, [0.0, 0.13]),
    ("prismatic", [0.0, 0.0, 0.013], O, Z, [0.0, 0.13]),
    ("prismatic", [0.0, 0.0, 0.013], O, Z, [0.0, 0.13]),
    (
        "revolute",
        [0.083, -0.03, 0.0],
        [FRAC_PI_2, 0.0, 0.0],
        Z,
        [-1.75, 4.0],
    ),
    (
        "revolute",
        [0.0, -0.02, -0.05],
        [FRAC_PI_2, 0.0, 0.0],
        Z,
        [-1.57, 0.56],
    ),
    (
        "revolute",
        [-0.02, 0.0, 0.02],
        [0.0, FRAC_PI_2, 0.0],
        Z,
        [-3.1, 3.1],
    ),
    ("fixed", [0.0, 0.0, 0.23], O, X, [0.0; 2]),
];

/// An arm on a lift and a telescope that points ahead, whose hand turns about an upright axis, pitches and
/// rolls: eight joints of which five move the hand in different ways.
pub(super) const TELESCOPE: &[Row] = &[
    ("prismatic", [-0.1, 0.0, 0.1], O, Z, [0.0, 1.1]),
    ("prismatic", O, O, X, [0.0, 0.13]),
    ("prismatic", [0.013, 0.0, 0.0], O, X, [0.0, 0.13]),
    ("prismatic", [0.013, 0.0, 0.0], O, X, [0.0, 0.13]),
    ("prismatic", [0.013, 0.0, 0.0], O, X, [0.0, 0.13]),
    ("revolute", [0.0, 0.083, -0.03], O, Z, [-1.75, 4.0]),
    ("revolute", [0.0, -0.02, -0.03], O, Y, [-1.57, 1.57]),
    ("revolute", [0.02, 0.02, -0.02], O, X, [-3.1, 3.1]),
    ("fixed", [0.23, 0.0, 0.0], O, X, [0.0; 2]),
];
