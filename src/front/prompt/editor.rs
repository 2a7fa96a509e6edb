//! The line editor with its history.

use std::io::{self, Write};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use rustyline::config::Configurer;
use rustyline::error::ReadlineError;
use rustyline::highlight::Highlighter;
use rustyline::history::{FileHistory, History, SearchDirection};
use rustyline::{
    Cmd, ColorMode, CompletionType, ConditionalEventHandler, Config, Editor, Event, EventHandler,
    KeyCode, KeyEvent, Modifiers, Movement, Result,
};

use super::assist::{Assist, Shared};
use super::drawing::Drawing;
use super::history::history_file;
#[cfg(unix)]
use super::keys::Suspend;
use super::keys::{Enter, NewLine, SharedHistory, Tab, UpOrDown};
use super::menu::{LISTED_CANDIDATES, Leave, Menu};
#[cfg(unix)]
use super::tty;
use super::typed_ahead::{Ahead, Collecting, Collector, LastKey, Over, TypedAhead, Usual};

/// Number of inputs kept from earlier sessions.
const HISTORY_SIZE: usize = 2000;
/// How long the rest of a key may take that sends several characters, in milliseconds.
const KEY_TIME: u16 = 500;
/// How long the rest of a pasted text may take.
#[cfg(unix)]
const PASTE_TIME: Duration = Duration::from_millis(20);

/// Reads inputs from the terminal.
pub(crate) struct LineEditor {
    editor: Editor<Assist, FileHistory>,
    history: Option<PathBuf>,
    entries: SharedHistory,
    /// What stands on the screen.
    drawing: Drawing,
    menu: Menu,
    collector: Collector,
    /// Whether keys can be collected.
    collects: bool,
    ahead: TypedAhead,
    /// Set by an interrupt.
    interrupt: Arc<AtomicBool>,
    /// When the prompt was shown.
    shown: Arc<Mutex<Instant>>,
}

impl LineEditor {
    pub(crate) fn new(
        evaluator: Shared,
        colored: bool,
        interrupt: Arc<AtomicBool>,
    ) -> Result<Self> {
        let config = Config::builder()
            .max_history_size(HISTORY_SIZE)?
            .history_ignore_dups(true)?
            .completion_type(CompletionType::List)
            .completion_show_all_if_ambiguous(true)
            .completion_prompt_limit(LISTED_CANDIDATES)
            .keyseq_timeout(Some(KEY_TIME))
            // What is drawn is ours in any case: tabs, for example.
            .color_mode(ColorMode::Forced)
            .build();
        let mut editor = Editor::with_config(config)?;
        let collector = Collector::default();
        // A terminal that cannot move its cursor has no line editor, either.
        let printer = editor.create_external_printer().ok();
        let last_key = printer
            .filter(|_| cfg!(unix))
            .map(|printer| LastKey::new(collector.clone(), Box::new(printer)));
        let collects = last_key.is_some();
        let (drawing, menu) = (Drawing::default(), Menu::default());
        let assist = Assist::new(evaluator, colored, drawing.clone(), last_key, menu.clone());
        editor.set_helper(Some(assist));
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
            drawing,
            menu,
            collector,
            collects,
            ahead: TypedAhead::default(),
            interrupt,
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
        let with = |code, modifiers| KeyEvent(code, modifiers);
        self.bind(
            key(KeyCode::Enter),
            Enter {
                drawing: self.drawing.clone(),
                interrupt: Arc::clone(&self.interrupt),
            },
        );
        self.bind(
            KeyEvent::ctrl('J'),
            NewLine {
                drawing: self.drawing.clone(),
                shown: Arc::clone(&self.shown),
            },
        );
        for (code, is_up) in [(KeyCode::Up, true), (KeyCode::Down, false)] {
            let history = Arc::clone(&self.entries);
            self.bind(key(code), UpOrDown { is_up, history });
        }
        let drawing = self.drawing.clone();
        self.bind(key(KeyCode::Tab), Tab { drawing });
        self.bind(KeyEvent::ctrl('C'), Leave(self.menu.clone()));
        #[cfg(unix)]
        if let Some(modes) = tty::Modes::now() {
            let drawing = self.drawing.clone();
            self.bind(KeyEvent::ctrl('Z'), Suspend { modes, drawing });
        }
        self.bind(Event::Any, Usual);
        // As in SLIME.
        for (event, command) in [
            (with(KeyCode::Up, Modifiers::CTRL), Cmd::PreviousHistory),
            (with(KeyCode::Down, Modifiers::CTRL), Cmd::NextHistory),
            // Terminals send the same for Alt-Backspace and Ctrl-Alt-Backspace.
            (
                with(KeyCode::Backspace, Modifiers::ALT),
                Cmd::Kill(Movement::WholeBuffer),
            ),
            (
                with(KeyCode::Backspace, Modifiers::ALT | Modifiers::CTRL),
                Cmd::Kill(Movement::WholeBuffer),
            ),
        ] {
            self.bind(event, Always(command));
        }
    }

    fn bind(&mut self, event: impl Into<Event>, handler: impl ConditionalEventHandler + 'static) {
        let handler = Collecting {
            collector: self.collector.clone(),
            otherwise: handler,
        };
        let handler = EventHandler::Conditional(Box::new(handler));
        self.editor.bind_sequence(event, handler);
    }

    /// Reads one input; `name` is shown before the `>` of the prompt. A draft is offered for
    /// editing. What was typed ahead comes first.
    pub(crate) fn read(
        &mut self,
        name: &str,
        draft: Option<&str>,
    ) -> std::result::Result<String, ReadlineError> {
        let prompt = format!("{name}> ");
        if self.collect()? {
            return Err(ReadlineError::Interrupted);
        }
        let mut begun = draft.map(str::to_owned);
        // What was typed ahead of a draft was not typed for it.
        if draft.is_none() {
            match self.ahead.next() {
                Ahead::Input(text) => {
                    self.show_input(&prompt, &text)?;
                    self.keep(name, &text)?;
                    return Ok(text);
                }
                Ahead::Draft(text) => begun = Some(text),
                Ahead::End => {
                    self.show_input(&prompt, "")?;
                    return Err(ReadlineError::Eof);
                }
                Ahead::Nothing => {}
            }
        }
        self.drawing.begin(&prompt);
        *self.shown.lock().unwrap_or_else(PoisonError::into_inner) = Instant::now();
        let text = match begun {
            Some(begun) => self.editor.readline_with_initial(&prompt, (&begun, ""))?,
            None => self.editor.readline(&prompt)?,
        };
        self.keep(name, &text)?;
        // A Ctrl-C that was read along with Enter concerns what is evaluated now.
        if self.collect()? {
            self.interrupt.store(true, Ordering::Relaxed);
        }
        Ok(match self.ahead.rest_of(&text) {
            Some(rest) => format!("{text}\n{rest}"),
            None => text,
        })
    }

    /// Shows an input as if it had just been typed.
    fn show_input(&self, prompt: &str, text: &str) -> io::Result<()> {
        let assist = self.editor.helper();
        let shown = assist.map_or(prompt.into(), |assist| {
            assist.highlight_prompt(prompt, true)
        });
        let mut out = io::stdout();
        writeln!(out, "\r\x1b[K{shown}{text}")?;
        out.flush()
    }

    /// Keeps an input for later sessions.
    fn keep(&mut self, name: &str, text: &str) -> Result<()> {
        // Commands of the debugger and the inspector are not worth keeping, only forms.
        let is_kept = !name.contains(' ') || text.trim_start().starts_with('(');
        let is_kept = is_kept && !text.trim().is_empty();
        if is_kept && self.editor.add_history_entry(text)? {
            self.entries
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .push(text.to_owned());
            // Kept at once, since a session may end at any time.
            if let Some(path) = &self.history
                && self.editor.append_history(path).is_err()
            {
                self.history = None;
            }
        }
        Ok(())
    }

    /// Collects what was typed ahead; returns whether Ctrl-C is in it.
    fn collect(&mut self) -> Result<bool> {
        if !self.collects {
            return Ok(false);
        }
        let mut is_interrupted = self.collect_keys()?;
        #[cfg(unix)]
        {
            // The rest of a pasted text may be on its way.
            let wait = |ahead: &TypedAhead| {
                if ahead.has_line() {
                    PASTE_TIME
                } else {
                    Duration::ZERO
                }
            };
            while tty::has_input(wait(&self.ahead)) {
                is_interrupted |= self.collect_keys()?;
            }
        }
        Ok(is_interrupted)
    }

    /// Collects the keys that the line editor and the terminal have; returns whether Ctrl-C is among
    /// them.
    fn collect_keys(&mut self) -> Result<bool> {
        self.collector.set(true);
        // Modes of the terminal that the line editor would not end.
        self.editor.enable_synchronized_output(false);
        self.editor.enable_bracketed_paste(false);
        let read = catch_unwind(AssertUnwindSafe(|| self.editor.readline("")));
        self.editor.enable_synchronized_output(true);
        self.editor.enable_bracketed_paste(true);
        self.collector.set(false);
        let is_interrupted = self.ahead.add(&self.collector.take());
        match read {
            Err(reason) if reason.is::<Over>() => Ok(is_interrupted),
            Err(reason) => resume_unwind(reason),
            Ok(read) => read.map(|_| is_interrupted),
        }
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
        let question = format!("{question} (y or n) ");
        self.drawing.begin(&question);
        let answer = self.editor.readline(&question)?;
        Ok(matches!(answer.trim(), "y" | "Y" | "yes"))
    }
}

/// A key that always means the same.
struct Always(Cmd);

impl ConditionalEventHandler for Always {
    fn handle(
        &self,
        _: &Event,
        _: rustyline::RepeatCount,
        _: bool,
        _: &rustyline::EventContext<'_>,
    ) -> Option<Cmd> {
        Some(self.0.clone())
    }
}
