//! Objects that are held by links.
//!
//! Fingers that press on an object hold it. A soft weld to the palm stands in for their
//! friction, which the engine would compute less exactly, and at a higher price. So the weld
//! exists only as long as the fingers are as close together as when they pressed, and only
//! while it transmits no more force than friction would.

use serde::Serialize;

use super::error::WorldError;
use super::hash::Hasher;
use super::object::{Attachment, Object};
use super::physics::{Robot, WeldHandle};
use super::scene::World;
use crate::robot::{LinkId, Side};

/// How far (rad) a finger joint opens before its fingers count as pressing no more.
const OPENED: f64 = 1e-4;

/// Number of consecutive steps with too much force after which an object slips: single steps
/// are noise of the solver.
const SLIPPING_STEPS: u32 = 3;

/// Number of consecutive steps without contact to anything but the robot after which an object
/// counts as lifted: a tenth of a second.
const LIFTED_STEPS: u32 = 24;

/// How fingers hold an object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hold {
    side: Side,
    /// Position of the finger joint (rad) at which both fingers press.
    fingers: f64,
    /// The force (N) with which each finger presses.
    press: f64,
    /// The greatest force (N) that friction transmits.
    strength: f64,
    /// For how many steps the force has been greater.
    slipping: u32,
    /// For how many steps the object has touched nothing but the robot.
    free: u32,
    /// Whether it is open at the top and upright.
    upright: bool,
    /// The greatest force (N) so far between this hand and another one that holds the object, too.
    between: f64,
}

impl Hold {
    /// Whether the object is open at the top and has stayed upright since the fingers have held it upright.
    pub(super) fn is_upright(&self) -> bool {
        self.upright
    }

    /// Whether the object has left what it stood on.
    pub fn is_lifted(&self) -> bool {
        self.free >= LIFTED_STEPS
    }

    /// The force (N) with which each finger presses.
    pub(crate) fn press(&self) -> f64 {
        self.press
    }

    /// The hand.
    pub(super) fn side(&self) -> Side {
        self.side
    }

    pub(super) fn hash_into(&self, hasher: &mut Hasher) {
        hasher.number(self.fingers);
        hasher.number(self.strength);
        hasher.integer(u64::from(self.slipping));
        hasher.integer(u64::from(self.free));
        if self.upright {
            hasher.integer(1);
        }
        if self.between > 0.0 {
            hasher.number(self.between);
        }
    }
}

/// An object that has slipped out of a hand.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Slip {
    /// Name of the object.
    pub object: String,
    /// The hand.
    pub side: Side,
    /// The force (N) between object and hand.
    pub force: f64,
    /// The greatest force (N) that friction could transmit.
    pub strength: f64,
    /// The number of the step in which it happened.
    pub step: u64,
}

impl World {
    /// Makes the hand hold the object, with its fingers pressing as they are now, each with the
    /// effort (N).
    pub fn hold(&mut self, name: &str, side: Side, effort: f64) -> Result<(), WorldError> {
        let gripper = &self.models.description.arm(side).gripper;
        let (palm, fingers) = (gripper.palm, self.state.robot.joints.get(gripper.joint));
        self.attach(name, palm)?;
        let object = self.object(name)?;
        let upright = object.is_upright_at(&self.physics.pose(object.body));
        if let Some(object) = self.state.objects.get_mut(name)
            && let Some(attachment) = &mut object.attachment
        {
            attachment.hold = Some(Hold {
                side,
                fingers,
                press: effort,
                // Each of the two pads transmits its share.
                strength: 2.0 * object.friction * effort,
                slipping: 0,
                free: 0,
                upright,
                between: 0.0,
            });
            self.physics
                .collide(object.body, Robot::WithoutHand(side.index()));
        }
        Ok(())
    }

    /// Welds the object softly to the robot's link at its current pose. An object that was
    /// attached elsewhere is detached first.
    pub fn attach(&mut self, name: &str, link: LinkId) -> Result<(), WorldError> {
        self.detach(name)?;
        self.bring_body(link);
        let body = self.object(name)?.body;
        let Some((carrier, root)) = self.body_of_link(link) else {
            // A link of another tree has no body here that could hold anything.
            return Ok(());
        };
        // The engine's poses, since the robot may already be set to move in the next step.
        let grip = self.physics.pose(carrier).inverse() * self.physics.pose(body);
        let weld = self.physics.weld(carrier, &grip, body);
        let at = self.link_pose(link).inverse() * self.link_pose(root) * grip;
        if let Some(object) = self.state.objects.get_mut(name) {
            object.attachment = Some(Attachment {
                link,
                at,
                weld,
                hold: None,
            });
        }
        Ok(())
    }

    /// Makes a second hand hold an object that another one holds, with its fingers pressing as they are now,
    /// each with the effort (N). Both welds then share the load.
    pub(crate) fn hold_too(
        &mut self,
        name: &str,
        side: Side,
        effort: f64,
    ) -> Result<(), WorldError> {
        let gripper = &self.models.description.arm(side).gripper;
        let (palm, fingers) = (gripper.palm, self.state.robot.joints.get(gripper.joint));
        let object = self.object(name)?;
        let first = object.attachment;
        if object.attachment_to(palm).is_some() {
            return Ok(());
        }
        if first.is_none_or(|first| first.hold.is_none()) {
            return self.hold(name, side, effort);
        }
        let (body, strength) = (object.body, 2.0 * object.friction * effort);
        self.bring_body(palm);
        let Some((carrier, root)) = self.body_of_link(palm) else {
            return Ok(());
        };
        let grip = self.physics.pose(carrier).inverse() * self.physics.pose(body);
        let weld = self.physics.weld(carrier, &grip, body);
        let at = self.link_pose(palm).inverse() * self.link_pose(root) * grip;
        // The robot's own checks keep the rest of it away from what both hands hold.
        self.physics.collide(body, Robot::Absent);
        if let Some(object) = self.state.objects.get_mut(name) {
            object.second = Some(Attachment {
                link: palm,
                at,
                weld,
                hold: Some(Hold {
                    side,
                    fingers,
                    press: effort,
                    strength,
                    slipping: 0,
                    free: 0,
                    upright: false,
                    between: 0.0,
                }),
            });
        }
        Ok(())
    }

    /// One of the hands lets go of the object; if another one holds it, too, that goes on holding it.
    fn detach_hand(&mut self, name: &str, side: Side) -> Result<(), WorldError> {
        let is_of = |attachment: &Attachment| {
            let hold = attachment.hold.as_ref();
            hold.is_some_and(|hold| hold.side == side)
        };
        let object = self.object(name)?;
        let body = object.body;
        let (gone, left) = match (object.attachment, object.second) {
            (Some(first), Some(second)) if is_of(&first) => (first, second),
            (Some(first), Some(second)) if is_of(&second) => (second, first),
            (Some(first), None) if is_of(&first) => return self.detach(name).map(|_| ()),
            _ => return Ok(()),
        };
        let upright = object.is_upright_at(&self.physics.pose(body));
        self.physics.unweld(gone.weld);
        self.physics.wake(body);
        if let Some(hold) = left.hold {
            let hand = hold.side.index();
            self.physics.collide(body, Robot::WithoutHand(hand));
        }
        if let Some(object) = self.state.objects.get_mut(name) {
            object.second = None;
            object.attachment = Some(left);
            if let Some(hold) = object
                .attachment
                .as_mut()
                .and_then(|left| left.hold.as_mut())
            {
                hold.upright = upright;
            }
        }
        Ok(())
    }

    /// Lets go of the object, with both hands if two hold it. Returns the link that held it.
    pub fn detach(&mut self, name: &str) -> Result<Option<LinkId>, WorldError> {
        self.object(name)?;
        let Some(object) = self.state.objects.get_mut(name) else {
            return Ok(None);
        };
        let held = object.attachment.take();
        let second = object.second.take();
        if let Some(attachment) = held {
            self.physics.unweld(attachment.weld);
            if let Some(second) = second {
                self.physics.unweld(second.weld);
            }
            self.physics.collide(object.body, Robot::Whole);
            self.physics.wake(object.body);
        }
        Ok(held.map(|a| a.link))
    }

    /// Lets go of what opening fingers no longer press on. Call before a step.
    pub(super) fn release_opened_hands(&mut self) {
        let joints = &self.state.robot.joints;
        let arm = |side: Side| self.models.description.arm(side);
        let is_released =
            |hold: &Hold| joints.get(arm(hold.side).gripper.joint) > hold.fingers + OPENED;
        let released = self.state.objects.values().flat_map(|object| {
            let holds = object.attachments().filter_map(|one| one.hold.as_ref());
            let opened = holds.filter(|hold| is_released(hold));
            opened.map(|hold| (object.name.clone(), hold.side))
        });
        let released: Vec<(String, Side)> = released.collect();
        for (name, side) in released {
            // The object has just been found.
            let _held = self.detach_hand(&name, side);
        }
    }

    /// The fingers that hold the object transmit no force any more, as if it were wet: it slips out of
    /// the hands. Returns whether fingers hold it.
    pub fn loosen(&mut self, name: &str) -> bool {
        let Some(object) = self.state.objects.get_mut(name) else {
            return false;
        };
        let attachments = [&mut object.attachment, &mut object.second];
        let attachments = attachments.into_iter().flatten();
        let mut is_held = false;
        for hold in attachments.filter_map(|attachment| attachment.hold.as_mut()) {
            hold.strength = 0.0;
            is_held = true;
        }
        is_held
    }

    /// Notes what the load on the hands has done in the last step: what has been lifted, and
    /// what has slipped away.
    pub(super) fn watch_holds(&mut self) {
        let mut slips = Vec::new();
        let mut changed = Vec::new();
        let mut tilts = Vec::new();
        for object in self.state.objects.values() {
            let Some((attachment, mut hold)) = object
                .attachment
                .and_then(|attachment| Some((attachment, attachment.hold?)))
            else {
                continue;
            };
            slips.extend(self.slip_of(object, attachment.weld, &mut hold));
            if !hold.is_lifted() {
                hold.free = if self.touches_others(object) {
                    0
                } else {
                    hold.free + 1
                };
            }
            if let Some(tilt) = self.newly_tilted(object, &hold) {
                hold.upright = false;
                tilts.push(tilt);
            }
            changed.push((object.name.clone(), hold));
        }
        let mut seconds = Vec::new();
        for object in self.state.objects.values() {
            let second = object.second;
            let Some((weld, mut hold)) = second.and_then(|one| Some((one.weld, one.hold?))) else {
                continue;
            };
            slips.extend(self.slip_of(object, weld, &mut hold));
            hold.between = hold.between.max(self.between_hands(object).unwrap_or(0.0));
            seconds.push((object.name.clone(), hold));
        }
        for (name, hold) in seconds {
            let object = self.state.objects.get_mut(&name);
            if let Some(second) = object.and_then(|o| o.second.as_mut()) {
                second.hold = Some(hold);
            }
        }
        for (name, hold) in changed {
            let object = self.state.objects.get_mut(&name);
            if let Some(attachment) = object.and_then(|o| o.attachment.as_mut()) {
                attachment.hold = Some(hold);
            }
        }
        for tilt in tilts {
            self.state.tilts.retain(|(_, old)| old.side != tilt.side);
            self.state.tilts.push((self.state.steps, tilt));
        }
        for slip in slips {
            // The object has just been found.
            let _held = self.detach_hand(&slip.object, slip.side);
            self.state.slips.retain(|old| old.side != slip.side);
            self.state.slips.push(slip);
        }
    }

    /// The force (N) with which hands hold an object up.
    pub(crate) fn lift_of(&self, object: &Object) -> f64 {
        let pushes = object
            .attachments()
            .map(|one| self.physics.weld_push(one.weld).z);
        pushes.sum()
    }

    /// The force (N) with which two hands that hold an object press it between them, or pull at it, along the line from
    /// one hand to the other: of the two opposite forces the smaller one, since the rest moves the object.
    fn between_hands(&self, object: &Object) -> Option<f64> {
        let (one, two) = (object.attachment?, object.second?);
        let palms = [one, two].map(|held| self.link_pose(held.link).translation.vector);
        let line = (palms[1] - palms[0]).try_normalize(1e-9)?;
        let [first, second] = [one, two].map(|held| self.physics.weld_push(held.weld).dot(&line));
        Some(match first * second < 0.0 {
            true => first.abs().min(second.abs()),
            false => 0.0,
        })
    }

    /// The force (N) between two hands that hold one object: now, and the greatest so far; `None` if no two hands
    /// hold one.
    pub fn force_between_hands(&self) -> Option<[f64; 2]> {
        let mut objects = self.state.objects.values();
        let object = objects.find(|object| object.is_held_by_two())?;
        let greatest = object.second?.hold?.between;
        Some([self.between_hands(object)?, greatest])
    }

    /// Counts for how long a hand has been pulled at harder than its friction transmits; what slips out of it then.
    fn slip_of(&self, object: &Object, weld: WeldHandle, hold: &mut Hold) -> Option<Slip> {
        let force = self.physics.weld_force(weld);
        hold.slipping = if force > hold.strength {
            hold.slipping + 1
        } else {
            0
        };
        (hold.slipping >= SLIPPING_STEPS).then(|| Slip {
            object: object.name.clone(),
            side: hold.side,
            force,
            strength: hold.strength,
            step: self.state.steps,
        })
    }

    /// The last object that has slipped out of one of the hands in that step or later.
    pub fn slip_since(&self, step: u64, is_hand: impl Fn(Side) -> bool) -> Option<&Slip> {
        let mut slips = self.state.slips.iter();
        slips.find(|slip| slip.step >= step && is_hand(slip.side))
    }
}
