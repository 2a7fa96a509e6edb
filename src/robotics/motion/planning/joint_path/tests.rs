use super::*;
use proptest::prelude::*;
use rand_pcg::rand_core::SeedableRng;

const PLANE: [PathAxis; 2] = [PathAxis {
    lower: -2.0,
    upper: 2.0,
    reach: 1.0,
    chain: 1,
}; 2];

fn find(
    test: &mut dyn PathTest<&'static str>,
) -> Result<Vec<Point>, JointPathFailure<&'static str>> {
    let mut rng = Pcg64::seed_from_u64(1);
    find_joint_path(
        &PLANE,
        &[-1.0, 0.0],
        &[1.0, 0.0],
        JointPathEffort::default(),
        &mut rng,
        test,
        None,
    )
}

/// A wall at x = 0 that leaves a gap at the top.
fn wall(p: &[f64]) -> Option<&'static str> {
    (p[0].abs() < 0.1 && p[1] < 1.0).then_some("wall")
}

#[test]
fn a_free_straight_path_is_taken() {
    assert_eq!(
        find(&mut |_: &[f64]| None),
        Ok(vec![vec![-1.0, 0.0], vec![1.0, 0.0]])
    );
}

#[test]
fn an_obstacle_is_passed_without_touching_it() {
    let path = find(&mut wall).unwrap();
    assert!(path.len() < 6, "{path:?}");
    for leg in path.windows(2) {
        assert!(is_free_between(&PLANE, &leg[0], &leg[1], 0.01, &mut wall));
    }
}

#[test]
fn the_same_seed_gives_the_same_path() {
    assert_eq!(find(&mut wall), find(&mut wall));
}

#[test]
fn a_blocked_goal_names_what_blocks_it() {
    let result = find(&mut |p: &[f64]| (p[0] > 0.5).then_some("table"));
    assert_eq!(result, Err(JointPathFailure::Goal("table")));
}

#[test]
fn an_obstacle_without_a_gap_is_named() {
    let result = find(&mut |p: &[f64]| (p[0].abs() < 0.1).then_some("wall"));
    assert_eq!(
        result,
        Err(JointPathFailure::NotFound {
            blocker: "wall",
            samples: 1500
        })
    );
}

#[test]
fn a_goal_that_cannot_be_left_is_soon_given_up() {
    // Around the goal there is less room than a branch takes.
    let mut cell = |p: &[f64]| {
        let from_goal = (p[0] - 1.0).abs().max(p[1].abs());
        (0.1..0.2).contains(&from_goal).then_some("wall")
    };
    let Err(JointPathFailure::NotFound { blocker, samples }) = find(&mut cell) else {
        panic!("a path leads through a wall");
    };
    assert_eq!(blocker, "wall");
    assert!(samples < 600, "{samples}");
}

#[test]
fn a_gap_that_is_far_from_the_straight_path_is_found_while_samples_stay_near_it() {
    let effort = JointPathEffort {
        // Too few for the share of the ranges to grow as far as the gap.
        samples: 400,
        ..JointPathEffort::default()
    };
    let mut wall = |p: &[f64]| (p[0].abs() < 0.1 && p[1] > -1.6).then_some("wall");
    let found = (0..20).filter(|seed| {
        let mut rng = Pcg64::seed_from_u64(*seed);
        let (start, goal) = ([-1.0, 0.0], [1.0, 0.0]);
        find_joint_path(&PLANE, &start, &goal, effort, &mut rng, &mut wall, None).is_ok()
    });
    let found = found.count();
    // Without samples from anywhere, none.
    assert!(found >= 8, "{found} of 20");
}

proptest! {
    #[test]
    fn shortening_makes_no_path_longer_and_cuts_corners_by_no_more_than_the_resolution(
        seed in 0u64..1000,
        heights in proptest::collection::vec(1.0f64..2.0, 1..8),
    ) {
        // A detour over the wall, by way of points above it.
        let steps = heights.len() as f64;
        let above = heights.iter().enumerate();
        let above = above.map(|(i, height)| vec![-0.5 + i as f64 / steps, *height]);
        let ends = [vec![-1.0, 0.0], vec![1.0, 0.0]];
        let mut path = vec![ends[0].clone(), vec![-0.5, 1.0]];
        path.extend(above);
        path.extend([vec![0.5, 1.0], ends[1].clone()]);
        let mut search = Search {
            axes: &PLANE,
            effort: JointPathEffort::default(),
            test: &mut wall,
            settle: None,
            checks: 0,
            samples: 0,
        };
        let before = search.along(path.iter());
        let short = search.shorten(path, &mut Pcg64::seed_from_u64(seed));
        prop_assert!(search.along(short.iter()) <= before + 1e-9);
        prop_assert_eq!([&short[0], &short[short.len() - 1]], [&ends[0], &ends[1]]);
        for leg in short.windows(2) {
            for i in 0..=2000 {
                let point = between(&leg[0], &leg[1], f64::from(i) / 2000.0);
                let by = search.effort.resolution;
                let is_inside = point[0].abs() < 0.1 - by && point[1] < 1.0 - by;
                prop_assert!(!is_inside, "{point:?} of {short:?}");
            }
        }
    }
}
