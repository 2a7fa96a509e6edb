//! Opens the prompt in a terminal.

use std::io;

use super::arguments::{Options, PromptOptions, WatchArguments};
use super::failure::{CommandError, Status};
use super::open::open_session;
use super::paint::Paint;
use super::watching;
use crate::front::prompt;
use crate::front::prompt::{Beginning, Earlier, Journal, ReplOptions};

/// Runs the prompt, in a fresh session or in a resumed one.
pub(crate) fn prompt(
    mut options: Options,
    wanted: &PromptOptions,
    watch: &WatchArguments,
) -> Result<Status, CommandError> {
    let earlier = match &wanted.resume {
        Some(path) => Some(Earlier::read(path.as_deref())?),
        None => None,
    };
    if let Some(earlier) = &earlier {
        let beginning = earlier.beginning.clone();
        options.seed = beginning.seed;
        options.world = beginning.world;
        options.robot = beginning.robot;
        options.robot_description = beginning.robot_description;
    }
    let journal = journal(&options, wanted, earlier.as_ref());
    let mut session = open_session(&options)?;
    watching::begin(&mut session, watch)?;
    let paint = Paint::new(options.color, &io::stdout());
    let status = prompt::run(
        session,
        ReplOptions {
            is_colored: paint.is_on(),
            journal,
            resume: earlier.map(|earlier| earlier.inputs).unwrap_or_default(),
            ..ReplOptions::default()
        },
    )?;
    Ok(Status::Left(status))
}

/// The journal of this session. The prompt also works without one.
fn journal(
    options: &Options,
    wanted: &PromptOptions,
    earlier: Option<&Earlier>,
) -> Option<Journal> {
    if let Some(earlier) = earlier {
        return Journal::go_on(&earlier.path).ok();
    }
    let beginning = Beginning {
        seed: options.seed,
        world: options.world.clone(),
        robot: options.robot.clone(),
        robot_description: options.robot_description.clone(),
    };
    match &wanted.journal {
        Some(path) => Journal::create(path, &beginning).ok(),
        None => Journal::begin(&beginning),
    }
}
