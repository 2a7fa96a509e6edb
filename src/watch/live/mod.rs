//! The live view: a page in the browser that shows the robot in its kitchen as it moves.
//!
//! The session writes into a [`History`]; a [`Server`] on 127.0.0.1 lets one page read it,
//! whose address has a random word in it. What holds true here:
//! - The session never waits for a viewer: it leaves the newest frame and goes on. Every
//!   viewer has a thread of its own, which may be slow, stuck or gone.
//! - A viewer can ask for nothing but a pause and another speed, see [`PaceControl`]. Nothing
//!   is evaluated, no file is read, what is malformed is dropped.
//! - Only requests with the random word, to the server's own address and from its own page
//!   are answered.
//! - Memory is bounded: the past is thinned out, old lines are forgotten. Only names of objects
//!   stay, however long ago they were.

mod browser;
mod connection;
mod event_json;
mod follower;
mod frame_json;
mod history;
mod http;
mod mesh_bytes;
mod pace_control;
mod page;
mod server;
mod stream;
mod timeline;
mod token;
mod views;

pub(crate) use browser::open_in_browser;
pub(crate) use follower::LiveFollower;
pub(crate) use history::{History, Origin};
pub(crate) use pace_control::{PaceControl, Speed};
pub(crate) use server::Server;
pub(crate) use views::Views;
