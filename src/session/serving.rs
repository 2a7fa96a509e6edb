//! The session's side of the dialogue with an editor.

use std::ops::Range;
use std::sync::Arc;

use super::Session;
use super::assist::Assistant;
use super::dialogue::{
    Beginning, Inspection, Names, Need, ObjectNumber, Relation, Serve, StackFrame, Stop,
    Unrecorded, Use,
};
use super::host::parts::View;
use crate::printing;
use crate::printing::on_one_line;
use lisp::image::identity::aside;
use lisp::print;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::symbol::Sym;

/// The variables that an input finds as the input before it has left them.
const CARRIED: [Sym; 11] = [
    known::V_PACKAGE,
    known::MINUS,
    known::PLUS,
    known::V_PLUS2,
    known::V_PLUS3,
    known::TIMES,
    known::V_STAR,
    known::V_STAR3,
    known::DIVIDE,
    known::V_SLASH2,
    known::V_SLASH3,
];

impl Serve for Session {
    fn set_served(&mut self, is_served: bool) {
        self.evaluator.objects.set_served(is_served);
    }

    fn let_serve(&mut self) {
        self.evaluator.host.person.can_serve = true;
    }

    fn take_port(&mut self) -> Option<u16> {
        self.evaluator.host.person.port.take()
    }

    fn stops(&self) -> Vec<u64> {
        self.evaluator.level_numbers()
    }

    fn last_stop(&self) -> Option<Stop> {
        self.evaluator.stop()
    }

    fn choice_needs(&self, choice: usize) -> Need {
        self.evaluator.need_of_choice(choice)
    }

    fn stack(&self) -> Vec<StackFrame> {
        self.evaluator.stack_frames()
    }

    fn frame_variables(&mut self, frame: usize) -> Vec<(String, String)> {
        let variables = self.evaluator.variables_of_frame(frame).into_iter();
        variables
            .map(|(name, value)| (name, printing::printed(&mut self.evaluator.image, &value)))
            .collect()
    }

    fn frame_variable(&mut self, frame: usize, variable: usize) -> Option<ObjectNumber> {
        let variables = self.evaluator.variables_of_frame(frame);
        let (_, value) = variables.into_iter().nth(variable)?;
        Some(self.evaluator.objects.keep(value))
    }

    fn stopped_by(&mut self) -> Option<ObjectNumber> {
        let condition = self.evaluator.stopping_condition()?;
        Some(self.evaluator.objects.keep(condition))
    }

    fn beginning(&self) -> Beginning {
        let values = CARRIED
            .iter()
            .map(|name| self.evaluator.image.special(*name).clone());
        Beginning(values.collect())
    }

    fn begin_with(&mut self, beginning: &Beginning) {
        for (name, value) in CARRIED.iter().zip(&beginning.0) {
            self.evaluator.image.set_special(*name, value.clone());
        }
    }

    fn enter_package(&mut self, name: &str) -> bool {
        let packages = &self.evaluator.image.packages;
        let found = packages.find(name);
        let found = found.or_else(|| packages.find(&name.to_uppercase()));
        let Some(package) = found.filter(|id| !packages.is_deleted(*id)) else {
            return false;
        };
        self.evaluator
            .image
            .set_special(known::V_PACKAGE, Value::Package(package));
        true
    }

    fn package_names(&self) -> (String, String) {
        let package = self.evaluator.image.current_package();
        let name = self.evaluator.image.packages.get(package).name.to_string();
        (name, self.evaluator.package_name())
    }

    fn next_object(&self) -> ObjectNumber {
        self.evaluator.objects.next()
    }

    fn last_value(&mut self) -> ObjectNumber {
        let value = self.evaluator.image.special(known::TIMES).clone();
        self.evaluator.objects.keep(value)
    }

    fn set_last_value(&mut self, object: ObjectNumber) -> bool {
        let Some(value) = self.evaluator.objects.get(object) else {
            return false;
        };
        self.evaluator.image.set_special(known::TIMES, value);
        true
    }

    fn take_inspected(&mut self) -> Option<ObjectNumber> {
        let value = self.evaluator.objects.take_inspected()?;
        Some(self.evaluator.objects.keep(value))
    }

    fn forget_objects(&mut self, objects: &[ObjectNumber]) {
        objects
            .iter()
            .for_each(|number| self.evaluator.objects.forget(*number));
    }

    fn look_into(&mut self, object: ObjectNumber, parts: Range<usize>) -> Option<Inspection> {
        let value = self.evaluator.objects.get(object)?;
        let view = View::of(&self.evaluator.host, &mut self.evaluator.image, &value);
        let (count, title) = (view.parts.len(), view.title);
        let wanted = view.parts.into_iter().skip(parts.start);
        let wanted = wanted.take(parts.len());
        let parts = wanted.map(|(name, part)| {
            if part.is_unbound() {
                return (name, "(no value)".to_owned(), None);
            }
            let image = &self.evaluator.image;
            let text = aside(image, || print::to_string(image, &part, true));
            (
                name,
                on_one_line(&text),
                Some(self.evaluator.objects.keep(part)),
            )
        });
        Some(Inspection {
            title,
            parts: parts.collect(),
            count,
        })
    }

    fn names(&mut self) -> Arc<Names> {
        self.told_names.all(&mut self.evaluator.image)
    }

    fn uses(&mut self, way: Relation, package: &str, name: &str) -> Result<Vec<Use>, Unrecorded> {
        Assistant::new(&self.evaluator.image, &self.evaluator.host.simulation).all_uses(
            &mut self.told_names,
            way,
            package,
            name,
        )
    }
}
