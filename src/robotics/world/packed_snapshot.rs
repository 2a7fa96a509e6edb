//! Snapshots that are kept for long take little memory.

use std::sync::Arc;

use parry3d_f64::bounding_volume::Aabb;
use serde::{Deserialize, Serialize};

use super::packing::{self, LeftOut, PackingError, Reader, Reference, Writer};
use super::physics::{LEFT_OUT, LEFT_OUT_AS_READ, Sets, Shapes};
use super::scene::{State, World};
use super::snapshot::Snapshot;
use crate::robot::JointPositions;
use spatial::Pose;

/// A snapshot as the difference to another state, compressed. A world restored to it continues with the same bits
/// as before, too.
pub struct Packed {
    /// What has changed since the reference.
    bytes: Box<[u8]>,
    reference: Arc<Reference>,
    shapes: Shapes,
    /// The rest, without what is in the bytes.
    state: State,
}

/// Packs snapshots of worlds that are much alike, such as one world at many times.
#[derive(Default)]
pub struct Packer {
    /// The state against which the next one is written.
    reference: Option<Arc<Reference>>,
    /// How many bytes have been written against it.
    written: usize,
    /// The shapes in the last one.
    shapes: Shapes,
    /// Bytes that were used.
    used: Vec<u8>,
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
        let (bytes, reference) = self.written(physics, &numbers).ok()?;
        self.shapes = physics.shapes(&self.shapes);
        Some(Packed {
            bytes,
            reference,
            shapes: Arc::clone(&self.shapes),
            state,
        })
    }

    /// The compressed difference to a state: an earlier one, unless what has been written against that already takes more
    /// memory than another would.
    fn written(
        &mut self,
        physics: &Sets,
        numbers: &Numbers,
    ) -> Result<(Box<[u8]>, Arc<Reference>), PackingError> {
        if let Some(reference) = self.reference.clone() {
            let bytes = self.difference(physics, numbers, &reference)?;
            self.written += bytes.len();
            if self.written <= reference.bytes() {
                return Ok((bytes, reference));
            }
        }
        let mut writer = Writer::new(Vec::new(), None, Some(LEFT_OUT));
        numbers.serialize(&mut writer)?;
        physics.write(&mut writer)?;
        let reference = Arc::new(writer.into_reference());
        self.reference = Some(Arc::clone(&reference));
        self.written = 0;
        let bytes = self.difference(physics, numbers, &reference)?;
        Ok((bytes, reference))
    }

    fn difference(
        &mut self,
        physics: &Sets,
        numbers: &Numbers,
        reference: &Reference,
    ) -> Result<Box<[u8]>, PackingError> {
        self.used.clear();
        let used = std::mem::take(&mut self.used);
        let mut writer = Writer::new(used, Some(reference), Some(LEFT_OUT));
        numbers.serialize(&mut writer)?;
        physics.write(&mut writer)?;
        self.used = writer.into_bytes();
        Ok(packing::compress(&self.used))
    }
}

impl Packed {
    /// How much memory (bytes) it takes beside what it shares with others, roughly.
    pub fn bytes(&self) -> usize {
        self.bytes.len() + size_of::<Self>() + self.state.bytes()
    }

    /// What it shares with others that were packed before and after it: a number that tells it apart, and how much
    /// memory (bytes) it takes.
    pub fn shared(&self) -> (usize, usize) {
        let reference = Arc::as_ptr(&self.reference).addr();
        let bytes = self.reference.bytes() + size_of_val(&*self.shapes);
        (reference, bytes)
    }

    /// Whether all that both have in bytes is the same.
    #[cfg(test)]
    pub(crate) fn says_the_same_as(&self, other: &Packed) -> bool {
        Arc::ptr_eq(&self.reference, &other.reference)
            && self.bytes == other.bytes
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
        let bytes = packing::decompress(&self.bytes)?;
        let shapes = self.bytes_of_shapes()?;
        let left_out = LeftOut {
            name: LEFT_OUT_AS_READ,
            bytes: &shapes,
        };
        let mut reader = Reader::new(&bytes, Some(&self.reference), Some(left_out));
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
