//! One connection: reads what the client sends, and gives it to whom it concerns.

use std::io::{self, BufReader};
use std::net::TcpStream;
use std::sync::Arc;

use super::framing;
use super::hub::{Client, Hub, Job, Request};
use super::known_names;
use super::outbox::Outbox;
use super::sexp::Sexp;
use view::watch::live::{Stranger, is_same};

/// The longest message of a client that has not said the secret, or anything yet.
const MAX_FIRST: usize = 1 << 16;

/// Serves a client until it leaves.
pub(super) fn serve(
    hub: &Hub,
    stranger: &Stranger,
    stream: TcpStream,
    secret: Option<&str>,
) -> io::Result<()> {
    // Messages are small and wanted at once.
    stream.set_nodelay(true)?;
    let mut from = BufReader::new(stream.try_clone()?);
    let Some(said) = framing::read_at_most(&mut from, MAX_FIRST)? else {
        return Ok(());
    };
    // Whoever does not know the secret learns nothing.
    let knows = |secret: &str| is_same(said.trim_end().as_bytes(), secret.as_bytes());
    if !secret.is_none_or(knows) {
        return Ok(());
    }
    let Some(_guest) = stranger.welcome() else {
        return Ok(());
    };
    // SLIME also says a secret that nobody has asked for.
    let first = match secret.is_some() || !said.trim_start().starts_with('(') {
        true => framing::read(&mut from)?,
        false => Some(said),
    };
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
