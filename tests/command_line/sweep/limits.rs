//! What ends sweeps early, or could: time, memory, an interrupt, a full disk, large numbers.

use std::process::Command;

use super::{SWEEP, planwright, scratch, text};

#[cfg(unix)]
#[test]
fn a_world_without_end_is_given_up_after_its_time() {
    let endless = scratch(
        "endless.plan",
        "(defsweep endless (:worlds 3)
           (vary (x (between 0 1)))
           (run (when (= x 1) (loop))))",
    );
    let endless = endless.to_str().expect("a name");
    let run = |options: &[&str]| {
        let arguments = [
            &["sweep", endless, "--seed", "3", "--time-limit", "0.5"],
            options,
        ];
        planwright(&arguments.concat())
    };
    let records = text(&run(&["--json"]).stdout);
    let late = records.matches("\"outcome\":\"timeout\"").count();
    assert!(late > 0 && late < 3, "{records}");
    assert_eq!(records.matches("\"outcome\":\"success\"").count(), 3 - late);
    // It says nothing about the plan: on a faster machine it could have ended.
    let shown = run(&[]);
    assert_eq!(shown.status.code(), Some(4));
    let shown = text(&shown.stdout);
    assert!(shown.contains("success  100.0 %"), "{shown}");
    assert!(shown.contains("not counted: timeout  --replay "), "{shown}");
    for wrong in ["0", "-1", "nan", "1e300"] {
        let option = format!("--time-limit={wrong}");
        let output = planwright(&["sweep", endless, &option]);
        assert_eq!(output.status.code(), Some(2), "{wrong}");
    }
}

#[test]
fn an_interrupt_keeps_what_is_done() {
    let file = scratch("interrupted.plan", SWEEP);
    let folder = file.with_file_name("interrupted");
    let mut sweep = Command::new(env!("CARGO_BIN_EXE_planwright"))
        .args(["sweep", file.to_str().expect("a name"), "--worlds", "4000"])
        .args(["--shards", "1000", "--into"])
        .arg(&folder)
        .stdout(std::process::Stdio::null())
        .spawn()
        .expect("the program runs");
    while !folder.join("shard-0.jsonl").exists() {
        let ended = sweep.try_wait().expect("it can be asked");
        assert_eq!(ended, None, "it ended before its first shard");
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    let interrupt = Command::new("kill")
        .args(["-INT", &sweep.id().to_string()])
        .status();
    assert!(interrupt.is_ok_and(|status| status.success()));
    let ended = sweep.wait().expect("it ends");
    assert_eq!(ended.code(), Some(3));
    let report = planwright(&[
        "sweep",
        "--report",
        folder.to_str().expect("a name"),
        "--json",
    ]);
    assert_eq!(report.status.code(), Some(3));
    let first = text(&report.stdout);
    assert!(first.starts_with("{\"world\":0,"), "{first}");
}

/// A plan that takes more memory than there is in some worlds, and handles that.
const HUNGRY: &str = "
    (defsweep hungry (:worlds 6)
      (vary (x (uniform 0 1)))
      (run (handler-case (length (make-list (if (< x 0.5) 20000000 10)))
             (serious-condition () (error 'end-of-file))))
      (goal (success :at-least 1)))";

#[test]
fn what_the_programs_own_limits_do_is_no_failure_of_the_plan() {
    let file = scratch("hungry.plan", HUNGRY);
    let file = file.to_str().expect("a name");
    let options = ["--threads", "1", "--heap", "200M"];
    let run = |more: &[&str]| planwright(&[&["sweep", file], &options[..], more].concat());
    let records = run(&["--json"]);
    assert_eq!(records.status.code(), Some(4), "{}", text(&records.stderr));
    let records = text(&records.stdout);
    let defects = records.matches("\"outcome\":\"defect\"").count();
    let successes = records.matches("\"outcome\":\"success\"").count();
    assert!(defects > 0 && successes == 6 - defects, "{records}");
    let shown = text(&run(&[]).stdout);
    assert!(shown.contains("success  100.0 %"), "{shown}");
    let told = "not counted: defect it takes more memory than --heap allows  --replay ";
    assert!(shown.contains(told), "{shown}");
}

#[test]
fn seeds_and_numbers_of_worlds_may_be_as_large_as_they_like() {
    let file = scratch("large.plan", SWEEP);
    let file = file.to_str().expect("a name");
    let run = |arguments: &[&str]| {
        let run = planwright(&[&["sweep", file, "--threads", "2"], arguments].concat());
        assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
        text(&run.stdout)
    };
    for seed in ["9223372036854775808", "18446744073709551615"] {
        let records = run(&["--seed", seed, "--worlds", "20", "--json"]);
        let worked = records.matches("\"outcome\":\"success\"").count();
        assert!((8..20).contains(&worked), "{records}");
        let world = ["--seed", seed, "--replay", "18446744073709551615", "--run"];
        let one = planwright(&[&["sweep", file], &world[..]].concat());
        // Its plan may fail there.
        assert!(
            !text(&one.stderr).contains("A seed"),
            "{}",
            text(&one.stderr)
        );
    }
    let enough = run(&["--worlds", "1000000000000", "--until-width", "0.9"]);
    assert!(
        enough.starts_with("light   seed 0   200 worlds\n"),
        "{enough}"
    );
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_leaves_the_summary() {
    let file = scratch("full.plan", SWEEP);
    let folder = file.with_file_name("full");
    std::fs::create_dir_all(&folder).expect("a folder");
    for world in 0..30 {
        let recording = folder.join(format!("world-{world}.mcap"));
        // Writing to the device fails as it does on a full disk.
        std::os::unix::fs::symlink("/dev/full", recording).expect("a link");
    }
    let into = folder.to_str().expect("a name");
    let arguments = ["--seed", "5", "--record-failures", into];
    let run = planwright(&[&["sweep", file.to_str().expect("a name")], &arguments[..]].concat());
    let told = text(&run.stderr);
    assert_eq!(run.status.code(), Some(2), "{told}");
    assert!(text(&run.stdout).starts_with("light   seed 5   30 worlds\nsuccess  "));
    assert!(told.contains("[not recorded: "), "{told}");
    assert!(told.contains(".mcap: the disk is full"), "{told}");
}

/// A sweep whose worlds are over as soon as they have begun.
const IDLE: &str = "(defsweep idle (:worlds 10000) (run nil))";

/// Of a process, kilobytes of memory that it holds.
#[cfg(target_os = "linux")]
fn resident(process: u32) -> u64 {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).expect("it runs");
    let line = status.lines().find(|line| line.starts_with("VmRSS:"));
    let number = line.and_then(|line| line.split_whitespace().nth(1));
    number.expect("a number").parse().expect("a number")
}

#[test]
#[ignore = "a measurement"]
#[cfg(target_os = "linux")]
fn memory_over_ten_thousand_worlds() {
    use std::io::{BufRead, BufReader};
    let file = scratch("idle.plan", IDLE);
    let mut child = Command::new(env!("CARGO_BIN_EXE_planwright"))
        .args(["sweep", file.to_str().expect("a name"), "--threads", "1"])
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("the program runs");
    let stderr = child.stderr.take().expect("it is piped");
    let began = std::time::Instant::now();
    let mut held = Vec::new();
    for line in BufReader::new(stderr).lines() {
        let line = line.expect("a line");
        let resident = resident(child.id());
        println!(
            "{line}   {resident} kB, {:.2} s",
            began.elapsed().as_secs_f64()
        );
        held.push(resident);
    }
    assert!(child.wait().expect("it ends").success());
    // What is kept of a world is its record.
    let (first, last) = (held[0], held[held.len() - 2]);
    assert!(
        last < first + 8_000,
        "{first} kB after 1,000 worlds, {last} kB after 9,000"
    );
}
