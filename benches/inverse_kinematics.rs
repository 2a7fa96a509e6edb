//! What it costs to compute forward and inverse kinematics and to read the robot: `cargo bench
//! --bench inverse_kinematics`.
#![allow(missing_docs)]

mod measured;

use criterion::{Criterion, criterion_group, criterion_main};
use measured::Watch;

fn kinematics(c: &mut Criterion) {
    planwright::measured::kinematics(&mut Watch(c));
    planwright::measured::reading(&mut Watch(c));
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(100);
    targets = kinematics
}
criterion_main!(benches);
