//! What a keystroke at the prompt costs: `cargo bench --bench prompt`.
#![allow(missing_docs)]

#[cfg(unix)]
#[path = "../tests/command_line/pseudo_terminal.rs"]
#[allow(dead_code)]
mod pseudo_terminal;

#[cfg(unix)]
fn typing(c: &mut criterion::Criterion) {
    use pseudo_terminal::{State, Terminal};

    let state = State::new("typing");
    let terminal = Terminal::start(&state, &[]);
    let lines = (0..500).map(|i| format!("  (list :line {i} \"text\" ?variable) ; {i}\n"));
    terminal.paste(&format!("(list\n{}", lines.collect::<String>()));
    terminal.wait_for("; 499");
    c.bench_function(
        "a key in a form of 500 lines, and taking it back",
        |bencher| {
            bencher.iter(|| {
                terminal.keys("x");
                terminal.wait_until("the key", |text| text.ends_with('x'));
                terminal.keys("\x7f");
                terminal.wait_until("its end", |text| !text.ends_with('x'));
            });
        },
    );
}

#[cfg(not(unix))]
fn typing(_: &mut criterion::Criterion) {}

criterion::criterion_group! {
    name = benches;
    config = criterion::Criterion::default().sample_size(20);
    targets = typing
}
criterion::criterion_main!(benches);
