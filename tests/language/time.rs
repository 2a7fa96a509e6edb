//! The clock of the language.

use super::checked::check;

#[test]
fn time_is_that_of_the_simulation() {
    check(&[
        (
            "(let ((before (get-internal-real-time))) (sleep 2) (/ (- (get-internal-real-time) before) internal-time-units-per-second))",
            "2",
        ),
        (
            "(multiple-value-list (decode-universal-time 3918000000 -1))",
            "(0 20 6 27 2 2024 1 NIL -1)",
        ),
        (
            "(loop for u from 0 below 10000000000 by 1234567891 always (multiple-value-bind (s m h d mo y) (decode-universal-time u 0) (= u (encode-universal-time s m h d mo y 0))))",
            "T",
        ),
    ]);
}
