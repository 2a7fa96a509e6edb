//! Replays the beginning of a transcript, then opens the prompt in the resulting state.

use std::io;
use std::path::PathBuf;

use super::failure::{CommandError, Status, read};
use super::open::open_session;
use super::options::Options;
use super::paint::Paint;
use crate::prompt;
use crate::prompt::{Opened, ReplOptions};
use crate::transcript::{Transcript, replay_first};

/// A journal could not be resumed to the same state, which depends on the transcript.
const UNKEPT: &str = "; Nothing typed here is kept; (save-transcript \"FILE\") saves all of it.";

/// Replays the file up to and including the `entry`th input (counted from one) and opens the
/// prompt.
pub(crate) fn stop_at(
    options: &Options,
    files: &[PathBuf],
    entry: usize,
) -> Result<Status, CommandError> {
    let [path] = files else {
        return Err(CommandError::Open(
            "--stop-at takes one transcript".to_owned(),
        ));
    };
    let transcript = Transcript::parse(&path.display().to_string(), &read(path)?);
    let count = transcript.entries.len();
    if entry == 0 || entry > count {
        return Err(CommandError::Open(format!(
            "{} has no entry {entry}; its entries are 1 to {count}",
            path.display()
        )));
    }
    let mut session = open_session(options)?;
    let verdicts = replay_first(&transcript, entry, &mut session);
    let differing = verdicts.iter().filter(|verdict| !verdict.passed()).count();
    let mut remark = format!(
        "; The state after entry {entry} of {count} of {}",
        path.display()
    );
    if differing > 0 {
        remark.push_str(&format!(
            "; {differing} of them differ from the expected output"
        ));
    }
    let paint = Paint::new(options.color, &io::stdout());
    let status = prompt::run(
        session,
        ReplOptions {
            is_colored: paint.is_on(),
            remark: Some(remark),
            journals: Opened {
                remarks: vec![UNKEPT.to_owned()],
                ..Opened::default()
            },
            inputs_before: entry,
            ..ReplOptions::default()
        },
    )?;
    Ok(Status::Left(status))
}
