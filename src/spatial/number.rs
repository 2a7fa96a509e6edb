//! Numbers as people wrote them.

use std::fmt;

/// A number for a message. One that was given in single precision is shown by the digits of that:
/// 0.9, not 0.8999999761581421.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Shortest(pub f64);

impl fmt::Display for Shortest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        #[allow(
            clippy::cast_possible_truncation,
            reason = "whether it does is the question"
        )]
        let single = self.0 as f32;
        if f64::from(single) == self.0 {
            write!(f, "{single}")
        } else {
            write!(f, "{}", self.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_floats_are_shown_by_their_own_digits() {
        assert_eq!(Shortest(f64::from(0.9_f32)).to_string(), "0.9");
        assert_eq!(Shortest(0.9).to_string(), "0.9");
        assert_eq!(Shortest(0.123_456_789).to_string(), "0.123456789");
        assert_eq!(Shortest(f64::from(-1.1_f32)).to_string(), "-1.1");
        assert_eq!(Shortest(2.0).to_string(), "2");
        assert_eq!(Shortest(f64::INFINITY).to_string(), "inf");
    }
}
