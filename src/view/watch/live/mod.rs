//! The live view: a page in the browser that shows the robot moving in its kitchen.
//!
//! The session writes to a [`History`]; a [`Server`] on 127.0.0.1 lets a single page read it,
//! whose address contains a random word. Invariants:
//! - The session never waits for a viewer: it publishes the newest frame and continues. Each
//!   viewer has its own thread, which may be slow, stuck or gone.
//! - A viewer can request only a pause or another speed, see [`PaceControl`]. Nothing is
//!   evaluated, no file is read, and malformed requests are dropped.
//! - Only requests that contain the random word, are addressed to this machine and come from the
//!   server's own page are answered. Others cannot use up the connections of these.
//! - Memory is bounded: the past is thinned out and old news is forgotten. Only the nodes of
//!   objects stay for ever.

mod browser;
mod connection;
mod door;
mod event_json;
mod follower;
mod frame_json;
mod history;
mod mesh_bytes;
mod pace_control;
mod page;
mod place;
mod run_file;
mod server;
mod stream;
mod timeline;
mod token;
mod updates;
mod views;

pub use browser::open_in_browser;
pub use door::{Door, Guest, Stranger};
pub use follower::{LiveFollower, RealTime};
pub use history::{History, Origin};
pub use pace_control::{PaceControl, Speed};
pub use page::embedded_page;
pub use place::{Place, PlaceError};
pub use run_file::run_file;
pub use server::Server;
pub use token::{is_same, random_word};
pub use updates::{Message, Updates};
pub use views::Views;
