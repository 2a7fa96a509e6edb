//! What world steps, snapshots, collision checks and perception cost: `cargo bench --bench
//! world`.
#![allow(missing_docs)]

mod measured;

use criterion::{Criterion, criterion_group, criterion_main};
use measured::Watch;

fn world(c: &mut Criterion) {
    planwright::measured::steps(&mut Watch(c));
    planwright::measured::snapshots(&mut Watch(c));
    planwright::measured::collisions(&mut Watch(c));
    planwright::measured::sight(&mut Watch(c));
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(100);
    targets = world
}
criterion_main!(benches);
