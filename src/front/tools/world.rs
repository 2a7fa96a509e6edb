//! The world that a client works with.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use lisp::files::Closed;
use robotics::world::Models;
use session::{LogLevel, Session, SessionOptions};

/// Makes a session with options, in a kitchen whose descriptions have been read.
type Open = fn(&SessionOptions, &Arc<Models>) -> Result<Session, String>;

/// What worlds are made of.
#[derive(Clone)]
pub(crate) struct Opened {
    options: SessionOptions,
    models: Arc<Models>,
    open: Open,
}

impl Opened {
    /// The options and the descriptions of a session, and how to open others.
    pub(crate) fn of(session: &Session, open: Open) -> Opened {
        let options = SessionOptions {
            log_level: LogLevel::Warn,
            ..session.options().clone()
        };
        let models = Arc::clone(session.models());
        Opened {
            options,
            models,
            open,
        }
    }

    /// A session without files.
    fn session(&self) -> Result<Session, String> {
        let mut session = (self.open)(&self.options, &self.models)?;
        session.image_mut().files = Arc::new(Closed);
        let entered = session.run("start", "(in-package :pp-tut)");
        entered.map_err(|failure| failure.to_string())?;
        session.end_set_up();
        Ok(session)
    }
}

/// The world at hand, and how to make others.
pub(crate) struct World {
    opened: Opened,
    at_hand: Session,
    folder: Option<PathBuf>,
}

impl World {
    /// A fresh world. `folder` is where pages may be written, if anywhere.
    pub(crate) fn new(opened: &Opened, folder: Option<&Path>) -> Result<World, String> {
        Ok(World {
            opened: opened.clone(),
            at_hand: opened.session()?,
            folder: folder.map(Path::to_owned),
        })
    }

    /// A session with a fresh world.
    pub(super) fn fresh(&self) -> Result<Session, String> {
        self.opened.session()
    }

    /// How to make sessions with fresh worlds.
    pub(super) fn maker(&self) -> impl Fn() -> Result<Session, String> + use<> {
        let opened = self.opened.clone();
        move || opened.session()
    }

    /// The session with the world at hand.
    pub(super) fn at_hand(&mut self) -> &mut Session {
        &mut self.at_hand
    }

    /// Makes another world the one at hand.
    pub(super) fn take(&mut self, session: Session) {
        self.at_hand = session;
    }

    /// The file of that name in the folder for pages.
    pub(super) fn page(&self, name: &str) -> Result<PathBuf, String> {
        let Some(folder) = &self.folder else {
            return Err(
                "no file is written: planwright mcp --folder FOLDER allows pages".to_owned(),
            );
        };
        let is_plain = !name.starts_with(['.', '-'])
            && name.len() <= 100
            && name
                .chars()
                .all(|c| c.is_ascii_alphanumeric() || "-_.".contains(c));
        if !is_plain || name.is_empty() {
            return Err(format!(
                "{name:?} is no name of a page: letters, digits, - and _ were expected, as in run-1"
            ));
        }
        let path = folder.join(format!("{}.html", name.trim_end_matches(".html")));
        // A link would lead elsewhere.
        match path.symlink_metadata() {
            Ok(known) if !known.is_file() => Err(format!("{} is no file", shown(&path))),
            _ => Ok(path),
        }
    }
}

fn shown(path: &Path) -> String {
    path.display().to_string()
}
