//! Sessions that are killed at random moments: nothing that was typed is lost. To be run by hand
//! (docs/contributing.md).

use std::fs;
use std::thread;
use std::time::Duration;

use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

use crate::pseudo_terminal::{State, Terminal};

const FORMS: [&str; 10] = [
    "(in-package :pp-tut)",
    "(pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))",
    "(pp-tut:spawn-object '((-1.3 -0.9 0.82) (0 0 0 1)) :bowl 'bowl-1)",
    "(defparameter *x* (random 1000))",
    "(pr2-proj:with-simulated-robot (pp-plans::park-arms))",
    "(pw:rewind)",
    "(error \"x\")",
    "q",
    "(loop repeat 20000 sum (random 10))",
    "(pw:snapshot 'here)",
];

/// Number of inputs in a journal, and whether the last one has no end.
fn inputs(journal: &str) -> (usize, bool) {
    let is = |line: &&str, word: &str| line.split(' ').next() == Some(word);
    let begun = |line: &&str| is(line, "input") || is(line, "pasted");
    let count = journal.lines().filter(begun).count();
    let last = journal
        .lines()
        .rfind(|line| begun(line) || is(line, "ended"));
    (count, last.is_some_and(|line| begun(&line)))
}

#[test]
#[ignore = "it takes minutes"]
fn torture() {
    let wanted = std::env::var("PLANWRIGHT_KILLS").ok();
    let kills = wanted.and_then(|n| n.parse().ok()).unwrap_or(500);
    let mut random = Pcg64::new(11, 0xa02b_dbf7_bb3c_0a7a);
    let mut number = |most: u64| random.next_u64() % most;
    for round in 0..kills {
        let state = State::new(&format!("torture-{round}"));
        let file = state.path().join("one.journal");
        let name = file.to_str().expect("a path");
        let mut terminal = Terminal::start(&state, &["--log-level=none", "--journal", name]);
        let mut typed = 0;
        for _ in 0..number(6) {
            let form = FORMS[usize::try_from(number(10)).expect("an index")];
            terminal.evaluate(form);
            typed += 1;
        }
        let form = FORMS[usize::try_from(number(10)).expect("an index")];
        terminal.line(form);
        thread::sleep(Duration::from_millis(number(300)));
        terminal.kill();

        let (count, is_open) = inputs(&fs::read_to_string(&file).expect("a journal"));
        assert!(
            count >= typed,
            "round {round}: {count} of {typed} inputs are kept"
        );
        let resumed = Terminal::spawn(&state, &[&format!("--resume={name}")]);
        if is_open {
            resumed.wait_for("Evaluate it again?");
            resumed.line("y");
        }
        if count > 0 {
            let inputs = if count == 1 { "input" } else { "inputs" };
            resumed.wait_for(&format!("; Resumed {count} {inputs};"));
        }
        let text = resumed.text();
        assert!(!text.contains("not the same"), "round {round}: {text}");
    }
    println!("{kills} sessions were killed; nothing was lost");
}
