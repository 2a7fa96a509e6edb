//! Snapshots that are kept for long take little memory.

use std::sync::Arc;

use parry3d_f64::bounding_volume::Aabb;
use serde::{Deserialize, Serialize};

use super::packing::{self, Compressed, LeftOut, PackingError, Places, Reader, Reference, Writer};
use super::physics::{LEFT_OUT, LEFT_OUT_AS_READ, Sets, Shapes};
use super::scene::{State, World};
use super::snapshot::Snapshot;
use crate::robot::JointPositions;
use spatial::Pose;

/// How many times as much memory what is written against a state may take as that state, before another takes its place.
const MAX_WRITTEN: usize = 4;

/// A snapshot as the difference to another state, compressed. A world restored to it continues with the same bits
/// as before, too.
pub struct Packed {
    /// What has changed since the state of reference.
    changes: Compressed,
    reference: Arc<KeptReference>,
    shapes: Shapes,
    /// The rest, without what is in the bytes.
    state: State,
}

/// A state against which others are written.
struct KeptReference {
    bytes: Compressed,
    places: Places,
}

impl KeptReference {
    /// How much memory (bytes) it takes.
    fn size(&self) -> usize {
        size_of::<Self>() + self.bytes.size() + self.places.size()
    }
}

/// Packs snapshots of worlds that are much alike, such as one world at many times.
#[derive(Default)]
pub struct Packer {
    /// The state against which the next one is written.
    reference: Option<Arc<KeptReference>>,
    /// The bytes of that; empty where they have to be unpacked first.
    bytes: Vec<u8>,
    /// How many bytes the differences to it take.
    written: usize,
    /// The shapes in the last one.
    shapes: Shapes,
    /// Room for bytes on the way.
    rooms: [Vec<u8>; 2],
}

/// What of the state beside the engine's is in the bytes.
#[derive(Default, Serialize, Deserialize)]
struct Numbers {
    joints: JointPositions,
    robot_poses: Vec<Pose>,
    left_behind: Vec<Option<Aabb>>,
    kitchen: JointPositions,
    kitchen_poses: Vec<Pose>,
}

impl Numbers {
    fn exchange(&mut self, state: &mut State) {
        std::mem::swap(&mut self.joints, &mut state.robot.joints);
        std::mem::swap(&mut self.robot_poses, &mut state.robot_poses);
        std::mem::swap(&mut self.left_behind, &mut state.left_behind);
        std::mem::swap(&mut self.kitchen, &mut state.kitchen);
        std::mem::swap(&mut self.kitchen_poses, &mut state.kitchen_poses);
    }
}

impl Packer {
    /// The snapshot as few bytes; nothing if it cannot be packed, because of joints that were made or removed after
    /// the last step.
    pub fn pack(&mut self, snapshot: &Snapshot) -> Option<Packed> {
        let physics = &snapshot.physics;
        if !physics.can_be_packed() {
            return None;
        }
        let mut state = snapshot.state.clone();
        let mut numbers = Numbers::default();
        numbers.exchange(&mut state);
        let (changes, reference) = self.written(physics, &numbers).ok()?;
        self.shapes = physics.shapes(&self.shapes);
        Some(Packed {
            changes,
            reference,
            shapes: Arc::clone(&self.shapes),
            state,
        })
    }

    /// Gives the room back that is used on the way, until the next snapshot.
    pub fn leave_room(&mut self) {
        self.bytes = Vec::new();
        self.rooms = Default::default();
    }

    /// The difference to a state: an earlier one, unless the differences to that already take too much memory.
    fn written(
        &mut self,
        physics: &Sets,
        numbers: &Numbers,
    ) -> Result<(Compressed, Arc<KeptReference>), PackingError> {
        if let Some(reference) = self.reference.clone() {
            if self.bytes.is_empty() {
                self.bytes = reference.bytes.bytes()?;
            }
            let changes = self.changes(physics, numbers, &reference)?;
            self.written += changes.size();
            if self.written <= MAX_WRITTEN * reference.size() {
                return Ok((changes, reference));
            }
        }
        let (bytes, places) = write(physics, numbers, None, std::mem::take(&mut self.bytes))?;
        self.bytes = bytes;
        let reference = Arc::new(KeptReference {
            bytes: Compressed::new(&self.bytes, &mut self.rooms[0]),
            places,
        });
        self.reference = Some(Arc::clone(&reference));
        self.written = 0;
        let changes = self.changes(physics, numbers, &reference)?;
        Ok((changes, reference))
    }

    /// The difference to the state of reference.
    fn changes(
        &mut self,
        physics: &Sets,
        numbers: &Numbers,
        reference: &KeptReference,
    ) -> Result<Compressed, PackingError> {
        let reference = Reference {
            bytes: &self.bytes,
            places: &reference.places,
        };
        let [bytes, compressed] = &mut self.rooms;
        *bytes = write(physics, numbers, Some(reference), std::mem::take(bytes))?.0;
        Ok(Compressed::new(bytes, compressed))
    }
}

/// Writes everything but shapes, as the difference to a state; the given bytes are overwritten.
fn write(
    physics: &Sets,
    numbers: &Numbers,
    reference: Option<Reference<'_>>,
    mut bytes: Vec<u8>,
) -> Result<(Vec<u8>, Places), PackingError> {
    bytes.clear();
    let mut writer = Writer::new(bytes, reference, Some(LEFT_OUT));
    numbers.serialize(&mut writer)?;
    physics.write(&mut writer)?;
    Ok(writer.finish())
}

impl Packed {
    /// How much memory (bytes) it takes beside what it shares with others, roughly.
    pub fn bytes(&self) -> usize {
        self.changes.size() + size_of::<Self>() + self.state.bytes()
    }

    /// What it shares with others that were packed before and after it: a number that tells it apart, and how much
    /// memory (bytes) it takes.
    pub fn shared(&self) -> (usize, usize) {
        let reference = Arc::as_ptr(&self.reference).addr();
        let bytes = self.reference.size() + size_of_val(&*self.shapes);
        (reference, bytes)
    }

    /// Whether all that both have in bytes is the same.
    #[cfg(test)]
    pub(crate) fn says_the_same_as(&self, other: &Packed) -> bool {
        Arc::ptr_eq(&self.reference, &other.reference)
            && self.changes.bytes() == other.changes.bytes()
            && self.bytes_of_shapes() == other.bytes_of_shapes()
    }

    /// The snapshot that was packed.
    pub fn unpacked(&self) -> Snapshot {
        match self.read() {
            Ok(snapshot) => snapshot,
            Err(error) => panic!("a packed snapshot: {error}"),
        }
    }

    fn bytes_of_shapes(&self) -> Result<Vec<u8>, PackingError> {
        let mut bytes = Vec::new();
        for shape in self.shapes.iter() {
            packing::plain(shape, &mut bytes)?;
        }
        Ok(bytes)
    }

    fn read(&self) -> Result<Snapshot, PackingError> {
        let bytes = self.changes.bytes()?;
        let earlier = self.reference.bytes.bytes()?;
        let reference = Reference {
            bytes: &earlier,
            places: &self.reference.places,
        };
        let shapes = self.bytes_of_shapes()?;
        let left_out = LeftOut {
            name: LEFT_OUT_AS_READ,
            bytes: &shapes,
        };
        let mut reader = Reader::new(&bytes, Some(reference), Some(left_out));
        let mut numbers = Numbers::deserialize(&mut reader)?;
        let physics = Sets::read(&mut reader)?;
        let mut state = self.state.clone();
        numbers.exchange(&mut state);
        Ok(Snapshot { physics, state })
    }
}

impl World {
    /// Restores a state of this world, or of one that was cloned from it, as [`World::restore`] does.
    pub fn restore_packed(&mut self, packed: &Packed) {
        self.go_to(packed.unpacked());
    }
}
