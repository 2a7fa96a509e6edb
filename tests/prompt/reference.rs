//! `docs/reference.md` is what `planwright reference` prints.

use crate::manual;
use session::{Session, SessionOptions};

#[test]
fn the_reference_is_current() {
    let session = Session::new(&SessionOptions::default()).unwrap();
    let kept = std::fs::read_to_string("docs/reference.md").unwrap();
    assert!(
        kept == manual::markdown(&session),
        "docs/reference.md is out of date; run: cargo run -- reference > docs/reference.md"
    );
}
