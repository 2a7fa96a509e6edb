//! The session's side of the dialogue with a notebook.

use super::Session;
use super::dialogue::{Illustrate, Swept, Table};
use super::tabulated::table_of;
use lisp::value::known;
use view::picture::{Image, View};

impl Illustrate for Session {
    fn show_errors_apart(&mut self) {
        self.evaluator.image.output.set_errors_apart(true);
    }

    fn description(&self, text: &str, at: usize) -> Option<String> {
        self.assistant().description_at(text, at)
    }

    fn backtrace(&self, most: usize) -> String {
        self.evaluator.backtrace_text(most)
    }

    fn depicted(&self, view: View, width: usize, height: usize) -> Option<Image> {
        self.simulation().picture(view, width, height).ok()
    }

    fn table(&self) -> Option<Table> {
        let mut values = self.evaluator.image.special(known::DIVIDE).iter_list();
        let value = values.next().filter(|_| values.next().is_none())?;
        table_of(&self.evaluator.image, &value)
    }

    fn take_swept(&mut self) -> Option<Swept> {
        self.evaluator.host.audience.swept.take()
    }

    fn now(&self) -> f64 {
        self.simulation().now()
    }
}
