//! The line editor with its history.

use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use rustyline::error::ReadlineError;
use rustyline::history::{FileHistory, History, SearchDirection};
use rustyline::{
    ColorMode, CompletionType, Config, Editor, EventHandler, KeyCode, KeyEvent, Modifiers, Result,
};

use super::assist::{Assist, Shared};
use super::history::history_file;
use super::keys::{Enter, NewLine, SharedHistory, UpOrDown};

/// Number of inputs kept from earlier sessions.
const HISTORY_SIZE: usize = 2000;
/// Number of candidates that are listed without asking.
const LISTED_CANDIDATES: usize = 60;

/// Reads inputs from the terminal.
pub(crate) struct LineEditor {
    editor: Editor<Assist, FileHistory>,
    history: Option<PathBuf>,
    entries: SharedHistory,
    prompt_width: Arc<AtomicUsize>,
    /// When the prompt was shown.
    shown: Arc<Mutex<Instant>>,
}

impl LineEditor {
    pub(crate) fn new(evaluator: Shared, colored: bool) -> Result<Self> {
        let config = Config::builder()
            .max_history_size(HISTORY_SIZE)?
            .history_ignore_dups(true)?
            .completion_type(CompletionType::List)
            .completion_show_all_if_ambiguous(true)
            .completion_prompt_limit(LISTED_CANDIDATES)
            .color_mode(if colored {
                ColorMode::Forced
            } else {
                ColorMode::Disabled
            })
            .build();
        let mut editor = Editor::with_config(config)?;
        editor.set_helper(Some(Assist::new(evaluator, colored)));
        let history = history_file();
        if let Some(path) = &history {
            // The first time there is no file, and a broken one must not stop us.
            let _ = editor.load_history(path);
        }
        let entries = SharedHistory::default();
        let mut reader = LineEditor {
            editor,
            history,
            entries,
            prompt_width: Arc::new(AtomicUsize::new(0)),
            shown: Arc::new(Mutex::new(Instant::now())),
        };
        reader.share_history();
        reader.bind_keys();
        Ok(reader)
    }

    fn share_history(&mut self) {
        let history = self.editor.history();
        let known: Vec<String> = (0..history.len())
            .filter_map(|at| history.get(at, SearchDirection::Forward).ok().flatten())
            .map(|found| found.entry.into_owned())
            .collect();
        *self.entries.lock().unwrap_or_else(PoisonError::into_inner) = known;
    }

    fn bind_keys(&mut self) {
        let key = |code| KeyEvent(code, Modifiers::NONE);
        let enter = Enter {
            prompt_width: Arc::clone(&self.prompt_width),
        };
        let handler = EventHandler::Conditional(Box::new(enter));
        self.editor.bind_sequence(key(KeyCode::Enter), handler);
        let new_line = NewLine {
            prompt_width: Arc::clone(&self.prompt_width),
            shown: Arc::clone(&self.shown),
        };
        let handler = EventHandler::Conditional(Box::new(new_line));
        self.editor.bind_sequence(KeyEvent::ctrl('J'), handler);
        for (code, is_up) in [(KeyCode::Up, true), (KeyCode::Down, false)] {
            let history = Arc::clone(&self.entries);
            let handler = EventHandler::Conditional(Box::new(UpOrDown { is_up, history }));
            self.editor.bind_sequence(key(code), handler);
        }
    }

    /// Reads one input; `name` is shown before the `>` of the prompt. A draft is offered for
    /// editing.
    pub(crate) fn read(
        &mut self,
        name: &str,
        draft: Option<&str>,
    ) -> std::result::Result<String, ReadlineError> {
        let prompt = format!("{name}> ");
        let width = prompt.chars().count();
        self.prompt_width.store(width, Ordering::Relaxed);
        let columns = self
            .editor
            .dimensions()
            .map(|(columns, _)| usize::from(columns));
        if let Some(assist) = self.editor.helper() {
            assist.set_widths(width, columns);
        }
        *self.shown.lock().unwrap_or_else(PoisonError::into_inner) = Instant::now();
        let text = match draft {
            Some(draft) => self.editor.readline_with_initial(&prompt, (draft, ""))?,
            None => self.editor.readline(&prompt)?,
        };
        // Commands of the debugger and the inspector are not worth keeping, only forms.
        let is_kept = !name.contains(' ') || text.trim_start().starts_with('(');
        let is_kept = is_kept && !text.trim().is_empty();
        if is_kept && self.editor.add_history_entry(text.as_str())? {
            self.entries
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .push(text.clone());
            // Kept at once, since a session may end at any time.
            if let Some(path) = &self.history
                && self.editor.append_history(path).is_err()
            {
                self.history = None;
            }
        }
        Ok(text)
    }

    /// Asks a question; returns whether the answer is yes.
    pub(crate) fn confirm(&mut self, question: &str) -> bool {
        match self.answer(question) {
            // A second Ctrl-D means yes.
            Err(ReadlineError::Eof) => true,
            answer => answer.unwrap_or(false),
        }
    }

    /// Asks a question; returns whether the answer is yes, and not Ctrl-D, either.
    pub(crate) fn is_wanted(&mut self, question: &str) -> bool {
        self.answer(question).unwrap_or(false)
    }

    fn answer(&mut self, question: &str) -> std::result::Result<bool, ReadlineError> {
        let answer = self.editor.readline(&format!("{question} (y or n) "))?;
        Ok(matches!(answer.trim(), "y" | "Y" | "yes"))
    }
}
