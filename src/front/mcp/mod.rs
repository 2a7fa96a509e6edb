//! A door for programs, such as assistants that write plans: the Model Context Protocol, over standard
//! input and output. Requests and answers are JSON-RPC 2.0, one on a line.

mod arguments;
mod resources;
mod run;
mod server;
mod tools;
mod world;

pub(crate) use server::Server;
pub(crate) use world::World;
