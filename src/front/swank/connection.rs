//! One connection: reads what the client sends, and gives it to whom it concerns.

use std::io::{self, BufReader};
use std::net::TcpStream;
use std::sync::Arc;

use super::framing;
use super::hub::{Client, Hub, Job, Request};
use super::known_names;
use super::outbox::Outbox;
use super::sexp::Sexp;

/// Serves a client until it leaves.
pub(super) fn serve(hub: &Hub, stream: TcpStream, secret: Option<&str>) -> io::Result<()> {
    // Messages are small and wanted at once.
    stream.set_nodelay(true)?;
    let mut from = BufReader::new(stream.try_clone()?);
    let mut first = framing::read(&mut from)?;
    match secret {
        // Whoever does not know the secret learns nothing.
        Some(secret) if !first.as_deref().is_some_and(|said| is_same(said, secret)) => {
            return Ok(());
        }
        Some(_) => first = framing::read(&mut from)?,
        // A secret that nobody has asked for.
        None if first
            .as_deref()
            .is_some_and(|said| !said.trim_start().starts_with('(')) =>
        {
            first = framing::read(&mut from)?;
        }
        None => {}
    }
    let client = hub.connect(Outbox::open(stream)?);
    let served = read_all(hub, &client, first, &mut from);
    hub.leave(&client);
    client.outbox.end();
    served
}

fn read_all(
    hub: &Hub,
    client: &Arc<Client>,
    first: Option<String>,
    from: &mut impl io::Read,
) -> io::Result<()> {
    let mut message = first;
    while let Some(text) = message {
        match Sexp::read(&text) {
            Ok(message) => take(hub, client, &message),
            Err(error) => refuse(
                client,
                &text,
                &format!("The request cannot be read: {error}."),
            ),
        }
        message = framing::read(from)?;
    }
    Ok(())
}

/// Whether the client said the secret; takes equally long for all that are equally long.
fn is_same(said: &str, secret: &str) -> bool {
    let (said, secret) = (said.trim_end().as_bytes(), secret.as_bytes());
    let differing = said.iter().zip(secret).fold(0, |all, (a, b)| all | (a ^ b));
    said.len() == secret.len() && differing == 0
}

/// Answers a message that cannot be read, if it was a request: its number is its last word.
fn refuse(client: &Arc<Client>, text: &str, reason: &str) {
    let text = text.trim();
    let last = text
        .trim_end_matches(')')
        .rsplit(char::is_whitespace)
        .next();
    let id = last.and_then(|word| word.parse().ok());
    if let Some(id) = id.filter(|_| text.starts_with("(:emacs-rex")) {
        let request = Request {
            client: Arc::clone(client),
            id,
            operation: String::new(),
            arguments: Vec::new(),
            package: None,
        };
        request.abort(reason);
    }
}

fn take(hub: &Hub, client: &Arc<Client>, message: &Sexp) {
    let items = message.items();
    let kind = items.first().and_then(Sexp::as_name);
    match (kind, items) {
        (Some(":emacs-rex"), [_, form, package, _, Sexp::Int(id)]) => {
            let operation = form.item(0).and_then(Sexp::as_name).unwrap_or_default();
            let operation = operation.rsplit(':').next().unwrap_or_default();
            let request = Request {
                client: Arc::clone(client),
                id: *id,
                operation: operation.to_owned(),
                arguments: form.items().iter().skip(1).cloned().collect(),
                package: package.as_str().map(str::to_owned),
            };
            ask(hub, request);
        }
        (Some(":emacs-interrupt"), _) => hub.interrupt(client),
        (Some(":emacs-return-string"), [_, _, Sexp::Int(tag), Sexp::Str(text)]) => {
            hub.add(Job::Typed(Arc::clone(client), *tag, text.clone()));
        }
        // Pongs, and what later versions may tell: nothing waits for an answer.
        _ => {}
    }
}

/// Has a request answered.
fn ask(hub: &Hub, request: Request) {
    if !known_names::is_quick(&request.operation) {
        hub.add(Job::Request(request));
        return;
    }
    if let Some((request, names)) = hub.add_quick(request) {
        let value = known_names::answer(&names, &hub.version(), &request);
        request.ok(value.unwrap_or(Sexp::NIL));
    }
}
