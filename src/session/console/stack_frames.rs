//! The stack frames of a stopped evaluation: the stopped task's and those of the tasks that
//! wait for it, innermost first.

use super::evaluator::Evaluator;
use crate::dialogue::{ActionStep, Event, Outcome};
use crate::printing;
use crate::printing::on_one_line;
use lisp::evaluator::backtrace::FrameView;
use lisp::print;
use lisp::source::{Location, Place};
use lisp::value::Value;

/// Number of frames shown by default.
const MAX_FRAMES: usize = 40;
/// Maximum number of enclosing actions shown with a condition.
const MAX_ACTIONS: usize = 8;

/// A frame with the index of its fiber.
pub(super) struct Told {
    pub link: usize,
    pub view: FrameView,
}

/// Internal builtins, which do not appear in users' code.
const HIDDEN: [&str; 4] = ["SIGNAL", "DEBUGGER", "EVAL", "FUNCALL"];

impl Evaluator {
    /// All frames that are shown, innermost first.
    pub(super) fn frames(&self) -> Vec<Told> {
        let fibers = self.scheduler.stopped_fibers();
        let mut frames = Vec::new();
        for (link, fiber) in fibers.into_iter().enumerate() {
            let views = fiber.views().into_iter();
            frames.extend(
                views
                    .filter(|view| !is_hidden(view))
                    .map(|view| Told { link, view }),
            );
        }
        frames
    }

    /// Where a stopped evaluation is in a text of the user's.
    pub(super) fn place_of_program(&self) -> Option<Location> {
        let sources = &self.image.sources;
        let frames = self.frames();
        let places = frames.iter().map(|told| told.view.place);
        let mut places = places
            .filter(|place| sources.is_of_program(*place))
            .filter_map(|place| sources.locate(place));
        places.find(|place| !printing::is_built_in(place))
    }

    /// The selected frame: the index of its fiber, and its index there.
    pub(super) fn selected_frame(&self) -> Option<(usize, usize)> {
        let selected = self.console.levels.last()?.frame;
        let frames = self.frames();
        let told = frames.get(selected)?;
        Some((told.link, told.view.index))
    }

    /// A call on one line.
    pub(super) fn call_text(&self, view: &FrameView) -> String {
        let image = &self.image;
        let name = match &view.name {
            Value::Str(text) => text.text(),
            name if !name.is_true() => "(top level)".to_owned(),
            name => print::to_string(image, name, true),
        };
        if name == "(top level)" {
            return name;
        }
        let is_anonymous = matches!(&view.name, Value::Cons(_));
        let mut text = if is_anonymous {
            on_one_line(&name)
        } else {
            format!("({}", on_one_line(&name))
        };
        if is_anonymous && !view.arguments.is_empty() {
            text.push_str(" with");
        }
        for argument in &view.arguments {
            text.push(' ');
            text.push_str(&on_one_line(&print::to_string(image, argument, true)));
        }
        if !is_anonymous {
            text.push(')');
        }
        shortened(&text)
    }

    /// ` at file:line:column`, for a place that the user can find.
    fn place_text(&self, place: Place) -> String {
        match self.image.sources.locate(place) {
            Some(place) if !place.name.starts_with("prompt[") => format!("  at {place}"),
            Some(place) => format!("  at line {}, column {}", place.line, place.column),
            None => String::new(),
        }
    }

    /// The actions being performed, innermost first.
    pub(super) fn open_actions(&self) -> Vec<ActionStep> {
        let frames = self.frames();
        let actions = frames.iter().enumerate().filter_map(|(at, told)| {
            let action = &told.view.annotation.as_ref()?.subject;
            let outer = frames.get(at + 1..).unwrap_or_default();
            let places = outer.iter().map(|told| told.view.place);
            Some(ActionStep {
                call: self.action_text(action),
                place: places
                    .filter_map(|place| self.image.sources.locate(place))
                    .next(),
            })
        });
        actions.take(MAX_ACTIONS).collect()
    }

    /// `(PERFORM (AN ACTION …))`.
    pub(super) fn action_text(&self, action: &Value) -> String {
        let shown = print::to_string(&self.image, action, false);
        format!("(PERFORM {})", on_one_line(&shown))
    }

    pub(super) fn tell_backtrace(
        &mut self,
        count: Option<usize>,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        let text = self.backtrace_text(count.unwrap_or(MAX_FRAMES));
        self.tell(&text, sink)
    }

    /// Up to `count` frames, each on a line.
    pub(crate) fn backtrace_text(&self, count: usize) -> String {
        let frames = self.frames();
        let selected = self.console.levels.last().map_or(0, |level| level.frame);
        let mut text = String::new();
        for (number, told) in frames.iter().enumerate().take(count) {
            let mark = if number == selected { '*' } else { ' ' };
            let call = self.call_text(&told.view);
            let place = self.place_text(told.view.place);
            text.push_str(&format!("{mark}{number:>3}: {call}{place}\n"));
        }
        if frames.len() > count {
            text.push_str(&format!("     … {} more\n", frames.len() - count));
        }
        if frames.is_empty() {
            text.push_str("; There are no frames.\n");
        }
        text
    }

    pub(super) fn look_at_next_frame(&mut self, by: isize, sink: &mut dyn FnMut(Event)) -> Outcome {
        let selected = self.console.levels.last().map_or(0, |level| level.frame);
        self.look_at_frame(selected.checked_add_signed(by), sink)
    }

    pub(super) fn look_at_frame(
        &mut self,
        number: Option<usize>,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        let frames = self.frames();
        let Some((number, told)) = number.and_then(|n| Some((n, frames.get(n)?))) else {
            let text = format!(
                "; There is no such frame: they are 0 to {}.",
                frames.len().max(1) - 1
            );
            return self.tell(&text, sink);
        };
        let call = self.call_text(&told.view);
        let place = self.place_text(told.view.place);
        let source = self.image.sources.locate(told.view.place);
        let source = source.map(|place| place.underlined()).unwrap_or_default();
        if let Some(level) = self.console.levels.last_mut() {
            level.frame = number;
        }
        self.tell(&format!("{number}: {call}{place}\n{source}"), sink)
    }

    /// What `?place` shows where a plan has stopped that has a variable of that name: its value in the
    /// selected frame, or in the nearest one around it, or else in the innermost one.
    pub(super) fn local_asked(&mut self, text: &str) -> Option<String> {
        let name = text.trim();
        if !name.starts_with('?') || name.contains(|c: char| c.is_whitespace()) {
            return None;
        }
        let name = name.to_uppercase();
        let selected = self.console.levels.last()?.frame;
        let frames = self.frames();
        let mut around = (selected..frames.len()).chain(0..selected);
        let fibers = self.scheduler.stopped_fibers();
        let (number, value) = around.find_map(|number| {
            let told = frames.get(number)?;
            let variables = fibers.get(told.link)?.variables(told.view.index);
            let mut named = variables
                .into_iter()
                .filter(|variable| self.image.name(variable.name) == name);
            let value = named.find(|variable| !variable.value.is_unbound())?.value;
            Some((number, value))
        })?;
        let value = printing::printed(&mut self.image, &value);
        Some(format!("{name} = {value}\n; in frame {number}"))
    }

    pub(super) fn tell_locals(&mut self, sink: &mut dyn FnMut(Event)) -> Outcome {
        let Some((link, frame)) = self.selected_frame() else {
            return self.tell("; There are no frames.", sink);
        };
        let fibers = self.scheduler.stopped_fibers();
        let variables = fibers.get(link).map(|fiber| fiber.variables(frame));
        let mut text = String::new();
        for variable in variables.unwrap_or_default() {
            let value = if variable.value.is_unbound() {
                "(not supplied)".to_owned()
            } else {
                printing::printed(&mut self.image, &variable.value)
            };
            let name = print::to_string(&self.image, &variable.name.into(), true);
            text.push_str(&format!("  {name} = {value}\n"));
        }
        if text.is_empty() {
            text.push_str("; The frame has no variables.");
        }
        self.tell(&text, sink)
    }
}

fn is_hidden(view: &FrameView) -> bool {
    match &view.name {
        Value::Str(name) => view.annotation.is_none() && HIDDEN.contains(&name.text().as_str()),
        _ => false,
    }
}

/// Maximum length of a call as shown, in characters.
const MAX_CALL_LENGTH: usize = 150;

fn shortened(text: &str) -> String {
    match text.char_indices().nth(MAX_CALL_LENGTH) {
        Some((end, _)) => format!("{} …", text.get(..end).unwrap_or(text)),
        None => text.to_owned(),
    }
}
