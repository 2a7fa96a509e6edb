//! Random worlds of many kinds: something is transported in each. Whoever judges it looks at the world alone: no
//! success that is not one, nothing thrown over, nothing that is open at the top tilted on its way.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::LazyLock;
use std::time::Instant;

use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

use super::cook::Cook;
use super::surfaces::{SURFACES, Surface};
use robotics::world::World;
use robotics::world::tilt::tilt_at;

/// How far (m) something may be moved, and lean (degrees), without a word.
const UNTOUCHED: f64 = 0.01;
const LEANS: f64 = 5.0;
/// How far (m) from a target that is given as a pose something may stand.
const NEAR: f64 = 0.05;
/// How far (degrees) what is open at the top may be tilted on its way.
const UPRIGHT: f64 = 15.0;

const VESSELS: [&str; 6] = ["bowl", "mug", "cup", "plate", "pot", "tray"];
const THINGS: [&str; 12] = [
    "bottle",
    "cup",
    "milk",
    "bowl",
    "breakfast-cereal",
    "mug",
    "cube",
    "buttermilk",
    "mondamin",
    "spoon",
    "plate",
    "apple",
];

const PLAN: &str = "
    (defun surface (?name) (a location (on (an object (urdf-name ?name) (part-of kitchen)))))
    (defun inside (?name &optional ?level)
      (a location (in (an object (urdf-name ?name) (part-of kitchen)))
         (desig:when ?level (level ?level))))
    (defun put-in (?type ?name &optional ?level)
      (let ((?for (an object (type ?type))))
        (spawn-object (desig:reference
                        (a location (in (an object (urdf-name ?name) (part-of kitchen)))
                           (for ?for) (desig:when ?level (level ?level))))
                      ?type 'thing)))
    (defun bring (?type ?from ?to)
      (with-simulated-robot
        (perform (an action (type transporting) (object (an object (type ?type) (name thing)))
                     (location ?from) (target ?to)))))";

/// What a kind of world is about: sets one up, and returns the form that transports something in it.
type Setup = fn(&mut Laid) -> Option<String>;

const KINDS: [(&str, Setup); 10] = [
    ("vessels", |laid| {
        let kind = laid.one_of(&VESSELS);
        laid.between_surfaces(kind, "")
    }),
    ("on things", |laid| {
        let kind = laid.one_of(&["cup", "mug", "bottle", "apple", "bowl", "spoon", "cube"]);
        let carrier = laid.one_of(&["plate", "tray", "cereal-box", "red-metal-plate", "pot"]);
        let from = laid.surface();
        let at = laid.place_on(from, 0.25);
        laid.put(carrier, at, from.height + 0.15, "carrier", "");
        let top = laid.top_of("CARRIER") + 0.12;
        laid.put(kind, at, top, "thing", "");
        laid.onto_another(kind, from)
    }),
    ("laden", |laid| {
        let kind = laid.one_of(&VESSELS);
        let from = laid.surface();
        let at = laid.place_on(from, 0.2);
        laid.put(kind, at, from.height + 0.12, "thing", "");
        for number in 0..1 + laid.below(2) {
            let rider = laid.one_of(&["cup", "apple", "spoon", "visualization-box", "bowl"]);
            let top = laid.top_of("THING");
            let spread = if kind == "tray" { 0.12 } else { 0.02 };
            let place = at.map(|at| at + laid.between(-spread, spread));
            laid.put(rider, place, top + 0.15, &format!("rider-{number}"), "");
        }
        laid.onto_another(kind, from)
    }),
    ("crowds", |laid| {
        let from = &SURFACES[0];
        let kind = laid.one_of(&THINGS);
        let at = laid.place_on(from, 0.1);
        laid.put(kind, at, from.height + 0.12, "thing", "");
        for number in 0..8 + laid.below(8) {
            let kind = laid.one_of(&THINGS);
            let at = laid.place_on(from, 0.08);
            laid.put(kind, at, from.height + 0.12, &format!("other-{number}"), "");
        }
        laid.onto_another(kind, from)
    }),
    ("edges", |laid| {
        let (kind, from) = (laid.one_of(&THINGS), laid.surface());
        let at = laid.place_at_edge(from);
        laid.put(kind, at, from.height + 0.12, "thing", "");
        laid.onto_another(kind, from)
    }),
    ("lying", |laid| {
        let kind = laid.one_of(&[
            "bottle",
            "milk",
            "mug",
            "cup",
            "mondamin",
            "breakfast-cereal",
        ]);
        let from = laid.surface();
        let [x, y] = laid.place_on(from, 0.15);
        let (s, c) = laid.between(0.0, 1.57).sin_cos();
        let z = from.height + 0.12;
        let half = std::f64::consts::FRAC_1_SQRT_2;
        laid.spawn(
            kind,
            &format!(
                "(({x:.4} {y:.4} {z:.3}) ({:.5} {:.5} {:.5} {:.5}))",
                c * half,
                s * half,
                s * half,
                c * half
            ),
            "thing",
            "",
        );
        laid.onto_another(kind, from)
    }),
    ("heavy", |laid| {
        let kind = laid.one_of(&[
            "bottle",
            "cereal-box",
            "pot",
            "tray",
            "milk",
            "bowl",
            "cube",
        ]);
        let mass = laid.between(0.6, 2.6);
        laid.between_surfaces(kind, &format!(":mass {mass:.2}"))
    }),
    ("shelves", |laid| {
        let kind = laid.one_of(&["milk", "breakfast-cereal", "cup", "bowl", "bottle"]);
        let level = 2 + laid.below(3);
        let drawer = "oven-area-area-right-drawer-main";
        laid.cook
            .say(&format!("(put-in :{kind} :{drawer} {level})"))
            .ok()?;
        Some(format!(
            "(bring :{kind} (inside :{drawer} {level}) (surface :kitchen-island-surface))"
        ))
    }),
    ("fridge", |laid| {
        let kind = laid.one_of(&["milk", "bottle", "cup", "buttermilk", "bowl"]);
        let fridge = "iai-fridge-main";
        let at = laid.surface().name;
        if laid.below(2) == 0 {
            laid.cook.say(&format!("(put-in :{kind} :{fridge})")).ok()?;
            return Some(format!(
                "(bring :{kind} (inside :{fridge}) (surface :{at}))"
            ));
        }
        let from = laid.surface();
        let place = laid.place_on(from, 0.1);
        laid.put(kind, place, from.height + 0.12, "thing", "");
        Some(format!(
            "(bring :{kind} (surface :{}) (inside :{fridge}))",
            from.name
        ))
    }),
    ("explicit targets", |laid| {
        let (kind, from, to) = (laid.one_of(&THINGS), laid.surface(), laid.surface());
        let at = laid.place_on(from, 0.1);
        laid.put(kind, at, from.height + 0.12, "thing", "");
        let [x, y] = laid.place_on(to, -0.03);
        let origin = laid.cook.pose("THING").translation.z - from.height;
        let above = [0.0, 0.0, 0.01, 0.1][laid.below(4)];
        let (s, c) = spatial::trig::sin_cos(laid.between(0.0, std::f64::consts::PI));
        let z = to.height + origin + above;
        laid.target = Some([x, y, z]);
        Some(format!(
            "(bring :{kind} (surface :{})
               (let ((?pose (make-pose \"map\" '(({x:.4} {y:.4} {z:.4}) (0 0 {s:.5} {c:.5})))))
                 (a location (pose ?pose))))",
            from.name
        ))
    }),
];

/// A world that is being laid out.
struct Laid {
    cook: Cook,
    random: Pcg64,
    /// Where the thing is to be (m), if that is given.
    target: Option<[f64; 3]>,
}

impl Laid {
    fn new(seed: u64) -> Self {
        let mut cook = Cook::new();
        cook.done(PLAN);
        Self {
            cook,
            random: Pcg64::seed_from_u64(seed),
            target: None,
        }
    }

    fn below(&mut self, count: usize) -> usize {
        (self.random.next_u64() % count as u64) as usize
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * f64::from(self.random.next_u32()) / f64::from(u32::MAX)
    }

    fn one_of(&mut self, all: &[&'static str]) -> &'static str {
        all[self.below(all.len())]
    }

    fn surface(&mut self) -> &'static Surface {
        &SURFACES[self.below(SURFACES.len())]
    }

    /// A place that far (m) from the edges at least.
    fn place_on(&mut self, on: &Surface, from_edge: f64) -> [f64; 2] {
        [0, 1].map(|i| self.between(on.low[i] + from_edge, on.high[i] - from_edge))
    }

    /// A place at most 6 cm from an edge.
    fn place_at_edge(&mut self, on: &Surface) -> [f64; 2] {
        let mut place = self.place_on(on, 0.02);
        let axis = self.below(2);
        let inward = self.between(0.02, 0.06);
        place[axis] = match self.below(2) {
            0 => on.low[axis] + inward,
            _ => on.high[axis] - inward,
        };
        place
    }

    /// Puts an upright thing there, at some heading; the place may be taken.
    fn put(&mut self, kind: &str, [x, y]: [f64; 2], z: f64, name: &str, more: &str) {
        let (s, c) = self.between(0.0, std::f64::consts::PI).sin_cos();
        let pose = format!("(({x:.4} {y:.4} {z:.3}) (0 0 {s:.5} {c:.5}))");
        self.spawn(kind, &pose, name, more);
    }

    fn spawn(&mut self, kind: &str, pose: &str, name: &str, more: &str) {
        let form = format!("(btr-utils:spawn-object '{name} :{kind} :pose '{pose} {more})");
        // Where there is no room, a thing less is there.
        let _report = self.cook.say(&form);
    }

    /// The height (m) of the top of a thing.
    fn top_of(&self, name: &str) -> f64 {
        let world = self.cook.session.simulation().world();
        let height = world.object(name).map_or(0.0, |object| object.size()[2]);
        self.cook.pose(name).translation.z + height / 2.0
    }

    fn between_surfaces(&mut self, kind: &str, more: &str) -> Option<String> {
        let from = self.surface();
        let at = self.place_on(from, 0.15);
        self.put(kind, at, from.height + 0.12, "thing", more);
        self.onto_another(kind, from)
    }

    /// The form that brings the thing from a surface to another one, if it is there.
    fn onto_another(&mut self, kind: &str, from: &Surface) -> Option<String> {
        let others: Vec<_> = SURFACES.iter().filter(|to| to.name != from.name).collect();
        let to = others[self.below(others.len())].name;
        let world = self.cook.session.simulation().world();
        let thing = world.object_pose("THING").ok()?;
        (thing.translation.z > from.height - 0.05)
            .then(|| format!("(bring :{kind} (surface :{}) (surface :{to}))", from.name))
    }
}

/// How a transport ended.
struct End {
    kind: String,
    /// The reason of a refusal or failure; what is wrong with a success.
    result: Result<(), String>,
    is_false: bool,
    /// Processor time (s) and simulated time (s).
    seconds: f64,
    simulated: f64,
    /// Greatest tilt (degrees) of what is open at the top, of those that a hand had lifted upright.
    tilt: f64,
}

/// The processor time (s) of this thread; where the system does not tell, the time that has passed.
fn processor_seconds() -> f64 {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|told| told.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| START.elapsed().as_secs_f64(), |time| time / 1e9)
}

/// Lays the world of that number and transports something in it; `None` if there is nothing.
fn transported(setup: Setup, seed: u64) -> Option<End> {
    let mut laid = Laid::new(seed);
    let form = setup(&mut laid)?;
    let cook = &mut laid.cook;
    let world = cook.session.simulation().world();
    let object = world.object("THING").ok()?;
    let (kind, began) = (object.type_name().to_owned(), world.time());
    let others = world.objects().map(|object| object.name().to_owned());
    let (riders, others): (Vec<_>, Vec<_>) = others
        .filter(|name| name != "THING")
        .partition(|name| rides(world, name));
    let stood: Vec<_> = others
        .into_iter()
        .map(|name| (cook.pose(&name), name))
        .collect();
    let tilt = Rc::new(Cell::new(0.0f64));
    let seen = tilt.clone();
    let lifted = Rc::new(Cell::new(None));
    cook.session.set_observer(Box::new(move |world: &World| {
        let Ok(object) = world.object("THING") else {
            return;
        };
        let is_lifted = object.hold().is_some_and(|hold| hold.is_lifted());
        if !is_lifted || !object.is_hollow() {
            lifted.set(None);
            return;
        }
        let Ok(pose) = world.object_pose("THING") else {
            return;
        };
        let now = tilt_at(&pose).to_degrees();
        let before = lifted.get().unwrap_or(now);
        lifted.set(Some(before));
        if before <= UPRIGHT {
            seen.set(seen.get().max(now));
        }
    }));
    let before = processor_seconds();
    let said = cook.say(&form);
    let seconds = processor_seconds() - before;
    let simulated = cook.session.simulation().world().time() - began;
    let mut is_false = false;
    let result = match said {
        Err((report, class)) => {
            let class = class.split_whitespace().next().unwrap_or_default();
            let report: String = report.chars().take(160).collect();
            Err(format!("{class} {}", report.replace('\n', " ")))
        }
        Ok(_) => {
            let flaw = flaw(cook, &form, laid.target, &stood).or_else(|| lost(cook, &riders));
            is_false = flaw.is_some();
            flaw.map_or(Ok(()), Err)
        }
    };
    Some(End {
        kind,
        result,
        is_false,
        seconds,
        simulated,
        tilt: tilt.get(),
    })
}

/// Whether the thing carries an object, by itself or by others.
fn rides(world: &World, name: &str) -> bool {
    let carriers = world.carriers(name).unwrap_or_default();
    carriers.iter().any(|body| body.object() == Some("THING"))
}

/// Which of the objects that the thing carried is not on it any more.
fn lost(cook: &Cook, riders: &[String]) -> Option<String> {
    let world = cook.session.simulation().world();
    let lost = riders.iter().find(|name| !rides(world, name))?;
    Some(format!("{lost} is not on it any more"))
}

/// What is wrong with a transport that has ended as a success.
fn flaw(
    cook: &mut Cook,
    form: &str,
    target: Option<[f64; 3]>,
    stood: &[(spatial::Pose, String)],
) -> Option<String> {
    let world = cook.session.simulation().world();
    let Ok(object) = world.object("THING") else {
        return Some("it is not there any more".to_owned());
    };
    if object.attachment().is_some() {
        return Some("a hand holds it".to_owned());
    }
    if let Some([x, y, z]) = target {
        let t = cook.pose("THING").translation;
        let off = libm::hypot(libm::hypot(t.x - x, t.y - y), (t.z - z).abs());
        if off > NEAR {
            return Some(format!("it stands {off:.3} m off its target"));
        }
    } else {
        let carriers = cook
            .done("(pp-plans::carriers-of 'thing)")
            .replace('_', "-");
        let to = form.rsplit(':').next().unwrap_or_default();
        let to = to
            .trim_end_matches(')')
            .split(' ')
            .next()
            .unwrap_or_default();
        // The basin is a part of the counter.
        let to = to.trim_end_matches("-main").trim_end_matches("-surface");
        if !carriers.contains(to) {
            return Some(format!("it is carried by {}", carriers.trim()));
        }
    }
    stood.iter().find_map(|(pose, name)| {
        let (moved, lean) = (cook.distance(name, pose), cook.turned_up(name, pose));
        (moved > UNTOUCHED || lean > LEANS)
            .then(|| format!("{name} was moved by {moved:.3} m and tipped by {lean:.0} degrees"))
    })
}

/// Prints how the worlds of a kind end, and returns what is wrong.
fn tabulated(
    name: &str,
    setup: Setup,
    seeds: impl Iterator<Item = u64>,
    tell: bool,
) -> Vec<String> {
    let mut ends = Vec::new();
    let mut flaws = Vec::new();
    for seed in seeds {
        let Some(end) = transported(setup, seed) else {
            continue;
        };
        if tell {
            let told = end.result.as_ref().map_or_else(String::as_str, |()| "ok");
            println!(
                "  {name} {seed} {} {:.2} s, {:.0} s of the robot, {:.1} degrees: {told}",
                end.kind, end.seconds, end.simulated, end.tilt
            );
        }
        if end.is_false {
            flaws.push(format!("{name} {seed} {}: {:?}", end.kind, end.result));
        }
        if end.tilt > UPRIGHT {
            let tilt = end.tilt;
            flaws.push(format!(
                "{name} {seed} {}: tilted by {tilt:.0} degrees",
                end.kind
            ));
        }
        ends.push(end);
    }
    if tell {
        print_table(name, &ends);
    }
    flaws
}

fn print_table(name: &str, ends: &[End]) {
    let mut seconds: Vec<f64> = ends.iter().map(|end| end.seconds).collect();
    seconds.sort_by(f64::total_cmp);
    let share = |share: f64| {
        let place = (share * seconds.len() as f64) as usize;
        seconds
            .get(place.min(seconds.len().saturating_sub(1)))
            .copied()
            .unwrap_or(0.0)
    };
    let done = ends.iter().filter(|end| end.result.is_ok()).count();
    println!(
        "{name}: {done} of {} done, {} false; processor time median {:.2} s, p95 {:.2} s, worst {:.2} s; \
         {:.0} s of the robot on average",
        ends.len(),
        ends.iter().filter(|end| end.is_false).count(),
        share(0.5),
        share(0.95),
        share(1.0),
        ends.iter().map(|end| end.simulated).sum::<f64>() / ends.len().max(1) as f64,
    );
    let mut tilts: BTreeMap<&str, (f64, usize)> = BTreeMap::new();
    for end in ends.iter().filter(|end| end.tilt > 0.0) {
        let (most, count) = tilts.entry(&end.kind).or_default();
        (*most, *count) = (most.max(end.tilt), *count + 1);
    }
    for (kind, (most, count)) in tilts {
        println!("    {kind}: tilted by at most {most:.1} degrees in {count} worlds");
    }
    let mut reasons: BTreeMap<String, usize> = BTreeMap::new();
    for end in ends {
        if let Err(reason) = &end.result {
            let words = reason.split_whitespace();
            let plain = words.filter(|word| !word.chars().any(|c| c.is_ascii_digit()));
            let reason = plain.take(14).collect::<Vec<_>>().join(" ");
            *reasons.entry(reason).or_default() += 1;
        }
    }
    for (reason, count) in reasons {
        println!("    {count:3}  {reason}");
    }
}

/// Ten minutes or more: `cargo test -p planwright --lib -- --ignored --nocapture how_each_kind_of_world_ends`;
/// `KINDS`, separated by commas, for some of the kinds, and `WORLDS=FROM..TO` for others than the first 20 of each.
#[test]
#[ignore = "takes minutes; prints how transports end, kind by kind"]
fn how_each_kind_of_world_ends() {
    let wanted = std::env::var("KINDS").unwrap_or_default();
    let mut flaws = Vec::new();
    for (name, setup) in KINDS {
        if !wanted.is_empty() && !wanted.split(',').any(|kind| kind == name) {
            continue;
        }
        let worlds = super::demos::range("WORLDS", 0..20);
        flaws.extend(tabulated(name, setup, worlds, true));
    }
    println!("{} flaws", flaws.len());
    assert!(flaws.is_empty(), "{}", flaws.join("\n"));
}

#[test]
fn what_is_open_at_the_top_is_carried_upright() {
    let vessels = |kind: &'static str| -> Setup {
        match kind {
            "bowl" => |laid| laid.between_surfaces("bowl", ""),
            "mug" => |laid| laid.between_surfaces("mug", ""),
            "plate" => |laid| laid.between_surfaces("plate", ""),
            _ => |laid| laid.between_surfaces("pot", ""),
        }
    };
    for kind in ["bowl", "mug", "plate", "pot"] {
        let end = transported(vessels(kind), 7).expect("it is there");
        assert_eq!(end.result, Ok(()), "{kind}");
        assert!(
            end.tilt > 0.0 && end.tilt <= UPRIGHT,
            "{kind}: {}",
            end.tilt
        );
    }
}
