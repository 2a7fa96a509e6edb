//! Long sessions, measured: to be run by hand, with a release build (docs/contributing.md).

use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use super::resume::{Folder, Sitting};
use lisp::guard::heap::HeapLimit;

/// Everything that a cycle needs.
const BEGIN: [&str; 6] = [
    "(in-package :pp-tut)",
    "(load \"plans/tutorial/skills.plan\")",
    "(spawn-object '((-1.4 -0.75 0.86) (0 0 0 1)))",
    "(defparameter *spot-on-table* (make-pose \"map\" '((-1.4 -0.75 0.86) (0 0 0 1))))",
    "(defun look-for (type spot) (look-at-spot spot) (detect type))",
    "(defun there-and-back ()
       (with-simulated-robot
         (get-ready-at *place-at-table*)
         (let* ((bottle (look-for :bottle *spot-on-table*)) (arm (pick-up-object bottle :right)))
           (bring-to-island bottle arm))
         (let* ((bottle (look-for :bottle *spot-on-island*)) (arm (pick-up-object bottle :right)))
           (go-to *place-at-table*)
           (put-down bottle arm *spot-on-table*))))",
];

fn cycles(usual: usize) -> usize {
    let wanted = std::env::var("PLANWRIGHT_CYCLES").ok();
    wanted.and_then(|n| n.parse().ok()).unwrap_or(usual)
}

/// Kilobytes of memory that this process holds.
fn resident() -> Option<i64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmRSS:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

#[test]
#[ignore = "it takes minutes and tells a time"]
fn time_of_a_resume() {
    let count = cycles(200);
    let folder = Folder::new("time");
    let journal = folder.journal();
    let begin = Instant::now();
    let mut first = Sitting::begin(&journal);
    for input in BEGIN {
        first.say(input);
    }
    for _ in 0..count {
        first.say("(there-and-back)");
    }
    println!("{count} cycles: {:.1} s", begin.elapsed().as_secs_f64());
    let hash = first.session.world_hash();
    let pose = first.say("(get-current-pose-of-object 'bottle-1)");
    drop(first);
    let begin = Instant::now();
    let mut second = Sitting::resume(&journal);
    println!("resumed: {:.2} s", begin.elapsed().as_secs_f64());
    print!("{}", second.told);
    assert!(second.has_resumed(BEGIN.len() + count));
    assert_eq!(second.session.world_hash(), hash);
    assert_eq!(second.say("(get-current-pose-of-object 'bottle-1)"), pose);
}

#[test]
#[ignore = "it takes long and tells figures"]
fn memory_and_drift_of_a_thousand_cycles() {
    let count = cycles(1000);
    let folder = Folder::new("soak");
    let mut sitting = Sitting::begin(&folder.journal());
    for input in BEGIN {
        sitting.say(input);
    }
    let mut first = None;
    let mut settled = None;
    let mut drift: f64 = 0.0;
    for cycle in 1..=count {
        sitting.say("(there-and-back)");
        let pose = sitting.session.object_pose("BOTTLE-1").unwrap();
        let place = pose.translation.vector;
        drift = drift.max((place - *first.get_or_insert(place)).norm());
        if cycle == count.min(100) {
            settled = resident();
        }
        if cycle % 50 == 0 || cycle == count {
            println!(
                "{cycle} cycles: {:?} kB, drift {:.3} mm",
                resident(),
                drift * 1e3
            );
        }
    }
    let grown = resident().zip(settled).map_or(0, |(now, then)| now - then);
    assert!(drift < 1e-3, "the bottle has drifted by {drift} m");
    assert!(grown < 16_384, "the memory has grown by {grown} kB");
}

/// Processor time (s) that this process has taken: unlike that of the clock, it does not depend on what else the
/// machine does.
fn processor_time() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The name of the program, in parentheses, may hold anything.
    let (_, fields) = status.rsplit_once(") ")?;
    let mut fields = fields.split(' ').skip(11);
    let mut ticks = || fields.next()?.parse::<f64>().ok();
    // Linux tells user and system time in hundredths of a second.
    Some((ticks()? + ticks()?) / 100.0)
}

/// Bytes of memory that this process holds, looked up now and then: files of the system take their time.
fn in_use() -> usize {
    static ASKED: AtomicUsize = AtomicUsize::new(0);
    static KNOWN: AtomicUsize = AtomicUsize::new(0);
    if ASKED.fetch_add(1, Ordering::Relaxed).is_multiple_of(256) {
        let bytes = resident().and_then(|kilobytes| usize::try_from(kilobytes * 1024).ok());
        KNOWN.store(bytes.unwrap_or(0), Ordering::Relaxed);
    }
    KNOWN.load(Ordering::Relaxed)
}

/// What each cycle of a household needs.
const HOUSEHOLD: [&str; 5] = [
    "(in-package :pp-tut)",
    "(spawn-object '((1.425 0.94 0.4631) (0 0 1 0)) :bowl 'bowl-1)",
    "(btr-utils:spawn-object
       'milk-1 :milk
       :pose (desig:reference
              (let ((?for (an object (type milk)))
                    (?in (an object (urdf-name iai-fridge-main) (part-of kitchen))))
                (a location (in ?in) (for ?for)))))",
    "(defun bring (?type ?context)
       (handler-case
           (with-simulated-robot
             (perform (an action (type transporting) (object (an object (type ?type)))
                          (context ?context)))
             t)
         (serious-condition (failure)
           (substitute #\\Space #\\Newline (format nil \"~a ~a: ~a\" ?type ?context failure)))))",
    "(defun set-and-clean ()
       (let ((ends (list (bring :bowl :table-setting) (bring :milk :table-setting)
                         (bring :milk :table-cleaning) (bring :bowl :table-cleaning))))
         (values (count-if #'stringp ends) (format nil \"~{~a~^; ~}\" ends))))",
];

#[test]
#[ignore = "it takes hours and tells figures"]
fn a_thousand_times_the_table_is_set_and_cleaned() {
    let count = cycles(1000);
    let folder = Folder::new("household");
    let mut sitting = Sitting::begin(&folder.journal());
    // As the program has it, the collector knows how much memory is in use.
    let limit = HeapLimit {
        bytes: 1 << 30,
        in_use,
    };
    let image = sitting.session.image_mut();
    image.limits.heap.set_limit(Some(limit));
    for input in HOUSEHOLD {
        sitting.say(input);
    }
    let mut failed = 0;
    let mut settled = None;
    let mut times = Vec::new();
    for cycle in 1..=count {
        let begin = processor_time().unwrap_or(0.0);
        let said = sitting.say("(set-and-clean)");
        times.push(processor_time().unwrap_or(0.0) - begin);
        let values = said.lines().last().unwrap_or_default();
        let of_these = values
            .split(' ')
            .next()
            .and_then(|count| count.parse().ok());
        if of_these != Some(0) {
            failed += of_these.unwrap_or(4);
            println!("cycle {cycle}: {values}");
        }
        if cycle == count.min(10) {
            settled = resident();
        }
        if cycle % 10 == 0 || cycle == count {
            println!(
                "{cycle} cycles: {:?} kB, {:.2} s of processor time each, {failed} failed",
                resident(),
                mean(&times[times.len().saturating_sub(10)..])
            );
        }
    }
    let grown = resident().zip(settled).map_or(0, |(now, then)| now - then);
    assert!(grown < 16_384, "the memory has grown by {grown} kB");
    assert!(
        failed * 50 <= 4 * count,
        "{failed} of {} transports",
        4 * count
    );
    let [first, last] = [&times[..10.min(count)], &times[count.saturating_sub(10)..]].map(mean);
    assert!(
        last < 1.5 * first,
        "{first:.2} s for the first cycles, {last:.2} s for the last"
    );
}

fn mean(times: &[f64]) -> f64 {
    times.iter().sum::<f64>() / times.len() as f64
}

#[test]
#[ignore = "it tells the memory of this process, in which no other test may run"]
fn memory_of_four_hundred_forms_that_change_the_world() {
    let folder = Folder::new("forms");
    let mut sitting = Sitting::begin(&folder.journal());
    sitting.say("(in-package :pp-tut)");
    sitting.say("(spawn-object '((-1.4 -0.75 0.86) (0 0 0 1)))");
    for number in 0..400 {
        let x = f64::from(number % 20) * 0.01;
        sitting.say(&format!(
            "(btr-utils:move-object 'bottle-1 '(({} -0.75 0.86) (0 0 0 1)))",
            x - 1.5
        ));
    }
    println!("400 forms: {:?} kB", resident());
    assert!(resident().is_none_or(|now| now <= 61_440));
}
