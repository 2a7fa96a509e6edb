//! The server: takes connections of this machine.

use std::io;
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::thread;

use thiserror::Error;

use super::connection;
use super::engine::Engine;
use super::hub::{Ended, Hub};
use super::keep::Keep;
use super::secret::SecretError;
use super::version::Version;
use session::dialogue::Serve;
use view::watch::live::{Door, Stranger};

/// Maximum number of clients at a time.
const MAX_CLIENTS: usize = 32;
/// Maximum number of connections at a time that have not said the secret. They cannot keep clients out:
/// the one that has been silent longest makes room.
const MAX_STRANGERS: usize = 32;
/// Bytes of stack for a connection's thread.
const STACK_BYTES: usize = 2 << 20;

/// How a server is set up.
#[derive(Default)]
pub(crate) struct ServerOptions {
    /// The port; any that is free if it is zero.
    pub(crate) port: u16,
    /// What clients have to say first.
    pub(crate) secret: Option<String>,
    /// The version of SLIME that clients have.
    pub(crate) version: Version,
}

/// Why there can be no server.
#[derive(Debug, Error)]
pub(crate) enum ServerError {
    /// The port cannot be used.
    #[error("cannot listen on port {port} of this machine: {error}")]
    Listen {
        /// The port.
        port: u16,
        /// The reason.
        error: io::Error,
    },
    /// There is no secret for clients to say.
    #[error("{0}")]
    Secret(#[from] SecretError),
    /// There are no threads for it.
    #[error("cannot start a thread: {0}")]
    Thread(io::Error),
}

/// A server that listens, but does not answer yet.
pub(crate) struct Server {
    listener: TcpListener,
    address: SocketAddr,
    options: ServerOptions,
}

/// Ends a server from another thread.
#[derive(Clone)]
pub(crate) struct Stopper(Arc<Hub>);

impl Stopper {
    /// Ends the server; what is evaluated is interrupted.
    pub(crate) fn stop(&self) {
        self.0.end(Ended::Stopped);
    }
}

impl Server {
    /// Listens on a port that only this machine can reach.
    pub(crate) fn bind(options: ServerOptions) -> Result<Server, ServerError> {
        let port = options.port;
        let failed = |error| ServerError::Listen { port, error };
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(failed)?;
        let address = listener.local_addr().map_err(failed)?;
        Ok(Server {
            listener,
            address,
            options,
        })
    }

    /// The address on which it listens.
    pub(crate) fn address(&self) -> SocketAddr {
        self.address
    }

    /// Serves a session until a client or the program ends that, or the one who is given the
    /// stopper does. If somebody keeps the inputs, the clients share the package and the latest values
    /// with him, since his inputs alone must lead to the same state.
    pub(crate) fn serve<'s>(
        self,
        session: &'s mut (dyn Serve + 's),
        keeper: Option<&'s mut (dyn Keep + 's)>,
        begin: impl FnOnce(Stopper),
    ) -> Result<Ended, ServerError> {
        let Server {
            listener,
            address,
            options,
        } = self;
        let names = session.names();
        let hub = Hub::new(session.interrupt_handle(), options.version, names);
        let hub = Arc::new(hub);
        let accepting = Arc::clone(&hub);
        let secret = options.secret;
        let thread = thread::Builder::new()
            .name("swank".to_owned())
            .spawn(move || accept(&listener, &accepting, secret))
            .map_err(ServerError::Thread)?;
        begin(Stopper(Arc::clone(&hub)));
        let ended = Engine::new(session, keeper, hub).run();
        // A connection wakes the thread that waits in `accept`.
        drop(TcpStream::connect(address));
        // It does nothing that could panic.
        drop(thread.join());
        Ok(ended)
    }
}

fn accept(listener: &TcpListener, hub: &Arc<Hub>, secret: Option<String>) {
    let own = Arc::clone(hub);
    let serve = move |stranger: &Stranger, stream| {
        // A client that breaks off, or sends what is no message, is merely gone.
        let _ = connection::serve(&own, stranger, stream, secret.as_deref());
    };
    let is_open = || !hub.is_ending();
    Door::new(MAX_STRANGERS, MAX_CLIENTS).serve(
        listener,
        ("swank input", STACK_BYTES),
        is_open,
        serve,
    );
}
