//! One world of a sweep, at the prompt or run to its end.

use std::io::{self, IsTerminal};
use std::path::PathBuf;

use super::options::SweepOptions;
use crate::command::failure::{CommandError, Status};
use crate::command::open::open_session;
use crate::command::options::Options;
use crate::command::paint::Paint;
use crate::command::run::{RunArguments, run};
use crate::command::watching::WatchArguments;
use crate::prompt;
use crate::prompt::{Opened, ReplOptions};
use session::dialogue::{Evaluate, Outcome, Screen, evaluate_keeping_abort};
use session::sweeping::SweepFile;

/// A journal could not be resumed to the same state, which depends on the file.
const UNKEPT: &str = "; Nothing typed here is kept; (save-transcript \"FILE\") saves all of it.";

/// Opens the prompt in a world of the sweep, or runs its plan there.
pub(super) fn replay(
    options: Options,
    wanted: &SweepOptions,
    file: &SweepFile,
    world: u64,
) -> Result<Status, CommandError> {
    let seed = options.seed;
    let name = match &wanted.name {
        Some(name) => format!("{name:?}"),
        None => "(planwright::%newest-sweep)".to_owned(),
    };
    let set_up = format!("(planwright:sweep-world {name} {world} :seed {seed})");
    if wanted.run {
        let wanted = RunArguments {
            files: vec![PathBuf::from(&file.name)],
            eval: vec![set_up, "(planwright:run-sweep-world)".to_owned()],
            time_limit: wanted.time_limit,
            episode: None,
            watch: WatchArguments::default(),
        };
        return run(&options, &wanted);
    }
    let mut session = open_session(&options)?;
    let mut screen = Screen::new(io::BufWriter::new(io::stdout()));
    screen.set_cautious(io::stdout().is_terminal());
    for (place, text) in [(file.name.as_str(), &file.text), ("sweep", &set_up)] {
        let (outcome, _) = evaluate_keeping_abort(&mut screen, &mut session, place, text)?;
        if outcome != Outcome::Finished {
            screen.flush()?;
            break;
        }
    }
    screen.flush()?;
    let paint = Paint::new(options.color, &io::stdout());
    let package = session.prompt();
    let status = prompt::run(
        session,
        ReplOptions {
            is_colored: paint.is_on(),
            remark: Some(format!(
                "; World {world} of {}, in {package}: (run-sweep-world) runs the plan in it.",
                file.name
            )),
            journals: Opened {
                remarks: vec![UNKEPT.to_owned()],
                ..Opened::default()
            },
            ..ReplOptions::default()
        },
    )?;
    Ok(Status::Left(status))
}
