//! A session in a web page.
//!
//! Compiled to WebAssembly, this crate runs in a worker of a page ([`page/`](build.mjs) has the page,
//! `build` puts all of it into one file). Requests of the page come in as JSON texts and are answered
//! by messages ([`Page`]). The module has only five imports, of which three may wait
//! (`wasm`): a clock, a wait, a breath, and two ways to send a message.
//!
//! While a session works, the page is heard at each breath: it may interrupt, set the pace, and read
//! what the live view shows. All else waits until the input has ended.

mod files;
mod page;
mod request;
mod sweeping;

#[cfg(target_family = "wasm")]
mod wasm;

pub use files::{MemoryFiles, Written};
pub use page::{Outbox, Page};
pub use request::Request;
