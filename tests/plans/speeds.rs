//! How fast the robot moves.

use super::cook::Cook;
use session::SessionOptions;

#[test]
fn a_faithful_torso_rises_as_slowly_as_its_urdf_says() {
    let seconds = |is_faithful| {
        let options = SessionOptions {
            is_faithful,
            ..SessionOptions::default()
        };
        let mut cook = Cook::with(&options);
        let before = cook.session.simulation().now();
        cook.done(
            "(with-simulated-robot
               (perform (a motion (type moving-torso) (joint-angle 0.3))))",
        );
        cook.session.simulation().now() - before
    };
    let (usual, faithful) = (seconds(false), seconds(true));
    assert!(usual < 3.0, "{usual}");
    // From its start at 0.15 m, at 0.013 m/s.
    assert!((11.5..13.0).contains(&faithful), "{faithful}");
}
