//! A search for proofs that goes on when the next one is asked for.

use std::cell::{Cell, RefCell};

use super::engine::{Engine, Progress};
use super::facts;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::copy::Copier;
use lisp::value::cycles;
use lisp::value::foreign::{Foreign, ForeignCopy, PrintContext};
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;
use lisp::vm::computation::{self, Computation};
use lisp::vm::machine::Machine;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Maximum number of proofs that are found before they are asked for.
const MAX_AHEAD: usize = 1000;

/// A search.
pub(crate) struct Search {
    engine: RefCell<Engine>,
    /// The call at which the search stopped, since nobody had asked for the proof after it yet.
    call: RefCell<Option<(Value, Vec<Value>)>>,
    /// Is the next proof being searched for? It stays so if an error or a throw ends that.
    is_busy: Cell<bool>,
}

impl Search {
    /// A search that has not begun.
    pub(crate) fn new(engine: Engine) -> Search {
        Search {
            engine: RefCell::new(engine),
            call: RefCell::new(None),
            is_busy: Cell::new(false),
        }
    }
}

impl Foreign for Search {
    fn type_symbol(&self) -> Sym {
        known::FUNCTION
    }

    fn print(&self, _: &dyn PrintContext, _: bool) -> String {
        "#<PROOFS>".to_owned()
    }

    fn may_be_in_circle(&self) -> bool {
        true
    }

    fn for_each_reference(&self, visit: &mut dyn FnMut(&Value)) {
        if let Ok(engine) = self.engine.try_borrow() {
            engine.for_each_reference(visit);
        }
        if let Ok(call) = self.call.try_borrow()
            && let Some((function, args)) = &*call
        {
            visit(function);
            args.iter().for_each(visit);
        }
    }

    fn let_go(&self) {
        self.engine.borrow_mut().let_go();
        self.call.take();
    }

    fn copied(&self, copier: &mut Copier) -> ForeignCopy {
        let call = self.call.borrow();
        let call = call.as_ref().map(|(function, args)| {
            let args = args.iter().map(|arg| copier.value(arg)).collect();
            (copier.value(function), args)
        });
        ForeignCopy::New(Box::new(Search {
            engine: RefCell::new(self.engine.borrow().copied(copier)),
            call: RefCell::new(call),
            is_busy: self.is_busy.clone(),
        }))
    }
}

/// The next proofs of a search: `(more . proofs)`. After the first one, the search goes on as long as
/// it calls no functions, since nobody can notice that: an ordinary list comes of an ordinary question.
/// Is there perhaps a further proof behind those, MORE is true.
pub(crate) struct NextProofs {
    search: Value,
    found: Vec<Value>,
    is_begun: bool,
}

impl NextProofs {
    /// Of a search.
    pub(crate) fn of(search: Value) -> NextProofs {
        if let Value::Foreign(search) = &search {
            cycles::note_foreign(search);
        }
        NextProofs {
            search,
            found: Vec::new(),
            is_begun: false,
        }
    }

    fn done(&mut self, search: &Search, is_more: bool) -> computation::Progress<Value> {
        search.is_busy.set(false);
        let proofs = Value::list(std::mem::take(&mut self.found));
        let more = if is_more { Value::T } else { Value::NIL };
        computation::Progress::Done(Value::cons(more, proofs))
    }

    fn begin(&mut self, image: &Image, search: &Search) -> Result<Option<(Value, Vec<Value>)>> {
        if search.is_busy.replace(true) {
            return Err(Raise::simple(
                "The next proof of this query is being searched for, or an error ended that: the list of proofs cannot be continued; make the query again.",
            ));
        }
        self.is_begun = true;
        search.engine.borrow_mut().attach(facts::of(image));
        Ok(search.call.take())
    }
}

impl Computation for NextProofs {
    type Output = Value;

    fn advance(
        &mut self,
        machine: &mut Machine<'_>,
        answer: Option<Value>,
    ) -> Result<computation::Progress<Value>> {
        let value = self.search.clone();
        let Some(search) = value.as_foreign::<Search>() else {
            return Err(Raise::type_error(&value, known::FUNCTION));
        };
        if !self.is_begun
            && let Some((function, args)) = self.begin(machine.image, search)?
        {
            return Ok(computation::Progress::Call { function, args });
        }
        let mut engine = search.engine.borrow_mut();
        let mut progress = match answer {
            Some(value) => engine.deliver(machine.image, value)?,
            None => engine.run(machine.image)?,
        };
        loop {
            match progress {
                Progress::Call { function, args } if self.found.is_empty() => {
                    return Ok(computation::Progress::Call { function, args });
                }
                Progress::Call { function, args } => {
                    *search.call.borrow_mut() = Some((function, args));
                    return Ok(self.done(search, true));
                }
                Progress::Failed => return Ok(self.done(search, false)),
                Progress::Proved => {
                    self.found.push(engine.solution()?);
                    if !engine.has_choices() {
                        return Ok(self.done(search, false));
                    }
                    if self.found.len() >= MAX_AHEAD {
                        return Ok(self.done(search, true));
                    }
                }
            }
            progress = engine.run(machine.image)?;
        }
    }
}
