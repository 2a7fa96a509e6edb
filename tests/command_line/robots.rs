//! Robots of one's own: descriptions that are derived, and robots by name.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const BRINGS_A_BOTTLE: &str = "
(in-package :pp-tut)
(init-projection)
(spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))
(with-simulated-robot
  (let ((?spot (make-pose \"map\" '((-0.8 2 0.96) (0 0 0 1)))))
    (perform (an action (type transporting) (object (an object (type bottle)))
                        (target (a location (pose ?spot)))))))
(format t \"~%It stands on ~a.~%\" (pp-plans::support-of 'bottle-1))";

/// A folder that is removed with the value.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let name = format!("planwright-robots-{}-{name}", std::process::id());
        let path = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&path).expect("a folder");
        Folder(path)
    }

    fn file(&self, name: &str, text: &[u8]) -> PathBuf {
        let path = self.0.join(name);
        std::fs::write(&path, text).expect("a file");
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn planwright(arguments: &[&Path]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_planwright"))
        .args(arguments)
        .output()
        .expect("the program runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn a_robot_fetches_with_nothing_but_what_was_derived_from_its_urdf() {
    let folder = Folder::new("derived");
    let urdf = Path::new("world/fetch.urdf");
    let derived = planwright(&[Path::new("describe-robot"), urdf]);
    assert!(derived.status.success(), "{}", text(&derived.stderr));
    let description = folder.file("derived.sexp", &derived.stdout);
    let plan = folder.file("plan.plan", BRINGS_A_BOTTLE.as_bytes());
    let run = planwright(&[
        Path::new("run"),
        &plan,
        Path::new("--robot"),
        urdf,
        Path::new("--robot-description"),
        &description,
    ]);
    let said = text(&run.stdout);
    assert!(
        said.contains("It stands on kitchen_island_surface."),
        "{said}{}",
        text(&run.stderr)
    );
}

#[test]
fn an_srdf_says_what_may_touch_and_how_the_arm_is_parked() {
    let folder = Folder::new("srdf");
    let urdf = Path::new("world/fetch.urdf");
    let joints = [
        ("shoulder_pan_joint", "1.32"),
        ("shoulder_lift_joint", "1.4"),
        ("upperarm_roll_joint", "-0.2"),
        ("elbow_flex_joint", "1.72"),
        ("forearm_roll_joint", "0.0"),
        ("wrist_flex_joint", "1.66"),
        ("wrist_roll_joint", "0.0"),
    ];
    let joints: String = joints
        .iter()
        .map(|(name, value)| format!("<joint name=\"{name}\" value=\"{value}\"/>"))
        .collect();
    let untucked = joints.replace("1.32", "0.5");
    let srdf = format!(
        "<robot name=\"fetch\">
           <group_state name=\"Straight up\" group=\"arm\"><joint name=\"elbow_flex_joint\" value=\"0\"/></group_state>
           <group_state name=\"Untucked\" group=\"arm\">{untucked}</group_state>
           <group_state name=\"tucked\" group=\"arm\">{joints}</group_state>
           <disable_collisions link1=\"forearm_roll_link\" link2=\"base_link\" reason=\"Default\"/>
           <disable_collisions link1=\"wrist_flex_link\" link2=\"base_link\" reason=\"User\"/>
           <disable_collisions link1=\"elbow_flex_link\" link2=\"base_link\" reason=\"Never\"/>
           <disable_collisions link1=\"head_tilt_link\" link2=\"base_link\" reason=\"Default\"/>
           <disable_all_collisions link=\"shoulder_lift_link\"/>
           <disable_collisions link1=\"laser\" link2=\"base_link\" reason=\"Adjacent\"/>
         </robot>"
    );
    let srdf = folder.file("fetch.srdf", srdf.as_bytes());
    let option = Path::new("--srdf");
    let derived = planwright(&[Path::new("describe-robot"), urdf, option, &srdf]);
    assert!(derived.status.success(), "{}", text(&derived.stderr));
    let said = text(&derived.stdout);
    assert!(
        said.contains("(tucked 1.32 1.4 -0.2 1.72 0 1.66 0)"),
        "{said}"
    );
    assert!(
        said.contains("(park 1.32 1.4 -0.2 1.72 0 1.66 0)"),
        "{said}"
    );
    assert!(!said.contains("straight-up"), "{said}");
    assert!(
        said.contains("which is no fault if they are parts that this robot is"),
        "{said}"
    );
    let may_touch = |one: &str| {
        let mut groups = said.lines().filter(|line| line.starts_with("(touching"));
        groups.any(|group| group.contains("base_link") && group.contains(one))
    };
    assert!(may_touch("forearm_roll_link"), "{said}");
    // What never touches is checked at no cost; no link is left out of all checks, and no pair without a reason.
    for checked in [
        "elbow_flex_link",
        "head_tilt_link",
        "shoulder_lift_link",
        "wrist_flex_link",
    ] {
        assert!(!may_touch(checked), "{checked}\n{said}");
    }
    let words = said.replace("\n; ", " ");
    assert!(
        words.contains(
            "that touch in some postures; they are checked here: base_link and wrist_flex_link."
        ),
        "{said}"
    );
    assert!(
        words.contains("they are checked here: shoulder_lift_link."),
        "{said}"
    );

    let other = planwright(&[Path::new("describe-robot"), urdf, option, urdf]);
    assert_eq!(other.status.code(), Some(2));
    let said = text(&other.stderr);
    assert!(said.contains("fetch.urdf: nothing says"), "{said}");

    let broken = folder.file("broken.srdf", b"<robot><group_state></robot>");
    let refused = planwright(&[Path::new("describe-robot"), urdf, option, &broken]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(
        text(&refused.stderr).contains("broken.srdf:1:"),
        "{}",
        text(&refused.stderr)
    );
}

#[test]
fn what_cannot_be_derived_is_refused_or_said() {
    let none = planwright(&[Path::new("describe-robot"), Path::new("no-such.urdf")]);
    assert_eq!(none.status.code(), Some(2));
    let said = text(&none.stderr);
    assert!(said.starts_with("error: no-such.urdf: "), "{said}");
    let folder = Folder::new("bare");
    let bare = folder.file(
        "bare.urdf",
        b"<robot name=\"bare\"><link name=\"rock\"/></robot>",
    );
    let bare = planwright(&[Path::new("describe-robot"), &bare]);
    assert!(bare.status.success(), "{}", text(&bare.stderr));
    let said = text(&bare.stdout);
    assert!(said.contains("No gripper was found"), "{said}");
}

#[test]
fn a_name_that_no_robot_has_is_a_file_that_is_not_there() {
    let none = planwright(&[
        Path::new("--robot"),
        Path::new("fitch"),
        Path::new("run"),
        Path::new("plans/tutorial/move-bottle.plan"),
    ]);
    assert_eq!(none.status.code(), Some(2));
    let said = text(&none.stderr);
    assert!(said.contains("fitch: "), "{said}");
}
