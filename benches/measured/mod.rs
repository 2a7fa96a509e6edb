//! Measures with criterion what the library sets up.

use criterion::{BatchSize, Criterion};
use planwright::measured::Stopwatch;

/// Criterion as a stopwatch.
pub(crate) struct Watch<'a>(pub(crate) &'a mut Criterion);

impl Stopwatch for Watch<'_> {
    fn repeated(&mut self, name: &str, work: &mut dyn FnMut()) {
        self.0
            .bench_function(name, |bencher| bencher.iter(&mut *work));
    }

    fn prepared(&mut self, name: &str, prepare: &mut dyn FnMut() -> Box<dyn FnOnce()>) {
        self.0.bench_function(name, |bencher| {
            bencher.iter_batched(&mut *prepare, |work| work(), BatchSize::SmallInput);
        });
    }
}
