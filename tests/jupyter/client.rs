//! A kernel in a thread, and clients of it that speak to its sockets.

use std::io::{self, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::mpsc;
use std::thread::{self, JoinHandle};
use std::time::Duration;

use serde_json::{Value, json};

use crate::command::open_default;
use crate::jupyter::zmtp::{encoded, read_frame};
use crate::jupyter::{Author, Connection, Interrupter, Kernel, Settings, Signer};
use session::dialogue::Evaluate;

/// How long an answer may take.
const PATIENCE: Duration = Duration::from_secs(60);
const STACK_BYTES: usize = 64 << 20;
/// The key of the messages.
pub(super) const KEY: &str = "a key";

/// A kernel that runs until it is dropped.
pub(super) struct Running {
    /// Shell, iopub, stdin, control and heartbeat.
    pub(super) addresses: Vec<SocketAddr>,
    pub(super) interrupter: Interrupter,
    thread: Option<JoinHandle<u8>>,
}

/// Starts a kernel; port 0 stands for any that is free.
pub(super) fn start_at(ports: [u16; 5]) -> Running {
    let [shell, iopub, stdin, control, heartbeat] = ports;
    let text = json!({
        "ip": "127.0.0.1", "key": KEY,
        "shell_port": shell, "iopub_port": iopub, "stdin_port": stdin,
        "control_port": control, "hb_port": heartbeat,
    });
    let connection: Connection = serde_json::from_value(text).expect("a connection");
    let (sender, started) = mpsc::channel();
    let run = move || {
        let mut session = open_default().expect("a session");
        let interrupter = Interrupter::new(session.interrupt_handle());
        let settings = Settings {
            view: None,
            ..Settings::default()
        };
        let kernel = Kernel::listen(&connection, interrupter.clone(), settings).expect("a kernel");
        sender
            .send((kernel.addresses(), interrupter))
            .expect("the test waits");
        kernel.serve(&mut session)
    };
    let thread = thread::Builder::new().stack_size(STACK_BYTES).spawn(run);
    let (addresses, interrupter) = started.recv().expect("the kernel starts");
    Running {
        addresses,
        interrupter,
        thread: thread.ok(),
    }
}

pub(super) fn start() -> Running {
    start_at([0; 5])
}

impl Running {
    /// Waits until it has ended; returns its exit status.
    pub(super) fn end(&mut self) -> u8 {
        let thread = self.thread.take().expect("it has not ended");
        thread.join().expect("it does not panic")
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.interrupter.end();
        if let Some(thread) = self.thread.take() {
            let ended = thread.join();
            assert!(ended.is_ok() || thread::panicking());
        }
    }
}

/// The bytes with which a peer begins.
pub(super) fn greeting(kind: &str, identity: &str) -> Vec<u8> {
    let mut bytes = vec![0; 64];
    bytes[0] = 0xff;
    bytes[9] = 0x7f;
    bytes[10] = 3;
    bytes[12..16].copy_from_slice(b"NULL");
    let mut ready = b"\x05READY".to_vec();
    for (name, value) in [("Socket-Type", kind), ("Identity", identity)] {
        ready.push(name.len() as u8);
        ready.extend(name.as_bytes());
        ready.extend((value.len() as u32).to_be_bytes());
        ready.extend(value.as_bytes());
    }
    bytes.extend([4, ready.len() as u8]);
    bytes.extend(ready);
    bytes
}

/// A connection that has been greeted.
pub(super) fn connect(address: SocketAddr, kind: &str, identity: &str) -> TcpStream {
    try_to_connect(address, kind, identity).expect("the kernel has room")
}

fn try_to_connect(address: SocketAddr, kind: &str, identity: &str) -> io::Result<TcpStream> {
    let mut stream = TcpStream::connect(address)?;
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_nodelay(true)?;
    stream.write_all(&greeting(kind, identity))?;
    let mut theirs = [0; 64];
    stream.read_exact(&mut theirs)?;
    let ready = read_frame(&mut stream, 1000)?;
    assert!(ready.is_command && ready.body.starts_with(b"\x05READY"));
    Ok(stream)
}

/// The frames of a message.
pub(super) fn receive(stream: &mut TcpStream) -> io::Result<Vec<Vec<u8>>> {
    let mut frames = Vec::new();
    loop {
        let frame = read_frame(stream, 1 << 30)?;
        frames.push(frame.body);
        if !frame.has_more {
            return Ok(frames);
        }
    }
}

/// A message from the kernel.
#[derive(Debug)]
pub(super) struct Message {
    pub(super) kind: String,
    /// The name of the request that it belongs to.
    pub(super) parent: String,
    pub(super) content: Value,
}

fn message(stream: &mut TcpStream) -> Message {
    let frames = receive(stream).expect("a message");
    let at = frames.iter().position(|frame| frame == b"<IDS|MSG>");
    let [_, signature, header, parent, metadata, content] = &frames[at.expect("a delimiter")..]
    else {
        panic!("parts are missing: {frames:?}");
    };
    let parts: [&[u8]; 4] = [header, parent, metadata, content];
    assert!(Signer::new(KEY).verify(&parts, signature));
    let value = |bytes: &[u8]| -> Value { serde_json::from_slice(bytes).expect("JSON") };
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    Message {
        kind: text(&value(header)["msg_type"]),
        parent: text(&value(parent)["msg_id"]),
        content: value(content),
    }
}

/// A client on all channels.
pub(super) struct Client {
    pub(super) shell: TcpStream,
    pub(super) iopub: TcpStream,
    pub(super) stdin: TcpStream,
    pub(super) control: TcpStream,
    author: Author,
}

/// What came of a cell.
#[derive(Debug)]
pub(super) struct Answer {
    pub(super) reply: Value,
    /// The messages of the iopub channel that belong to it.
    pub(super) messages: Vec<Message>,
}

impl Answer {
    /// The contents of the messages of a kind.
    pub(super) fn of(&self, kind: &str) -> Vec<&Value> {
        let found = self.messages.iter().filter(|message| message.kind == kind);
        found.map(|message| &message.content).collect()
    }

    /// The output.
    pub(super) fn text(&self) -> String {
        let texts = self.of("stream").into_iter();
        texts
            .filter_map(|content| content["text"].as_str())
            .collect()
    }

    /// The value.
    pub(super) fn value(&self) -> Option<&str> {
        self.of("execute_result").first()?["data"]["text/plain"].as_str()
    }
}

impl Client {
    pub(super) fn new(kernel: &Running, identity: &str) -> Client {
        Client::with_key(kernel, identity, KEY)
    }

    pub(super) fn with_key(kernel: &Running, identity: &str, key: &str) -> Client {
        let shell = connect(kernel.addresses[0], "DEALER", identity);
        Client::with_shell(kernel, shell, identity, key)
    }

    fn with_shell(kernel: &Running, shell: TcpStream, identity: &str, key: &str) -> Client {
        let [_, iopub, stdin, control, _] = kernel.addresses[..] else {
            panic!("there are five channels");
        };
        let mut client = Client {
            shell,
            iopub: connect(iopub, "SUB", ""),
            stdin: connect(stdin, "DEALER", identity),
            control: connect(control, "DEALER", identity),
            author: Author::new(Signer::new(key)),
        };
        client
            .iopub
            .write_all(&encoded(&[b"\x01"]))
            .expect("it is read");
        let welcome = message(&mut client.iopub);
        assert_eq!(welcome.kind, "iopub_welcome");
        client
    }

    /// The bytes of a request, and its name.
    pub(super) fn request(&self, kind: &str, content: &Value) -> (Vec<u8>, String) {
        let frames = self.author.message(kind, b"", content);
        let header: Value = serde_json::from_slice(&frames[2]).expect("JSON");
        let name = header["msg_id"].as_str().unwrap_or_default().to_owned();
        (encoded(&frames), name)
    }

    /// Sends a cell; returns the name of the request.
    pub(super) fn send(&mut self, code: &str, can_ask: bool) -> String {
        let content = json!({"code": code, "silent": false, "allow_stdin": can_ask});
        let (bytes, name) = self.request("execute_request", &content);
        self.shell.write_all(&bytes).expect("it is read");
        name
    }

    /// Waits until the kernel has read all that was sent on the shell channel, and has answered
    /// nothing.
    pub(super) fn wait_until_read(&mut self) {
        let ping = b"\x04\x07\x04PING\0\0";
        self.shell.write_all(ping).expect("it is read");
        let pong = read_frame(&mut self.shell, 1000).expect("a command");
        assert!(
            pong.is_command && pong.body == b"\x04PONG",
            "{:?}",
            pong.body
        );
    }

    /// Collects what comes of a request.
    pub(super) fn wait(&mut self, name: &str) -> Answer {
        let mut messages = Vec::new();
        let mut is_idle = false;
        while !is_idle {
            let message = message(&mut self.iopub);
            if message.parent == name {
                is_idle = message.content["execution_state"] == json!("idle");
                messages.push(message);
            }
        }
        loop {
            let reply = message(&mut self.shell);
            if reply.parent == name {
                let reply = reply.content;
                return Answer { reply, messages };
            }
        }
    }

    /// Waits for a message on the iopub channel.
    pub(super) fn wait_for(&mut self, name: &str, kind: &str) -> Value {
        loop {
            let message = message(&mut self.iopub);
            if message.parent == name && message.kind == kind {
                return message.content;
            }
        }
    }

    /// Evaluates a cell; nobody can be asked.
    pub(super) fn run(&mut self, code: &str) -> Answer {
        let name = self.send(code, false);
        self.wait(&name)
    }

    /// Sends a request on the control channel; returns the content of the answer.
    pub(super) fn control(&mut self, kind: &str) -> Value {
        let (bytes, name) = self.request(kind, &json!({"restart": true}));
        self.control.write_all(&bytes).expect("it is read");
        let answer = message(&mut self.control);
        assert_eq!(answer.parent, name);
        answer.content
    }

    /// The question that the kernel asks.
    pub(super) fn question(&mut self) -> String {
        let question = message(&mut self.stdin);
        assert_eq!(question.kind, "input_request");
        let prompt = question.content["prompt"].as_str();
        prompt.unwrap_or_default().to_owned()
    }

    /// The question that the kernel asks, which is answered.
    pub(super) fn answer(&mut self, text: &str) -> String {
        let question = self.question();
        let (bytes, _) = self.request("input_reply", &json!({"value": text}));
        self.stdin.write_all(&bytes).expect("it is read");
        question
    }
}
