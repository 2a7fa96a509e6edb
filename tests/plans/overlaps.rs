//! Watches a session for things that go through each other.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use robotics::robot::Side;
use robotics::world::{AllowedPairs, BodyName, World};
use session::Session;

/// What was seen of a session so far.
pub(crate) struct Overlaps {
    first: Rc<RefCell<Option<String>>>,
    steps: Rc<Cell<u32>>,
}

impl Overlaps {
    /// Looks at the world after every step from here on.
    pub(crate) fn watch(session: &mut Session) -> Self {
        let overlaps = Self {
            first: Rc::default(),
            steps: Rc::default(),
        };
        let (first, steps) = (overlaps.first.clone(), overlaps.steps.clone());
        let observer = move |world: &World| {
            steps.set(steps.get() + 1);
            if let Some(hit) = world.deepest_penetration(&hands_and_objects(world), 0.002) {
                let text = || format!("{:.2} s: {hit:?}", world.time());
                first.borrow_mut().get_or_insert_with(text);
            }
        };
        session.set_observer(Box::new(observer));
        overlaps
    }

    /// The first time that something overlapped by more than 2 mm.
    pub(crate) fn first(&self) -> Option<String> {
        self.first.borrow().clone()
    }

    /// Steps that were looked at.
    #[allow(dead_code)]
    pub(crate) fn steps(&self) -> u32 {
        self.steps.get()
    }
}

/// The pairs that may always overlap: hands and objects, which grasping presses together.
fn hands_and_objects(world: &World) -> AllowedPairs {
    let models = world.models();
    let hands: Vec<BodyName> = [Side::Left, Side::Right]
        .iter()
        .flat_map(|side| models.description.arm(*side).gripper.links())
        .map(|link| models.robot_body(link))
        .collect();
    world.objects().fold(AllowedPairs::none(), |pairs, object| {
        pairs.and_all(hands.clone(), &BodyName::Object(object.name().to_owned()))
    })
}
