//! The class precedence list: a class and its superclasses in one order that respects every
//! class's own order of direct superclasses.

use std::rc::Rc;

use crate::value::class::Class;
use crate::value::raise::Raise;

/// The precedence list of a class whose direct superclasses are set.
///
/// `Ok(None)` while one of the superclasses is not defined. The order is the one of the
/// Common Lisp standard, 4.3.5: a topological order in which, where there is a choice, the
/// class with a direct subclass furthest to the right in the order so far comes first.
pub(crate) fn precedence_list(class: &Rc<Class>) -> Result<Option<Vec<Rc<Class>>>, Box<Raise>> {
    let Some(mut remaining) = class_and_superclasses(class) else {
        return Ok(None);
    };
    let mut pairs: Vec<(Rc<Class>, Rc<Class>)> = Vec::new();
    for each in &remaining {
        let mut before = each.clone();
        for superclass in each.direct_superclasses.borrow().iter() {
            pairs.push((before, superclass.clone()));
            before = superclass.clone();
        }
    }
    let mut order: Vec<Rc<Class>> = Vec::with_capacity(remaining.len());
    while !remaining.is_empty() {
        let candidates: Vec<Rc<Class>> = remaining
            .iter()
            .filter(|c| !pairs.iter().any(|(_, later)| Rc::ptr_eq(later, c)))
            .cloned()
            .collect();
        let Some(next) = choose(&candidates, &order) else {
            return Err(Raise::simple(
                "The superclasses of a class contradict each other about their order.",
            ));
        };
        remaining.retain(|c| !Rc::ptr_eq(c, &next));
        pairs.retain(|(earlier, _)| !Rc::ptr_eq(earlier, &next));
        order.push(next);
    }
    Ok(Some(order))
}

/// The class and all its superclasses, each once; `None` if one is undefined.
fn class_and_superclasses(class: &Rc<Class>) -> Option<Vec<Rc<Class>>> {
    let mut found = vec![class.clone()];
    let mut next = 0;
    while let Some(current) = found.get(next).cloned() {
        next += 1;
        for superclass in current.direct_superclasses.borrow().iter() {
            if !superclass.is_defined.get() {
                return None;
            }
            if !found.iter().any(|c| Rc::ptr_eq(c, superclass)) {
                found.push(superclass.clone());
            }
        }
    }
    Some(found)
}

/// Of several candidates, the one with a direct subclass furthest right in `order`.
fn choose(candidates: &[Rc<Class>], order: &[Rc<Class>]) -> Option<Rc<Class>> {
    if let [only] = candidates {
        return Some(only.clone());
    }
    let by_subclass = order.iter().rev().find_map(|placed| {
        let supers = placed.direct_superclasses.borrow();
        candidates
            .iter()
            .find(|c| supers.iter().any(|s| Rc::ptr_eq(s, c)))
            .cloned()
    });
    by_subclass.or_else(|| candidates.first().cloned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::class::ClassKind;
    use crate::value::symbol::Sym;

    fn class(n: u32, supers: &[&Rc<Class>]) -> Rc<Class> {
        let class = Class::new(Sym(n), ClassKind::Standard);
        class.is_defined.set(true);
        *class.direct_superclasses.borrow_mut() = supers.iter().map(|c| (*c).clone()).collect();
        Rc::new(class)
    }

    fn order(class: &Rc<Class>) -> Vec<u32> {
        let list = precedence_list(class).ok().flatten().unwrap_or_default();
        list.iter().map(|c| c.name.0).collect()
    }

    #[test]
    fn a_diamond_puts_the_common_superclass_last() {
        let top = class(0, &[]);
        let left = class(1, &[&top]);
        let right = class(2, &[&top]);
        assert_eq!(order(&class(3, &[&left, &right])), [3, 1, 2, 0]);
    }

    #[test]
    fn branches_are_followed_before_the_next_branch_begins() {
        let top = class(0, &[]);
        let a = class(1, &[&top]);
        let b = class(2, &[&a]);
        let c = class(3, &[&top]);
        assert_eq!(order(&class(4, &[&b, &c])), [4, 2, 1, 3, 0]);
    }

    #[test]
    fn contradicting_orders_are_an_error() {
        let a = class(1, &[]);
        let b = class(2, &[]);
        let ab = class(3, &[&a, &b]);
        let ba = class(4, &[&b, &a]);
        assert!(precedence_list(&class(5, &[&ab, &ba])).is_err());
    }

    #[test]
    fn an_undefined_superclass_leaves_the_order_open() {
        let a = class(1, &[]);
        a.is_defined.set(false);
        assert!(matches!(precedence_list(&class(2, &[&a])), Ok(None)));
    }
}
