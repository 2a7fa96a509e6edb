//! The names that records have.

/// Names in the order in which they first occur.
pub(super) fn names<'r>(all: impl Iterator<Item = &'r str>) -> Vec<&'r str> {
    let mut names = Vec::new();
    for name in all {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// Three worlds, of which the second does not hold what is expected.
#[cfg(test)]
pub(super) fn records() -> Vec<sweep::Record> {
    use sweep::{Drawn, Ending, Record};
    let mut records: Vec<Record> = (0..3).map(|i| Record::new(i, Ending::Success)).collect();
    records[1].outcome = Ending::Expectation;
    records[1].class = Some("a < \"b\"".to_owned());
    records[1]
        .draws
        .set("kind", Drawn::Text("A, \"B\"".to_owned()));
    for record in &mut records {
        record.expectations.set("a < \"b\"", record.world != 1);
    }
    records
}
