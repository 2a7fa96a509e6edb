//! Sets up evaluators, in this one place.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

#[cfg(test)]
use clap::Parser;

#[cfg(test)]
use super::arguments::Arguments;
use super::cache;
use super::failure::CommandError;
use super::heap;
use super::options::{LogLevel, Options};
use super::stack::COMPILER_STACK;
use closest_name::closest_name;
use descriptions::ROBOTS;
use lisp::files::{bytes_of, text_of};
use lisp::guard::set_stack_budget;
use lisp::visible::visible;
use robotics::robot::urdf_text;
use robotics::world::Models;
use session::dialogue::Evaluate;
use session::{self, ASSETS, Session, SessionOptions, Simulator, is_generated, is_shipped_robot};

/// A fresh evaluator with its own world. Call it on a thread with a large stack.
pub(crate) fn open(options: &Options) -> Result<Box<dyn Evaluate>, CommandError> {
    Ok(Box::new(open_session(options)?))
}

/// Like [`open`], for callers that need the world.
pub(crate) fn open_session(options: &Options) -> Result<Session, CommandError> {
    let read = |path: &Path| -> Result<(String, String), CommandError> {
        let text = text_of(path)
            .map_err(|error| CommandError::Open(format!("{}: {error}", path.display())))?;
        Ok((path.display().to_string(), text))
    };
    let generated = options.world.as_deref().filter(|world| is_generated(world));
    let published = options.world.as_deref();
    let published = published.and_then(|file| Some((file, Simulator::of(file)?)));
    let shipped = options.robot.as_deref();
    let shipped = shipped.filter(|robot| is_shipped_robot(robot));
    let mut session_options = SessionOptions {
        seed: options.seed,
        robot: match shipped {
            Some(_) => None,
            None => options.robot.as_deref().map(read_robot).transpose()?,
        },
        robot_description: options.robot_description.as_deref().map(read).transpose()?,
        world: match generated.is_some() || published.is_some() {
            true => None,
            false => options.world.as_deref().map(read_urdf).transpose()?,
        },
        world_description: world_description(options)
            .as_deref()
            .map(read)
            .transpose()?,
        objects: options.objects.as_deref().map(read).transpose()?,
        package_paths: package_paths(&options.package_path)?,
        mesh_cache: cache::directory("meshes"),
        noise: options.noise.clone(),
        is_faithful: options.faithful,
        systems: folders("--systems", &options.systems)?,
        log_level: match options.log_level {
            LogLevel::Debug => session::LogLevel::Debug,
            LogLevel::Info => session::LogLevel::Info,
            LogLevel::Warn => session::LogLevel::Warn,
            LogLevel::Error => session::LogLevel::Error,
            LogLevel::None => session::LogLevel::None,
        },
        realtime: options.realtime,
        view_port: options.view_port,
        heap: heap::limit(options.heap),
        ..SessionOptions::default()
    };
    if let Some(name) = shipped {
        let set = session_options.set_shipped_robot(&name.to_string_lossy());
        set.map_err(|error| CommandError::Open(error.to_string()))?;
    }
    if let Some(name) = generated {
        let set = session_options.set_generated_world(&name.to_string_lossy());
        set.map_err(|error| CommandError::Open(error.to_string()))?;
    }
    if let Some((file, simulator)) = published {
        let (name, text) = read(file)?;
        let set = match simulator {
            Simulator::RoboCasa => session_options.set_layout(&name, &text),
            Simulator::ProcThor => {
                let (_, assets) = read(&assets_of(file, &options.package_path)?)?;
                session_options.set_house(&name, &text, &assets)
            }
        };
        set.map_err(|error| CommandError::Open(error.to_string()))?;
    }
    set_stack_budget(COMPILER_STACK);
    let mut session =
        Session::new(&session_options).map_err(|error| CommandError::Open(error.to_string()))?;
    tell_remarks(&session, options)?;
    for file in &options.setup {
        let set_up = session.run_file(file);
        set_up.map_err(|failure| CommandError::Open(format!("{}: {failure}", file.display())))?;
    }
    if options.closed {
        session.close();
    }
    Ok(session)
}

/// The file with the sizes of what stands in a house: beside it, or in one of some folders.
fn assets_of(house: &Path, folders: &[PathBuf]) -> Result<PathBuf, CommandError> {
    let beside = house.parent().map(Path::to_path_buf);
    let files = beside
        .iter()
        .chain(folders)
        .map(|folder| folder.join(ASSETS));
    let mut files = files.filter(|file| file.is_file());
    files.next().ok_or_else(|| {
        CommandError::Open(format!(
            "{}: a house of ProcTHOR says what stands in it, {ASSETS} how large that is: put that file beside it, or \
             give its folder by --package-path",
            house.display()
        ))
    })
}

/// A fresh session with options, in a kitchen whose descriptions have been read.
pub(super) fn open_for_programs(
    options: &SessionOptions,
    models: &Arc<Models>,
) -> Result<Session, String> {
    set_stack_budget(COMPILER_STACK);
    Session::with_models(options, Arc::clone(models)).map_err(|error| error.to_string())
}

/// The description of the kitchen's furniture: the one that is given, or else the file beside the
/// given kitchen that is called like it.
fn world_description(options: &Options) -> Option<PathBuf> {
    let beside = || {
        let file = options.world.as_ref()?.with_extension("sexp");
        file.is_file().then_some(file)
    };
    options.world_description.clone().or_else(beside)
}

/// A fresh session, as with no options on the command line.
#[cfg(test)]
pub(crate) fn open_default() -> Result<Session, String> {
    crate::precompiled::use_compiled_library();
    let arguments = Arguments::try_parse_from(["planwright"]).map_err(|error| error.to_string())?;
    open_session(&arguments.options).map_err(|error| error.to_string())
}

/// Name and text of a URDF.
fn read_urdf(path: &Path) -> Result<(String, String), CommandError> {
    let wrong = |error: String| CommandError::Open(format!("{}: {error}", path.display()));
    let bytes = bytes_of(path).map_err(|error| wrong(error.to_string()))?;
    let text = urdf_text(&bytes).map_err(wrong)?;
    Ok((path.display().to_string(), text))
}

/// As [`read_urdf`], of a robot; what cannot be read may be the misspelt name of one that comes with
/// planwright.
fn read_robot(path: &Path) -> Result<(String, String), CommandError> {
    let names = || ROBOTS.iter().map(|robot| robot.name);
    read_urdf(path).map_err(|error| match error {
        CommandError::Open(text) if path.extension().is_none() && !path.exists() => {
            let closest = closest_name(&path.to_string_lossy(), names());
            let hint = closest.map_or_else(String::new, |name| format!("; did you mean {name}?"));
            let names: Vec<&str> = names().collect();
            CommandError::Open(format!(
                "{text}; the robots of planwright are {}{hint}",
                names.join(", ")
            ))
        }
        other => other,
    })
}

/// Options that are about nothing but the robot of a file.
pub(in crate::command) fn robot_options(
    options: &Options,
    file: &Path,
) -> Result<SessionOptions, CommandError> {
    Ok(SessionOptions {
        robot: Some(read_urdf(file)?),
        package_paths: package_paths(&options.package_path)?,
        mesh_cache: cache::directory("meshes"),
        ..SessionOptions::default()
    })
}

/// The folders of packages: those that are given, then those of ROS.
fn package_paths(given: &[PathBuf]) -> Result<Vec<String>, CommandError> {
    let mut paths = folders("--package-path", given)?;
    let of_ros = std::env::var_os("ROS_PACKAGE_PATH").unwrap_or_default();
    let of_ros = std::env::split_paths(&of_ros).filter(|path| path.is_absolute());
    paths.extend(of_ros.filter_map(|path| path.to_str().map(str::to_owned)));
    Ok(paths)
}

/// Tells a person what the session remarks on the robot and the kitchen that were given, unless
/// warnings are not to be shown.
pub(in crate::command) fn tell_remarks(session: &Session, options: &Options) -> io::Result<()> {
    if options.log_level <= LogLevel::Warn {
        for remark in session.remarks() {
            writeln!(io::stderr(), "; Warning: {}", visible(&remark))?;
        }
    }
    Ok(())
}

/// The names of folders, independent of the working directory; an error if one is none.
fn folders(option: &str, paths: &[PathBuf]) -> Result<Vec<String>, CommandError> {
    let name = |path: &PathBuf| {
        let absolute = std::path::absolute(path).unwrap_or_else(|_| path.clone());
        match absolute.to_str() {
            Some(name) if absolute.is_dir() => Ok(name.to_owned()),
            _ => Err(CommandError::Open(format!(
                "{option} {}: there is no such folder",
                path.display()
            ))),
        }
    };
    paths.iter().map(name).collect()
}
