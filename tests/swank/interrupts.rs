//! Interrupts at any moment.

use std::time::{Duration, Instant};

use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

use super::client::{Client, Served};

/// A plan that drives, looks and moves both arms, again and again.
const PLAN: &str = "(pp-tut:with-simulated-robot (loop for x = 0 then (- 1 x) do \
    (let ((?there (pp-tut::make-pose \"map\" (list (list (- x) -0.15 0) (list 0 0 0 1))))) \
      (cpl:par (exe:perform (desig:an action (type going) \
          (target (desig:a location (pose ?there))))) \
        (pp-plans::park-arms))) \
    (princ \".\")))";

/// Interrupts the plan at a moment so long after its beginning; returns how long that takes. The plan is then abandoned, or
/// goes on first.
fn interrupt_after(client: &mut Client, wait: Duration, goes_on: bool) -> Duration {
    let id = client.begin(PLAN);
    std::thread::sleep(wait);
    let mut took = interrupt(client);
    if goes_on {
        client.request("(swank:sldb-continue)");
        client.until("(:debug-return 1 1 nil)");
        std::thread::sleep(wait);
        took = took.max(interrupt(client));
    }
    client.request("(swank:throw-to-toplevel)");
    client.answer(id);
    assert_eq!(client.shown("(+ 1 2)").lines().last(), Some("3"));
    took
}

fn interrupt(client: &mut Client) -> Duration {
    let begin = Instant::now();
    client.send("(:emacs-interrupt :repl-thread)");
    let messages = client.until("(:debug-activate 1 1 nil)");
    let took = begin.elapsed();
    let is_interrupt = |message: &String| message.contains("(\"Interrupt from Emacs\" ");
    assert!(messages.iter().any(is_interrupt), "{messages:?}");
    took
}

fn interrupts(count: u32, seed: u128) -> Vec<Duration> {
    let served = Served::start();
    let mut client = served.client();
    client.shown("(pp-tut:init-projection)");
    let mut random = Pcg64::new(seed, 1);
    let times = (0..count).map(|at| {
        let wait = Duration::from_millis(u64::from(random.next_u32() % 700));
        interrupt_after(&mut client, wait, at % 3 == 0)
    });
    let mut times: Vec<Duration> = times.collect();
    // The robot is as able as before.
    let id = client.type_in("(pp-tut:with-simulated-robot (pp-plans::park-arms))");
    let last = client.answer(id).pop().unwrap();
    assert!(last.starts_with("(:return (:ok"), "{last}");
    times.sort();
    times
}

#[test]
fn a_plan_is_interrupted_and_the_session_goes_on() {
    interrupts(6, 1);
}

/// Prints the median and the longest time that an interrupt takes.
#[test]
#[ignore = "takes minutes"]
fn a_hundred_interrupts() {
    let times = interrupts(100, 2);
    println!(
        "{} interrupts: median {:?}, longest {:?}",
        times.len(),
        times[times.len() / 2],
        times[times.len() - 1]
    );
}
