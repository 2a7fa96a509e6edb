//! References to fluents, and the creation of fluents.

use std::cell::{Cell, RefCell};
use std::rc::{Rc, Weak};

use super::{Fluent, FluentName, Kind, Missed, Operation};
use crate::state::Plan;
use lisp::value::Value;
use lisp::value::cycles;
use lisp::value::foreign::ForeignBox;
use lisp::value::slot::Slot;

/// A counted reference to a fluent.
#[derive(Clone)]
pub(crate) struct FluentRef(Rc<ForeignBox>);

impl FluentRef {
    fn make(plan: &Plan, name: FluentName, kind: Kind, rank: u32) -> FluentRef {
        let names = &plan.names;
        let type_symbol = match &kind {
            Kind::Value { .. } => names.value_fluent,
            Kind::Net {
                is_cacheable: true, ..
            } => names.cached_net_fluent,
            Kind::Net { .. } | Kind::Change { .. } => names.net_fluent,
            Kind::Pulses { .. } => names.pulse_fluent,
        };
        FluentRef(Rc::new(ForeignBox::new(Fluent {
            name,
            kind,
            rank,
            serial: plan.fresh_number(),
            pulses: Cell::new(0),
            callbacks: RefCell::default(),
            dependents: RefCell::default(),
            waiters: RefCell::default(),
            type_symbol,
        })))
    }

    /// A value fluent.
    pub(crate) fn with_value(plan: &Plan, name: Value, value: Value) -> FluentRef {
        FluentRef::value_fluent(plan, Some(name), value, Value::NIL)
    }

    /// A value fluent with a test that determines what counts as a change (`NIL`: `eql`).
    pub(crate) fn value_fluent(
        plan: &Plan,
        name: Option<Value>,
        value: Value,
        test: Value,
    ) -> FluentRef {
        let name = match name {
            Some(name) => FluentName::Given(name),
            None => FluentName::Numbered("FLUENT-", plan.fresh_number()),
        };
        let kind = Kind::Value {
            value: Slot::new(value),
            test,
        };
        FluentRef::make(plan, name, kind, 0)
    }

    /// A network over the fluents among the arguments.
    pub(crate) fn net(
        plan: &Plan,
        prefix: &'static str,
        operation: Operation,
        args: Vec<Value>,
    ) -> FluentRef {
        let mut sources: Vec<FluentRef> = args.iter().filter_map(FluentRef::from_value).collect();
        if let (Operation::Apply(_), Some(list)) = (&operation, args.last()) {
            sources.extend(list.iter_list().filter_map(|v| FluentRef::from_value(&v)));
        }
        let rank = sources.iter().map(|s| s.get().rank).max().unwrap_or(0);
        let kind = Kind::Net {
            operation,
            args: RefCell::new(args),
            cache: Slot::new(Value::Unbound),
            is_cacheable: sources.iter().all(|s| s.get().is_cacheable()),
        };
        let name = FluentName::Numbered(prefix, plan.fresh_number());
        let net = FluentRef::make(plan, name, kind, rank.saturating_add(1));
        for (i, source) in sources.iter().enumerate() {
            if !sources[..i].iter().any(|other| other.is(source)) {
                source.get().add_dependent(&net);
            }
        }
        net
    }

    /// A fluent that is true once per pulse of the source.
    pub(crate) fn pulses(plan: &Plan, source: &FluentRef, mode: Missed) -> FluentRef {
        let processed = match mode {
            Missed::Never => source.get().pulses.get(),
            Missed::Once | Missed::Always => 0,
        };
        let kind = Kind::Pulses {
            source: source.clone(),
            mode,
            processed: Cell::new(processed),
        };
        FluentRef::depending(plan, "FN-PULSE-FLUENT", kind, source)
    }

    /// A fluent that is true once per change of the source. `old` is the present value of the
    /// source after applying the key function.
    pub(crate) fn change(
        plan: &Plan,
        source: &FluentRef,
        test: Value,
        key: Value,
        old: Value,
    ) -> FluentRef {
        let kind = Kind::Change {
            source: source.clone(),
            test,
            key,
            old: Slot::new(old),
        };
        FluentRef::depending(plan, "FN-FL-UPDATED", kind, source)
    }

    fn depending(plan: &Plan, prefix: &'static str, kind: Kind, source: &FluentRef) -> FluentRef {
        let name = FluentName::Numbered(prefix, plan.fresh_number());
        let rank = source.get().rank.saturating_add(1);
        let fluent = FluentRef::make(plan, name, kind, rank);
        source.get().add_dependent(&fluent);
        fluent
    }

    /// Notes that the fluent holds something that may hold it.
    pub(super) fn note(&self) {
        cycles::note_foreign(&self.0);
    }

    /// Adds a callback; false if the name is taken.
    pub(crate) fn add_callback(&self, name: &Value, function: &Value) -> bool {
        self.note();
        self.get().add_callback(name, function)
    }

    /// The fluent, if the value is one.
    pub(crate) fn from_value(value: &Value) -> Option<FluentRef> {
        match value {
            Value::Foreign(object) if object.downcast_ref::<Fluent>().is_some() => {
                Some(FluentRef(object.clone()))
            }
            _ => None,
        }
    }

    /// The fluent as a value.
    pub(crate) fn value(&self) -> Value {
        Value::Foreign(self.0.clone())
    }

    /// The fluent.
    ///
    /// # Panics
    ///
    /// Never: every function that makes a reference checks what it refers to.
    pub(crate) fn get(&self) -> &Fluent {
        match self.0.downcast_ref() {
            Some(fluent) => fluent,
            None => unreachable!("a fluent reference refers to a fluent"),
        }
    }

    /// Whether this is the same fluent.
    pub(crate) fn is(&self, other: &FluentRef) -> bool {
        Rc::ptr_eq(&self.0, &other.0)
    }

    pub(super) fn downgrade(&self) -> Weak<ForeignBox> {
        Rc::downgrade(&self.0)
    }

    pub(super) fn upgrade(weak: &Weak<ForeignBox>) -> Option<FluentRef> {
        weak.upgrade().map(FluentRef)
    }
}
