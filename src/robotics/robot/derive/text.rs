//! The text of a description that was derived.

use std::fmt::Write;

use super::{DerivedArm, DerivedDrive, DerivedGripper, DerivedRobot};
use crate::robot::{JointId, KinematicTree, LinkId};
use nalgebra::Vector3;

/// Columns of a line.
const WIDTH: usize = 100;
/// Cameras that are written.
const MOST_CAMERAS: usize = 3;

pub(super) fn written(robot: &DerivedRobot, tree: &KinematicTree) -> String {
    let link = |id: LinkId| tree.link(id).name.clone();
    let joint = |id: JointId| tree.joint(id).name.clone();
    let mut text = String::new();
    comment(
        &mut text,
        &format!(
            "The roles of the links and joints of {}, derived from its URDF. Units: m, rad, s. What is \
             assumed is said; correct it where you know better.",
            robot.name
        ),
    );
    for remark in &robot.remarks {
        comment(&mut text, remark);
    }
    let _ = writeln!(text, "\n(robot {})\n", symbol(&robot.name));
    let drive = match robot.wheels.drive {
        DerivedDrive::Omnidirectional => "omnidirectional",
        DerivedDrive::Differential => "differential",
        DerivedDrive::Fixed => "fixed",
    };
    let start = match robot.wheels.drive {
        DerivedDrive::Fixed => {
            comment(
                &mut text,
                "The base does not drive. Say where in the kitchen it stands, by its frame in the map: \
                 :start ((x y z) (0 0 sin cos)) with sine and cosine of half its heading; z is the height \
                 of the table that it stands on.",
            );
            "\n      :start ((0 0 0) (0 0 0 1))"
        }
        _ => {
            comment(&mut text, "Assumed: speeds and accelerations of the base.");
            ""
        }
    };
    let _ = writeln!(
        text,
        "(base :frame {} :body {} :drive {drive}{start}\n      :drive-velocity 0.5 :drive-acceleration 1.0 \
         :turn-velocity 0.6 :turn-acceleration 1.2)",
        link(robot.base_frame),
        link(robot.base_body)
    );
    if let Some((id, limits)) = robot.torso.and_then(|t| Some((t, tree.joint(t).limits?))) {
        let _ = writeln!(
            text,
            "(torso :link {} :joint {} :start {})",
            link(tree.joint(id).child),
            joint(id),
            super::arms::start_height(limits)
        );
    }
    neck(&mut text, robot, tree);
    if robot.cameras.is_empty() {
        missing_camera(&mut text, robot, tree);
    } else {
        comment(
            &mut text,
            "Assumed: what the cameras see, in pixels and radians.",
        );
    }
    for camera in robot.cameras.iter().take(MOST_CAMERAS) {
        let name = link(*camera);
        let short = name
            .trim_end_matches("_frame")
            .trim_end_matches("_link")
            .trim_end_matches("_optical");
        let _ = writeln!(
            text,
            "(camera {short} :frame {name} :width 320 :height 240\n        :vertical-view 0.8 :near 0.1 \
             :far 10 :visible-share 0.9)"
        );
    }
    if let Some(others) = robot
        .cameras
        .get(MOST_CAMERAS..)
        .filter(|others| !others.is_empty())
    {
        let names: Vec<String> = others.iter().map(|camera| link(*camera)).collect();
        comment(
            &mut text,
            &format!("Further optical frames: {}.", names.join(" ")),
        );
    }
    for derived in &robot.arms {
        arm(&mut text, derived, tree);
    }
    comment(
        &mut text,
        "Assumed: joints are as fast as their URDF says, up to the default.",
    );
    text.push_str("(default-speed :velocity 1.0 :acceleration 4.0)\n");
    for group in &robot.touching {
        names(
            &mut text,
            "(touching",
            group.iter().map(|id| link(*id)),
            ")",
        );
    }
    let wheels = &robot.wheels.links;
    if !wheels.is_empty() {
        names(&mut text, "(wheels", wheels.iter().map(|id| link(*id)), ")");
    }
    if !robot.idle.is_empty() {
        names(
            &mut text,
            "(idle-joints",
            robot.idle.iter().map(|id| joint(*id)),
            ")",
        );
    }
    text
}

/// A camera to be completed: beside an arm that stands, it sees what is before that arm.
fn missing_camera(text: &mut String, robot: &DerivedRobot, tree: &KinematicTree) {
    let length = robot.arms.first().map_or(1.0, |arm| {
        let origins = arm.joints.iter().map(|joint| tree.joint(*joint).origin);
        origins.fold(arm.tool_offset, |sum, origin| {
            sum + origin.translation.vector.norm()
        })
    });
    comment(
        text,
        "A camera may also stand where no link is: :at and :looks-at (m) are in the frame of the link :frame. If \
         the next one is where yours is, take the semicolon away.",
    );
    let metres = |share: f64| number((share * length * 100.0).round() / 100.0);
    let _ = writeln!(
        text,
        "; (camera beside :frame {} :at ({} {} {}) :looks-at ({} 0 0) :width 320 :height 240 :vertical-view 0.8 \
         :near 0.1 :far 10 :visible-share 0.9)",
        tree.link(robot.base_frame).name,
        metres(0.4),
        metres(1.0),
        metres(0.7),
        metres(0.4),
    );
}

fn neck(text: &mut String, robot: &DerivedRobot, tree: &KinematicTree) {
    let name = |id: JointId| tree.joint(id).name.clone();
    let poses = super::rest_poses(tree);
    let along =
        |id: JointId, axis: Vector3<f64>| super::rest_axis(tree, &poses, id).dot(&axis) > 0.99;
    match robot.neck.as_slice() {
        [] => {}
        [pan, tilt] if along(*pan, Vector3::z()) && along(*tilt, Vector3::y()) => {
            let child = |id: JointId| tree.link(tree.joint(id).child).name.clone();
            let _ = writeln!(
                text,
                "(neck :pan-joint {} :pan-link {}\n      :tilt-joint {} :tilt-link {})",
                name(*pan),
                child(*pan),
                name(*tilt),
                child(*tilt)
            );
        }
        joints => {
            let names: Vec<String> = joints.iter().map(|id| name(*id)).collect();
            let _ = writeln!(text, "(neck :joints ({}))", names.join(" "));
        }
    }
}

fn arm(text: &mut String, arm: &DerivedArm, tree: &KinematicTree) {
    let link = |id: LinkId| tree.link(id).name.clone();
    let joint = |id: &JointId| tree.joint(*id).name.clone();
    let all: Vec<String> = arm.joints.iter().map(joint).collect();
    comment(text, &format!("Joints of a posture: {}.", all.join(" ")));
    let row = |i: usize| {
        let numbers: Vec<String> = arm.tool_axes.row(i).iter().map(|x| number(*x)).collect();
        format!("({})", numbers.join(" "))
    };
    let _ = writeln!(
        text,
        "(arm {} :base {} :wrist {} :tool {}\n     :tool-offset {} :tool-axes ({} {} {})",
        arm.side,
        link(arm.base),
        link(arm.wrist),
        link(arm.tool),
        arm.tool_offset,
        row(0),
        row(1),
        row(2)
    );
    let park: Vec<String> = match &arm.park {
        Some(park) => park.iter().map(|position| number(*position)).collect(),
        None => arm.joints.iter().map(|_| "0".to_owned()).collect(),
    };
    let _ = write!(
        text,
        "     :start park :postures ((park {})",
        park.join(" ")
    );
    for (name, posture) in arm.postures.iter().filter(|(name, _)| name != "park") {
        let positions: Vec<String> = posture.iter().map(|position| number(*position)).collect();
        let _ = write!(
            text,
            "\n                            ({name} {})",
            positions.join(" ")
        );
    }
    text.push_str("))\n");
    match &arm.gripper {
        Some(gripper) => write_gripper(text, arm, gripper, tree),
        None => {
            let _ = writeln!(
                text,
                "; (gripper {} :palm … :joints (…) :left-finger (…) :right-finger (…))",
                arm.side
            );
        }
    }
}

fn write_gripper(
    text: &mut String,
    arm: &DerivedArm,
    gripper: &DerivedGripper,
    tree: &KinematicTree,
) {
    let jaw = &gripper.jaw;
    let moved = gripper
        .joints
        .iter()
        .map(|joint| tree.joint(*joint).name.clone());
    let moved: Vec<String> = moved.collect();
    comment(
        text,
        &format!(
            "The gap is measured: {} to {} mm at {} to {} of {}.",
            number((1e4 * jaw.closed().1).round() / 10.0),
            number((1e4 * jaw.open().1).round() / 10.0),
            number(jaw.closed().0),
            number(jaw.open().0),
            moved.first().map_or("", String::as_str)
        ),
    );
    let palm = &tree.link(gripper.palm).name;
    let _ = write!(
        text,
        "(gripper {} :palm {palm} :joints ({})",
        arm.side,
        moved.join(" ")
    );
    match gripper.effort {
        Some(effort) => {
            let _ = writeln!(text, " :effort {effort}");
        }
        None => text.push('\n'),
    }
    let [left, right] = &gripper.fingers;
    let link = |id: &LinkId| tree.link(*id).name.clone();
    names(text, "         :left-finger (", left.iter().map(link), ")");
    names(
        text,
        "         :right-finger (",
        right.iter().map(link),
        "))",
    );
}

/// A number that is read as it is meant: with a point, and of few digits.
fn number(x: f64) -> String {
    let rounded = (x * 1e9).round() / 1e9 + 0.0;
    format!("{rounded}")
}

/// A name as one symbol.
pub(super) fn symbol(name: &str) -> String {
    let is_part = |c: char| c.is_alphanumeric() || "-_.".contains(c);
    let name: String = name
        .chars()
        .map(|c| if is_part(c) { c } else { '-' })
        .collect();
    if name.is_empty() {
        "robot".to_owned()
    } else {
        name
    }
}

/// Appends sentences as comments.
fn comment(text: &mut String, sentences: &str) {
    let mut line = String::from(";");
    for word in sentences.split_whitespace() {
        if line.chars().count() + 1 + word.chars().count() > WIDTH {
            let _ = writeln!(text, "{line}");
            line = String::from(";");
        }
        line.push(' ');
        line.push_str(word);
    }
    let _ = writeln!(text, "{line}");
}

/// Appends a list of names between its beginning and its end.
fn names(text: &mut String, head: &str, names: impl Iterator<Item = String>, end: &str) {
    let margin = head.len() + usize::from(!head.ends_with('('));
    let mut line = String::from(head);
    for name in names {
        if line.chars().count() + 3 + name.chars().count() > WIDTH && line.len() > margin {
            let _ = writeln!(text, "{line}");
            line = " ".repeat(margin);
        }
        if !line.ends_with('(') && !line.ends_with(' ') {
            line.push(' ');
        }
        line.push_str(&name);
    }
    let _ = writeln!(text, "{line}{end}");
}
