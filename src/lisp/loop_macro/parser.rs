//! Reading the forms of a `loop` from left to right.

use crate::image::Image;
use crate::print;
use crate::reader::nearest;
use crate::value::Value;
use crate::value::raise::Raise;

/// The forms of a loop, and how many have been read.
pub(crate) struct Parser<'a> {
    /// The image: names of symbols, fresh variables.
    pub image: &'a mut Image,
    forms: Vec<Value>,
    position: usize,
}

impl<'a> Parser<'a> {
    /// A parser of the forms after `loop`.
    pub(crate) fn new(image: &'a mut Image, forms: Vec<Value>) -> Parser<'a> {
        Parser {
            image,
            forms,
            position: 0,
        }
    }

    /// Have all forms been read?
    pub(crate) fn is_at_end(&self) -> bool {
        self.position >= self.forms.len()
    }

    /// The next form, without reading it.
    pub(crate) fn peek(&self) -> Option<&Value> {
        self.forms.get(self.position)
    }

    /// The name of the next form, if that is a symbol.
    pub(crate) fn word(&self) -> Option<&str> {
        let sym = self.peek()?.as_symbol()?;
        Some(self.image.name(sym))
    }

    /// Is the next form one of these words?
    pub(crate) fn is_any(&self, words: &[&str]) -> bool {
        self.word().is_some_and(|word| words.contains(&word))
    }

    /// Reads the next form if it is one of these words.
    pub(crate) fn accept(&mut self, words: &[&str]) -> bool {
        let found = self.is_any(words);
        if found {
            self.position += 1;
        }
        found
    }

    /// Reads the next form; `after` names what it belongs to.
    pub(crate) fn form(&mut self, after: &str) -> Result<Value, Box<Raise>> {
        match self.forms.get(self.position) {
            Some(form) => {
                let form = form.clone();
                self.position += 1;
                Ok(form)
            }
            None => Err(Raise::program(format!(
                "LOOP ends after {after}, where a form is wanted."
            ))),
        }
    }

    /// Reads forms up to the next word: at least one.
    pub(crate) fn compound_forms(&mut self, after: &str) -> Result<Vec<Value>, Box<Raise>> {
        let mut forms = Vec::new();
        while let Some(form @ Value::Cons(_)) = self.peek() {
            forms.push(form.clone());
            self.position += 1;
        }
        if forms.is_empty() {
            let found = match self.peek() {
                Some(form) => format!("not {}", self.shown(form)),
                None => "and the LOOP ends there".to_owned(),
            };
            return Err(Raise::program(format!(
                "{after} in LOOP is followed by forms in parentheses, {found}."
            )));
        }
        Ok(forms)
    }

    /// A form as messages show it.
    pub(crate) fn shown(&self, form: &Value) -> String {
        print::to_string(self.image, form, true)
    }

    /// The error for a next form that is none of the words allowed here.
    pub(crate) fn unexpected(&self, after: &str, words: &[&str]) -> Box<Raise> {
        let expected = match words.split_last() {
            Some((last, [])) => (*last).to_owned(),
            Some((last, rest)) => format!("{} or {last}", rest.join(", ")),
            None => "nothing".to_owned(),
        };
        let Some(found) = self.peek() else {
            return Raise::program(format!(
                "LOOP ends after {after}, where {expected} is wanted."
            ));
        };
        let hint = match self.word().and_then(|w| nearest(w, words.iter().copied())) {
            Some(near) => format!(" Did you mean {near}?"),
            None => String::new(),
        };
        Raise::program(format!(
            "{} in LOOP after {after}: {expected} may stand there.{hint}",
            self.shown(found)
        ))
    }

    /// A fresh variable.
    pub(crate) fn fresh(&mut self, name: &str) -> Value {
        self.image.gensym(name)
    }
}
