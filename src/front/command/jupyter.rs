//! Notebooks: makes the kernel known to Jupyter, runs it, and makes notebooks of Markdown.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};

use super::failure::{CommandError, Status, read};
use super::open::open_session;
use super::options::{LogLevel, Options};
use super::replay::report;
use crate::jupyter::{
    Connection, Interrupter, Kernel, KernelError, Place, Settings, Specification, notebook,
    outputs, watch,
};
use crate::prompt::lessons_file;
use crate::transcript::{Transcript, Verdict};
use session::dialogue::Evaluate;
use session::is_built_in;
use view::picture::View;

/// Width and height of the picture by which the kernel is known (pixels).
const LOGO: usize = 64;

/// What to do about notebooks.
#[derive(Subcommand, Debug)]
pub(crate) enum JupyterCommand {
    /// Make the kernel known to Jupyter; it will run with the options that are given here
    Install {
        #[command(flatten)]
        place: PlaceArguments,
        #[command(flatten)]
        behaviour: BehaviourArguments,
    },
    /// Remove what `install` has written
    Uninstall {
        #[command(flatten)]
        place: PlaceArguments,
    },
    /// Run the kernel, as Jupyter does
    Run {
        /// File in which Jupyter tells where to listen
        #[arg(value_name = "CONNECTION-FILE")]
        connection: PathBuf,
        #[command(flatten)]
        behaviour: BehaviourArguments,
    },
    /// Print the notebook of a Markdown file: each input in its `session` blocks becomes a cell
    Notebook {
        /// Markdown file
        #[arg(value_name = "FILE")]
        file: PathBuf,
        /// Name of the kernel that the notebook is for
        #[arg(long, value_name = "NAME", default_value = "planwright")]
        name: String,
    },
    /// Compare an executed notebook with the Markdown file that it was made of
    Compare {
        /// Markdown file
        #[arg(value_name = "FILE")]
        file: PathBuf,
        /// The notebook
        #[arg(value_name = "NOTEBOOK")]
        executed: PathBuf,
    },
}

/// Where a kernel is installed.
#[derive(Args, Debug)]
pub(crate) struct PlaceArguments {
    /// For this user; this is the default
    #[arg(long, conflicts_with_all = ["prefix", "sys_prefix"])]
    user: bool,
    /// For all that use the programs in FOLDER, such as /usr/local
    #[arg(long, value_name = "FOLDER", conflicts_with = "sys_prefix")]
    prefix: Option<PathBuf>,
    /// For the Python environment at hand
    #[arg(long)]
    sys_prefix: bool,
    /// Name of the kernel
    #[arg(long, value_name = "NAME", default_value = "planwright")]
    name: String,
}

impl PlaceArguments {
    fn place(&self) -> Place {
        match &self.prefix {
            Some(prefix) => Place::Prefix(prefix.clone()),
            None if self.sys_prefix => Place::Environment,
            None => Place::User,
        }
    }
}

/// How a kernel behaves, until a cell says otherwise.
#[derive(Args, Debug)]
pub(crate) struct BehaviourArguments {
    /// Show no picture after a cell that has changed the world, as %pictures off
    #[arg(long)]
    no_pictures: bool,
    /// Abort at a condition that nothing handles instead of waiting for the choice of a restart, as
    /// %debugger off
    #[arg(long)]
    no_debugger: bool,
}

impl BehaviourArguments {
    fn settings(&self) -> Settings {
        let usual = Settings::default();
        Settings {
            view: usual.view.filter(|_| !self.no_pictures),
            has_debugger: !self.no_debugger,
            ..usual
        }
    }
}

/// Does what is wanted.
pub(crate) fn jupyter(options: &Options, wanted: &JupyterCommand) -> Result<Status, CommandError> {
    match wanted {
        JupyterCommand::Install { place, behaviour } => install(options, place, behaviour),
        JupyterCommand::Uninstall { place } => {
            let folder = Specification::uninstall(&place.name, &place.place())?;
            writeln!(io::stdout(), "Removed {}", folder.display())?;
            Ok(Status::Good)
        }
        JupyterCommand::Run {
            connection,
            behaviour,
        } => run(options, connection, behaviour),
        JupyterCommand::Notebook { file, name } => {
            let text = read(file)?;
            let notebook = notebook(&file.to_string_lossy(), &text, name);
            io::stdout().write_all(notebook.as_bytes())?;
            Ok(Status::Good)
        }
        JupyterCommand::Compare { file, executed } => compare(options, file, executed),
    }
}

fn install(
    options: &Options,
    place: &PlaceArguments,
    behaviour: &BehaviourArguments,
) -> Result<Status, CommandError> {
    // This also shows that the options can be used.
    let session = open_session(options)?;
    let logo = session.simulation().picture(View::Follow, LOGO, LOGO)?;
    let program = std::env::current_exe()?;
    let mut command = vec![program.to_string_lossy().into_owned()];
    command.extend(options_as_given(options)?);
    command.extend(["jupyter".to_owned(), "run".to_owned()]);
    for (flag, is_given) in [
        ("--no-pictures", behaviour.no_pictures),
        ("--no-debugger", behaviour.no_debugger),
    ] {
        command.extend(is_given.then(|| flag.to_owned()));
    }
    let specification = Specification {
        name: place.name.clone(),
        command,
    };
    let folder = specification.install(&place.place(), &logo.to_png()?)?;
    writeln!(
        io::stdout(),
        "Installed {} in {}",
        specification.name,
        folder.display()
    )?;
    Ok(Status::Good)
}

/// The options that differ from the usual ones, independent of the working directory.
fn options_as_given(options: &Options) -> Result<Vec<String>, CommandError> {
    let mut given = Vec::new();
    let mut add = |name: &str, value: String| given.push(format!("--{name}={value}"));
    if options.seed != 0 {
        add("seed", options.seed.to_string());
    }
    let files = [
        ("world", &options.world),
        ("world-description", &options.world_description),
        ("robot", &options.robot),
        ("robot-description", &options.robot_description),
        ("objects", &options.objects),
    ];
    let files = files.into_iter();
    let files = files.filter_map(|(name, path)| Some((name, path.as_ref()?)));
    let packages = options.package_path.iter();
    let packages = packages.map(|path| ("package-path", path));
    let systems = options.systems.iter().map(|path| ("systems", path));
    let setup = options.setup.iter().map(|path| ("setup", path));
    for (name, path) in files.chain(packages).chain(systems).chain(setup) {
        if is_built_in(path) {
            add(name, path.to_string_lossy().into_owned());
            continue;
        }
        add(
            name,
            std::path::absolute(path)?.to_string_lossy().into_owned(),
        );
    }
    if let Some(noise) = &options.noise {
        add("noise", noise.clone());
    }
    let level = match options.log_level {
        LogLevel::Debug => Some("debug"),
        LogLevel::Info => None,
        LogLevel::Warn => Some("warn"),
        LogLevel::Error => Some("error"),
        LogLevel::None => Some("none"),
    };
    if let Some(level) = level {
        add("log-level", level.to_owned());
    }
    if let Some(factor) = options.realtime {
        add("realtime", factor.to_string());
    }
    if let Some(port) = options.view_port {
        add("view-port", port.to_string());
    }
    if let Some(bytes) = options.heap {
        add("heap", bytes.to_string());
    }
    if options.faithful {
        given.push("--faithful".to_owned());
    }
    if options.closed {
        given.push("--closed".to_owned());
    }
    Ok(given)
}

/// Compares the outputs of cells with those of the inputs that they are.
fn compare(options: &Options, file: &Path, executed: &Path) -> Result<Status, CommandError> {
    let transcript = Transcript::parse(&file.to_string_lossy(), &read(file)?);
    let outputs = outputs(&read(executed)?).map_err(|error| CommandError::Notebook {
        path: executed.to_owned(),
        error,
    })?;
    let entries = transcript.entries.iter();
    let entries = entries.filter(|entry| !entry.input.trim().is_empty());
    let mut outputs = outputs.iter();
    let verdicts: Vec<Verdict> = entries
        .map(|entry| Verdict::of(entry, outputs.next().map_or("", String::as_str)))
        .collect();
    report(options, &transcript, &verdicts)
}

fn run(
    options: &Options,
    connection: &Path,
    behaviour: &BehaviourArguments,
) -> Result<Status, CommandError> {
    let connection = Connection::read(connection).map_err(KernelError::from)?;
    let mut session = open_session(options)?;
    if let Some(path) = lessons_file() {
        session.remember_lessons(&path, &std::process::id().to_string());
    }
    let interrupter = Interrupter::new(session.interrupt_handle());
    let kernel = Kernel::listen(&connection, interrupter.clone(), behaviour.settings())?;
    watch(interrupter.clone())?;
    // Ctrl-C in the terminal of a client reaches the kernel, too.
    ctrlc::set_handler(move || interrupter.interrupt())
        .map_err(|error| CommandError::Write(io::Error::other(error)))?;
    Ok(Status::Left(kernel.serve(&mut session)))
}
