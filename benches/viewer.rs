//! What pictures cost: `cargo bench --bench viewer`.
#![allow(missing_docs)]

mod measured;

use criterion::{Criterion, criterion_group, criterion_main};
use measured::Watch;

fn pictures(c: &mut Criterion) {
    planwright::measured::pictures(&mut Watch(c));
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = pictures
}
criterion_main!(benches);
