//! The program in a pseudo-terminal, as a person has it before them: keys go in, a screen is
//! read.

use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::Child;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use pty_process::Size;
use pty_process::blocking::{Command, Pty, open};

/// Lines and columns of the screen.
const ROWS: u16 = 50;
const COLUMNS: u16 = 110;
/// Lines that have left the screen and can still be read.
const SCROLLBACK: usize = 5000;
/// How long anything may take on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);
const POLL: Duration = Duration::from_millis(2);

pub(crate) const UP: &str = "\x1b[A";
pub(crate) const DOWN: &str = "\x1b[B";
pub(crate) const LEFT: &str = "\x1b[D";
pub(crate) const TAB: &str = "\t";
pub(crate) const ENTER: &str = "\r";
pub(crate) const CTRL_C: &str = "\x03";
pub(crate) const CTRL_D: &str = "\x04";
pub(crate) const CTRL_J: &str = "\n";
pub(crate) const CTRL_R: &str = "\x12";

/// A directory for what a test's sessions keep; removed with the value.
pub(crate) struct State(PathBuf);

impl State {
    pub(crate) fn new(name: &str) -> State {
        let path = std::env::temp_dir().join(format!("planwright-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a directory");
        State(path)
    }

    pub(crate) fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for State {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// The program and its screen.
pub(crate) struct Terminal {
    keys: Arc<Pty>,
    screen: Arc<Mutex<vt100::Parser>>,
    child: Child,
}

impl Terminal {
    /// Starts the program and waits for its prompt.
    pub(crate) fn start(state: &State, arguments: &[&str]) -> Terminal {
        let terminal = Terminal::spawn(state, arguments);
        terminal.wait_for("CL-USER> ");
        terminal
    }

    /// Starts the program where the last session ended.
    pub(crate) fn start_resumed(state: &State) -> Terminal {
        Terminal::spawn(state, &["--resume"])
    }

    /// Starts the program with variables of the environment.
    pub(crate) fn start_with(
        state: &State,
        arguments: &[&str],
        variables: &[(&str, &str)],
    ) -> Terminal {
        let terminal = Terminal::spawn_with(state, arguments, variables);
        terminal.wait_for("CL-USER> ");
        terminal
    }

    /// Starts the program.
    pub(crate) fn spawn(state: &State, arguments: &[&str]) -> Terminal {
        Terminal::spawn_with(state, arguments, &[])
    }

    fn spawn_with(state: &State, arguments: &[&str], variables: &[(&str, &str)]) -> Terminal {
        let (pty, pts) = open().expect("a pseudo-terminal");
        pty.resize(Size::new(ROWS, COLUMNS)).expect("it has a size");
        let child = Command::new(env!("CARGO_BIN_EXE_planwright"))
            .args(arguments)
            .env("XDG_STATE_HOME", state.path())
            .env("HOME", state.path())
            .env("TERM", "xterm-256color")
            .env_remove("NO_COLOR")
            .env_remove("XTERM_VERSION")
            .env_remove("TMUX")
            .envs(variables.iter().copied())
            .spawn(pts)
            .expect("the program starts");
        let keys = Arc::new(pty);
        let screen = Arc::new(Mutex::new(vt100::Parser::new(ROWS, COLUMNS, SCROLLBACK)));
        let (from, to) = (Arc::clone(&keys), Arc::clone(&screen));
        thread::spawn(move || {
            let mut bytes = [0; 4096];
            // Reading fails when the program has ended.
            while let Ok(count) = (&*from).read(&mut bytes) {
                if count == 0 {
                    break;
                }
                let mut screen = to.lock().unwrap_or_else(PoisonError::into_inner);
                screen.process(bytes.get(..count).unwrap_or_default());
            }
        });
        Terminal {
            keys,
            screen,
            child,
        }
    }

    /// Gives the window another size.
    pub(crate) fn resize(&self, rows: u16, columns: u16) {
        let mut screen = self.screen.lock().unwrap_or_else(PoisonError::into_inner);
        screen.screen_mut().set_size(rows, columns);
        drop(screen);
        self.keys
            .resize(Size::new(rows, columns))
            .expect("it has a size");
    }

    /// Types a text, or presses keys.
    pub(crate) fn keys(&self, text: &str) {
        (&*self.keys)
            .write_all(text.as_bytes())
            .expect("the program listens");
    }

    /// Types a line and presses Enter.
    pub(crate) fn line(&self, text: &str) {
        self.keys(text);
        self.keys(ENTER);
    }

    /// Types a line and waits until a prompt is there again.
    pub(crate) fn evaluate(&self, text: &str) -> String {
        let before = self.prompts();
        self.line(text);
        self.wait_until("another prompt", |all| {
            prompts_in(all) > before && ends_in_prompt(all)
        });
        self.text()
    }

    /// Pastes a text as terminals do.
    pub(crate) fn paste(&self, text: &str) {
        self.keys(&format!("\x1b[200~{text}\x1b[201~"));
    }

    /// All that is on the screen.
    pub(crate) fn text(&self) -> String {
        let screen = self.screen.lock().unwrap_or_else(PoisonError::into_inner);
        let contents = screen.screen().contents();
        contents.trim_end().to_owned()
    }

    /// The screen with its colours.
    pub(crate) fn formatted(&self) -> String {
        let screen = self.screen.lock().unwrap_or_else(PoisonError::into_inner);
        String::from_utf8_lossy(&screen.screen().contents_formatted()).into_owned()
    }

    /// The rows of the screen that hold something, from the one that begins with the text to the
    /// cursor's; none while no row begins so.
    pub(crate) fn rows_from(&self, beginning: &str) -> Option<usize> {
        let screen = self.screen.lock().unwrap_or_else(PoisonError::into_inner);
        let screen = screen.screen();
        let (cursor, _) = screen.cursor_position();
        let first = screen
            .rows(0, screen.size().1)
            .position(|row| row.starts_with(beginning))?;
        (usize::from(cursor) + 1).checked_sub(first)
    }

    fn prompts(&self) -> usize {
        prompts_in(&self.text())
    }

    /// Waits until the screen shows the text.
    pub(crate) fn wait_for(&self, wanted: &str) {
        self.wait_until(wanted, |all| all.contains(wanted.trim_end()));
    }

    /// Waits until the last line of the screen is that.
    pub(crate) fn wait_for_last_line(&self, wanted: &str) {
        self.wait_until(wanted, |all| {
            all.lines().last().map(str::trim_end) == Some(wanted)
        });
    }

    /// Waits until the text on the screen is as wanted.
    pub(crate) fn wait_until(&self, what: &str, is_there: impl Fn(&str) -> bool) {
        let begin = Instant::now();
        while !is_there(&self.text()) {
            assert!(
                begin.elapsed() < PATIENCE,
                "waited for {what}; the screen shows\n{}",
                self.text()
            );
            thread::sleep(POLL);
        }
    }

    /// Ends the program as `kill -9` does.
    pub(crate) fn kill(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }

    /// Waits for the program's end; its exit status.
    pub(crate) fn exit_status(&mut self) -> Option<i32> {
        let begin = Instant::now();
        loop {
            match self.child.try_wait() {
                Ok(Some(status)) => return status.code(),
                Ok(None) => {}
                Err(_) => return None,
            }
            assert!(begin.elapsed() < PATIENCE, "the program goes on");
            thread::sleep(POLL);
        }
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        self.kill();
    }
}

fn is_prompt(line: &str) -> bool {
    line.starts_with("CL-USER") || line.starts_with("PP-TUT")
}

fn prompts_in(text: &str) -> usize {
    text.lines().filter(|line| is_prompt(line)).count()
}

fn ends_in_prompt(text: &str) -> bool {
    text.lines()
        .last()
        .is_some_and(|line| is_prompt(line) && line.trim_end().ends_with('>'))
}
