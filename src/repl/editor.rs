//! The line editor with its history.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use rustyline::error::ReadlineError;
use rustyline::history::FileHistory;
use rustyline::{ColorMode, Config, Editor, EventHandler, KeyCode, KeyEvent, Modifiers, Result};

use super::assist::{Assist, Enter};
use super::history::history_file;

/// Inputs kept from earlier sessions.
const HISTORY_SIZE: usize = 2000;

/// Reads inputs from the terminal.
pub(super) struct LineEditor {
    editor: Editor<Assist, FileHistory>,
    history: Option<PathBuf>,
    prompt_width: Arc<AtomicUsize>,
}

impl LineEditor {
    pub(super) fn new(colored: bool) -> Result<Self> {
        let config = Config::builder()
            .max_history_size(HISTORY_SIZE)?
            .history_ignore_dups(true)?
            .color_mode(if colored {
                ColorMode::Forced
            } else {
                ColorMode::Disabled
            })
            .build();
        let mut editor = Editor::with_config(config)?;
        editor.set_helper(Some(Assist::new(colored)));
        let prompt_width = Arc::new(AtomicUsize::new(0));
        let enter = Enter {
            prompt_width: Arc::clone(&prompt_width),
        };
        editor.bind_sequence(
            KeyEvent(KeyCode::Enter, Modifiers::NONE),
            EventHandler::Conditional(Box::new(enter)),
        );
        let history = history_file();
        if let Some(path) = &history {
            // There is none the first time, and a broken one must not keep us out.
            let _ = editor.load_history(path);
        }
        Ok(LineEditor {
            editor,
            history,
            prompt_width,
        })
    }

    /// Reads one input; `name` is shown before the `>` of the prompt.
    pub(super) fn read(&mut self, name: &str) -> std::result::Result<String, ReadlineError> {
        let prompt = format!("{name}> ");
        self.prompt_width
            .store(prompt.chars().count(), Ordering::Relaxed);
        let text = self.editor.readline(&prompt)?;
        if !text.trim().is_empty() && self.editor.add_history_entry(text.as_str())? {
            // Kept at once, for a session may end in any way.
            if let Some(path) = &self.history
                && self.editor.append_history(path).is_err()
            {
                self.history = None;
            }
        }
        Ok(text)
    }
}
