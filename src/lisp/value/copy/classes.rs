//! Copies of classes, generic functions and methods.

use std::cell::RefCell;
use std::rc::Rc;

use super::{Copier, address};
use crate::value::Value;
use crate::value::class::{
    Class, Initform, OldSlot, SlotDefinition, StructureLayout, StructureSlot,
};
use crate::value::dispatch::Dispatch;
use crate::value::generic::{GenericFunction, Method, Specializer};
use crate::value::symbol::Sym;

impl Copier {
    /// The copy of a class.
    pub fn class(&mut self, class: &Rc<Class>) -> Rc<Class> {
        let copy = self.object(&Value::Class(class.clone()), class, |_, class| {
            Value::Class(Rc::new(Class::new(class.name, class.kind)))
        });
        match copy {
            Value::Class(copy) => copy,
            _ => class.clone(),
        }
    }

    fn classes(&mut self, classes: &[Rc<Class>]) -> Vec<Rc<Class>> {
        classes.iter().map(|class| self.class(class)).collect()
    }

    fn initform(&mut self, initform: &Initform) -> Initform {
        match initform {
            Initform::Value(value) => Initform::Value(self.value(value)),
            Initform::Function(function) => Initform::Function(self.function(function)),
        }
    }

    fn slot_definitions(&mut self, slots: &[SlotDefinition]) -> Vec<SlotDefinition> {
        let slots = slots.iter().map(|slot| SlotDefinition {
            name: slot.name,
            initargs: slot.initargs.clone(),
            initform: slot.initform.as_ref().map(|form| self.initform(form)),
            shared: slot.shared.as_ref().map(|shared| self.slot(shared)),
            slot_type: self.value(&slot.slot_type),
            doc: slot.doc.clone(),
        });
        slots.collect()
    }

    fn structure(&mut self, layout: &StructureLayout) -> StructureLayout {
        let slots = layout.slots.iter().map(|slot| StructureSlot {
            name: slot.name,
            initform: self.value(&slot.initform),
            slot_type: self.value(&slot.slot_type),
            read_only: slot.read_only,
        });
        StructureLayout {
            slots: slots.collect(),
            conc_name: layout.conc_name.clone(),
        }
    }

    fn method(&mut self, method: &Rc<Method>) -> Rc<Method> {
        if let Some(copy) = self.methods.get(&address(method)) {
            return copy.clone();
        }
        let specializers = method
            .specializers
            .iter()
            .map(|specializer| match specializer {
                Specializer::Class(class) => Specializer::Class(self.class(class)),
                Specializer::Eql(value) => Specializer::Eql(self.value(value)),
            });
        let specializers = specializers.collect();
        let qualifiers = method.qualifiers.iter();
        let qualifiers = qualifiers.map(|q| self.value(q)).collect();
        let copy = Rc::new(Method {
            name: self.value(&method.name),
            qualifiers,
            specializers,
            parameters: method.parameters.clone(),
            function: self.function(&method.function),
            takes_next: method.takes_next,
            accessor: method.accessor,
            is_builtin: method.is_builtin,
            doc: method.doc.clone(),
            object: RefCell::default(),
        });
        self.methods.insert(address(method), copy.clone());
        copy
    }

    fn method_list(&mut self, methods: &[Rc<Method>]) -> Vec<Rc<Method>> {
        methods.iter().map(|method| self.method(method)).collect()
    }

    pub(super) fn fill_class(&mut self, original: &Class, copy: &Class) {
        let with_values = |copier: &mut Copier, initargs: &[(Sym, Initform)]| {
            let initargs = initargs.iter();
            initargs
                .map(|(name, form)| (*name, copier.initform(form)))
                .collect::<Vec<_>>()
        };
        let above = self.classes(&original.direct_superclasses.borrow());
        copy.direct_superclasses.replace(above);
        let below = self.classes(&original.direct_subclasses.borrow());
        copy.direct_subclasses.replace(below);
        let order = self.classes(&original.precedence.borrow());
        copy.precedence.replace(order);
        let slots = self.slot_definitions(&original.direct_slots.borrow());
        copy.direct_slots.replace(slots);
        let slots = self.slot_definitions(&original.slots.borrow());
        copy.slots.replace(slots);
        let initargs = with_values(self, &original.direct_default_initargs.borrow());
        copy.direct_default_initargs.replace(initargs);
        let initargs = with_values(self, &original.default_initargs.borrow());
        copy.default_initargs.replace(initargs);
        let accessors = self.method_list(&original.accessors.borrow());
        copy.accessors.replace(accessors);
        let report = original.report.borrow();
        let report = report.as_ref().map(|report| self.function(report));
        copy.report.replace(report);
        let layout = original.structure.borrow();
        let layout = layout
            .as_ref()
            .map(|layout| Rc::new(self.structure(layout)));
        copy.structure.replace(layout);
        copy.doc.replace(original.doc.borrow().clone());
        copy.generation.set(original.generation.get());
        let layouts = original.old_layouts.borrow().clone();
        let layouts = layouts.into_iter().map(|slots| {
            let slots = slots.into_iter();
            let copied = |(name, value): OldSlot| (name, value.map(|v| self.value(&v)));
            slots.map(copied).collect()
        });
        let layouts = layouts.collect();
        copy.old_layouts.replace(layouts);
        copy.is_defined.set(original.is_defined.get());
        let name = original.given_name.borrow().clone();
        copy.given_name.replace(name.map(|name| self.value(&name)));
    }

    pub(super) fn fill_generic(&mut self, original: &GenericFunction, copy: &GenericFunction) {
        copy.is_declared.set(original.is_declared.get());
        let methods = self.method_list(&original.methods.borrow());
        // Effective methods are known by addresses of classes; they are found again.
        copy.dispatch.replace(Dispatch::for_methods(&methods));
        copy.methods.replace(methods);
        let own = self.method_list(&original.own_methods.borrow());
        copy.own_methods.replace(own);
        copy.doc.replace(original.doc.borrow().clone());
        copy.combination.set(original.combination.get());
        *copy.precedence.borrow_mut() = original.precedence.borrow().clone();
        copy.most_specific_last
            .set(original.most_specific_last.get());
    }
}
