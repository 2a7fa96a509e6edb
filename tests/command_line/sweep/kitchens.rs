//! Sweeps that draw kitchens: the table in the report, and the simplest kitchen that still fails.

use std::fs;

use super::{planwright, scratch, text};

/// A plan that fails where there is an island and the counters are high, whatever else is so.
const HIGH_ISLAND: &str = "
    (in-package :pp-tut)
    (defsweep high-island (:worlds 60)
      (vary (home (kitchen))
            (from (surface))
            (cup  (object cup :on from)))
      (run (let ((island (find \"ISLAND-COUNTER\" (list-surfaces) :test #'string=)))
             (when (and island (> (third (pw::%surface-point island 0.5 0.5)) 0.88))
               (error 'end-of-file)))))";

/// The number in front of a word in a line.
fn number_before(line: &str, word: &str) -> usize {
    let before = line.split(word).next().expect("a part");
    let number = before.split_whitespace().next_back().expect("a number");
    number.parse().expect("a number")
}

#[test]
fn the_report_has_a_table_of_kitchens_that_adds_up() {
    let file = scratch("high-island.plan", HIGH_ISLAND);
    let file = file.to_str().expect("a name");
    let page = scratch("high-island.html", "");
    let page_name = page.to_str().expect("a name");
    let report = planwright(&["sweep", file, "--seed", "2", "--html", page_name]);
    let shown = text(&report.stdout);
    let table = &shown[shown.find("kitchens: ").expect("a table")..];
    let first = table.lines().next().expect("a line");
    let failures = number_before(first, " failures in 60 worlds");
    assert!((5..55).contains(&failures), "{table}");
    // The layout explains them; its rows have all worlds.
    let of_layout = table
        .lines()
        .skip_while(|line| !line.starts_with("  layout"));
    let heading = of_layout.clone().next().expect("layouts");
    assert!(heading.contains("explains failures"), "{table}");
    let rows = of_layout
        .skip(1)
        .take_while(|line| line.starts_with("    "));
    let (mut failed, mut tried) = (0, 0);
    for row in rows {
        failed += number_before(row, " of ");
        let rest = row.split(" of ").nth(1).expect("a count");
        tried += rest
            .split_whitespace()
            .next()
            .expect("a count")
            .parse::<usize>()
            .expect("a count");
        let is_island = row.contains("island");
        assert!(is_island || row.contains("  0 of "), "{table}");
    }
    assert_eq!((failed, tried), (failures, 60), "{table}");
    let last = table.lines().last().expect("a finding");
    assert!(last.contains("END-OF-FILE"), "{table}");
    assert_eq!(number_before(last, " worlds in"), failures, "{table}");
    let page = fs::read_to_string(&page).expect("a page");
    assert!(page.contains("<h2>Kitchens</h2>") && page.contains("<th>layout</th>"));
}

#[test]
fn a_failing_kitchen_shrinks_to_what_the_failure_needs() {
    let file = scratch("shrinking.plan", HIGH_ISLAND);
    let file = file.to_str().expect("a name");
    let records = planwright(&["sweep", file, "--seed", "2", "--worlds", "40", "--json"]);
    let records = text(&records.stdout);
    let world_of = |is: &dyn Fn(&str) -> bool| {
        let line = records.lines().find(|line| is(line)).expect("such a world");
        let number = line["{\"world\":".len()..].split(',').next();
        number.expect("a number").to_owned()
    };
    let failing =
        world_of(&|line| line.contains("END-OF-FILE") && line.contains("\"home.table\":true"));
    let working = world_of(&|line| line.contains("\"outcome\":\"success\""));
    let shrink = |world: &str, threads: &str| {
        planwright(&[
            "sweep",
            file,
            "--seed",
            "2",
            "--shrink",
            world,
            "--threads",
            threads,
        ])
    };
    let shrunk = shrink(&failing, "2");
    let shown = text(&shrunk.stdout);
    assert!(
        shown.starts_with(&format!("world {failing}, END-OF-FILE, after ")),
        "{shown}"
    );
    // Runs of more threads are the same.
    assert_eq!(text(&shrink(&failing, "3").stdout), shown);
    let kitchen = shown
        .lines()
        .find(|line| line.starts_with("kitchen "))
        .expect("a kitchen");
    for simpler in ["table nil", "back-"] {
        assert!(kitchen.contains(simpler), "{shown}");
    }
    // The size of a table that is gone changes nothing.
    assert!(!shown.contains("table-length"), "{shown}");
    let needs = shown
        .lines()
        .find(|line| line.starts_with("no simpler, "))
        .expect("needs");
    assert!(needs.contains("island"), "{shown}");
    // The island stays, and all else of its kitchen is as simple as can be.
    let form = shown
        .lines()
        .find(|line| line.starts_with("(new-kitchen "))
        .expect("a form");
    let world = shown
        .lines()
        .find_map(|line| line.strip_prefix("planwright --world "));
    let world = world.expect("a command");
    let look = "(print (not (null (find \"ISLAND-COUNTER\" (list-surfaces) :test #'string=))))
                (print (null (find \"TABLE\" (list-surfaces) :test #'string=)))";
    let by_form = scratch("form.plan", &format!("(in-package :pp-tut) {form} {look}"));
    let by_form = planwright(&["run", by_form.to_str().expect("a name")]);
    assert_eq!(
        text(&by_form.stdout).split_whitespace().collect::<Vec<_>>(),
        ["T", "T"]
    );
    let there = scratch("there.plan", &format!("(in-package :pp-tut) {look}"));
    let there = planwright(&["--world", world, "run", there.to_str().expect("a name")]);
    assert_eq!(
        text(&there.stdout).split_whitespace().collect::<Vec<_>>(),
        ["T", "T"]
    );
    // The whole world fails again.
    let again = &shown[shown.find("(sweep-world").expect("a form")..];
    let again = &again[..again.find("\nkitchen ").expect("its end")];
    let again = scratch(
        "again-there.plan",
        &format!("{HIGH_ISLAND}\n{again}\n(run-sweep-world)"),
    );
    let again = planwright(&["run", again.to_str().expect("a name")]);
    assert!(
        text(&again.stderr).contains("END-OF-FILE"),
        "{}",
        text(&again.stderr)
    );
    let works = shrink(&working, "2");
    assert_eq!(works.status.code(), Some(2));
    let why = text(&works.stderr);
    assert!(
        why.contains(&format!(
            "world {working} does not fail: its outcome is success"
        )),
        "{why}"
    );
}

#[test]
fn a_failure_that_is_not_the_kitchens_leaves_the_simplest_kitchen() {
    let plan = HIGH_ISLAND.replace("(when (and island", "(when (or t island");
    // What the sweep itself sets belongs to the kitchen, too.
    let plan = plan.replace("(kitchen)", "(kitchen :handle-length 0.3)");
    let file = scratch("not-the-kitchens.plan", &plan);
    let file = file.to_str().expect("a name");
    let shrunk = planwright(&[
        "sweep",
        file,
        "--seed",
        "2",
        "--shrink",
        "0",
        "--threads",
        "2",
    ]);
    let shown = text(&shrunk.stdout);
    assert!(shown.contains("home.arrangement one-wall\n"), "{shown}");
    assert!(!shown.contains("home.table true"), "{shown}");
    assert!(shown.contains(" :handle-length 0.3"), "{shown}");
    assert!(shown.contains(",handle-length=0.3"), "{shown}");
}

#[test]
fn kitchens_with_wrong_parameters_are_mistakes_and_impossible_ones_invalid() {
    let run = |draw: &str| {
        let plan = format!("(defsweep s (:worlds 2) (vary (home {draw})) (run nil))");
        let file = scratch("wrong-kitchen.plan", &plan);
        let run = planwright(&["sweep", file.to_str().expect("a name")]);
        text(&run.stderr) + &text(&run.stdout)
    };
    for (draw, told) in [
        ("(kitchen :islnd nil)", "did you mean island?"),
        (
            "(kitchen :counter-height 3)",
            "a length from 0.7 to 1.1 m was expected",
        ),
        (
            "(kitchen :clutter 3)",
            "3 is no share of the things that usually stand about",
        ),
        ("(kitchen 9 3)", "9 and 3 are no range of integers"),
        (
            "(kitchen :arrangement :galley :island t)",
            "2 worlds invalid: home no kitchen is like that",
        ),
        ("(kitchen 0 9 :table nil)", "success  100.0 %"),
    ] {
        let shown = run(draw);
        assert!(shown.contains(told), "{draw}: {shown}");
    }
}

#[test]
fn a_world_of_a_folder_shrinks_if_the_folder_is_sound() {
    let plan = HIGH_ISLAND.replace("(when (and island", "(when (or t island");
    let file = scratch("into-a-folder.plan", &plan);
    let file = file.to_str().expect("a name");
    let folder = file.replace(".plan", "");
    // What an earlier run of this test has left.
    let _ = fs::remove_dir_all(&folder);
    planwright(&[
        "sweep", file, "--seed", "2", "--worlds", "3", "--shards", "1", "--into", &folder,
    ]);
    let shrink = |world: &str| {
        let shrunk = planwright(&[
            "sweep",
            "--report",
            &folder,
            "--shrink",
            world,
            "--threads",
            "2",
        ]);
        (
            shrunk.status.code(),
            text(&shrunk.stdout),
            text(&shrunk.stderr),
        )
    };
    let (status, shown, _) = shrink("1");
    assert_eq!(status, Some(0));
    assert!(shown.starts_with("world 1, END-OF-FILE, after "), "{shown}");
    assert!(shown.contains("home.arrangement one-wall\n"), "{shown}");
    let (status, _, why) = shrink("3");
    assert_eq!(status, Some(2));
    assert!(why.contains("has worlds 0 to 2, not 3"), "{why}");
    // A damaged shard is told, and its worlds are run.
    fs::write(format!("{folder}/shard-0.jsonl"), "{").expect("a shard");
    let (status, again, _) = shrink("1");
    assert_eq!(status, Some(0));
    assert_eq!(again, shown);
    fs::write(format!("{folder}/sweep.json"), "{").expect("a job");
    let (status, _, why) = shrink("1");
    assert_eq!(status, Some(2));
    assert!(why.contains("describes no sweep"), "{why}");
}
