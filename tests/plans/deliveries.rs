//! How often objects are transported from one surface to another, from anywhere on it.

use std::collections::BTreeMap;
use std::time::Instant;

use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

use super::cook::Cook;
use super::surfaces::{SURFACES, Surface};

/// How far (m) from the edge of a surface an object stands at least.
const FROM_EDGE: f64 = 0.05;
/// How far (m) from where it was to be put an object may stand.
const NEAR: f64 = 0.05;

/// Tells whether there is any place to pick the object THING up from, on a grid of 5 cm and 15 degrees.
pub(super) const REACHABLE_P: &str = "
    (defun reachable-p (type &optional ?grasps)
      (let* ((pose (get-current-pose-of-object 'thing))
             (?object (desig:make-designator :object
                        `((:type ,type) (:name thing) (:pose ((:pose-in-map ,pose))))))
             (location (a location (reachable-for pr2) (desig:when ?grasps (grasp ?grasps))
                          (object ?object)))
             (origin (cl-tf:origin pose)))
        (loop for i from -21 to 21
              thereis (loop for j from -21 to 21
                            thereis (loop for k below 24
                                          for half = (* k (/ pi 24))
                                          thereis (coe::fulfils-p location
                                                    (make-pose \"map\"
                                                      (list (list (+ (cl-tf:x origin) (* i 0.05))
                                                                  (+ (cl-tf:y origin) (* j 0.05))
                                                                  0)
                                                            (list 0 0 (sin half) (cos half))))))))))";

const PLAN: &str = "
    (defvar *object*)
    (defvar *target*)
    (defun transport (type from to)
      (let ((?type type) (?from from) (?to to))
        (setf *object* (an object (type ?type)))
        (let ((?object *object*))
          (setf *target* (a location (on (an object (urdf-name ?to) (part-of kitchen)))
                                     (for ?object)))
          (again ?object *target*
                 (a location (on (an object (urdf-name ?from) (part-of kitchen))))))))
    (defun again (?object ?target &optional ?from)
      (with-simulated-robot
        (perform (an action (type transporting) (object ?object) (target ?target)
                     (desig:when ?from (location ?from))))))
    (defun block-first-stand (type)
      (let* ((?object (desig:make-designator :object
                        `((:type ,type) (:name thing)
                          (:pose ((:pose-in-map ,(get-current-pose-of-object 'thing)))))))
             (stand (reference (a location (reachable-for pr2) (visible-for pr2)
                                  (object ?object)))))
        (loop for (dx dy) in '((0 0) (0.15 0.15) (0.15 -0.15) (-0.15 0.15) (-0.15 -0.15))
              for number from 1
              do (spawn-object (list (list (+ (cl-tf:x (cl-tf:origin stand)) dx)
                                           (+ (cl-tf:y (cl-tf:origin stand)) dy) 0.15)
                                     '(0 0 0 1))
                               :breakfast-cereal
                               (intern (format nil \"BOX-~a\" number))))))
    (defun millimetres-off-target ()
      (values (round (* 1000 (coe::distance
                              (coe::pose-in-map (reference (current-desig *target*)))
                              (get-current-pose-of-object 'thing))))))";

/// What has come of transports.
#[derive(Default)]
struct Tally {
    trials: u32,
    delivered: u32,
    /// Those that cannot be picked up from anywhere.
    out_of_reach: u32,
    moved_twice: u32,
    milliseconds: Vec<f64>,
    reasons: BTreeMap<String, u32>,
}

impl Tally {
    fn line(&mut self, name: &str) {
        self.milliseconds.sort_by(f64::total_cmp);
        let median = self.milliseconds.get(self.milliseconds.len() / 2);
        eprintln!(
            "{name:30} {:4} of {:4} delivered ({:.1} %), {} out of reach, median {:.0} ms, {} moved again",
            self.delivered,
            self.trials - self.out_of_reach,
            100.0 * f64::from(self.delivered) / f64::from((self.trials - self.out_of_reach).max(1)),
            self.out_of_reach,
            median.copied().unwrap_or(0.0),
            self.moved_twice,
        );
        for (reason, count) in &self.reasons {
            eprintln!("  {count:4}  {reason}");
        }
    }
}

/// A stream of worlds.
struct Worlds {
    random: Pcg64,
}

impl Worlds {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * f64::from(self.random.next_u32()) / f64::from(u32::MAX)
    }

    /// Puts an object of a type somewhere on a surface, where it stands; false if it never does.
    fn populate(&mut self, cook: &mut Cook, kind: &str, on: &Surface) -> bool {
        for _ in 0..100 {
            let [x, y] =
                [0, 1].map(|i| self.between(on.low[i] + FROM_EDGE, on.high[i] - FROM_EDGE));
            let half_yaw = self.between(0.0, std::f64::consts::PI);
            let (s, c) = half_yaw.sin_cos();
            cook.done("(init-projection)");
            cook.done(&format!(
                "(spawn-object '(({x:.4} {y:.4} {:.3}) (0 0 {s:.5} {c:.5})) {kind} 'thing)",
                on.height + 0.1
            ));
            let t = cook.pose("THING").translation;
            let aside = (t.x - x).hypot(t.y - y);
            // The origin of flat things is at their bottom; the basin is deeper.
            if aside < 0.02 && t.z > on.height - 0.02 && cook.lean("THING") < 5.0 {
                return true;
            }
        }
        eprintln!("no {kind} stands on {}", on.name);
        false
    }
}

/// Transports one object.
fn trial(cook: &mut Cook, kind: &str, from: &Surface, to: &Surface, tally: &mut Tally) {
    let stood = cook.done("(get-current-pose-of-object (quote thing))");
    let stood = stood.trim();
    let start = Instant::now();
    let said = cook.say(&format!("(transport {kind} :{} :{})", from.name, to.name));
    tally.trials += 1;
    tally.milliseconds.push(start.elapsed().as_secs_f64() * 1e3);
    if let Err((report, class)) = said {
        if report.contains("could not be fetched")
            && cook.done(&format!("(reachable-p {kind})")) == "NIL\n"
        {
            tally.out_of_reach += 1;
            return;
        }
        let class = class
            .split_whitespace()
            .next()
            .unwrap_or_default()
            .to_owned();
        let report: String = report.chars().take(200).collect();
        eprintln!(
            "{kind} {} {stood} -> {}: {class} {report}",
            from.name, to.name
        );
        *tally.reasons.entry(class).or_default() += 1;
        return;
    }
    let off = cook.done("(millimetres-off-target)");
    let off = off.trim().parse::<f64>().expect("a number") / 1e3;
    if off > NEAR {
        eprintln!(
            "{kind} {} {stood} -> {}: {off:.3} m off",
            from.name, to.name
        );
        *tally.reasons.entry("elsewhere".to_owned()).or_default() += 1;
        return;
    }
    tally.delivered += 1;
    let before = cook.session.simulation().now();
    cook.done("(again *object* *target*)");
    tally.moved_twice += u32::from(cook.session.simulation().now() > before);
}

/// `cargo test --release --lib -- --ignored --nocapture how_often_objects_are_transported`, with
/// `WORLDS` for the number of worlds for each type and pair of surfaces, and `TYPES`, separated
/// by commas, for the types; with `BLOCKED`, boxes stand where the robot would first go to pick
/// the object up.
#[test]
#[ignore = "takes minutes; prints how often objects are transported"]
fn how_often_objects_are_transported() {
    let worlds = std::env::var("WORLDS").ok().and_then(|n| n.parse().ok());
    let worlds: u32 = worlds.unwrap_or(5);
    let is_blocked = std::env::var("BLOCKED").is_ok();
    let mut cook = Cook::new();
    cook.done(PLAN);
    cook.done(REACHABLE_P);
    let types = match std::env::var("TYPES") {
        Ok(types) => types,
        Err(_) => cook
            .done("(format nil \"~{~(~a~)~^,~}\" (remove-if-not #'list-defined-grasps (list-available-objects)))"),
    };
    let types: Vec<String> = types
        .trim()
        .trim_matches('"')
        .split(',')
        .map(|name| format!(":{name}"))
        .collect();
    let mut all = Tally::default();
    for kind in &types {
        let mut tally = Tally::default();
        for from in &SURFACES {
            for to in &SURFACES {
                if from.name == to.name {
                    continue;
                }
                let mut stream = Worlds {
                    random: Pcg64::seed_from_u64(13),
                };
                for _ in 0..worlds {
                    if !stream.populate(&mut cook, kind, from) {
                        break;
                    }
                    if is_blocked {
                        // It fails if there is no place to stand, which is for the trial to tell.
                        let _ = cook.say(&format!("(block-first-stand {kind})"));
                    }
                    trial(&mut cook, kind, from, to, &mut tally);
                }
            }
        }
        tally.line(kind);
        all.trials += tally.trials;
        all.delivered += tally.delivered;
        all.out_of_reach += tally.out_of_reach;
        all.moved_twice += tally.moved_twice;
        all.milliseconds.append(&mut tally.milliseconds);
        for (reason, count) in tally.reasons {
            *all.reasons.entry(reason).or_default() += count;
        }
    }
    all.line("all");
}
