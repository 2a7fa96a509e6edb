//! stub
pub mod host;
use crate::lisp::{Image, Value};
pub use host::*;
/// x
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct TaskId(pub u64);
/// x
pub enum Evaluation {
    /// x
    Values(Vec<Value>),
    /// x
    Unhandled(Value),
    /// x
    Interrupted,
}
/// x
pub struct Scheduler;
impl Scheduler {
    /// x
    pub fn new() -> Self {
        Scheduler
    }
    /// x
    pub fn evaluate(
        &mut self,
        _image: &mut Image,
        _host: &mut dyn Host,
        _form: &Value,
    ) -> Evaluation {
        Evaluation::Interrupted
    }
    /// x
    pub fn abort(&mut self, _image: &mut Image, _host: &mut dyn Host) {}
}
/// x
pub fn install(_: &mut Image) {}
