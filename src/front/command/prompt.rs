//! Opens the prompt in a terminal.

use std::io::{self, Write};
use std::path::PathBuf;

use clap::Args;

use super::failure::{CommandError, Status};
use super::open::open_session;
use super::options::Options;
use super::paint::Paint;
use super::watching::{self, WatchArguments};
use crate::prompt;
use crate::prompt::lessons_file;
use session::is_built_in;

use crate::prompt::{Beginning, JournalError, Loaded, Opened, ReplOptions, Wanted};
use lisp::visible::visible;

/// Options of the prompt.
#[derive(Args, Debug, Default)]
pub(crate) struct PromptOptions {
    /// Resume the last session that is over, or the one recorded in the journal FILE: evaluate
    /// all its inputs again, which leads to the same state
    #[arg(long, value_name = "FILE", num_args = 0..=1, require_equals = true)]
    pub(crate) resume: Option<Option<PathBuf>>,
    /// Resume also where files have changed since, or an input ends otherwise than before
    #[arg(long, requires = "resume")]
    pub(crate) despite_changes: bool,
    /// New file to save the inputs to [default: a file in the state directory]
    #[arg(long, value_name = "FILE", conflicts_with = "resume")]
    pub(crate) journal: Option<PathBuf>,
}

/// Runs the prompt, in a fresh session or in a resumed one.
pub(crate) fn prompt(
    mut options: Options,
    wanted: &PromptOptions,
    watch: &WatchArguments,
) -> Result<Status, CommandError> {
    let journals = open_journals(&mut options, wanted)?;
    if let Some(path) = changed(&journals, wanted)? {
        write!(io::stdout(), "Resume with them as they are now? (y or n) ")?;
        io::stdout().flush()?;
        let mut answer = String::new();
        io::stdin().read_line(&mut answer)?;
        if !matches!(answer.trim(), "y" | "Y" | "yes") {
            return Err(JournalError::Changed(path).into());
        }
    }
    let mut session = open_session(&options)?;
    if let Some(path) = lessons_file() {
        session.remember_lessons(&path, &std::process::id().to_string());
    }
    let _watched = watching::begin(&mut session, watch)?;
    let paint = Paint::new(options.color, &io::stdout());
    let status = prompt::run(
        session,
        ReplOptions {
            is_colored: paint.is_on(),
            journals,
            despite_changes: wanted.despite_changes,
            ..ReplOptions::default()
        },
    )?;
    Ok(Status::Left(status))
}

/// Says which files are not what they were in the session that is to be resumed. Returns its journal if
/// there are any, unless the user has said that it does not matter.
pub(super) fn changed(
    journals: &Opened,
    wanted: &PromptOptions,
) -> Result<Option<PathBuf>, CommandError> {
    let Some(earlier) = &journals.earlier else {
        return Ok(None);
    };
    let changed = earlier.changed();
    for change in &changed {
        let text = change.to_string();
        writeln!(io::stderr(), "{}", visible(&text))?;
    }
    let matters = !changed.is_empty() && !wanted.despite_changes;
    Ok(matters.then(|| earlier.path.clone()))
}

/// Opens the journals that the options ask for. A session that is resumed determines how it
/// begins.
pub(super) fn open_journals(
    options: &mut Options,
    wanted: &PromptOptions,
) -> Result<Opened, JournalError> {
    let journal = match (&wanted.resume, &wanted.journal) {
        (Some(Some(path)), _) => Wanted::Of(path),
        (Some(None), _) => Wanted::Last,
        (None, Some(path)) => Wanted::In(path),
        (None, None) => Wanted::Fresh,
    };
    let beginning = Beginning {
        seed: options.seed,
        world: options.world.clone(),
        world_description: options.world_description.clone(),
        robot: options.robot.clone(),
        robot_description: options.robot_description.clone(),
        objects: options.objects.clone(),
        noise: options.noise.clone(),
        is_faithful: options.faithful,
        package_path: options.package_path.clone(),
        systems: options.systems.clone(),
        setup: options.setup.clone(),
        is_closed: options.closed,
        digests: Loaded::all(options.files()),
    };
    let mut opened = prompt::open(journal, &beginning)?;
    if let Some(earlier) = &opened.earlier {
        let beginning = earlier.beginning.clone();
        let differs = |given: &Option<PathBuf>, began: &Option<PathBuf>| {
            if given.as_deref().is_some_and(is_built_in) {
                return given != began;
            }
            let given = given.as_ref().map(std::path::absolute);
            given.is_some_and(|given| given.ok() != *began)
        };
        let absolute = |folders: &[PathBuf]| -> Vec<PathBuf> {
            let absolute = folders.iter().map(std::path::absolute);
            absolute.flatten().collect()
        };
        let unused = [
            (
                "--seed",
                options.seed != 0 && options.seed != beginning.seed,
            ),
            ("--world", differs(&options.world, &beginning.world)),
            (
                "--world-description",
                differs(&options.world_description, &beginning.world_description),
            ),
            ("--robot", differs(&options.robot, &beginning.robot)),
            (
                "--robot-description",
                differs(&options.robot_description, &beginning.robot_description),
            ),
            ("--objects", differs(&options.objects, &beginning.objects)),
            (
                "--package-path",
                !options.package_path.is_empty()
                    && absolute(&options.package_path) != beginning.package_path,
            ),
            (
                "--systems",
                !options.systems.is_empty() && absolute(&options.systems) != beginning.systems,
            ),
            (
                "--setup",
                !options.closed
                    && !options.setup.is_empty()
                    && absolute(&options.setup) != beginning.setup,
            ),
            (
                "--noise",
                options.noise.is_some() && options.noise != beginning.noise,
            ),
            ("--faithful", options.faithful && !beginning.is_faithful),
        ];
        let unused = unused.iter().filter(|(_, is_unused)| *is_unused);
        opened.remarks.extend(unused.map(|(option, _)| {
            format!("; {option} is not used: a session is resumed with what it began with.")
        }));
        options.seed = beginning.seed;
        options.world = beginning.world;
        options.world_description = beginning.world_description;
        options.robot = beginning.robot;
        options.robot_description = beginning.robot_description;
        options.objects = beginning.objects;
        options.noise = beginning.noise;
        options.faithful = beginning.is_faithful;
        options.package_path = beginning.package_path;
        options.systems = beginning.systems;
        // Who resumes a session as a closed one trusts neither its inputs nor the files that it names.
        if !options.closed {
            options.setup = beginning.setup;
            options.closed = beginning.is_closed;
        }
    }
    Ok(opened)
}
