//! The file by which a client tells a kernel where to listen.

use std::fs;
use std::io;
use std::net::{IpAddr, Ipv4Addr, SocketAddr, ToSocketAddrs};
use std::path::{Path, PathBuf};

use serde::Deserialize;
use thiserror::Error;

/// Where a kernel listens, and the key of its messages.
#[derive(Clone, Deserialize, Debug)]
pub(crate) struct Connection {
    ip: String,
    #[serde(default = "tcp")]
    transport: String,
    #[serde(default)]
    key: String,
    #[serde(default = "hmac_sha256")]
    signature_scheme: String,
    /// Ports of the channels.
    pub(crate) shell_port: u16,
    pub(crate) iopub_port: u16,
    pub(crate) stdin_port: u16,
    pub(crate) control_port: u16,
    pub(crate) hb_port: u16,
}

fn tcp() -> String {
    "tcp".to_owned()
}

fn hmac_sha256() -> String {
    "hmac-sha256".to_owned()
}

/// Why a connection file is of no use.
#[derive(Debug, Error)]
pub(crate) enum ConnectionError {
    /// It cannot be read.
    #[error("cannot read {}: {error}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The reason.
        error: io::Error,
    },
    /// It is no connection file.
    #[error("{} is no connection file of Jupyter: {error}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// The reason.
        error: serde_json::Error,
    },
    /// It asks for another transport.
    #[error("the transport {0} is not supported; tcp is")]
    Transport(String),
    /// It asks for another signature.
    #[error("messages signed by {0} are not supported; those signed by hmac-sha256 are")]
    Signature(String),
    /// The address means nothing.
    #[error("{0} is no address of this machine")]
    Address(String),
}

impl Connection {
    /// Reads a connection file.
    pub(crate) fn read(path: &Path) -> Result<Connection, ConnectionError> {
        let text = fs::read_to_string(path).map_err(|error| ConnectionError::Read {
            path: path.to_owned(),
            error,
        })?;
        let read: Result<Connection, _> = serde_json::from_str(&text);
        let connection = read.map_err(|error| ConnectionError::Malformed {
            path: path.to_owned(),
            error,
        })?;
        if connection.transport != "tcp" {
            return Err(ConnectionError::Transport(connection.transport));
        }
        if connection.signature_scheme != "hmac-sha256" {
            return Err(ConnectionError::Signature(connection.signature_scheme));
        }
        Ok(connection)
    }

    /// The key of the signatures; messages are not signed if it is empty.
    pub(crate) fn key(&self) -> &str {
        &self.key
    }

    /// The address of a port.
    pub(crate) fn address(&self, port: u16) -> Result<SocketAddr, ConnectionError> {
        if self.ip == "*" {
            return Ok((IpAddr::from(Ipv4Addr::UNSPECIFIED), port).into());
        }
        let found = (self.ip.as_str(), port).to_socket_addrs();
        let found = found.ok().and_then(|mut addresses| addresses.next());
        found.ok_or_else(|| ConnectionError::Address(self.ip.clone()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Connection, String> {
        let path = std::env::temp_dir().join(format!("connection-{}.json", std::process::id()));
        fs::write(&path, text).expect("the file can be written");
        let read = Connection::read(&path).map_err(|error| error.to_string());
        fs::remove_file(&path).expect("the file is there");
        read
    }

    #[test]
    fn what_a_kernel_cannot_do_is_said() {
        let file = |transport: &str, scheme: &str| {
            format!(
                r#"{{"ip": "127.0.0.1", "transport": "{transport}", "key": "k", "signature_scheme": "{scheme}",
                    "shell_port": 1, "iopub_port": 2, "stdin_port": 3, "control_port": 4, "hb_port": 5}}"#
            )
        };
        let read_file = |transport, scheme| read(&file(transport, scheme));
        let connection = read_file("tcp", "hmac-sha256").expect("that is supported");
        let address = connection.address(connection.hb_port).ok();
        assert_eq!(address, Some(([127, 0, 0, 1], 5).into()));
        assert!(read_file("ipc", "hmac-sha256").is_err_and(|e| e.contains("ipc")));
        assert!(read_file("tcp", "hmac-md5").is_err_and(|e| e.contains("hmac-md5")));
        assert!(read("{").is_err_and(|e| e.contains("no connection file")));
    }
}
