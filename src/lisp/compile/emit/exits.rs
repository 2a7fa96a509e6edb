//! Code for blocks and tagbodies, and for the exits out of them.

use std::rc::Rc;

use super::{Emitter, OpenBlock, OpenTagbody, Want, at_least_one, index};
use crate::compile::analyze::Compiled;
use crate::compile::node::Node;
use crate::compile::scope::{Block, Tagbody};
use crate::value::Value;
use crate::value::operation::Op;
use crate::value::raise::Raise;

impl Emitter<'_> {
    pub(super) fn emit_block(
        &mut self,
        block: &Rc<Block>,
        body: &Node,
        want: Want,
    ) -> Compiled<()> {
        let height = self.height;
        let enter = self.ops.len();
        let dynamic = self.dynamic;
        if block.dynamic.get() {
            block.identity.slot.set(self.height);
            self.push(Op::EnterBlock {
                target: 0,
                multi: want == Want::All,
            });
            self.dynamic += 1;
        }
        // A dynamic block always leaves a value, so that both exits agree.
        let inner = if block.dynamic.get() {
            at_least_one(want)
        } else {
            want
        };
        self.blocks.push(OpenBlock {
            block: block.clone(),
            height,
            dynamic,
            want: inner,
            exits: Vec::new(),
        });
        self.emit(body, inner)?;
        self.close(height, dynamic, inner);
        if let Some(open) = self.blocks.pop() {
            for exit in open.exits {
                self.patch(exit);
            }
        }
        if block.dynamic.get() {
            self.patch(enter);
            self.discard_unless(want);
        }
        Ok(())
    }

    pub(super) fn emit_local_return(
        &mut self,
        block: &Rc<Block>,
        value: &Node,
        want: Want,
    ) -> Compiled<()> {
        let found = self
            .blocks
            .iter()
            .rposition(|open| Rc::ptr_eq(&open.block, block));
        // The analysis makes local returns only inside the block.
        let Some(i) = found else {
            return Err(Raise::program("return for unknown block"));
        };
        let before = self.height;
        let OpenBlock {
            height,
            dynamic,
            want: block_want,
            ..
        } = self.blocks[i];
        self.emit(value, block_want)?;
        if self.dynamic > dynamic {
            self.op(Op::PopDynamic(self.dynamic - dynamic));
        }
        self.slide_to(height, block_want);
        let exit = self.ops.len();
        self.op(Op::Jump(0));
        self.blocks[i].exits.push(exit);
        self.height = before;
        self.pretend_value(want);
        Ok(())
    }

    pub(super) fn emit_tagbody(
        &mut self,
        tagbody: &Rc<Tagbody>,
        statements: &[Node],
        positions: &[usize],
        want: Want,
    ) -> Compiled<()> {
        let height = self.height;
        let outer_dynamic = self.dynamic;
        let table = index(self.tags.len())?;
        if tagbody.dynamic.get() {
            self.tags.push(Vec::new());
            tagbody.identity.slot.set(self.height);
            self.push(Op::EnterTagbody(table));
            self.dynamic += 1;
        }
        self.tagbodies.push(OpenTagbody {
            tagbody: tagbody.clone(),
            height: self.height,
            dynamic: self.dynamic,
            jumps: Vec::new(),
        });
        let mut targets = vec![0; positions.len()];
        for i in 0..=statements.len() {
            for (tag, position) in positions.iter().enumerate() {
                if *position == i {
                    targets[tag] = self.here();
                }
            }
            if let Some(statement) = statements.get(i) {
                self.emit(statement, Want::Effect)?;
            }
        }
        if let Some(open) = self.tagbodies.pop() {
            for (at, tag) in open.jumps {
                self.ops[at] = Op::Jump(targets[tag]);
            }
        }
        self.close(height, outer_dynamic, Want::Effect);
        if tagbody.dynamic.get() {
            self.tags[table as usize] = targets;
        }
        self.emit_constant(&Value::NIL, want)
    }

    pub(super) fn emit_local_go(&mut self, tagbody: &Rc<Tagbody>, tag: usize, want: Want) {
        let found = self
            .tagbodies
            .iter()
            .rposition(|open| Rc::ptr_eq(&open.tagbody, tagbody));
        // The analysis makes local jumps only inside the tagbody.
        let Some(i) = found else { return };
        let (height, dynamic) = (self.tagbodies[i].height, self.tagbodies[i].dynamic);
        if self.dynamic > dynamic {
            self.op(Op::PopDynamic(self.dynamic - dynamic));
        }
        if self.height > height {
            self.op(Op::Drop(self.height - height));
        }
        let at = self.ops.len();
        self.op(Op::Jump(0));
        self.tagbodies[i].jumps.push((at, tag));
        self.pretend_value(want);
    }
}
