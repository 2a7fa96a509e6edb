//! Long sessions, measured: to be run by hand, with a release build (docs/contributing.md).

use std::time::Instant;

use super::resume::{Folder, Sitting};

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
