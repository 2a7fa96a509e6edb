//! Pairs of links that touch by construction, found by trying postures.

use crate::robot::{KinematicTree, LinkId, PostureSample, RobotDescription, TouchingPairs};
use crate::world::self_touching::touching_pairs;
use descriptions::{FETCH_URDF, PR2_DESCRIPTION, PR2_URDF};

fn tree(text: &str) -> KinematicTree {
    KinematicTree::from_urdf(text, "robot.urdf").expect("the robot is right")
}

fn sampled(tree: &KinematicTree, count: usize) -> TouchingPairs {
    touching_pairs(tree, PostureSample { count, seed: 0 }, |_| false)
}

fn names(
    tree: &KinematicTree,
    pairs: impl IntoIterator<Item = (LinkId, LinkId)>,
) -> Vec<[&str; 2]> {
    let name = |link: LinkId| tree.link(link).name.as_str();
    pairs.into_iter().map(|(a, b)| [name(a), name(b)]).collect()
}

/// A tower: a box, a column in it that turns, an arm that turns on the column and always is in the box,
/// and a hand that hits the box at times.
const TOWER: &str = r#"<robot name="tower">
  <link name="box"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <link name="column"><collision><geometry><box size="0.1 0.1 1"/></geometry></collision></link>
  <link name="frame"/>
  <link name="arm"><collision><geometry><box size="0.2 0.1 0.1"/></geometry></collision></link>
  <link name="hand"><collision><origin xyz="0.6 0 0"/><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  <link name="flag"><collision><origin xyz="0 0 3"/><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="turn" type="continuous"><parent link="box"/><child link="column"/><axis xyz="0 0 1"/></joint>
  <joint name="still" type="fixed"><parent link="column"/><child link="frame"/></joint>
  <joint name="shoulder" type="continuous"><parent link="frame"/><child link="arm"/><axis xyz="0 0 1"/></joint>
  <joint name="wrist" type="revolute"><parent link="arm"/><child link="hand"/><axis xyz="0 1 0"/>
    <limit lower="-1.5" upper="1.5" effort="1" velocity="1"/></joint>
  <joint name="pole" type="fixed"><parent link="column"/><child link="flag"/></joint>
</robot>"#;

#[test]
fn pairs_are_told_apart() {
    let tree = tree(TOWER);
    let pairs = sampled(&tree, 2000);
    assert_eq!(
        names(&tree, pairs.neighbours.clone()),
        [
            ["box", "column"],
            ["column", "arm"],
            ["column", "flag"],
            ["arm", "hand"]
        ]
    );
    assert_eq!(names(&tree, pairs.always.clone()), [["box", "arm"]]);
    // The column carries the flag beside a joint, so that it is no neighbour of the box.
    let never = names(&tree, pairs.never.clone());
    assert!(
        never.contains(&["box", "flag"]) && never.contains(&["hand", "flag"]),
        "{never:?}"
    );
    // What touches at times is checked.
    let settled = names(&tree, pairs.by_construction().chain(pairs.never.clone()));
    assert!(!settled.contains(&["box", "hand"]), "{settled:?}");
    assert!(pairs.almost_always.is_empty());
}

#[test]
fn what_touches_almost_always_is_reported() {
    // The hand slides up, and is clear of the box only at the end.
    let text = TOWER.replace(
        r#"type="revolute"><parent link="arm"/><child link="hand"/><axis xyz="0 1 0"/>
    <limit lower="-1.5" upper="1.5""#,
        r#"type="prismatic"><parent link="arm"/><child link="hand"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="0.566""#,
    );
    let tree = tree(&text.replace("xyz=\"0.6 0 0\"", "xyz=\"0 0 0\""));
    let pairs = sampled(&tree, 2000);
    let odd = pairs.almost_always.iter().map(|(a, b, _)| (*a, *b));
    assert_eq!(names(&tree, odd), [["box", "hand"], ["column", "hand"]]);
    let (.., share) = pairs.almost_always[0];
    assert!((0.95..0.99).contains(&share), "{share}");
    let settled = names(&tree, pairs.by_construction());
    assert!(settled.contains(&["box", "hand"]), "{settled:?}");
}

#[test]
fn the_same_seed_finds_the_same_pairs() {
    let tree = tree(FETCH_URDF);
    assert_eq!(sampled(&tree, 300), sampled(&tree, 300));
}

#[test]
fn joints_that_stand_do_not_move() {
    let tree = tree(TOWER);
    let wrist = tree.joint_named("wrist").expect("there is one");
    let sample = PostureSample {
        count: 200,
        seed: 0,
    };
    let pairs = touching_pairs(&tree, sample, |joint| joint == wrist);
    let neighbours = names(&tree, pairs.neighbours.clone());
    assert!(neighbours.contains(&["arm", "hand"]), "{neighbours:?}");
    // At 0 the hand is in the wall of the box or beside it, always.
    let settled = names(&tree, pairs.by_construction().chain(pairs.never.clone()));
    assert!(settled.contains(&["box", "flag"]), "{settled:?}");
}

#[test]
fn the_built_in_robots_touch_where_their_descriptions_say() {
    let fetch = tree(FETCH_URDF);
    let pairs = sampled(&fetch, 2000);
    assert!(pairs.almost_always.is_empty() && pairs.always.is_empty());
    assert!(pairs.never.len() > 50);
    let pr2 = tree(PR2_URDF);
    let pairs = sampled(&pr2, 1000);
    assert!(pairs.always.len() > 10);
    let description = RobotDescription::from_sexp(PR2_DESCRIPTION, "pr2.sexp", &pr2);
    let description = description.expect("the description is right");
    let odd = pairs.almost_always.iter().map(|(a, b, _)| (*a, *b));
    for (a, b) in pairs.always.iter().copied().chain(odd) {
        let groups = &description.touching;
        let is_known = groups
            .iter()
            .any(|group| group.contains(&a) && group.contains(&b));
        let rolls = [a, b].iter().any(|link| description.wheels.contains(link));
        assert!(is_known || rolls, "{:?}", names(&pr2, [(a, b)]));
    }
}

/// A carriage with a tube that is fixed to it, and two tubes that slide in that; a drawer beside them that
/// slides alone.
const TELESCOPE: &str = r#"<robot name="telescope">
  <link name="post"><collision><origin xyz="0 0 -2"/><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  <link name="carriage"><collision><geometry><box size="0.3 0.3 0.3"/></geometry></collision></link>
  <link name="tube"><collision><geometry><box size="1 0.1 0.1"/></geometry></collision></link>
  <link name="middle"><collision><geometry><box size="1 0.08 0.08"/></geometry></collision></link>
  <link name="inner"><collision><geometry><box size="1 0.06 0.06"/></geometry></collision></link>
  <link name="drawer"><collision><geometry><box size="0.2 0.05 0.05"/></geometry></collision></link>
  <joint name="lift" type="revolute"><parent link="post"/><child link="carriage"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/></joint>
  <joint name="fixed" type="fixed"><parent link="carriage"/><child link="tube"/></joint>
  <joint name="first" type="prismatic"><parent link="tube"/><child link="middle"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="1.2" effort="1" velocity="1"/></joint>
  <joint name="second" type="prismatic"><parent link="middle"/><child link="inner"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="1.2" effort="1" velocity="1"/></joint>
  <joint name="slide" type="prismatic"><parent link="tube"/><child link="drawer"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="1.2" effort="1" velocity="1"/></joint>
</robot>"#;

#[test]
fn pieces_of_a_telescope_are_neighbours() {
    let tree = tree(TELESCOPE);
    let pairs = sampled(&tree, 500);
    let neighbours = names(&tree, pairs.neighbours.clone());
    for pair in [
        ["carriage", "middle"],
        ["carriage", "inner"],
        ["tube", "inner"],
        ["middle", "inner"],
    ] {
        assert!(neighbours.contains(&pair), "{pair:?} {neighbours:?}");
    }
    // What slides alone may run into what carries it.
    let settled = names(&tree, pairs.by_construction());
    for pair in [["carriage", "drawer"], ["middle", "drawer"]] {
        assert!(!settled.contains(&pair), "{pair:?} {settled:?}");
    }
}
