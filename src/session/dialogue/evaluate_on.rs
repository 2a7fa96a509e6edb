//! Evaluating an input and showing its events on a screen.

use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use super::{Abort, Evaluate, Event, Outcome, Screen};

/// How long an evaluation whose output nobody reads may clean up before it is interrupted again.
const BETWEEN_INTERRUPTS: Duration = Duration::from_millis(100);

/// Evaluates an input, shows its events and ends the last line.
///
/// If the output cannot be written any more, the evaluation is interrupted and the error is
/// returned: nobody would see what the robot does.
pub fn evaluate_on<W: Write>(
    screen: &mut Screen<W>,
    evaluator: &mut (impl Evaluate + ?Sized),
    source_name: &str,
    text: &str,
) -> io::Result<Outcome> {
    evaluate_events(screen, evaluator, source_name, text, Screen::show)
}

/// As [`evaluate_on`], but an unhandled condition is returned, not shown.
pub fn evaluate_keeping_abort<W: Write>(
    screen: &mut Screen<W>,
    evaluator: &mut (impl Evaluate + ?Sized),
    source_name: &str,
    text: &str,
) -> io::Result<(Outcome, Option<Abort>)> {
    let mut kept = None;
    let outcome = evaluate_events(screen, evaluator, source_name, text, |screen, event| {
        if let Event::Aborted(abort) = event {
            kept = Some((**abort).clone());
            return Ok(());
        }
        screen.show(event)
    })?;
    Ok((outcome, kept))
}

fn evaluate_events<W: Write>(
    screen: &mut Screen<W>,
    evaluator: &mut (impl Evaluate + ?Sized),
    source_name: &str,
    text: &str,
    mut show: impl FnMut(&mut Screen<W>, &Event) -> io::Result<()>,
) -> io::Result<Outcome> {
    let interrupt = evaluator.interrupt_handle();
    let mut insisting = None;
    let mut written = Ok(());
    screen.begin_input(source_name, text);
    let outcome = evaluator.evaluate(source_name, text, &mut |event| {
        if written.is_ok() {
            written = show(screen, &event).and_then(|()| screen.flush());
            if written.is_err() {
                insisting = Some(Insisting::on(&interrupt));
            }
        }
    });
    drop(insisting);
    written?;
    screen.fresh_line()?;
    screen.flush()?;
    Ok(outcome)
}

/// Interrupts an evaluation again and again until it is dropped: what the evaluation does after an
/// interrupt, such as cleanup code, may have no end, either.
struct Insisting {
    interrupt: Arc<AtomicBool>,
    has_ended: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Insisting {
    fn on(interrupt: &Arc<AtomicBool>) -> Insisting {
        interrupt.store(true, Ordering::Relaxed);
        let has_ended = Arc::new(AtomicBool::new(false));
        let (flag, end) = (Arc::clone(interrupt), Arc::clone(&has_ended));
        let insist = move || {
            while !end.load(Ordering::Relaxed) {
                thread::park_timeout(BETWEEN_INTERRUPTS);
                flag.store(true, Ordering::Relaxed);
            }
        };
        Insisting {
            interrupt: Arc::clone(interrupt),
            has_ended,
            // Without a thread, there is the one interrupt.
            thread: thread::Builder::new().spawn(insist).ok(),
        }
    }
}

impl Drop for Insisting {
    fn drop(&mut self) {
        self.has_ended.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            thread.thread().unpark();
            // It does nothing that could panic.
            let _ = thread.join();
        }
        self.interrupt.store(false, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use crate::dialogue::Finding;
    use crate::dialogue::evaluate_on::*;
    /// Outputs its input again and again until it is interrupted.
    #[derive(Default)]
    struct Endless {
        interrupt: Arc<AtomicBool>,
        rounds: usize,
        /// How often it goes on after an interrupt.
        persistence: usize,
    }

    impl Evaluate for Endless {
        fn evaluate(&mut self, _: &str, text: &str, sink: &mut dyn FnMut(Event)) -> Outcome {
            while !self.interrupt.load(Ordering::Relaxed) {
                self.rounds += 1;
                sink(Event::Output(text.to_owned()));
            }
            for _ in 0..self.persistence {
                self.interrupt.store(false, Ordering::Relaxed);
                while !self.interrupt.load(Ordering::Relaxed) {}
            }
            Outcome::Aborted
        }

        fn check(&mut self, _: &str, _: &str) -> Vec<Finding> {
            Vec::new()
        }

        fn prompt(&self) -> String {
            String::new()
        }

        fn interrupt_handle(&self) -> Arc<AtomicBool> {
            Arc::clone(&self.interrupt)
        }
    }

    /// Accepts a few bytes, then fails.
    struct Closing {
        room: usize,
    }

    impl Write for Closing {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            if self.room < bytes.len() {
                return Err(io::ErrorKind::BrokenPipe.into());
            }
            self.room -= bytes.len();
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn when_nobody_listens_the_evaluation_is_interrupted() {
        let mut endless = Endless::default();
        let mut screen = Screen::new(Closing { room: 5 });
        let ended = evaluate_on(&mut screen, &mut endless, "prompt[1]", "ab");
        let kind = ended.map_err(|error| error.kind());
        assert_eq!(kind, Err(io::ErrorKind::BrokenPipe));
        assert_eq!(endless.rounds, 3);
    }

    #[test]
    fn cleanup_without_end_is_interrupted_when_nobody_listens() {
        let mut endless = Endless {
            persistence: 3,
            ..Endless::default()
        };
        let mut screen = Screen::new(Closing { room: 5 });
        let ended = evaluate_on(&mut screen, &mut endless, "prompt[1]", "ab");
        assert!(ended.is_err());
        assert!(!endless.interrupt.load(Ordering::Relaxed));
    }
}
