//! How the PR2 looks: white covers with round edges over dark joints, sensors in the head, and
//! shoulders and grippers coloured by side, blue on the left and orange on the right.
//! The proportions are those of the boxes and cylinders of its model, which the covers fill and
//! exceed by a few millimetres at most.

use super::look::Look;
use crate::picture::loft::{Along, Section, lofted, section};
use crate::picture::scene::Finish;
use Along::{X, Y, Z};

/// Name of the robot that looks like this.
pub(crate) const NAME: &str = "pr2";

/// Linear colours.
type Paint = [f32; 4];
const WHITE: Paint = [0.80, 0.80, 0.775, 1.0];
const SILVER: Paint = [0.50, 0.51, 0.52, 1.0];
const GREY: Paint = [0.22, 0.225, 0.235, 1.0];
const DARK: Paint = [0.055, 0.057, 0.062, 1.0];
const BLACK: Paint = [0.018, 0.018, 0.02, 1.0];
const RED: Paint = [0.55, 0.02, 0.02, 1.0];
const LEFT: Paint = [0.015, 0.16, 0.42, 1.0];
const RIGHT: Paint = [0.72, 0.20, 0.01, 1.0];

/// The looks of a link; `None` if it looks as its model says.
pub(crate) fn looks_of(link: &str) -> Option<Vec<Look>> {
    let of_arm = |name: &str, paint: Paint| arm_link(name, paint);
    match link {
        "base_link" => Some(base()),
        "base_bellow_link" => Some(bellow()),
        "torso_lift_link" => Some(torso()),
        "laser_tilt_mount_link" => Some(tilting_laser()),
        "head_pan_link" => Some(neck()),
        "head_tilt_link" => Some(head()),
        _ => match link.split_once('_')? {
            ("l", name) => of_arm(name, LEFT),
            ("r", name) => of_arm(name, RIGHT),
            _ => None,
        },
    }
}

fn arm_link(name: &str, paint: Paint) -> Option<Vec<Look>> {
    match name {
        "shoulder_pan_link" => Some(shoulder(paint)),
        "shoulder_lift_link" => Some(shoulder_lift()),
        "upper_arm_roll_link" => Some(vec![disc(X, [0.119, 0.1405], 0.0725, [0.0; 2], DARK)]),
        "upper_arm_link" => Some(upper_arm(paint)),
        "elbow_flex_link" => Some(elbow()),
        "forearm_roll_link" => Some(vec![disc(X, [0.086, 0.1065], 0.045, [0.0; 2], DARK)]),
        "forearm_link" => Some(forearm(paint)),
        "wrist_flex_link" => Some(wrist()),
        "gripper_palm_link" => Some(palm(paint)),
        "gripper_l_finger_link" => Some(finger(1.0)),
        "gripper_r_finger_link" => Some(finger(-1.0)),
        _ => None,
    }
}

/// A body through sections, with rounded ends.
fn cover(along: Along, sections: &[Section], ends: [f64; 2], paint: Paint) -> Look {
    Look::of_surface(lofted(along, sections, ends), paint, Finish::Gloss)
}

/// A straight body from one position on the axis to another.
fn bar(
    along: Along,
    [from, to]: [f64; 2],
    middle: [f64; 2],
    half: [f64; 2],
    round: f64,
    paint: Paint,
) -> Look {
    let ends = [0.012_f64, 0.3 * (to - from), half[0] * 0.4, half[1] * 0.4];
    let end = ends.into_iter().fold(f64::INFINITY, f64::min);
    let sections = [from, to].map(|place| section(place, half, round).at(middle));
    cover(along, &sections, [end; 2], paint)
}

/// A disc perpendicular to the axis.
fn disc(along: Along, [from, to]: [f64; 2], radius: f64, middle: [f64; 2], paint: Paint) -> Look {
    let bevel = (0.2 * (to - from)).min(0.006);
    let line = [
        [0.0, from],
        [radius - bevel, from],
        [radius, from + bevel],
        [radius, to - bevel],
        [radius - bevel, to],
        [0.0, to],
    ];
    Look::turned(along, &line, middle, paint)
}

fn base() -> Vec<Look> {
    let skirt = [
        section(0.012, [0.322, 0.322], 0.075),
        section(0.05, [0.334, 0.334], 0.085),
        section(0.175, [0.334, 0.334], 0.085),
        section(0.23, [0.326, 0.326], 0.085),
    ];
    vec![
        cover(Z, &skirt, [0.008, 0.02], WHITE),
        bar(Z, [-0.012, 0.02], [0.0; 2], [0.312, 0.312], 0.075, BLACK),
        // The laser of the base in its slot.
        bar(
            X,
            [0.25, 0.3375],
            [0.0, 0.188],
            [0.235, 0.018],
            0.012,
            BLACK,
        ),
        bar(Z, [0.228, 0.238], [0.03, 0.0], [0.245, 0.25], 0.06, SILVER),
        disc(Z, [0.225, 0.27], 0.042, [0.245, 0.0], DARK),
        disc(Z, [0.27, 0.295], 0.034, [0.245, 0.0], BLACK),
        // The battery box, and the column above it.
        bar(Z, [0.228, 0.325], [-0.262, 0.0], [0.072, 0.3], 0.035, WHITE),
        bar(
            Z,
            [0.32, 0.656],
            [-0.2875, 0.0],
            [0.047, 0.232],
            0.035,
            WHITE,
        ),
        bar(
            X,
            [-0.3365, -0.325],
            [0.0, 0.49],
            [0.165, 0.115],
            0.02,
            GREY,
        ),
    ]
}

/// The bellows that hide the lift.
fn bellow() -> Vec<Look> {
    const FOLDS: u32 = 10;
    let sections: Vec<_> = (0..=2 * FOLDS)
        .map(|i| {
            let along = -0.15 + 0.30 * f64::from(i) / f64::from(2 * FOLDS);
            let inset = if i % 2 == 0 { 0.008 } else { 0.0 };
            section(along, [0.025 - inset, 0.185 - inset], 0.015)
        })
        .collect();
    vec![cover(Z, &sections, [0.0; 2], DARK)]
}

fn torso() -> Vec<Look> {
    let column = [
        section(-0.505, [0.09, 0.158], 0.05).at([-0.1145, 0.0]),
        section(-0.05, [0.0975, 0.165], 0.05).at([-0.1145, 0.0]),
    ];
    let trunk = [
        section(-0.052, [0.118, 0.185], 0.06).at([-0.152, 0.0]),
        section(-0.005, [0.1355, 0.2085], 0.06).at([-0.152, 0.0]),
        section(0.135, [0.1355, 0.2085], 0.06).at([-0.152, 0.0]),
        section(0.175, [0.193, 0.2095], 0.07).at([-0.092, 0.0]),
        section(0.314, [0.2, 0.2095], 0.08).at([-0.088, 0.0]),
    ];
    vec![
        cover(Z, &column, [0.02, 0.0], SILVER),
        cover(Z, &trunk, [0.015, 0.03], WHITE),
        bar(X, [0.03, 0.116], [0.0, 0.236], [0.112, 0.052], 0.03, BLACK),
        bar(X, [-0.30, -0.285], [0.0, 0.11], [0.13, 0.14], 0.03, SILVER),
        disc(X, [-0.312, -0.299], 0.026, [0.085, 0.20], RED),
        disc(Z, [0.30, 0.33], 0.105, [-0.017, 0.0], GREY),
    ]
}

/// The tilting laser between the shoulders.
fn tilting_laser() -> Vec<Look> {
    vec![
        disc(Y, [-0.0815, -0.045], 0.040, [0.003, -0.003], GREY),
        disc(Y, [0.045, 0.0815], 0.040, [0.003, -0.003], GREY),
        bar(X, [-0.045, 0.052], [0.0, 0.0], [0.046, 0.042], 0.02, DARK),
        disc(Z, [0.03, 0.066], 0.030, [0.012, 0.0], BLACK),
    ]
}

fn neck() -> Vec<Look> {
    let sections = [
        section(-0.066, [0.108, 0.135], 0.06).at([0.012, 0.0]),
        section(-0.03, [0.127, 0.159], 0.065).at([0.016, 0.0]),
        section(0.03, [0.127, 0.159], 0.065).at([0.016, 0.0]),
        section(0.0795, [0.095, 0.159], 0.06).at([0.03, 0.0]),
    ];
    let side = |from: f64, to: f64| disc(Y, [from, to], 0.05, [0.0, 0.068], GREY);
    vec![
        disc(Z, [-0.085, -0.05], 0.098, [0.0, 0.0], GREY),
        cover(Z, &sections, [0.012, 0.02], SILVER),
        side(-0.164, -0.150),
        side(0.150, 0.164),
    ]
}

/// The head: a flat box with the cameras in a dark plate across its front.
fn head() -> Vec<Look> {
    let box_of = [
        section(-0.183, [0.128, 0.034], 0.03).at([0.0, 0.118]),
        section(-0.12, [0.145, 0.041], 0.035).at([0.0, 0.114]),
        section(0.015, [0.147, 0.0445], 0.035).at([0.0, 0.110]),
        section(0.05, [0.147, 0.054], 0.035).at([0.0, 0.101]),
        section(0.079, [0.147, 0.054], 0.035).at([0.0, 0.101]),
    ];
    let mut looks = vec![
        cover(X, &box_of, [0.02, 0.01], WHITE),
        bar(
            X,
            [0.07, 0.0835],
            [0.0, 0.108],
            [0.136, 0.034],
            0.024,
            BLACK,
        ),
    ];
    // The high-definition camera, two pairs of cameras, and the projector.
    let lenses = [
        (-0.11, 0.021, [0.03, 0.05, 0.10, 1.0]),
        (-0.06, 0.013, [0.10, 0.13, 0.20, 1.0]),
        (-0.03, 0.013, [0.10, 0.13, 0.20, 1.0]),
        (0.03, 0.013, [0.10, 0.13, 0.20, 1.0]),
        (0.06, 0.013, [0.10, 0.13, 0.20, 1.0]),
        (0.11, 0.021, [0.45, 0.05, 0.03, 1.0]),
    ];
    for (left, radius, paint) in lenses {
        let at = [left, 0.114];
        looks.push(disc(X, [0.078, 0.0875], radius, at, GREY));
        looks.push(disc(X, [0.08, 0.0895], radius * 0.68, at, paint));
    }
    looks
}

fn shoulder(paint: Paint) -> Vec<Look> {
    let tower = [
        [0.0, -0.4915],
        [0.085, -0.4915],
        [0.104, -0.485],
        [0.112, -0.468],
        [0.116, -0.30],
        [0.131, -0.245],
        [0.131, -0.06],
    ];
    let cap = [
        [0.131, -0.062],
        [0.1318, -0.058],
        [0.1318, 0.085],
        [0.126, 0.112],
        [0.110, 0.130],
        [0.085, 0.140],
        [0.0, 0.142],
    ];
    let seam = [
        [0.126, -0.068],
        [0.1325, -0.064],
        [0.1325, -0.058],
        [0.126, -0.054],
    ];
    let mut looks = vec![
        Look::turned(Z, &tower, [0.0; 2], WHITE),
        Look::turned(Z, &cap, [0.0; 2], paint),
        Look::turned(Z, &seam, [0.0; 2], DARK),
    ];
    for side in [-1.0, 1.0] {
        let (from, to) = (side * 0.102 - 0.025, side * 0.102 + 0.025);
        let outer: f64 = if side > 0.0 { to } else { from };
        looks.push(disc(Y, [from, to], 0.134, [0.0, 0.098], WHITE));
        looks.push(disc(
            Y,
            [outer - 0.004, outer + 0.004],
            0.062,
            [0.0, 0.098],
            GREY,
        ));
    }
    looks
}

fn shoulder_lift() -> Vec<Look> {
    vec![
        disc(Y, [-0.077, 0.077], 0.128, [0.0; 2], GREY),
        bar(X, [0.03, 0.122], [0.0, 0.0], [0.076, 0.095], 0.06, GREY),
    ]
}

fn upper_arm(paint: Paint) -> Vec<Look> {
    let barrel = [
        section(0.135, [0.0765, 0.082], 0.06).at([0.0, -0.004]),
        section(0.24, [0.0765, 0.082], 0.06).at([0.0, -0.004]),
        section(0.30, [0.068, 0.070], 0.055).at([0.0, -0.016]),
        section(0.40, [0.0675, 0.066], 0.05).at([0.0, -0.0205]),
    ];
    let hub = |[from, to]: [f64; 2]| disc(Y, [from, to], 0.052, [0.0, 0.4], GREY);
    vec![
        cover(X, &barrel, [0.02, 0.01], WHITE),
        bar(
            X,
            [0.158, 0.172],
            [0.0, -0.004],
            [0.078, 0.0835],
            0.06,
            paint,
        ),
        disc(Y, [-0.0705, 0.0705], 0.086, [-0.0015, 0.4], WHITE),
        hub([-0.0735, -0.066]),
        hub([0.066, 0.0735]),
    ]
}

fn elbow() -> Vec<Look> {
    vec![
        disc(Y, [-0.0195, 0.0195], 0.082, [0.0; 2], DARK),
        bar(
            X,
            [0.04, 0.0925],
            [0.0, -0.0035],
            [0.046, 0.062],
            0.035,
            DARK,
        ),
    ]
}

fn forearm(paint: Paint) -> Vec<Look> {
    let sleeve = [
        section(0.096, [0.0605, 0.0605], 0.05).at([0.0, 0.006]),
        section(0.165, [0.0605, 0.0605], 0.05).at([0.0, 0.006]),
        section(0.225, [0.0605, 0.051], 0.042).at([0.0, 0.001]),
        section(0.30, [0.0595, 0.0425], 0.036).at([0.0, -0.006]),
        section(0.355, [0.046, 0.038], 0.03).at([0.0, -0.006]),
    ];
    vec![
        cover(X, &sleeve, [0.014, 0.012], WHITE),
        bar(
            X,
            [0.176, 0.188],
            [0.0, 0.0048],
            [0.0613, 0.0602],
            0.05,
            paint,
        ),
        bar(X, [0.235, 0.30], [0.0, 0.036], [0.03, 0.006], 0.005, DARK),
    ]
}

fn wrist() -> Vec<Look> {
    vec![
        disc(Y, [-0.0215, 0.0215], 0.0385, [0.0; 2], DARK),
        bar(
            X,
            [0.0, 0.0275],
            [0.0, -0.003],
            [0.0215, 0.032],
            0.015,
            DARK,
        ),
    ]
}

fn palm(paint: Paint) -> Vec<Look> {
    let neck = bar(X, [0.026, 0.062], [0.0; 2], [0.0265, 0.0235], 0.012, SILVER);
    vec![
        neck,
        disc(Z, [-0.0243, 0.0243], 0.0515, [0.0785, 0.0], paint),
        disc(Z, [-0.0262, 0.0262], 0.030, [0.0785, 0.0], GREY),
        bar(X, [0.099, 0.1255], [0.0; 2], [0.034, 0.0235], 0.01, GREY),
    ]
}

/// A finger; `side` is 1 on the left and -1 on the right.
fn finger(side: f64) -> Vec<Look> {
    let part =
        |along: f64, left: f64, half: [f64; 2]| section(along, half, 0.010).at([side * left, 0.0]);
    let sections = [
        part(-0.006, 0.012, [0.016, 0.021]),
        part(0.018, 0.021, [0.024, 0.0265]),
        part(0.055, 0.020, [0.021, 0.0235]),
        part(0.0955, 0.013, [0.0135, 0.016]),
    ];
    vec![
        cover(X, &sections, [0.006, 0.004], SILVER),
        disc(Z, [-0.0282, 0.0282], 0.0115, [0.0, 0.0], DARK),
    ]
}
