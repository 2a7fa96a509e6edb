//! Printing lists: prefixes such as quotes, layouts of forms, dotted and shared tails.

use super::{Printer, Task};
use crate::print::shape::{self, Form, Layout, Shape, Style};
use crate::value::Value;
use crate::value::document::Newline;
use crate::value::known;

pub(super) struct Rest {
    list: Value,
    /// Number of elements printed.
    index: usize,
    layout: ListLayout,
    depth: usize,
    /// Inner blocks to end with the list.
    inner: usize,
}

#[derive(Clone, Copy)]
enum ListLayout {
    Shape(&'static Shape),
    Macro(usize),
}

impl Printer<'_> {
    pub(super) fn list(&mut self, list: Value, style: Style, depth: usize) {
        let form = match style {
            Style::List(shape) if self.settings.pretty && !shape::is_backquote_part(&list) => {
                Form::Shape(shape)
            }
            _ if self.settings.pretty => shape::form(self.image, &list),
            _ => match shape::prefix(&list) {
                // Backquotes are always printed with their prefix.
                Some(prefix) if !matches!(prefix, "'" | "#'") => Form::Prefix(prefix),
                _ => Form::Shape(&shape::FILL),
            },
        };
        let layout = match form {
            Form::Prefix(prefix) => {
                self.document.text(prefix);
                let argument = list.cdr_or_nil().car_or_nil();
                if prefix == ","
                    && let Value::Symbol(sym, ..) = argument
                    && self.image.name(sym).starts_with(['@', '.'])
                {
                    self.document.text(" ");
                }
                self.tasks.push(Task::Value(argument, Style::Auto, depth));
                return;
            }
            Form::Shape(shape) => ListLayout::Shape(shape),
            Form::Macro(count) => ListLayout::Macro(count),
        };
        if self.is_too_deep(depth) {
            return;
        }
        self.document.open("(", ")");
        self.tasks.push(Task::Rest(Rest {
            list,
            index: 0,
            layout,
            depth,
            inner: 0,
        }));
    }

    /// Writes what precedes an element; returns how the element is printed.
    fn before(&mut self, rest: &mut Rest, element: &Value) -> Style {
        let Some(position) = rest.index.checked_sub(1) else {
            return match rest.layout {
                ListLayout::Shape(shape) => shape.first,
                ListLayout::Macro(_) => Style::Auto,
            };
        };
        let shape = match rest.layout {
            ListLayout::Shape(shape) => shape,
            ListLayout::Macro(count) => {
                self.before_macro_argument(position, count);
                return Style::Auto;
            }
        };
        let step = shape.steps.get(position).or_else(|| {
            let position = position - shape.steps.len();
            shape.rest.get(position % shape.rest.len().max(1))
        });
        let Some(step) = step else {
            self.document.text(" ");
            return Style::Auto;
        };
        for layout in step.before {
            match layout {
                Layout::Space => self.document.text(" "),
                Layout::Break(newline) => self.document.newline(*newline),
                Layout::Block(columns) => self.document.indent_block(*columns),
                Layout::Current => self.document.indent_current(0),
                Layout::Inner => {
                    self.document.start();
                    rest.inner += 1;
                }
                Layout::TagIndent => {
                    let columns = i64::from(matches!(element, Value::Cons(_)));
                    self.document.indent_block(columns);
                }
                Layout::LoopBreak if shape::begins_loop_clause(self.image, element) => {
                    self.document.newline(Newline::Mandatory);
                }
                Layout::LoopBreak => {}
                Layout::ParameterBreak if shape::is_parameter_keyword(element) => {
                    self.document.newline(Newline::Linear);
                }
                Layout::ParameterBreak => self.document.newline(Newline::Fill),
            }
        }
        step.style
    }

    /// The first argument follows the macro's name on its line, others are below it, then the body.
    fn before_macro_argument(&mut self, position: usize, count: usize) {
        self.document.text(" ");
        if position == 0 && count > 0 {
            return;
        }
        let indent = if position < count { 3 } else { 1 };
        self.document.indent_block(indent);
        self.document.newline(Newline::Mandatory);
    }

    pub(super) fn rest(&mut self, mut rest: Rest) {
        let list = rest.list.clone();
        let depth = rest.depth;
        let is_first = rest.index == 0;
        let cons = match &list {
            Value::Cons(cons)
                if is_first
                    || !(self.labels.is_marked(&list) || shape::is_backquote_part(&list)) =>
            {
                cons
            }
            Value::Symbol(known::NIL, ..) => {
                self.close_list(rest.inner);
                return;
            }
            tail => {
                // A dotted tail, or one that is shared with another place.
                self.before(&mut rest, tail);
                self.document.text(". ");
                self.push_close(rest.inner);
                self.tasks
                    .push(Task::Value(tail.clone(), Style::Auto, depth + 1));
                return;
            }
        };
        let element = cons.car();
        let style = self.before(&mut rest, &element);
        if self.is_cut(rest.index) {
            self.document.text("...");
            self.close_list(rest.inner);
            return;
        }
        rest.list = cons.cdr();
        rest.index += 1;
        self.tasks.push(Task::Rest(rest));
        self.tasks.push(Task::Value(element, style, depth + 1));
    }

    fn push_close(&mut self, inner: usize) {
        self.tasks.push(Task::Close(")"));
        for _ in 0..inner {
            self.tasks.push(Task::Close(""));
        }
    }

    fn close_list(&mut self, inner: usize) {
        for _ in 0..inner {
            self.document.end();
        }
        self.document.end();
        self.document.text(")");
    }
}
