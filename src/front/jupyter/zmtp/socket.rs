//! A socket that listens, and its peers.

use std::collections::BTreeMap;
use std::io::{self, BufReader, Write};
use std::net::{Shutdown, SocketAddr, TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::frame::{MAX_BYTES, Received, encoded, encoded_command, read};
use super::handshake::greet;
use super::outbox::Outbox;
use view::watch::live::{Door, Guest, Stranger};

/// Maximum number of peers.
const MAX_PEERS: usize = 64;
/// Maximum number of connections that are no peers yet: to a socket for requests, those that have not sent
/// a message with the right signature; to others, those that have sent nothing. They cannot keep peers out:
/// the one that has been silent longest makes room.
const MAX_STRANGERS: usize = 64;
/// Maximum number of bytes of a message of those.
const MAX_FIRST: u64 = 1 << 16;
/// Maximum number of subscriptions of a peer.
const MAX_SUBSCRIPTIONS: usize = 64;
/// Bytes that may wait for a peer before whoever produces them waits.
const ROOM: usize = 4 << 20;
/// How long a peer for which much waits may take nothing before it is disconnected.
const PATIENCE: Duration = Duration::from_millis(if cfg!(test) { 500 } else { 30_000 });
/// How often a wait looks whether it is to be ended.
const LOOK: Duration = Duration::from_millis(20);

/// Bytes of stack for a connection's thread.
const STACK_BYTES: usize = 2 << 20;

/// The kinds of sockets.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Kind {
    /// Takes requests and answers them.
    Router,
    /// Sends to all that have subscribed, and takes subscriptions.
    Publisher,
    /// Sends back what it gets.
    Echo,
}

impl Kind {
    pub(super) fn name(self) -> &'static str {
        match self {
            Kind::Router => "ROUTER",
            Kind::Publisher => "XPUB",
            Kind::Echo => "REP",
        }
    }

    /// The kinds of sockets that may connect to it.
    pub(super) fn peers(self) -> &'static [&'static str] {
        match self {
            Kind::Router => &["DEALER", "REQ", "ROUTER"],
            Kind::Publisher => &["SUB", "XSUB"],
            Kind::Echo => &["REQ", "DEALER"],
        }
    }
}

/// The number of a peer; no two peers of a socket ever have the same one.
pub(crate) type PeerNumber = u64;

/// What is done with messages: called with a peer's number and identity, and the frames; returns whether
/// the peer knows the key. For a publisher it is called with each topic that a peer subscribes to.
type Handler = dyn Fn(&Socket, PeerNumber, &[u8], Vec<Vec<u8>>) -> bool + Send + Sync;

/// A socket that listens.
#[derive(Clone)]
pub(crate) struct Socket(Arc<Shared>);

struct Shared {
    kind: Kind,
    address: SocketAddr,
    peers: Mutex<Peers>,
    is_closed: AtomicBool,
    handler: Box<Handler>,
}

#[derive(Default)]
struct Peers {
    all: BTreeMap<PeerNumber, Peer>,
    last: PeerNumber,
}

struct Peer {
    identity: Vec<u8>,
    outbox: Arc<Outbox>,
    stream: TcpStream,
    subscriptions: Vec<Vec<u8>>,
}

impl Socket {
    /// Listens at an address; port 0 stands for any that is free.
    pub(crate) fn bind(
        address: SocketAddr,
        kind: Kind,
        handler: impl Fn(&Socket, PeerNumber, &[u8], Vec<Vec<u8>>) -> bool + Send + Sync + 'static,
    ) -> io::Result<Socket> {
        let listener = TcpListener::bind(address)?;
        let socket = Socket(Arc::new(Shared {
            kind,
            address: listener.local_addr()?,
            peers: Mutex::default(),
            is_closed: AtomicBool::new(false),
            handler: Box::new(handler),
        }));
        let accepting = socket.clone();
        let name = format!("{} socket", kind.name());
        thread::Builder::new()
            .name(name)
            .spawn(move || accepting.accept(&listener))?;
        Ok(socket)
    }

    /// Where it listens.
    #[cfg(any(test, fuzzing))]
    pub(crate) fn address(&self) -> SocketAddr {
        self.0.address
    }

    /// Sends a message to a peer; it is lost if the peer is gone.
    pub(crate) fn send<F: AsRef<[u8]>>(&self, peer: PeerNumber, frames: &[F]) {
        let message = encoded(frames).into();
        if let Some(peer) = self.peers().all.get(&peer) {
            peer.outbox.push(message);
        }
    }

    /// Sends a message to the newest peer of that identity; returns false if there is none.
    pub(crate) fn send_to<F: AsRef<[u8]>>(&self, identity: &[u8], frames: &[F]) -> bool {
        let peers = self.peers();
        let mut found = peers.all.values().rev();
        let found = found.find(|peer| peer.identity == identity);
        if let Some(peer) = found {
            peer.outbox.push(encoded(frames).into());
        }
        found.is_some()
    }

    /// Sends a message to all peers that have subscribed to a beginning of its first frame.
    pub(crate) fn publish<F: AsRef<[u8]>>(&self, frames: &[F]) {
        let topic = frames.first().map(AsRef::as_ref).unwrap_or_default();
        let peers = self.peers();
        let takes = |peer: &&Peer| peer.subscriptions.iter().any(|s| topic.starts_with(s));
        let mut takers = peers.all.values().filter(takes).peekable();
        if takers.peek().is_some() {
            let message: Arc<[u8]> = encoded(frames).into();
            takers.for_each(|peer| peer.outbox.push(Arc::clone(&message)));
        }
    }

    /// Whether a peer is connected.
    pub(crate) fn has(&self, peer: PeerNumber) -> bool {
        self.peers().all.contains_key(&peer)
    }

    /// Waits until no peer lags far behind, or until `is_hurried`. A peer that takes nothing for
    /// long is disconnected, so that it does not keep the others waiting.
    pub(crate) fn wait_for_room(&self, is_hurried: impl Fn() -> bool) {
        let lagging: Vec<(PeerNumber, Arc<Outbox>)> = {
            let peers = self.peers();
            let lagging = peers.all.iter().filter(|(_, p)| p.outbox.bytes() > ROOM);
            lagging.map(|(n, p)| (*n, Arc::clone(&p.outbox))).collect()
        };
        for (number, outbox) in lagging {
            let mut bytes = outbox.bytes();
            let mut changed = Instant::now();
            while bytes > ROOM && !is_hurried() {
                let now = outbox.wait(ROOM, Instant::now() + LOOK);
                if now != bytes {
                    bytes = now;
                    changed = Instant::now();
                } else if changed.elapsed() > PATIENCE {
                    self.disconnect(number);
                }
            }
        }
    }

    /// Waits until everything has been sent, or until a moment.
    pub(crate) fn drain(&self, until: Instant) {
        let outboxes: Vec<Arc<Outbox>> = {
            let peers = self.peers();
            peers.all.values().map(|p| Arc::clone(&p.outbox)).collect()
        };
        for outbox in outboxes {
            while outbox.wait(0, until) > 0 && Instant::now() < until {}
        }
    }

    /// Disconnects all peers and listens no more.
    pub(crate) fn close(&self) {
        self.0.is_closed.store(true, Ordering::Relaxed);
        let numbers: Vec<PeerNumber> = self.peers().all.keys().copied().collect();
        numbers.into_iter().for_each(|peer| self.disconnect(peer));
        // The thread that accepts looks at the flag when somebody connects.
        let _ = TcpStream::connect_timeout(&self.0.address, Duration::from_millis(100));
    }

    fn peers(&self) -> MutexGuard<'_, Peers> {
        // Nothing panics while holding the lock.
        self.0.peers.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn accept(&self, listener: &TcpListener) {
        let socket = self.clone();
        let serve = move |stranger: &Stranger, stream| {
            // Whatever ends a connection, the peer is gone.
            let _ = socket.serve(stranger, stream);
        };
        let is_open = || !self.0.is_closed.load(Ordering::Relaxed);
        let kind = ("jupyter input", STACK_BYTES);
        Door::new(MAX_STRANGERS, MAX_PEERS).serve(listener, kind, is_open, serve);
    }

    /// Reads what a peer sends until it is gone.
    fn serve(&self, stranger: &Stranger, stream: TcpStream) -> io::Result<()> {
        stream.set_nodelay(true)?;
        let identity = greet(&stream, self.0.kind)?;
        let outbox = Arc::new(Outbox::default());
        let number = {
            let mut peers = self.peers();
            peers.last += 1;
            let number = peers.last;
            let peer = Peer {
                identity: identity.clone(),
                outbox: Arc::clone(&outbox),
                stream: stream.try_clone()?,
                subscriptions: Vec::new(),
            };
            peers.all.insert(number, peer);
            number
        };
        let writing = (stream.try_clone()?, Arc::clone(&outbox));
        let spawned = thread::Builder::new().spawn(move || write(&writing.0, &writing.1));
        let ended =
            spawned.and_then(|_| self.receive(number, stranger, &identity, &outbox, &stream));
        self.disconnect(number);
        ended
    }

    fn receive(
        &self,
        number: PeerNumber,
        stranger: &Stranger,
        identity: &[u8],
        outbox: &Outbox,
        stream: &TcpStream,
    ) -> io::Result<()> {
        let mut from = BufReader::new(stream);
        let mut guest: Option<Guest> = None;
        while !self.0.is_closed.load(Ordering::Relaxed) {
            let room = if guest.is_some() {
                MAX_BYTES
            } else {
                MAX_FIRST
            };
            let frames = match read(&mut from, room)? {
                Received::Message(frames) => frames,
                Received::Command(body) => {
                    if let Some(rest) = body.strip_prefix(b"\x04PING") {
                        // After two bytes of time to live comes what is to be sent back.
                        let context = rest.get(2..).unwrap_or_default();
                        let pong = [b"\x04PONG", context].concat();
                        outbox.push(encoded_command(&pong).into());
                    }
                    continue;
                }
            };
            let is_known = match self.0.kind {
                Kind::Router => (self.0.handler)(self, number, identity, frames),
                Kind::Echo => {
                    outbox.push(encoded(&frames).into());
                    true
                }
                Kind::Publisher => {
                    self.subscribe(number, identity, frames);
                    true
                }
            };
            if is_known && guest.is_none() {
                guest = stranger.welcome();
                if guest.is_none() {
                    return Ok(());
                }
            }
        }
        Ok(())
    }

    fn subscribe(&self, number: PeerNumber, identity: &[u8], frames: Vec<Vec<u8>>) {
        let Some((what, topic)) = frames.first().and_then(|frame| frame.split_first()) else {
            return;
        };
        {
            let mut peers = self.peers();
            let Some(peer) = peers.all.get_mut(&number) else {
                return;
            };
            let subscriptions = &mut peer.subscriptions;
            match what {
                1 if subscriptions.len() < MAX_SUBSCRIPTIONS => subscriptions.push(topic.to_vec()),
                0 => {
                    if let Some(at) = subscriptions.iter().position(|s| s == topic) {
                        subscriptions.remove(at);
                    }
                    return;
                }
                _ => return,
            }
        }
        (self.0.handler)(self, number, identity, vec![topic.to_vec()]);
    }

    fn disconnect(&self, number: PeerNumber) {
        if let Some(peer) = self.peers().all.remove(&number) {
            peer.outbox.close();
            // It may be gone already.
            let _ = peer.stream.shutdown(Shutdown::Both);
        }
    }
}

/// Sends what an outbox holds until it is closed.
fn write(stream: &TcpStream, outbox: &Outbox) {
    let mut to = stream;
    while let Some(message) = outbox.next() {
        if to.write_all(&message).is_err() {
            outbox.close();
            // The thread that reads notices.
            let _ = stream.shutdown(Shutdown::Both);
            return;
        }
        outbox.sent(message.len());
    }
}
