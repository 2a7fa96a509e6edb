//! Opening the page.

use std::env;
use std::process::{Command, Stdio};
use std::thread;

/// Opens the address in the user's browser if there is a display. Does not wait for the
/// browser; having none is not an error. Returns whether one was started.
pub fn open_in_browser(address: &str) -> bool {
    let Some(mut command) = opener() else {
        return false;
    };
    let command = command
        .arg(address)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    let Ok(mut child) = command.spawn() else {
        return false;
    };
    // The child must be waited for; whether it succeeded does not matter.
    thread::spawn(move || child.wait().map(drop));
    true
}

fn opener() -> Option<Command> {
    if cfg!(target_os = "macos") {
        return Some(Command::new("open"));
    }
    if cfg!(windows) {
        let mut command = Command::new("rundll32");
        command.arg("url.dll,FileProtocolHandler");
        return Some(command);
    }
    let has = |name| env::var_os(name).is_some_and(|value| !value.is_empty());
    (has("DISPLAY") || has("WAYLAND_DISPLAY")).then(|| Command::new("xdg-open"))
}
