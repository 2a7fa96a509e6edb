//! Robots whose links and joints are called differently from the built-in one's.

use std::collections::BTreeSet;
use std::fs;
use std::num::NonZeroUsize;

use super::cook::Cook;
use crate::command::open_default;
use crate::transcript::{Transcript, Verdict, replay_all};
use descriptions::{PR2_DESCRIPTION, PR2_URDF};
use robotics::robot::KinematicTree;
use session::dialogue::{Evaluate, Event, Outcome};
use session::{Session, SessionOptions};

fn renamed(text: &str) -> String {
    text.replace("torso_lift_link", "spine")
        .replace("head_pan_joint", "neck_joint")
}

fn options(description: Option<String>) -> SessionOptions {
    SessionOptions {
        robot: Some(("my.urdf".to_owned(), renamed(PR2_URDF))),
        robot_description: description.map(|text| ("my.sexp".to_owned(), text)),
        ..SessionOptions::default()
    }
}

fn refusal(description: Option<String>) -> String {
    match Session::new(&options(description)) {
        Ok(_) => panic!("the robot was accepted"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn a_robot_without_its_description_is_told_what_it_lacks() {
    assert_eq!(
        refusal(None),
        "my.urdf lacks the link torso_lift_link and the joint head_pan_joint, which the built-in \
         description of the PR2 names: say with --robot-description FILE what its links and \
         joints are for; planwright describe-robot my.urdf writes such a file"
    );
}

#[test]
fn a_description_is_told_where_it_is_wrong() {
    assert_eq!(
        refusal(Some(PR2_DESCRIPTION.to_owned())),
        "my.sexp:14:14: there is no link named torso_lift_link"
    );
    let typo = renamed(PR2_DESCRIPTION).replace(":body base_link", ":body base_lnk");
    assert_eq!(
        refusal(Some(typo)),
        "my.sexp:9:13: there is no link named base_lnk; did you mean base_link?"
    );
    let typo = renamed(PR2_DESCRIPTION).replace("(neck ", "(neek ");
    assert_eq!(
        refusal(Some(typo)),
        "my.sexp:17:1: there is no record named neek; did you mean neck?"
    );
    let none = refusal(Some(String::new()));
    assert_eq!(none, "my.sexp:1:1: the file has no (robot …); add one");
}

#[test]
fn a_robot_with_other_names_moves() {
    let description = renamed(PR2_DESCRIPTION);
    let mut session = Session::new(&options(Some(description))).unwrap();
    let mut printed = String::new();
    let mut sink = |event: Event| match event {
        Event::Values(values) => printed.push_str(&values.join(" ")),
        Event::Aborted(abort) => printed.push_str(&abort.report),
        _ => {}
    };
    let form = "(in-package :pp-tut)
                (with-simulated-robot
                  (perform (a motion (type moving-torso) (joint-angle 0.2d0)))
                  (perform (a motion (type looking) (direction down))))";
    let outcome = session.evaluate("test", form, &mut sink);
    assert_eq!(outcome, Outcome::Finished, "{printed}");
    let world = session.simulation().world();
    let joints = &world.robot_configuration().joints;
    let torso = world.models().description.torso.height(joints);
    assert!((torso - 0.2).abs() < 1e-9, "{torso}");
}

/// The names of all links and joints of the PR2.
fn names() -> BTreeSet<String> {
    let tree = KinematicTree::from_urdf(PR2_URDF, "pr2.urdf").unwrap();
    let links = tree.links().map(|(_, link)| link.name.clone());
    let joints = tree.joints().map(|(_, joint)| joint.name.clone());
    links.chain(joints).collect()
}

/// A name with other letters, and as long as before: printed texts are broken where they were. Twice
/// applied, it is the name again.
fn other_letters(name: &str) -> String {
    let turned = |letter: char, first: u8| char::from(first + (letter as u8 - first + 13) % 26);
    name.chars()
        .map(|letter| match letter {
            'a'..='z' => turned(letter, b'a'),
            'A'..='Z' => turned(letter, b'A'),
            other => other,
        })
        .collect()
}

/// A text with other words in place of those that are among some names.
fn with_names(text: &str, is_name: impl Fn(&str) -> bool) -> String {
    let mut changed = String::new();
    let mut rest = text;
    while !rest.is_empty() {
        let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let end = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
        let (word, after) = rest.split_at(end);
        match is_name(word) {
            true => changed.push_str(&other_letters(word)),
            false => changed.push_str(word),
        }
        let between = after.find(is_part).unwrap_or(after.len());
        let (gap, next) = after.split_at(between);
        changed.push_str(gap);
        rest = next;
    }
    changed
}

/// The PR2 with other names for all its links and joints. Users may call its base by the PR2's name.
fn all_renamed(seed: u64) -> SessionOptions {
    let names = names();
    let other = |text| with_names(text, |word| names.contains(word));
    let base = other("base_footprint");
    assert_ne!(base, "base_footprint");
    let description = other(PR2_DESCRIPTION) + &format!("(alias base_footprint {base})");
    SessionOptions {
        seed,
        robot: Some(("my.urdf".to_owned(), other(PR2_URDF))),
        robot_description: Some(("my.sexp".to_owned(), description)),
        ..SessionOptions::default()
    }
}

/// What such a robot has printed, with the PR2's names.
fn as_for_the_pr2(text: &str) -> String {
    let names = names();
    with_names(text, |word| names.contains(&other_letters(word)))
}

#[test]
fn a_robot_with_all_names_changed_does_the_tutorial() {
    let text = fs::read_to_string("docs/tutorial.md").unwrap();
    let tutorial = Transcript::parse("docs/tutorial.md", &text);
    assert!(tutorial.entries.len() > 100, "{}", tutorial.entries.len());
    let open = || {
        open_default()?;
        Session::new(&all_renamed(0)).map_err(|error| error.to_string())
    };
    let mut differ = Vec::new();
    let mut renamed = 0;
    let one = NonZeroUsize::MIN;
    replay_all(&[tutorial], one, open, |transcript, verdicts| {
        for (entry, verdict) in transcript.entries.iter().zip(verdicts.unwrap()) {
            if let Verdict::Failed(difference) = verdict {
                renamed += 1;
                let printed = as_for_the_pr2(&difference.actual.join("\n"));
                if let Verdict::Failed(difference) = Verdict::of(entry, &printed) {
                    differ.push(difference.unified().join("\n"));
                }
            }
        }
        true
    });
    assert!(differ.is_empty(), "{}", differ.join("\n\n"));
    // Else nothing has been renamed.
    assert!(renamed > 3, "{renamed}");
}

#[test]
fn the_world_is_the_same_with_all_names_changed() {
    let done = |options: &SessionOptions| {
        let mut cook = Cook::with(options);
        let said = cook.done(
            "(init-projection)
             (spawn-object '((1.5 0.9 0.9) (0 0 0 1)) :milk)
             (print (list cram-tf:*robot-base-frame* cram-tf:*robot-torso-frame*
                          cram-tf:*robot-left-tool-frame* cram-tf:*robot-right-tool-frame*))
             (with-simulated-robot
               (perform (an action (type transporting) (object (an object (type milk)))
                            (target (a location (on (an object (urdf-name kitchen-island-surface))))))))
             (coe:holds '(cpoe:torso-at :middle 1))",
        );
        (as_for_the_pr2(&said), cook.session.world_hash())
    };
    let (said, hash) = done(&all_renamed(3));
    let options = SessionOptions {
        seed: 3,
        ..SessionOptions::default()
    };
    let (expected, expected_hash) = done(&options);
    assert_eq!(said, expected);
    assert!(said.contains("l_gripper_tool_frame"), "{said}");
    assert_eq!(hash, expected_hash);
}

/// `cargo test --release -p planwright --lib -- --ignored all_names_changed_keeps_house`
#[test]
#[ignore = "takes half a minute"]
fn a_robot_with_all_names_changed_keeps_house() {
    let done = |options: &SessionOptions| {
        let mut cook = Cook::with(options);
        let said = cook.done(
            "(asdf:load-system \"cram_projection_demos\") (demos::household-demo)
             (asdf:load-system \"cram_pr2_pick_place_demo\") (demo::demo-hard-coded)",
        );
        (as_for_the_pr2(&said), cook.session.world_hash())
    };
    let (said, hash) = done(&all_renamed(0));
    let (expected, expected_hash) = done(&SessionOptions::default());
    assert_eq!(said, expected);
    assert_eq!(hash, expected_hash);
}

#[test]
fn an_alias_is_another_name_of_one_part() {
    let with = |alias: &str| {
        let options = SessionOptions {
            robot_description: Some(("my.sexp".to_owned(), format!("{PR2_DESCRIPTION}{alias}"))),
            ..SessionOptions::default()
        };
        Session::new(&options)
    };
    let refused = |alias: &str| match with(alias) {
        Ok(_) => panic!("{alias} was accepted"),
        Err(error) => {
            let text = error.to_string();
            let (_, problem) = text.split_once(' ').unwrap();
            problem.to_owned()
        }
    };
    assert_eq!(
        refused("(alias spine torso_lift_lnk)"),
        "there is no link or joint named torso_lift_lnk; did you mean torso_lift_link?"
    );
    assert_eq!(
        refused("(alias head_pan_link torso_lift_link)"),
        "the name head_pan_link is given twice; keep one"
    );
    assert_eq!(
        refused("(alias spine)"),
        "expected (alias NAME LINK-OR-JOINT), found (alias spine)"
    );
    let mut session = with("(alias spine torso_lift_joint) (alias chest torso_lift_link)").unwrap();
    let mut values = Vec::new();
    let form = "(list (rob-int::joint-limits \"spine\")
                      (cl-tf:frame-id (rob-int::pose-in-map
                        (cl-tf:make-pose-stamped \"chest\" 0.0 (cl-tf:make-identity-vector)
                                                 (cl-tf:make-identity-rotation)))))";
    session.evaluate("test", form, &mut |event| {
        if let Event::Values(new) = event {
            values.extend(new);
        }
    });
    assert_eq!(values, ["((0.0d0 0.33d0) \"map\")"]);
}
