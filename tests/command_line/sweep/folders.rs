//! Sweeps in folders: shards, and what is written about them.

use std::path::PathBuf;
use std::process::Command;

use super::{SWEEP, planwright, scratch, text};

#[test]
fn shards_in_any_number_and_order_are_merged_to_the_same_bytes() {
    let file = scratch("shards.plan", SWEEP);
    let file = file.to_str().expect("a name");
    let folder = |name: &str| {
        let folder = scratch("shards.plan", SWEEP).with_file_name(name);
        let _old = std::fs::remove_dir_all(&folder);
        folder
    };
    let merged = |folder: &PathBuf| std::fs::read(folder.join("records.jsonl")).expect("merged");
    let arguments = ["--seed", "5", "--worlds", "23"];
    let whole = folder("whole");
    let run = |more: &[&str]| planwright(&[&["sweep"], more].concat());
    let into = whole.to_str().expect("a name");
    let output = run(&[&[file, "--into", into], arguments.as_slice()].concat());
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let plain = run(&[&[file, "--json"], arguments.as_slice()].concat());
    assert_eq!(text(&plain.stdout).into_bytes(), merged(&whole));

    let parts = folder("parts");
    let into = parts.to_str().expect("a name");
    let first = run(&[
        &[file, "--into", into, "--shard", "3/7"],
        arguments.as_slice(),
    ]
    .concat());
    assert_eq!(first.status.code(), Some(0), "{}", text(&first.stderr));
    // A worker knows the rest from the folder, and its index from an engine.
    for index in ["6", "0"] {
        let output = Command::new(env!("CARGO_BIN_EXE_planwright"))
            .args(["sweep", "--into", into])
            .env("SLURM_ARRAY_TASK_ID", index)
            .output()
            .expect("the program runs");
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    }
    // What was cut off, or changed, is missing.
    let shard = std::fs::read(parts.join("shard-6.jsonl")).expect("a shard");
    std::fs::write(parts.join("shard-6.jsonl"), &shard[..shard.len() / 2]).expect("written");
    let status = run(&["--status", into]);
    assert_eq!(status.status.code(), Some(3));
    assert!(
        text(&status.stdout).ends_with("missing: 1-2,4-6\n"),
        "{}",
        text(&status.stdout)
    );
    assert!(text(&status.stdout).contains("2 of 7 shards are there, 7 worlds of 23"));
    let damaged = "damaged: shard-6.jsonl: it is cut off: no count and checksum at its end\n";
    assert!(text(&status.stdout).contains(damaged));
    let untouched = std::fs::metadata(parts.join("shard-3.jsonl")).and_then(|m| m.modified());
    let resumed = run(&["--resume", into]);
    assert_eq!(resumed.status.code(), Some(0), "{}", text(&resumed.stderr));
    assert_eq!(merged(&parts), merged(&whole));
    let now = std::fs::metadata(parts.join("shard-3.jsonl")).and_then(|m| m.modified());
    assert_eq!(
        untouched.ok(),
        now.ok(),
        "a shard that is there is not done again"
    );

    // Another sweep does not get into the folder, nor a file that has been changed.
    let other = run(&[&[file, "--into", into, "--seed", "6"], &arguments[2..]].concat());
    assert_eq!(other.status.code(), Some(2));
    assert!(
        text(&other.stderr).contains("is of another sweep"),
        "{}",
        text(&other.stderr)
    );
    std::fs::write(parts.join("sweep.plan"), "(print 1)").expect("written");
    std::fs::remove_file(parts.join("shard-3.jsonl")).expect("removed");
    let changed = run(&["--into", into, "--shard", "3/7"]);
    assert_eq!(changed.status.code(), Some(2));
    assert!(
        text(&changed.stderr).contains("has been changed since"),
        "{}",
        text(&changed.stderr)
    );
}

#[test]
fn a_sweep_that_cannot_be_done_is_refused_in_one_line() {
    let file = scratch("counted.plan", SWEEP);
    let folder = file.with_file_name("counted");
    let into = folder.to_str().expect("a name");
    let arguments = ["--worlds", "4", "--shards", "2", "--into", into];
    let made = planwright(&[&["sweep", file.to_str().expect("a name")], &arguments[..]].concat());
    assert_eq!(made.status.code(), Some(0), "{}", text(&made.stderr));
    let json = folder.join("sweep.json");
    let plan = std::fs::read_to_string(&json).expect("it is there");
    for (one, other) in [
        ("\"worlds\": 4", "\"worlds\": 0"),
        ("\"worlds\": 4", "\"worlds\": 1000000000000000000000000"),
        ("\"worlds\": 4", "\"worlds\": -1"),
        ("\"shards\": 2", "\"shards\": 0"),
        ("\"shards\": 2", "\"shards\": 5"),
        ("\"goal\": 0.5", "\"goal\": 50"),
        ("\"goal\": 0.5", "\"goal\": 0.5, \"time_limit\": -1"),
        ("\"goal\": 0.5", "\"goal\": 0.5, \"time_limit\": 1e300"),
    ] {
        assert!(plan.contains(one), "{plan}");
        std::fs::write(&json, plan.replace(one, other)).expect("written");
        for command in ["--status", "--report", "--resume"] {
            let refused = planwright(&["sweep", command, into]);
            let told = text(&refused.stderr);
            assert_eq!(refused.status.code(), Some(2), "{other}: {told}");
            assert!(told.contains("describes no sweep: "), "{other}: {told}");
            assert_eq!(told.lines().count(), 1, "{other}: {told}");
        }
    }
}
