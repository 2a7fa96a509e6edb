//! The task tree: which plans were called from which, by path.
//!
//! A path is a list of parts, innermost first. The second call of the same part in the same node
//! gets the part `(part… :CALL 2)`. A node remembers only the last node of each part and the number
//! of calls, so a loop around a plan does not fill memory.

use std::cell::RefCell;
use std::rc::Rc;

use lisp::value::Value;
use lisp::value::foreign::{Foreign, ForeignBox, PrintContext};
use lisp::value::hash_table::{HashTable, HashTest};
use lisp::value::symbol::Sym;

/// A node of a task tree.
pub struct TreeNode {
    /// The path, innermost part first.
    pub path: Value,
    children: RefCell<Vec<Child>>,
    /// Index of each part in `children`.
    parts: HashTable,
    object: RefCell<std::rc::Weak<ForeignBox>>,
}

struct Child {
    first: Rc<TreeNode>,
    /// The node of the last call, unless that is the first.
    last: Option<Rc<TreeNode>>,
    /// Number of calls in this run of the tree.
    calls: i64,
    /// Maximum number of calls in any run.
    most: i64,
}

impl TreeNode {
    /// A node without children.
    pub fn new(path: Value) -> Rc<TreeNode> {
        Rc::new(TreeNode {
            path,
            children: RefCell::default(),
            parts: HashTable::new(HashTest::Equal),
            object: RefCell::default(),
        })
    }

    /// Starts a new run: calls are counted from one again, but the structure remains.
    pub fn restart(&self) {
        let mut pending: Vec<Rc<TreeNode>> = Vec::new();
        self.restart_children(&mut pending);
        while let Some(node) = pending.pop() {
            node.restart_children(&mut pending);
        }
    }

    fn restart_children(&self, pending: &mut Vec<Rc<TreeNode>>) {
        for child in self.children.borrow_mut().iter_mut() {
            child.calls = 0;
            child.last = None;
            pending.push(child.first.clone());
        }
    }

    /// The node for the next call of a part; `call_marker` is the symbol `:CALL`.
    pub fn enter(&self, part: &Value, call_marker: Sym) -> Rc<TreeNode> {
        let mut children = self.children.borrow_mut();
        let position = match self.parts.get(part) {
            Some(Value::Int(i)) => usize::try_from(i).ok(),
            _ => None,
        };
        if let Some(child) = position.and_then(|i| children.get_mut(i)) {
            child.calls += 1;
            child.most = child.most.max(child.calls);
            if child.calls == 1 {
                return child.first.clone();
            }
            let part = numbered(part, child.calls, call_marker);
            let node = TreeNode::new(Value::cons(part, self.path.clone()));
            child.last = Some(node.clone());
            return node;
        }
        let node = TreeNode::new(Value::cons(part.clone(), self.path.clone()));
        self.parts.insert(part.clone(), Value::from(children.len()));
        children.push(Child {
            first: node.clone(),
            last: None,
            calls: 1,
            most: 1,
        });
        node
    }

    /// The remembered nodes below, in the order of their parts' first calls.
    pub(crate) fn children(&self) -> Vec<Rc<TreeNode>> {
        let children = self.children.borrow();
        let both = |c: &Child| std::iter::once(c.first.clone()).chain(c.last.clone());
        children.iter().flat_map(both).collect()
    }

    /// The number of nodes there have been below.
    pub(crate) fn child_count(&self) -> i64 {
        self.children.borrow().iter().map(|c| c.most).sum()
    }

    /// The node as a value: the same object as long as it is referenced.
    pub fn value(self: &Rc<TreeNode>, type_symbol: Sym) -> Value {
        if let Some(object) = self.object.borrow().upgrade() {
            return Value::Foreign(object);
        }
        let object = Rc::new(ForeignBox::new(NodeObject {
            node: self.clone(),
            type_symbol,
        }));
        *self.object.borrow_mut() = Rc::downgrade(&object);
        Value::Foreign(object)
    }
}

impl Drop for TreeNode {
    /// Frees deep trees with a loop.
    fn drop(&mut self) {
        let mut pending = self.children.take();
        while let Some(child) = pending.pop() {
            for node in std::iter::once(child.first).chain(child.last) {
                if Rc::strong_count(&node) == 1 {
                    pending.append(&mut node.children.borrow_mut());
                }
            }
        }
    }
}

/// `(part… :CALL n)`.
fn numbered(part: &Value, n: i64, call_marker: Sym) -> Value {
    let mut items: Vec<Value> = match part {
        Value::Cons(_) => part.iter_list().collect(),
        other => vec![other.clone()],
    };
    items.push(call_marker.into());
    items.push(Value::Int(n));
    Value::list(items)
}

/// A tree node as a Lisp value.
pub(crate) struct NodeObject {
    /// The node.
    pub node: Rc<TreeNode>,
    type_symbol: Sym,
}

impl Foreign for NodeObject {
    fn type_symbol(&self) -> Sym {
        self.type_symbol
    }

    fn print(&self, context: &dyn PrintContext, _: bool) -> String {
        let identity = match self.node.object.borrow().upgrade() {
            Some(object) => context.identity(&Value::Foreign(object)),
            None => String::new(),
        };
        format!(
            "#<TASK-TREE-NODE :PATH {} :CHILD-COUNT {} {identity}>",
            context.text(&self.node.path, true),
            self.node.child_count(),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lisp::image::Image;
    use lisp::print;
    use lisp::value::known;

    #[test]
    fn the_second_call_of_a_part_is_numbered() {
        let root = TreeNode::new(Value::NIL);
        let part = Value::list([Value::symbol(known::CAR)]);
        let image = Image::new();
        let shown = |node: &Rc<TreeNode>| print::to_string(&image, &node.path, true);
        assert_eq!(shown(&root.enter(&part, known::K_COUNT)), "((CAR))");
        assert_eq!(
            shown(&root.enter(&part, known::K_COUNT)),
            "((CAR :COUNT 2))"
        );
        assert_eq!(root.child_count(), 2);
        root.restart();
        assert_eq!(root.child_count(), 2);
        root.enter(&part, known::K_COUNT);
        assert_eq!(root.child_count(), 2);
    }
}
