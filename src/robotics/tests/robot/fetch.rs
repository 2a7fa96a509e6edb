//! The built-in Fetch: its figures, and postures in which nothing touches.

use crate::robot::{JointPositions, KinematicTree, MissingNames, NumericKinematics, PostureSample};
use crate::sexp::DataFile;
use crate::world::self_touching::{touching_links, touching_pairs};
use descriptions::{FETCH_DESCRIPTION, FETCH_URDF};
use spatial::Pose;

fn fetch() -> KinematicTree {
    KinematicTree::from_urdf(FETCH_URDF, "fetch.urdf").expect("Fetch is right")
}

fn arm(tree: &KinematicTree) -> NumericKinematics {
    let [base, tip] = ["torso_lift_link", "gripper_link"].map(|name| tree.link_named(name));
    NumericKinematics::new(tree, base.expect("a torso"), tip.expect("a hand")).expect("an arm")
}

/// The arm's postures by name.
fn postures() -> Vec<(String, Vec<f64>)> {
    let file = DataFile::read(FETCH_DESCRIPTION, "fetch.sexp").expect("it can be read");
    let mut postures = Vec::new();
    for record in file.nodes() {
        let items = record.list().expect("records are lists");
        let place = items
            .iter()
            .position(|item| item.as_keyword() == Some("postures"));
        let listed = place.and_then(|place| items.get(place + 1));
        for posture in listed
            .into_iter()
            .flat_map(|all| all.list().expect("a list"))
        {
            let items = posture.list().expect("a posture");
            let numbers = items
                .iter()
                .skip(1)
                .map(|item| item.number().expect("a number"));
            let name = posture.head().expect("a name").to_owned();
            postures.push((name, numbers.collect()));
        }
    }
    postures
}

fn at(tree: &KinematicTree, torso: f64, posture: &[f64]) -> JointPositions {
    let mut q = tree.zero_positions();
    q.set(
        tree.joint_named("torso_lift_joint").expect("a torso"),
        torso,
    );
    for (joint, position) in arm(tree).joints().iter().zip(posture) {
        q.set(*joint, *position);
    }
    q
}

#[test]
fn the_description_names_what_there_is() {
    let missing = MissingNames::of(FETCH_DESCRIPTION, "fetch.sexp", &fetch());
    let missing = missing.expect("it can be read");
    assert!(missing.is_empty(), "{missing}");
}

#[test]
fn the_figures_are_those_of_fetch() {
    let tree = fetch();
    let height = |link: &str, torso: f64| {
        let link = tree.link_named(link).expect("there is the link");
        let q = at(&tree, torso, &[]);
        tree.link_pose(link, &Pose::identity(), &q).translation.z
    };
    for (torso, expected) in [(0.0, 1.06), (0.386, 1.45)] {
        let camera = height("head_camera_rgb_optical_frame", torso);
        assert!((camera - expected).abs() < 0.005, "{camera}");
    }
    let reach = arm(&tree).forward(&[0.0; 7]).translation.x - (0.119525 + 0.117);
    assert!((reach - 0.98).abs() < 0.005, "{reach}");
    let moving = tree
        .joints()
        .filter(|(_, joint)| joint.is_actuated())
        .count();
    assert_eq!(moving, 14);
    let mass: f64 = tree.links().map(|(_, link)| link.mass).sum();
    // Some small parts are left out.
    assert!((mass - 121.3).abs() < 0.5, "{mass}");
}

#[test]
fn nothing_touches_in_the_postures() {
    let tree = fetch();
    let sample = PostureSample {
        count: 500,
        seed: 0,
    };
    let allowed: Vec<_> = touching_pairs(&tree, sample, |_| false)
        .by_construction()
        .collect();
    let fingers = ["r_gripper_finger_link", "l_gripper_finger_link"];
    let postures = postures();
    assert_eq!(postures.len(), 4);
    for (name, posture) in &postures {
        for (position, limits) in posture.iter().zip(arm(&tree).limits()) {
            assert!(
                limits.is_none_or(|l| l.contains(*position)),
                "{name}: {position}"
            );
        }
        for torso in [0.0, 0.05, 0.15, 0.38615] {
            let mut touching = touching_links(&tree, &at(&tree, torso, posture));
            touching.retain(|pair| !allowed.contains(pair));
            let names = touching
                .iter()
                .map(|(a, b)| [&tree.link(*a).name, &tree.link(*b).name]);
            let names: Vec<_> = names.filter(|pair| *pair != fingers).collect();
            assert!(names.is_empty(), "{name} at {torso}: {names:?}");
        }
    }
}
