//! Evaluating an input and showing its events on a screen.

use std::io::{self, Write};
use std::sync::atomic::Ordering;

use super::{Abort, Evaluate, Event, Outcome, Screen};

/// Evaluates an input, shows its events and ends the last line.
///
/// If the output cannot be written any more, the evaluation is interrupted and the error is
/// returned: nobody would see what the robot does.
pub(crate) fn evaluate_on<W: Write>(
    screen: &mut Screen<W>,
    evaluator: &mut (impl Evaluate + ?Sized),
    source_name: &str,
    text: &str,
) -> io::Result<Outcome> {
    evaluate_events(screen, evaluator, source_name, text, Screen::show)
}

/// As [`evaluate_on`], but an unhandled condition is returned, not shown.
pub(crate) fn evaluate_keeping_abort<W: Write>(
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
    let mut written = Ok(());
    screen.begin_input(source_name, text);
    let outcome = evaluator.evaluate(source_name, text, &mut |event| {
        if written.is_ok() {
            written = show(screen, &event).and_then(|()| screen.flush());
            if written.is_err() {
                interrupt.store(true, Ordering::Relaxed);
            }
        }
    });
    written?;
    screen.fresh_line()?;
    screen.flush()?;
    Ok(outcome)
}

#[cfg(test)]
mod tests {
    use crate::session::dialogue::Finding;
    use crate::session::dialogue::evaluate_on::*;
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;

    /// Outputs its input again and again until it is interrupted.
    #[derive(Default)]
    struct Endless {
        interrupt: Arc<AtomicBool>,
        rounds: usize,
    }

    impl Evaluate for Endless {
        fn evaluate(&mut self, _: &str, text: &str, sink: &mut dyn FnMut(Event)) -> Outcome {
            while !self.interrupt.load(Ordering::Relaxed) {
                self.rounds += 1;
                sink(Event::Output(text.to_owned()));
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
}
