//! A camera that answers what is not so.

use robotics::motion::RobotTrouble;
use session::outside::SeenObject;
use spatial::Pose;

use super::{DETECT, Driver};

const NOT_FOUND: &str = "perception-object-not-found";

fn seen(type_name: &str, name: &str, at: [f64; 3]) -> SeenObject {
    let [x, y, z] = at;
    SeenObject {
        type_name: type_name.to_owned(),
        name: name.to_owned(),
        pose: Pose::translation(x, y, z),
    }
}

/// Where a bottle stands on the table.
const THERE: [f64; 3] = [-1.6, -0.9, 0.82];

fn sees(objects: Vec<SeenObject>) -> Driver {
    let driver = Driver::new();
    driver.robot.change().sight = Some(Ok(objects));
    driver
}

fn bottles(driver: &Driver) -> Vec<String> {
    let world = driver.cook.session.simulation().world();
    let bottles = world
        .objects()
        .filter(|known| known.type_name() == "bottle");
    bottles.map(|known| known.name().to_owned()).collect()
}

#[test]
fn what_is_seen_is_believed() {
    let mut driver = sees(vec![seen("bottle", "", THERE)]);
    driver.done(DETECT);
    assert_eq!(bottles(&driver), ["BOTTLE-1"]);
    let at = driver.cook.pose("BOTTLE-1").translation;
    assert!(
        (at.x + 1.6).abs() < 1e-3 && (at.y + 0.9).abs() < 1e-3,
        "{at}"
    );
    // Seen again a little beside, it is the same one.
    driver.robot.change().sight = Some(Ok(vec![seen("bottle", "", [-1.55, -0.9, 0.82])]));
    driver.done(DETECT);
    assert_eq!(bottles(&driver), ["BOTTLE-1"]);
}

#[test]
fn types_that_are_not_known_are_named() {
    let mut driver = sees(vec![seen("samovar", "", THERE), seen("", "X", THERE)]);
    driver.fails(NOT_FOUND, &["cannot be believed", "samovar"], DETECT);
    assert!(bottles(&driver).is_empty());
}

#[test]
fn poses_that_are_none_are_not_believed() {
    for at in [
        [f64::NAN, 0.0, 0.8],
        [f64::INFINITY, 0.0, 0.8],
        [1e300, 0.0, 0.8],
        [-1.6, -0.9, -5.0],
        [-1.6, -0.9, 30.0],
        // Inside of the table.
        [-1.6, -0.9, 0.74],
    ] {
        let mut driver = sees(vec![seen("bottle", "", at)]);
        driver.fails(NOT_FOUND, &["cannot be believed"], DETECT);
        assert!(bottles(&driver).is_empty(), "{at:?}");
    }
}

#[test]
fn one_object_that_is_told_twice_is_one() {
    let mut driver = sees(vec![seen("bottle", "", THERE), seen("bottle", "", THERE)]);
    driver.done(DETECT);
    assert_eq!(bottles(&driver), ["BOTTLE-1"]);
    let elsewhere = [-1.3, -0.9, 0.82];
    let mut driver = sees(vec![
        seen("bottle", "mine", THERE),
        seen("bottle", "mine", elsewhere),
    ]);
    // One name at two places: neither is known to be the right one.
    driver.fails(NOT_FOUND, &["MINE", "at two places"], DETECT);
    let mut driver = sees(vec![
        seen("bottle", "mine", THERE),
        seen("bottle", "mine", THERE),
    ]);
    driver.done(DETECT);
    assert_eq!(bottles(&driver), ["MINE"]);
}

#[test]
fn a_camera_that_cannot_tell_says_why() {
    let mut driver = Driver::new();
    driver.robot.change().sight = Some(Err(RobotTrouble::Blind {
        name: "/detect_objects".to_owned(),
        text: "the lens cap is on".to_owned(),
    }));
    driver.fails(
        "perception-low-level-failure",
        &["/detect_objects cannot tell what the camera sees: the lens cap is on"],
        DETECT,
    );
}

#[test]
fn a_camera_that_never_answers_hangs_nothing() {
    let mut driver = Driver::new();
    driver.fails(
        "perception-low-level-failure",
        &["/detect_objects has not answered"],
        DETECT,
    );
}
