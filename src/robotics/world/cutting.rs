//! Cutting a thing with a blade: one body becomes two where the blade is.
//!
//! The food offers no resistance and makes no crumbs: while it is being cut, blade and food pass through each
//! other. It is parted where the blade truly is, and only if the blade has got all the way through.

use parry3d_f64::math::Vector;

use super::error::WorldError;
use super::hash::Hasher;
use super::object::Object;
use super::object_library::ObjectType;
use super::physics::Robot;
use super::scene::World;
use super::solid::{Solid, bounds_of, from_parry_vector, to_parry};
use super::splitting::{Plane, Split};
use spatial::{PlacedShape, Pose, Shape};

/// A box is a blade if it is not thicker (m).
const THIN: f64 = 0.006;
/// How far (m) a blade may be from the lowest part of a section, and from its sides.
const THROUGH: f64 = 0.002;
/// How much a blade may lean to a side, as the vertical part of its normal.
const LEANS: f64 = 0.1;
/// The first edition of pieces: each looks different.
const PIECES: u32 = 1 << 20;

/// Things that are being cut.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cut {
    /// Name of the tool.
    tool: String,
    /// Names of what it may pass through.
    foods: Vec<String>,
}

impl Cut {
    pub(super) fn hash_into(&self, hasher: &mut Hasher) {
        hasher.text(&self.tool);
        self.foods.iter().for_each(|food| hasher.text(food));
    }
}

/// A piece that was cut.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Its name.
    pub name: String,
    /// Its volume (m³).
    pub volume: f64,
    /// Its extent (m) across the cut.
    pub thickness: f64,
}

/// How pieces are called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PieceNames<'a> {
    /// The name of the smaller piece, or of the one that no hand holds.
    pub slice: &'a str,
    /// Its type, if that is in the library; else it keeps the type of the whole.
    pub slice_type: &'a str,
    /// The name of the other piece, which may be that of the whole.
    pub rest: &'a str,
    /// Its type, if that is in the library; else it keeps the type of the whole.
    pub rest_type: &'a str,
}

/// Why nothing was cut.
#[derive(Clone, Debug, PartialEq)]
pub enum NotCut {
    /// There is no such object, or no such piece can be made.
    World(WorldError),
    /// The tool has no blade.
    NoBlade(String),
    /// No hand holds the tool.
    NotHeld(String),
    /// The blade leans to a side, by so much (the vertical part of its normal).
    Leans(f64),
    /// The blade is beside the food.
    Beside,
    /// The blade is not yet through: so far (m) above the lowest point of the section.
    NotThrough(f64),
    /// The section sticks out so far (m) beyond the ends of the blade.
    TooShort(f64),
    /// The shape cannot be cut.
    Shape,
}

impl std::fmt::Display for NotCut {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::World(error) => write!(f, "{error}"),
            Self::NoBlade(tool) => write!(f, "{tool} has no blade"),
            Self::NotHeld(tool) => write!(f, "no hand holds {tool}"),
            Self::Leans(_) => write!(f, "the blade leans to a side"),
            Self::Beside => write!(f, "the blade is beside it"),
            Self::NotThrough(above) => {
                write!(
                    f,
                    "the blade is still {:.0} mm above its bottom",
                    above * 1e3
                )
            }
            Self::TooShort(out) => {
                write!(f, "it sticks out {:.0} mm beyond the blade", out * 1e3)
            }
            Self::Shape => write!(f, "its shape cannot be cut"),
        }
    }
}

impl From<WorldError> for NotCut {
    fn from(error: WorldError) -> Self {
        Self::World(error)
    }
}

/// The blade of a tool, in the frame of the tool.
#[derive(Clone, Debug, PartialEq)]
pub struct Blade {
    /// Its middle (m).
    pub middle: [f64; 3],
    /// The direction from its handle to its tip.
    pub tip: [f64; 3],
    /// The direction of its edge.
    pub edge: [f64; 3],
    /// Half its length and half its height (m), along these directions.
    pub half: [f64; 2],
}

impl Blade {
    fn directions(&self) -> [Vector; 3] {
        let [tip, edge] = [self.tip, self.edge].map(Vector::from);
        [tip, edge, tip.cross(edge)]
    }
}

impl Object {
    /// Its blade: the longest of its boxes that are thin. The edge is on the side to which the blade sticks out
    /// from the middle of the tool's frame, where it is held.
    pub fn blade(&self) -> Option<Blade> {
        let boxes = self
            .shapes()
            .iter()
            .filter_map(|placed| match placed.shape {
                Shape::Box { size } => Some((placed, size)),
                _ => None,
            });
        let sorted = boxes.filter_map(|(placed, size)| {
            let mut axes = [0, 1, 2];
            axes.sort_by(|a, b| size[*b].total_cmp(&size[*a]));
            (size[axes[2]] <= THIN).then_some((placed, size, axes))
        });
        let longest = sorted.max_by(|a, b| a.1[a.2[0]].total_cmp(&b.1[b.2[0]]));
        let (placed, size, [long, wide, _]) = longest?;
        let pose = to_parry(&placed.pose);
        let middle = pose.translation;
        let away = |axis: usize| {
            let axis = pose.rotation * [Vector::X, Vector::Y, Vector::Z][axis];
            if axis.dot(middle) < 0.0 { -axis } else { axis }
        };
        Some(Blade {
            middle: middle.to_array(),
            tip: away(long).to_array(),
            edge: away(wide).to_array(),
            half: [size[long] / 2.0, size[wide] / 2.0],
        })
    }
}

impl World {
    /// From now on, a tool passes through a thing that it is to cut, and through its pieces.
    pub fn begin_cut(&mut self, tool: &str, food: &str) -> Result<(), NotCut> {
        let object = self.object(tool)?;
        if object.blade().is_none() {
            return Err(NotCut::NoBlade(tool.to_owned()));
        }
        if object.hold().is_none() {
            return Err(NotCut::NotHeld(tool.to_owned()));
        }
        let (tool_body, food_body) = (object.body, self.object(food)?.body);
        self.end_cut(tool);
        self.physics.let_pass(tool_body, true);
        self.physics.be_cut(food_body, true);
        self.state.cuts.push(Cut {
            tool: tool.to_owned(),
            foods: vec![food.to_owned()],
        });
        Ok(())
    }

    /// A tool passes through nothing any more.
    pub fn end_cut(&mut self, tool: &str) {
        let (ended, kept) = std::mem::take(&mut self.state.cuts)
            .into_iter()
            .partition::<Vec<Cut>, _>(|cut| cut.tool == tool);
        self.state.cuts = kept;
        for cut in ended {
            if let Some(object) = self.state.objects.get(&cut.tool) {
                self.physics.let_pass(object.body, false);
            }
            for food in cut.foods {
                if let Some(object) = self.state.objects.get(&food) {
                    self.physics.be_cut(object.body, false);
                }
            }
        }
    }

    /// Parts a thing where the blade of a tool is. The pieces are the slice and the rest; a hand that held the
    /// whole holds the rest. Nothing changes if the blade is not all the way through.
    pub fn cut(
        &mut self,
        tool: &str,
        food: &str,
        names: PieceNames<'_>,
    ) -> Result<[Piece; 2], NotCut> {
        let knife = self.object(tool)?;
        if knife.hold().is_none() {
            return Err(NotCut::NotHeld(tool.to_owned()));
        }
        let blade = knife.blade();
        let blade = blade.ok_or_else(|| NotCut::NoBlade(tool.to_owned()))?;
        let knife_at = to_parry(&self.physics.pose(knife.body));
        let middle = knife_at.transform_point(Vector::from(blade.middle));
        let [tip, edge, normal] = blade.directions().map(|axis| knife_at.rotation * axis);
        let deep = (tip.z * blade.half[0]).abs() + (edge.z * blade.half[1]).abs();
        let lowest = middle.z - deep;
        let whole = self.object(food)?.clone();
        let at = self.physics.pose(whole.body);
        let in_food = to_parry(&at).inverse();
        if normal.z.abs() > LEANS {
            return Err(NotCut::Leans(normal.z));
        }
        let plane = Plane {
            point: in_food.transform_point(middle),
            normal: in_food.rotation * normal,
        };
        let split = Split::of(&whole.shapes, &plane).ok_or(NotCut::Shape)?;
        if split.section.is_empty() {
            return Err(NotCut::Beside);
        }
        let place = to_parry(&at);
        for point in &split.section {
            let point = place.transform_point(*point);
            let above = lowest - point.z;
            if above > THROUGH {
                return Err(NotCut::NotThrough(above));
            }
            let out = (point - middle).dot(tip).abs() - blade.half[0];
            if out > THROUGH {
                return Err(NotCut::TooShort(out));
            }
        }
        self.part_whole(tool, &whole, &at, split, plane.normal, names)
    }

    fn part_whole(
        &mut self,
        tool: &str,
        whole: &Object,
        at: &Pose,
        split: Split,
        normal: Vector,
        names: PieceNames<'_>,
    ) -> Result<[Piece; 2], NotCut> {
        let volumes = [0, 1].map(|i| volume(&split.sides[i]));
        let all = volumes[0] + volumes[1];
        // The hand is where its link is; without one, the larger piece is the rest.
        let grip = whole.attachment.map(|held| {
            let hand = to_parry(at).inverse() * to_parry(&self.link_tool(held.link));
            (hand.translation - split.section[0]).dot(normal)
        });
        let rest = match grip {
            Some(side) => usize::from(side > 0.0),
            None => usize::from(volumes[1] > volumes[0]),
        };
        let kinds = [0, 1].map(|side| {
            let wanted = if side == rest {
                names.rest_type
            } else {
                names.slice_type
            };
            let known = self
                .models
                .objects
                .get(wanted)
                .map(|known| known.name.clone());
            known.unwrap_or_else(|| whole.type_name.clone())
        });
        let held = whole.attachment;
        self.remove(&whole.name)?;
        let mut pieces = Vec::new();
        for (side, (shapes, kind)) in split.sides.into_iter().zip(kinds).enumerate() {
            let name = if side == rest {
                names.rest
            } else {
                names.slice
            };
            let solids = Solid::all(&shapes);
            let bounds = bounds_of(&solids).ok_or(NotCut::Shape)?;
            let middle = from_parry_vector(bounds.center());
            let thickness = extent(&shapes, normal).unwrap_or(0.0);
            let back = Pose::translation(-middle.x, -middle.y, -middle.z);
            let shapes: Vec<PlacedShape> = shapes
                .into_iter()
                .map(|placed| PlacedShape {
                    pose: back * placed.pose,
                    color: placed.color.or(Some(whole.color)),
                    shape: placed.shape,
                })
                .collect();
            let piece = ObjectType {
                name: kind,
                looks: Some(shapes.clone()),
                shapes,
                mass: whole.mass * volumes[side] / all,
                friction: whole.friction,
                color: whole.color,
                is_round: false,
                balance: [0.0; 3],
                inside: None,
                edition: PIECES + self.state.next_number,
            };
            self.insert(name, &piece, &(at * back.inverse()))?;
            let body = self.object(name)?.body;
            self.physics.be_cut(body, true);
            if let Some(cut) = self.state.cuts.iter_mut().find(|cut| cut.tool == tool) {
                cut.foods.push(name.to_owned());
            }
            pieces.push(Piece {
                name: name.to_owned(),
                volume: volumes[side],
                thickness,
            });
        }
        if let Some(held) = held {
            self.attach(names.rest, held.link)?;
            let body = self.object(names.rest)?.body;
            if let Some(hold) = held.hold {
                self.physics
                    .collide(body, Robot::WithoutHand(hold.side().index()));
                self.physics.be_cut(body, true);
            }
            if let Some(object) = self.state.objects.get_mut(names.rest)
                && let Some(attachment) = &mut object.attachment
            {
                attachment.hold = held.hold;
            }
        }
        pieces.sort_by_key(|piece| piece.name == names.rest);
        <[Piece; 2]>::try_from(pieces).map_err(|_| NotCut::Shape)
    }

    /// Where the fingers of the hand are whose palm is the link; the link's own pose if it is no palm.
    fn link_tool(&self, link: crate::robot::LinkId) -> Pose {
        let arms = self.models.description.arms.iter();
        let mut palms = arms.filter(|arm| arm.gripper.palm == link);
        match palms.next() {
            Some(arm) => arm.tool_for_wrist(&self.link_pose(arm.wrist)),
            None => self.link_pose(link),
        }
    }
}

fn volume(shapes: &[PlacedShape]) -> f64 {
    Solid::all(shapes).iter().map(|solid| solid.volume).sum()
}

/// The extent (m) of shapes along a direction.
fn extent(shapes: &[PlacedShape], along: Vector) -> Option<f64> {
    let mut least = f64::INFINITY;
    let mut most = f64::NEG_INFINITY;
    for solid in Solid::all(shapes) {
        let turned = parry3d_f64::math::Rotation::from_rotation_arc(along, Vector::X);
        let pose = parry3d_f64::math::Pose::from_rotation(turned) * solid.pose;
        let bounds = solid.shape.compute_aabb(&pose);
        least = least.min(bounds.mins.x);
        most = most.max(bounds.maxs.x);
    }
    (most > least).then_some(most - least)
}
