//! How often drawers and the fridge are opened and closed, from anywhere in the room.

use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

use super::containers::FUNCTIONS;
use super::cook::Cook;
use robotics::motion::can_stand;
use robotics::robot::JointKind;
use spatial::Pose;
use spatial::pose::{angle_between, distance_between};

/// A free base pose somewhere in the room.
pub(super) fn somewhere(cook: &Cook, rng: &mut Pcg64) -> [f64; 3] {
    let mut share = || f64::from(rng.next_u32()) / f64::from(u32::MAX);
    let world = cook.session.simulation().world();
    loop {
        let place = [
            -0.4 + 1.2 * share(),
            -1.2 + 3.6 * share(),
            std::f64::consts::PI * (2.0 * share() - 1.0),
        ];
        if can_stand(world, &place) {
            return place;
        }
    }
}

/// A run of opening and closing.
struct Run {
    opened: f64,
    closed: f64,
    /// How far (m, rad) what was in it is from where it was.
    shift: Option<[f64; 2]>,
    report: Option<String>,
}

/// Opens and closes a container from a random place, with a thing in it if one fits.
fn run(name: &str, joint: &str, wanted: f64, seed: u64) -> Run {
    let mut cook = Cook::new();
    cook.done(FUNCTIONS);
    let mut rng = Pcg64::seed_from_u64(seed);
    let [x, y, yaw] = somewhere(&cook, &mut rng);
    let (s, c) = spatial::trig::sin_cos(yaw / 2.0);
    cook.done(&format!(
        "(btr-utils:move-robot '(({x} {y} 0) (0 0 {s} {c})))"
    ));
    // Another place for every seed.
    let skipped = seed % 7;
    let thing = ["CUP", "SPOON"].into_iter().find(|kind| {
        let put = format!(
            "(dotimes (i {skipped} (put-in 'thing :{kind} :{name}))
               (let* ((?for (an object (type {kind})))
                      (?in (an object (urdf-name {name}) (part-of kitchen))))
                 (desig:reference (a location (in ?in) (for ?for)))))"
        );
        cook.say(&put).is_ok()
    });
    let before: Option<Pose> = thing.map(|_| cook.pose("THING"));
    let opened = cook.say(&format!("(go-open :{name} {wanted})"));
    let reached = cook.joint(joint);
    let closed = opened.and_then(|_| cook.say(&format!("(go-close :{name})")));
    Run {
        opened: reached,
        closed: cook.joint(joint),
        shift: before.map(|before| {
            let now = cook.pose("THING");
            [
                distance_between(&before, &now),
                angle_between(&before, &now),
            ]
        }),
        report: closed.err().map(|(report, _)| report),
    }
}

/// Prints how often each drawer and the fridge are opened and closed; `STARTS` in the environment
/// is the number of random places from where the robot sets out, `NAMES` limits the containers.
#[test]
#[ignore = "a measurement that takes minutes"]
fn how_often_containers_are_opened_and_closed() {
    let starts: u64 = std::env::var("STARTS").map_or(20, |s| s.parse().unwrap());
    let wanted_names = std::env::var("NAMES").unwrap_or_default();
    let models = crate::measured::models();
    let (mut all, mut good) = (0, 0);
    println!("| container | opened | closed | contents kept | failures |\n|---|---|---|---|---|");
    for container in robotics::location::containers(&models) {
        let joint = models.kitchen.joint(container.joint);
        let name = models.kitchen.link(container.link).name.replace('_', "-");
        let is_drawer = joint.kind == JointKind::Prismatic;
        if !is_drawer && !name.contains("fridge") || !name.contains(&wanted_names) {
            continue;
        }
        let (wanted, tolerance) = match is_drawer {
            true => (joint.limits.unwrap().upper, 0.01),
            false => (1.3, 2f64.to_radians()),
        };
        let runs: Vec<Run> = (0..starts)
            .map(|seed| run(&name, &joint.name, wanted, seed))
            .collect();
        let opened = |run: &&Run| (run.opened - wanted).abs() <= tolerance;
        let closed = |run: &&Run| opened(run) && run.closed.abs() <= tolerance;
        let kept = |run: &&Run| {
            run.shift
                .is_none_or(|[d, a]| d <= 0.01 && a <= 5f64.to_radians())
        };
        let count = |test: &dyn Fn(&&Run) -> bool| runs.iter().filter(|run| test(run)).count();
        let mut reports: Vec<String> = runs.iter().filter_map(|run| run.report.clone()).collect();
        reports.dedup();
        println!(
            "| {name} | {}/{starts} | {}/{starts} | {}/{starts} | {} |",
            count(&opened),
            count(&closed),
            count(&kept),
            reports.join("; ").replace('\n', " ")
        );
        all += runs.len();
        good += count(&|run| closed(run) && kept(run));
    }
    println!("{good} of {all}");
    assert!(good * 100 >= all * 98, "{good} of {all}");
}
