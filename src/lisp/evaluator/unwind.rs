//! Non-local exits: returning from blocks, jumping to tags, throwing, and running cleanup
//! code on the way.

use super::entry::Next;
use crate::print;
use crate::value::Value;
use crate::value::function::Body;
use crate::value::raise::Raise;
use crate::vm::fiber::{Dynamic, Pending, Target};
use crate::vm::frames::FrameKind;
use crate::vm::machine::{Event, Machine};
use crate::vm::step::Step;

impl Machine<'_> {
    pub(super) fn return_from(&mut self, id: &Value, value: Value) -> Next {
        let found = self.fiber.dynamic.iter().rposition(
            |d| matches!(d, Dynamic::Block { id: other, .. } if id.is_eql(&Value::Int(*other))),
        );
        match found {
            Some(i) => self.unwind(Target::Exit(i), value),
            None => self.raise(exit_is_gone()),
        }
    }

    pub(super) fn go(&mut self, id: &Value, tag: u32) -> Next {
        let found = self.fiber.dynamic.iter().rposition(
            |d| matches!(d, Dynamic::Tagbody { id: other, .. } if id.is_eql(&Value::Int(*other))),
        );
        match found {
            Some(i) => self.unwind(Target::Tag(i, tag), Value::NIL),
            None => self.raise(exit_is_gone()),
        }
    }

    /// `throw`: the step that leaves the innermost catch with this tag, with a value.
    pub fn throw(&mut self, tag: &Value, value: Value) -> Result<Step, Box<Raise>> {
        let target = self.catch_of(tag)?;
        Ok(Step::Unwind(target, value))
    }

    /// Pops values and a tag, and leaves the innermost catch of the tag with the values.
    pub(super) fn throw_top(&mut self) -> Next {
        let value = self.pop();
        let tag = self.pop();
        // Mostly there is nothing to undo on the way.
        let innermost = self.fiber.dynamic.last();
        if matches!(innermost, Some(Dynamic::Catch { tag: other, .. }) if other.is_eq(&tag)) {
            return self.arrive(Target::Exit(self.fiber.dynamic.len() - 1), value, None);
        }
        match self.catch_of(&tag) {
            Ok(target) => self.unwind(target, value),
            Err(raise) => self.raise(raise),
        }
    }

    /// The innermost catch with this tag.
    pub(super) fn catch_of(&self, tag: &Value) -> Result<Target, Box<Raise>> {
        let found = self
            .fiber
            .dynamic
            .iter()
            .rposition(|d| matches!(d, Dynamic::Catch { tag: other, .. } if other.is_eq(tag)));
        found.map(Target::Exit).ok_or_else(|| {
            let shown = print::to_string(self.image, tag, true);
            Raise::control(format!(
                "attempt to THROW to a tag that does not exist: {shown}"
            ))
        })
    }

    /// Leaves everything inside the target, running cleanup code on the way.
    pub(super) fn unwind(&mut self, target: Target, value: Value) -> Next {
        self.unwind_for(target, value, None)
    }

    /// The same, because of a condition. If there is none, it is the one whose handler is left.
    pub(super) fn unwind_for(
        &mut self,
        target: Target,
        value: Value,
        mut cause: Option<Value>,
    ) -> Next {
        let limit = match target {
            Target::Exit(i) => i + 1,
            Target::Tag(i, _) => i + 1,
            Target::Frame(i) => self.fiber.frames.get(i).map_or(0, |frame| frame.dynamic),
            Target::Everything => 0,
        };
        while self.fiber.dynamic.len() > limit {
            match self.fiber.dynamic.pop() {
                Some(Dynamic::Bind(sym, outside)) => {
                    self.image.symbols.get_mut(sym).value = outside;
                }
                Some(Dynamic::Unwind {
                    frame,
                    height,
                    target: cleanup,
                }) => {
                    self.cut_to(frame, height, cause.as_ref());
                    self.fiber.stack.push(Value::Unbound);
                    self.fiber.stack.push(Value::Int(1));
                    self.save_pc(cleanup as usize);
                    self.fiber.pending.push(Pending {
                        target,
                        value,
                        dynamic: self.fiber.dynamic.len(),
                        cause,
                    });
                    return Next::Run;
                }
                Some(Dynamic::HandlerMask { condition, .. }) => {
                    cause.get_or_insert(condition);
                }
                _ => {}
            }
        }
        self.arrive(target, value, cause.as_ref())
    }

    fn arrive(&mut self, target: Target, value: Value, cause: Option<&Value>) -> Next {
        match target {
            Target::Everything => {
                self.cut(0, cause);
                self.fiber.stack.clear();
                self.fiber.pending.clear();
                return Next::Stop(Event::Unwound);
            }
            Target::Frame(i) => {
                let Some(frame) = self.fiber.frames.get(i) else {
                    return Next::Run;
                };
                let (cut, multi, dynamic) = (frame.cut, frame.multi, frame.dynamic);
                self.fiber.pending.retain(|p| p.dynamic <= dynamic);
                self.cut(i, cause);
                self.fiber.stack.truncate(cut);
                let args = value.cdr_or_nil().iter_list().collect();
                return self.call_value(value.car_or_nil(), args, multi);
            }
            Target::Exit(i) => {
                if let Some(
                    Dynamic::Block {
                        frame,
                        height,
                        target,
                        multi,
                        ..
                    }
                    | Dynamic::Catch {
                        frame,
                        height,
                        target,
                        multi,
                        ..
                    },
                ) = self.fiber.dynamic.pop()
                {
                    self.cut_to(frame, height, cause);
                    self.fiber
                        .stack
                        .push(if multi { value } else { value.primary() });
                    self.save_pc(target as usize);
                }
                self.fiber.pending.retain(|p| p.dynamic <= i);
            }
            Target::Tag(i, tag) => {
                if let Some(&Dynamic::Tagbody {
                    frame,
                    height,
                    table,
                    ..
                }) = self.fiber.dynamic.last()
                {
                    self.cut_to(frame, height, cause);
                    if let Some(pc) = self.tag_position(table, tag) {
                        self.save_pc(pc);
                    }
                }
                self.fiber.pending.retain(|p| p.dynamic <= i + 1);
            }
        }
        Next::Run
    }

    fn tag_position(&self, table: u32, tag: u32) -> Option<usize> {
        let FrameKind::Code { function, .. } = &self.fiber.frames.last()?.kind else {
            return None;
        };
        let Body::Closure { code, .. } = &function.body else {
            return None;
        };
        let content = code.content()?;
        let position = content.tags.get(table as usize)?.get(tag as usize)?;
        Some(*position as usize)
    }

    fn cut_to(&mut self, frame: usize, height: usize, cause: Option<&Value>) {
        self.cut(frame + 1, cause);
        self.fiber.stack.truncate(height);
    }

    /// Drops the innermost frames, down to so many, because of a condition, if there is one.
    fn cut(&mut self, count: usize, cause: Option<&Value>) {
        let Some(cause) = cause else {
            return self.fiber.cut_frames(count);
        };
        let leaving = self.image.leaving();
        leaving.set(Some(cause.clone()));
        self.fiber.cut_frames(count);
        leaving.set(None);
    }

    /// Continues the exit that the cleanup code, now at its end, interrupted.
    pub(super) fn continue_unwinding(&mut self) -> Next {
        match self.fiber.pending.pop() {
            Some(pending) => self.unwind_for(pending.target, pending.value, pending.cause),
            None => Next::Run,
        }
    }
}

fn exit_is_gone() -> Box<Raise> {
    Raise::control("Attempt to RETURN-FROM a block or GO to a tag that no longer exists")
}
