//! By how much a robot's clock is ahead, as the stamps of its messages tell it, which take their time on the way.

use std::time::Duration;

/// A message that is later than others by more than this (s) tells of the past, and a clock that differs by more has jumped.
const JUMP: f64 = 1.0;
/// By how much (s) what is known becomes less with each message.
const DRIFT: f64 = 1e-4;
/// For how long all messages are late if it is the clock that was set back. Also: for how long a message with an older
/// stamp than that of the newest one is one that was overtaken on its way.
pub const OVERTAKEN: Duration = Duration::from_millis(300);

/// What the stamp of a message says about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Timing {
    /// It is as old as messages are.
    Usual,
    /// It was on its way for so long that it counts for nothing.
    Late,
    /// The clock has jumped by so much (s).
    Jumped(f64),
}

/// What is known of a robot's clock. Times are those of a clock that never jumps.
#[derive(Clone, Copy, Debug, Default)]
pub struct RobotClock {
    ahead: Option<f64>,
    /// Since when all messages are late.
    late_since: Option<Duration>,
}

impl RobotClock {
    /// By how much (s) it is ahead of the one that never jumps: most of what was heard lately.
    pub fn ahead(&self) -> Option<f64> {
        self.ahead
    }

    /// Hears the stamp (s) of a message.
    pub fn hear(&mut self, stamp: f64, now: Duration) -> Timing {
        let ahead = stamp - now.as_secs_f64();
        let Some(known) = self.ahead else {
            self.ahead = Some(ahead);
            return Timing::Usual;
        };
        let by = ahead - known;
        if by.abs() <= JUMP {
            self.late_since = None;
            self.ahead = Some((known - DRIFT).max(ahead));
            return Timing::Usual;
        }
        let since = *self.late_since.get_or_insert(now);
        if by < 0.0 && now.saturating_sub(since) < OVERTAKEN {
            return Timing::Late;
        }
        self.late_since = None;
        self.ahead = Some(ahead);
        Timing::Jumped(by)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ms(number: u64) -> Duration {
        Duration::from_millis(number)
    }

    #[test]
    fn late_messages_are_no_jump_of_the_clock() {
        let mut clock = RobotClock::default();
        assert_eq!(clock.hear(100.0, ms(0)), Timing::Usual);
        // Every other one is two seconds late, for as long as one likes.
        for step in 1..100 {
            let now = ms(20 * step);
            let stamp = 100.0 + now.as_secs_f64();
            assert_eq!(clock.hear(stamp - 2.0, now), Timing::Late);
            assert_eq!(clock.hear(stamp - 0.3, now), Timing::Usual);
        }
        let ahead = clock.ahead().unwrap();
        assert!((ahead - 100.0).abs() < 0.02, "{ahead}");
    }

    #[test]
    fn a_clock_that_is_set_has_jumped_once() {
        let mut clock = RobotClock::default();
        clock.hear(100.0, ms(0));
        // Ahead at once, back when nothing comes in time any more.
        let Timing::Jumped(by) = clock.hear(150.1, ms(100)) else {
            panic!("it has not jumped");
        };
        assert!((by - 50.0).abs() < 0.01, "{by}");
        assert_eq!(clock.hear(150.2, ms(200)), Timing::Usual);
        assert_eq!(clock.hear(100.3, ms(300)), Timing::Late);
        assert_eq!(clock.hear(100.5, ms(500)), Timing::Late);
        assert!(matches!(clock.hear(100.6, ms(600)), Timing::Jumped(by) if by < -49.0));
        assert_eq!(clock.hear(100.7, ms(700)), Timing::Usual);
        assert!((clock.ahead().unwrap() - 100.0).abs() < 0.01);
    }
}
