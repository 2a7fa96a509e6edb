//! Temporary.
use super::{JointId, KinematicTree, Limits, LinkId};
#[derive(Clone, Debug, PartialEq)]
pub struct JawGap;
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("not yet")]
pub struct JawGapError;
impl JawGap {
    pub fn measure(_: &KinematicTree, _: LinkId, _: JointId, _: Limits, _: &[Vec<LinkId>; 2]) -> Result<Self, JawGapError> { Err(JawGapError) }
    pub fn gap(&self, q: f64) -> f64 { q }
    pub fn position_for_gap(&self, q: f64) -> f64 { q }
}
