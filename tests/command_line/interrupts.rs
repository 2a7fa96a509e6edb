//! Ctrl-C at random moments of a plan, in a terminal: the robot stops, and the session is sane.

use std::thread;
use std::time::{Duration, Instant};

use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

use crate::pseudo_terminal::{CTRL_C, State, Terminal};

/// What is interrupted: driving and both arms at once, again and again; it tells when it begins.
const PLAN: &str = "(progn (print :begun-NUMBER) (with-simulated-robot (loop for y = 1 then (- 1 y) do \
    (let ((?p (make-pose \"map\" (list (list 0 y 0) '(0 0 0 1))))) (cpl:par \
    (perform (an action (type going) (target (a location (pose ?p))))) (park-arms))))))";

/// The keys that end what an interrupt has stopped.
const ANSWERS: [&str; 3] = ["1\r", CTRL_C, "2\r"];

/// Presses Ctrl-C; returns how long it takes until the prompt is there.
fn interrupt(terminal: &Terminal) -> Duration {
    let begin = Instant::now();
    terminal.keys(CTRL_C);
    terminal.wait_for_last_line("PP-TUT stopped>");
    begin.elapsed()
}

/// Interrupts a plan so many times; returns how long each interrupt took, in ascending order.
fn interrupts(count: u64, seed: u128) -> Vec<Duration> {
    let state = State::new(&format!("interrupts-{seed}"));
    let terminal = Terminal::start(&state, &["--log-level=none"]);
    terminal.evaluate("(in-package :pp-tut)");
    let mut random = Pcg64::new(seed, 1);
    let mut pause = || thread::sleep(Duration::from_millis(20 + random.next_u64() % 700));
    let mut times = Vec::new();
    for round in 0..count {
        terminal.line(&PLAN.replace("NUMBER", &round.to_string()));
        terminal.wait_for(&format!(":BEGUN-{round}"));
        pause();
        times.push(interrupt(&terminal));
        if round % 4 == 3 {
            terminal.line("0");
            terminal.wait_until("the plan goes on", |text| !text.ends_with("stopped>"));
            pause();
            times.push(interrupt(&terminal));
        }
        terminal.keys(ANSWERS[usize::try_from(round % 3).expect("an index")]);
        terminal.wait_for_last_line("PP-TUT>");
        terminal.line(&format!("(list :sane {round})"));
        terminal.wait_for(&format!("(:SANE {round})"));
        terminal.wait_for_last_line("PP-TUT>");
    }
    // The robot is as able as before.
    terminal.line("(progn (with-simulated-robot (park-arms)) :parked)");
    terminal.wait_for("\n:PARKED\n");
    times.sort();
    times
}

#[test]
fn a_plan_is_interrupted_at_random_moments() {
    interrupts(4, 1);
}

/// Prints the median and the longest time until the prompt is there.
#[test]
#[ignore = "it takes minutes"]
fn ctrl_c_a_hundred_times() {
    let times = interrupts(100, 2);
    println!(
        "{} interrupts: median {:?}, longest {:?}",
        times.len(),
        times[times.len() / 2],
        times[times.len() - 1]
    );
}
