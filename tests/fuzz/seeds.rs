//! The pieces that inputs are made of are read as they are.

use super::target::{Taken, Target, attempt, with_large_stack};
use super::targets;

/// Maximum number of pieces of a target that are tried.
const MAX_PIECES: usize = 24;

/// Of a hundred pieces of a target, how many are read, and some that are not.
fn read(target: &Target) -> Result<(usize, Vec<String>), String> {
    let corpus = (target.corpus)();
    let mut take = (target.open)();
    let step = corpus.len().div_ceil(MAX_PIECES).max(1);
    let (mut tried, mut read, mut refused) = (0, 0, Vec::new());
    for piece in corpus.iter().step_by(step) {
        tried += 1;
        match attempt(&mut take, piece)? {
            Taken::Read => read += 1,
            Taken::Refused => refused.push(String::from_utf8_lossy(piece).into_owned()),
        }
    }
    refused.truncate(3);
    Ok((100 * read / tried.max(1), refused))
}

#[test]
fn what_inputs_are_made_of_is_read() {
    let wrong = with_large_stack(|| {
        let mut wrong = Vec::new();
        for target in targets() {
            match read(&target) {
                Ok((share, _)) if share >= target.least_read => {
                    println!("{:12} {share} % of the seeds are read", target.name);
                }
                found => wrong.push(format!("{}: {found:#?}", target.name)),
            }
        }
        wrong
    });
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
