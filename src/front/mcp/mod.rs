//! A door for programs, such as assistants that write plans: the Model Context Protocol, over standard
//! input and output or HTTP. Requests and answers are JSON-RPC 2.0.

mod http;
mod server;

pub(crate) use http::serve;
pub(crate) use server::Server;
