//! Serving Emacs: the command, and the prompt in a terminal.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Command, Stdio};
use std::time::Duration;

use super::pseudo_terminal::{CTRL_C, State, Terminal};

/// A connection as SLIME's.
struct Connection(TcpStream);

impl Connection {
    /// To a server whose home the state is: it has made a secret there.
    fn to(port: u16, state: &State) -> Connection {
        let stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
        let patience = Duration::from_secs(60);
        stream.set_read_timeout(Some(patience)).unwrap();
        let mut connection = Connection(stream);
        let secret = std::fs::read_to_string(state.path().join(".slime-secret")).unwrap();
        connection.send(secret.trim_end());
        connection
    }

    fn send(&mut self, message: &str) {
        let message = format!("{:06x}{message}", message.len());
        self.0.write_all(message.as_bytes()).unwrap();
    }

    /// Makes a request; returns the messages up to its answer, or to the end of the connection.
    fn call(&mut self, id: u32, form: &str) -> String {
        self.request(id, form);
        self.until("(:return")
    }

    fn request(&mut self, id: u32, form: &str) {
        self.send(&format!("(:emacs-rex {form} \"CL-USER\" t {id})"));
    }

    /// The messages up to one that begins in this way, or to the end of the connection.
    fn until(&mut self, wanted: &str) -> String {
        let mut told = String::new();
        loop {
            let mut digits = [0; 6];
            if self.0.read_exact(&mut digits).is_err() {
                return told;
            }
            let digits = std::str::from_utf8(&digits).unwrap();
            let mut bytes = vec![0; usize::from_str_radix(digits, 16).unwrap()];
            self.0.read_exact(&mut bytes).unwrap();
            let message = String::from_utf8(bytes).unwrap();
            told.push_str(&message);
            if message.starts_with(wanted) {
                return told;
            }
        }
    }
}

/// The port that a text tells.
fn port(text: &str) -> Option<u16> {
    let (_, rest) = text.split_once("127.0.0.1:")?;
    rest.split(':').next()?.parse().ok()
}

#[test]
fn the_command_serves_until_the_session_ends() {
    let state = State::new("swank");
    let mut served = Command::new(env!("CARGO_BIN_EXE_planwright"))
        .args(["swank", "--port", "0"])
        .env("HOME", state.path())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut line = String::new();
    let mut told = BufReader::new(served.stdout.take().unwrap());
    told.read_line(&mut line).unwrap();
    let mut connection = Connection::to(port(&line).unwrap(), &state);
    let shown = connection.call(1, "(swank-repl:listener-eval \"(+ 1 2)\")");
    assert!(
        shown.contains("(:write-string \"3\" :repl-result)"),
        "{shown}"
    );
    connection.call(2, "(swank-repl:listener-eval \"(quit 3)\")");
    assert_eq!(served.wait().unwrap().code(), Some(3));
}

#[cfg(unix)]
#[test]
fn a_secret_that_others_can_read_is_refused() {
    use std::os::unix::fs::PermissionsExt;
    let state = State::new("swank-shared");
    let file = state.path().join(".slime-secret");
    std::fs::write(&file, "guess\n").unwrap();
    std::fs::set_permissions(&file, std::fs::Permissions::from_mode(0o644)).unwrap();
    let refused = Command::new(env!("CARGO_BIN_EXE_planwright"))
        .args(["swank", "--port", "0"])
        .env("HOME", state.path())
        .output()
        .unwrap();
    assert_eq!(refused.status.code(), Some(2));
    let told = String::from_utf8(refused.stderr).unwrap();
    assert!(
        told.contains("others can read ") && told.contains("chmod 600"),
        "{told}"
    );
}

#[test]
fn the_prompt_serves_until_ctrl_c_and_keeps_what_was_evaluated() {
    let state = State::new("create-server");
    let mut terminal = Terminal::start(&state, &[]);
    terminal.evaluate("(defvar *here* 1)");
    terminal.line("(swank:create-server :port 0)");
    terminal.wait_for("Ctrl-C returns to the prompt.");
    let mut connection = Connection::to(port(&terminal.text()).unwrap(), &state);
    let created = connection.call(1, "(swank-repl:create-repl nil)");
    assert!(
        created.contains("(\"COMMON-LISP-USER\" \"CL-USER\")"),
        "{created}"
    );
    connection.call(
        2,
        "(swank-repl:listener-eval \"(defvar *there* (1+ *here*))\")",
    );
    connection.call(3, "(swank-repl:listener-eval \"(in-package :pp-tut)\")");
    connection.call(4, "(swank-repl:listener-eval \"(defvar *far* 7)\")");
    // The buffer of another package.
    let value = connection.call(5, "(swank:interactive-eval \"(list *there* *package*)\")");
    assert!(
        value.contains("=> (2 #<PACKAGE \\\"COMMON-LISP-USER\\\">)"),
        "{value}"
    );
    connection.call(6, "(swank-repl:listener-eval \"(defvar *farther* 8)\")");
    terminal.keys(CTRL_C);
    terminal.wait_for("; Emacs is no longer served.");
    assert_eq!(connection.call(7, "(swank:connection-info)"), "");
    let shown = terminal.evaluate("(list cl-user::*there* *far* *farther*)");
    assert!(shown.contains("(2 7 8)"), "{shown}");
    terminal.kill();
    let resumed = Terminal::start_resumed(&state);
    resumed.wait_for_last_line("PP-TUT>");
    let shown = resumed.evaluate("(list cl-user::*there* pp-tut::*far* pp-tut::*farther*)");
    assert!(shown.contains("(2 7 8)"), "{shown}");
}

#[test]
fn an_evaluation_that_ctrl_c_interrupts_is_left_to_the_prompt() {
    let state = State::new("create-server-stop");
    let terminal = Terminal::start(&state, &[]);
    terminal.line("(swank:create-server :port 0)");
    terminal.wait_for("Ctrl-C returns to the prompt.");
    let mut connection = Connection::to(port(&terminal.text()).unwrap(), &state);
    let endless = r#"(swank-repl:listener-eval "(progn (princ \"begun\") (loop))")"#;
    connection.request(1, endless);
    let begun = connection.until("(:write-string \"begun");
    assert!(begun.contains("begun"), "{begun}");
    terminal.keys(CTRL_C);
    terminal.wait_for("0: Continue.");
    connection.until("(:return");
    terminal.line("1");
    terminal.wait_for_last_line("CL-USER>");
    let shown = terminal.evaluate("(+ 20 3)");
    assert!(shown.contains("23"), "{shown}");
}

#[test]
fn where_nobody_could_return_nothing_is_served() {
    let output = Command::new(env!("CARGO_BIN_EXE_planwright"))
        .args(["run", "--eval", "(swank:create-server :port 0)"])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1));
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(told.contains("Only a session at the prompt"), "{told}");
}
