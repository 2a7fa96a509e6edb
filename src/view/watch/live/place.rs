//! Where the page is: the port and the random word in its address.

use std::io;
use std::net::{Ipv4Addr, TcpListener};

use thiserror::Error;

use super::token::random_word;

/// Where the page is. A server that is started again is at the same place if it can be, so that
/// open pages find it.
#[derive(Debug)]
pub struct Place {
    /// The port that the user wants.
    wanted: Option<u16>,
    /// The port of the last server.
    last: Option<u16>,
    token: String,
}

/// Why the page cannot be served.
#[derive(Debug, Error)]
pub enum PlaceError {
    /// Something else has the port.
    #[error(
        "port {0} is in use; give --view-port another one, or leave it out to use any that is free"
    )]
    InUse(u16),
    /// The system refuses the port.
    #[error("port {port} cannot be used: {error}")]
    Refused {
        /// The port.
        port: u16,
        /// The reason.
        error: io::Error,
    },
    /// Anything else.
    #[error("the page cannot be served: {0}")]
    Other(io::Error),
}

impl Place {
    /// At this port, or at any that is free.
    pub fn new(port: Option<u16>) -> Self {
        Self {
            wanted: port,
            last: None,
            token: random_word(),
        }
    }

    /// The random word.
    pub fn token(&self) -> &str {
        &self.token
    }

    /// Listens on 127.0.0.1.
    pub(super) fn listen(&mut self) -> Result<TcpListener, PlaceError> {
        let at = |port| TcpListener::bind((Ipv4Addr::LOCALHOST, port));
        let listener = match (self.wanted, self.last) {
            (Some(port), _) => at(port).map_err(|error| match error.kind() {
                io::ErrorKind::AddrInUse => PlaceError::InUse(port),
                _ => PlaceError::Refused { port, error },
            })?,
            (None, Some(port)) => at(port).or_else(|_| at(0)).map_err(PlaceError::Other)?,
            (None, None) => at(0).map_err(PlaceError::Other)?,
        };
        let address = listener.local_addr().map_err(PlaceError::Other)?;
        self.last = Some(address.port());
        Ok(listener)
    }
}

impl Default for Place {
    fn default() -> Self {
        Self::new(None)
    }
}
