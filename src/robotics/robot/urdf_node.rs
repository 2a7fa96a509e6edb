//! The elements of a URDF as a tree: what is in an element, and the values of its attributes.
//!
//! Values are those that the schema has let pass; where one is missing or wrong, the standard's default
//! is taken. Of children that may stand only once, the last one counts, as in most readers of URDFs.

use super::xml_elements::Element;
use spatial::Pose;
use spatial::pose::from_xyz_rpy;

/// An element in the list of all elements.
#[derive(Clone, Copy)]
pub(super) struct Node<'a> {
    elements: &'a [Element<'a>],
    index: usize,
}

impl<'a> Node<'a> {
    /// The outermost element.
    pub(super) fn root(elements: &'a [Element<'a>]) -> Self {
        Self { elements, index: 0 }
    }

    fn element(self) -> Option<&'a Element<'a>> {
        self.elements.get(self.index)
    }

    /// Byte offset of the element.
    pub(super) fn offset(self) -> usize {
        self.element().map_or(0, |element| element.offset)
    }

    /// The elements directly in this one.
    pub(super) fn contents(self) -> impl Iterator<Item = Node<'a>> {
        let elements = self.elements;
        let parent = Some(self.index);
        // The contents of an element follow it directly, in the order of the file.
        (self.index + 1..elements.len())
            .take_while(move |&i| elements[i].parent >= parent)
            .filter(move |&i| elements[i].parent == parent)
            .map(move |index| Node { elements, index })
    }

    /// Name of the element.
    pub(super) fn name(self) -> &'a str {
        self.element().map_or("", |e| e.name)
    }

    /// All children with that name.
    pub(super) fn children(self, name: &'a str) -> impl Iterator<Item = Node<'a>> {
        self.contents().filter(move |node| node.name() == name)
    }

    /// The child with that name.
    pub(super) fn child(self, name: &'a str) -> Option<Node<'a>> {
        self.children(name).last()
    }

    /// An attribute's value.
    pub(super) fn value(self, attribute: &str) -> Option<&'a str> {
        Some(self.element()?.attribute(attribute)?.value.as_ref())
    }

    /// An attribute's value, empty if it has none.
    pub(super) fn text(self, attribute: &str) -> &'a str {
        self.value(attribute).unwrap_or_default()
    }

    /// A number.
    pub(super) fn number(self, attribute: &str) -> Option<f64> {
        self.value(attribute)?.trim().parse().ok()
    }

    /// A number that defaults to 0.
    pub(super) fn number_or_zero(self, attribute: &str) -> f64 {
        self.number(attribute).unwrap_or_default()
    }

    /// The first numbers of a list.
    pub(super) fn numbers<const N: usize>(self, attribute: &str) -> Option<[f64; N]> {
        let mut numbers = [0.0; N];
        let mut words = self.value(attribute)?.split_whitespace();
        for number in &mut numbers {
            *number = words.next()?.parse().ok()?;
        }
        Some(numbers)
    }

    /// Three numbers that default to 0.
    pub(super) fn vector(self, attribute: &str) -> [f64; 3] {
        self.numbers(attribute).unwrap_or_default()
    }

    /// The pose that the element's `<origin>` gives.
    pub(super) fn origin(self) -> Pose {
        let Some(origin) = self.child("origin") else {
            return from_xyz_rpy([0.0; 3], [0.0; 3]);
        };
        let xyz = origin.vector("xyz");
        let mut pose = from_xyz_rpy(xyz, origin.vector("rpy"));
        if let Some([x, y, z, w]) = origin.numbers("quat_xyzw") {
            let turn = nalgebra::Quaternion::new(w, x, y, z);
            if let Some(turn) = nalgebra::UnitQuaternion::try_new(turn, 1e-9) {
                pose.rotation = turn;
            }
        }
        pose
    }

    /// The name of a link that a child of the element refers to.
    pub(super) fn link_of(self, child: &'a str) -> &'a str {
        self.child(child).map_or("", |c| c.text("link"))
    }
}
