//! A client that speaks as SLIME does, and a server for it.

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::mpsc;
use std::thread::{self, JoinHandle};
use std::time::Duration;

use crate::command::open_default;
use crate::swank::{Ended, Server, ServerOptions, Stopper};
use crate::tests::waiting::wait_for;

/// How long a client waits for a message.
const PATIENCE: Duration = Duration::from_secs(120);

/// A server with a session of its own; ends when it is dropped.
pub(super) struct Served {
    pub(super) address: SocketAddr,
    stopper: Stopper,
    thread: Option<JoinHandle<Ended>>,
}

impl Served {
    pub(super) fn start() -> Served {
        Served::with(ServerOptions::default())
    }

    pub(super) fn with(options: ServerOptions) -> Served {
        let server = Server::bind(options).unwrap();
        let address = server.address();
        let (tell, told) = mpsc::channel();
        let serve = move || {
            let mut session = open_default().unwrap();
            let begin = move |stopper| tell.send(stopper).unwrap();
            server.serve(&mut session, None, begin).unwrap()
        };
        let thread = thread::Builder::new().stack_size(64 << 20).spawn(serve);
        Served {
            address,
            stopper: told.recv().unwrap(),
            thread: Some(thread.unwrap()),
        }
    }

    /// A client that has a prompt.
    pub(super) fn client(&self) -> Client {
        let mut client = self.stranger();
        client.call("(swank-repl:create-repl nil :coding-system \"utf-8-unix\")");
        client
    }

    /// A client that has only connected.
    pub(super) fn stranger(&self) -> Client {
        let stream = TcpStream::connect(self.address).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        Client { stream, id: 0 }
    }

    /// A client that has a prompt, as soon as there is room for one.
    pub(super) fn client_once_there_is_room(&self) -> Client {
        let mut client = wait_for("room for a client", || {
            let mut client = self.stranger();
            client.id = 1;
            let request = framed("(:emacs-rex (swank:connection-info) nil t 1)");
            client.stream.write_all(request.as_bytes()).ok()?;
            client.receive().map(|_| client)
        });
        client.call("(swank-repl:create-repl nil :coding-system \"utf-8-unix\")");
        client
    }

    /// How the server ends by itself.
    pub(super) fn wait(mut self) -> Ended {
        self.thread.take().unwrap().join().unwrap()
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        self.stopper.stop();
        if let Some(thread) = self.thread.take() {
            let ended = thread.join();
            assert!(thread::panicking() || ended.is_ok());
        }
    }
}

/// A client.
pub(super) struct Client {
    stream: TcpStream,
    id: u32,
}

impl Client {
    pub(super) fn send_bytes(&mut self, bytes: &[u8]) {
        self.stream.write_all(bytes).unwrap();
    }

    pub(super) fn send(&mut self, message: &str) {
        self.send_bytes(framed(message).as_bytes());
    }

    /// The next message; `None` if the connection has ended.
    pub(super) fn receive(&mut self) -> Option<String> {
        let mut digits = [0; 6];
        self.stream.read_exact(&mut digits).ok()?;
        let length = usize::from_str_radix(std::str::from_utf8(&digits).unwrap(), 16).unwrap();
        let mut bytes = vec![0; length];
        self.stream.read_exact(&mut bytes).ok()?;
        Some(String::from_utf8(bytes).unwrap())
    }

    /// Makes a request; returns its number.
    pub(super) fn request_in(&mut self, package: &str, form: &str) -> u32 {
        self.id += 1;
        let id = self.id;
        self.send(&format!("(:emacs-rex {form} \"{package}\" t {id})"));
        id
    }

    pub(super) fn request(&mut self, form: &str) -> u32 {
        self.request_in("CL-USER", form)
    }

    /// The messages up to the one that contains a text, that one included.
    pub(super) fn until(&mut self, wanted: &str) -> Vec<String> {
        let mut messages = Vec::new();
        loop {
            let message = self.receive();
            let message = message.unwrap_or_else(|| panic!("no {wanted} in {messages:#?}"));
            let is_last = message.contains(wanted);
            messages.push(message);
            if is_last {
                return messages;
            }
        }
    }

    /// The messages up to the answer to a request.
    pub(super) fn answer(&mut self, id: u32) -> Vec<String> {
        let mut messages = Vec::new();
        loop {
            let message = self.receive();
            let message = message.unwrap_or_else(|| panic!("no answer to {id}: {messages:#?}"));
            let is_last = message.starts_with("(:return") && message.ends_with(&format!(" {id})"));
            messages.push(message);
            if is_last {
                return messages;
            }
        }
    }

    /// The answer to a request, without the number; other messages are left out.
    pub(super) fn call_in(&mut self, package: &str, form: &str) -> String {
        let id = self.request_in(package, form);
        let answer = self.answer(id).pop().unwrap();
        let answer = answer.strip_prefix("(:return ").unwrap();
        let answer = answer.strip_suffix(&format!(" {id})")).unwrap();
        answer.to_owned()
    }

    pub(super) fn call(&mut self, form: &str) -> String {
        self.call_in("CL-USER", form)
    }

    /// Types a text at the prompt; returns the number of the request.
    pub(super) fn type_in(&mut self, text: &str) -> u32 {
        self.request(&format!("(swank-repl:listener-eval {})", quoted(text)))
    }

    /// Types a form at the prompt; returns the number of the request once it is evaluated.
    pub(super) fn begin(&mut self, form: &str) -> u32 {
        let id = self.type_in(&format!("(progn (princ \"begun\") {form})"));
        self.until("(:write-string \"begun");
        id
    }

    /// What appears at the prompt: output, values, and a condition with which it was aborted.
    pub(super) fn shown(&mut self, text: &str) -> String {
        let id = self.type_in(text);
        let messages = self.answer(id);
        shown(&messages)
    }
}

/// A message with its length.
fn framed(message: &str) -> String {
    format!("{:06x}{message}", message.len())
}

/// A text as a string in a message.
pub(super) fn quoted(text: &str) -> String {
    let text = text.replace('\\', "\\\\").replace('"', "\\\"");
    format!("\"{text}\"")
}

/// What messages show at the prompt.
pub(super) fn shown(messages: &[String]) -> String {
    let mut shown = String::new();
    for message in messages {
        if let Some(rest) = message.strip_prefix("(:write-string \"") {
            let text = rest.strip_suffix("\" :repl-result)");
            let text = text.or_else(|| rest.strip_suffix("\")")).unwrap();
            shown.push_str(&text.replace("\\\"", "\"").replace("\\\\", "\\"));
        } else if let Some(rest) = message.strip_prefix("(:return (:abort \"") {
            let reason = rest.rsplit_once("\")").unwrap().0;
            shown.push_str(&format!("aborted on {reason}"));
        }
    }
    shown
}
