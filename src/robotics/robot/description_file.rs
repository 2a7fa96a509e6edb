//! Reading a robot description from s-expressions.

use super::alias_file::aliases;
use super::description::{
    Aim, Arm, Base, Camera, DriveKind, Gripper, Jaws, Neck, RobotDescription, Speed, Torso,
};
use super::description_values::{
    base_start, drive_kind, optional_positive, pad_size, rotation, speed,
};
use super::interface_file::{INTERFACE_KEYS, interface};
use super::jaw_gap::{JawGap, JawGapError};
use super::mounted_frame::{MountedFrame, aimed};
use super::{ArmKinematics, ArmPositions, JointId, JointKind, KinematicTree, Limits, LinkId, Side};
use crate::sexp::{DataError, DataFile, DataProblem, Node, Record};
use closest_name::closest_name;
use spatial::Pose;

/// The records of a description, each with its keys.
const RECORDS: &[(&str, &[&str])] = &[
    ("robot", &[]),
    (
        "base",
        &[
            "frame",
            "body",
            "drive",
            "drive-velocity",
            "drive-acceleration",
            "turn-velocity",
            "turn-acceleration",
            "odometry",
            "start",
        ],
    ),
    ("torso", &["link", "joint", "start"]),
    (
        "neck",
        &["pan-joint", "pan-link", "tilt-joint", "tilt-link", "joints"],
    ),
    (
        "camera",
        &[
            "frame",
            "at",
            "looks-at",
            "width",
            "height",
            "vertical-view",
            "near",
            "far",
            "visible-share",
        ],
    ),
    (
        "arm",
        &[
            "base",
            "wrist",
            "tool",
            "tool-offset",
            "tool-axes",
            "start",
            "payload",
            "postures",
        ],
    ),
    (
        "gripper",
        &[
            "palm",
            "joint",
            "joints",
            "tip-joint",
            "pad-face",
            "pad-size",
            "joint-per-metre",
            "effort",
            "left-finger",
            "right-finger",
        ],
    ),
    ("default-speed", &["velocity", "acceleration"]),
    ("speed", &["velocity", "acceleration"]),
    ("touching", &[]),
    ("wheels", &[]),
    ("idle-joints", &[]),
    ("alias", &[]),
    ("interface", INTERFACE_KEYS),
];

/// Greatest force (N) of fingers whose description does not give it: little, so that nothing is
/// held here that a robot would drop.
const UNKNOWN_EFFORT: f64 = 20.0;

impl RobotDescription {
    /// Reads a description of the robot with that tree; `file_name` is used only in errors.
    pub fn from_sexp(text: &str, file_name: &str, tree: &KinematicTree) -> Result<Self, DataError> {
        let file = DataFile::read(text, file_name)?;
        let mut records = Vec::new();
        for node in file.nodes() {
            records.push(node.record("record", RECORDS)?);
        }
        let mut reader = Reader {
            tree,
            file: &file,
            records,
        };
        // Fingers that move together are measured so.
        let mut joined = tree.clone();
        let followers = reader.joined()?;
        for &(follower, leader) in &followers {
            joined.join(follower, leader);
        }
        let frames = reader.mounted_frames()?;
        for frame in &frames {
            joined.mount(frame);
        }
        reader.tree = &joined;
        reader.description(followers, frames)
    }
}

/// The records of a file, and the tree that they refer to.
struct Reader<'a> {
    tree: &'a KinematicTree,
    file: &'a DataFile,
    records: Vec<Record<'a>>,
}

impl<'a> Reader<'a> {
    fn description(
        &self,
        joined: Vec<(JointId, JointId)>,
        frames: Vec<MountedFrame>,
    ) -> Result<RobotDescription, DataError> {
        let robot = self.single("robot")?;
        let cameras: Vec<Camera> = self
            .all("camera")
            .map(|record| self.camera(record))
            .collect::<Result<_, _>>()?;
        let Some(camera) = cameras.first() else {
            return Err(self.missing("camera"));
        };
        let base = self.base()?;
        let torso = self.torso(&base)?;
        Ok(RobotDescription {
            name: robot.thing("name")?.symbol()?.to_owned(),
            neck: self.neck(camera)?,
            cameras,
            arms: self.arms(&base, &torso)?,
            torso,
            base,
            touching: self.groups("touching")?,
            wheels: self.groups("wheels")?.concat(),
            idle_joints: self.idle_joints()?,
            joined,
            frames,
            aliases: aliases(self.tree, self.all("alias"))?,
            interface: interface(self.all("interface"))?,
            speeds: self.speeds()?,
        })
    }

    fn all(&self, head: &'static str) -> impl Iterator<Item = &Record<'a>> {
        self.records.iter().filter(move |r| r.head() == head)
    }

    fn missing(&self, head: &str) -> DataError {
        self.file.error(DataProblem::MissingRecord(head.to_owned()))
    }

    fn single(&self, head: &'static str) -> Result<&Record<'a>, DataError> {
        self.optional(head)?.ok_or_else(|| self.missing(head))
    }

    /// The record with that head, if there is one.
    fn optional(&self, head: &'static str) -> Result<Option<&Record<'a>>, DataError> {
        let mut all = self.all(head);
        let first = all.next();
        match all.next() {
            None => Ok(first),
            Some(second) => Err(second
                .node()
                .error(DataProblem::Repeated(format!("({head} …)")))),
        }
    }

    /// The record with that head for one side, if there is one.
    fn sided(&self, head: &'static str, side: Side) -> Result<Option<&Record<'a>>, DataError> {
        let mut found = None;
        for record in self.all(head) {
            let thing = record.thing("side, left or right")?;
            let name = thing.symbol()?;
            let this = Side::named(name).ok_or_else(|| thing.expected("left or right"))?;
            if this == side && found.replace(record).is_some() {
                return Err(thing.error(DataProblem::Repeated(format!("({head} {side} …)"))));
            }
        }
        Ok(found)
    }

    fn link(&self, node: Node<'_>) -> Result<LinkId, DataError> {
        let name = node.symbol()?;
        self.tree.link_named(name).ok_or_else(|| {
            let names = self.tree.links().map(|(_, l)| l.name.as_str());
            node.unknown("link", name, closest_name(name, names))
        })
    }

    fn links(&self, nodes: &[Node<'_>]) -> Result<Vec<LinkId>, DataError> {
        nodes.iter().map(|node| self.link(*node)).collect()
    }

    fn joint(&self, node: Node<'_>) -> Result<JointId, DataError> {
        let name = node.symbol()?;
        self.tree.joint_named(name).ok_or_else(|| {
            let names = self.tree.joints().map(|(_, j)| j.name.as_str());
            node.unknown("joint", name, closest_name(name, names))
        })
    }

    /// A joint with limits, and the limits.
    fn limited_joint(&self, node: Node<'_>) -> Result<(JointId, Limits), DataError> {
        let id = self.joint(node)?;
        let joint = self.tree.joint(id);
        match joint.limits {
            Some(limits) if joint.is_actuated() => Ok((id, limits)),
            _ => Err(node.expected("a joint with limits that follows no other one")),
        }
    }

    /// A joint that moves on its own.
    fn moving_joint(&self, node: Node<'_>) -> Result<JointId, DataError> {
        let id = self.joint(node)?;
        match self.tree.joint(id).is_actuated() {
            true => Ok(id),
            false => Err(node.expected("a joint that moves and follows no other one")),
        }
    }

    fn groups(&self, head: &'static str) -> Result<Vec<Vec<LinkId>>, DataError> {
        self.all(head).map(|r| self.links(r.things())).collect()
    }

    fn idle_joints(&self) -> Result<Vec<JointId>, DataError> {
        let nodes = self.all("idle-joints").flat_map(Record::things);
        nodes.map(|node| self.joint(*node)).collect()
    }

    fn base(&self) -> Result<Base, DataError> {
        let record = self.single("base")?;
        let frame = record.required("frame")?;
        let kind = record
            .optional("drive")
            .map_or(Ok(DriveKind::Omnidirectional), drive_kind)?;
        let base = Base {
            frame: self.link(frame)?,
            body: self.link(record.required("body")?)?,
            kind,
            drive: speed(record, "drive-velocity", "drive-acceleration")?,
            turn: speed(record, "turn-velocity", "turn-acceleration")?,
            odometry: record
                .optional("odometry")
                .map(|node| node.symbol().map(str::to_owned))
                .transpose()?,
            start: match record.optional("start") {
                Some(node) => base_start(node, kind)?,
                None => Pose::identity(),
            },
        };
        if base.frame != self.tree.root() {
            let root = &self.tree.link(self.tree.root()).name;
            return Err(frame.expected(&format!("{root}, the root of the robot")));
        }
        Ok(base)
    }

    fn torso(&self, base: &Base) -> Result<Torso, DataError> {
        let Some(record) = self.optional("torso")? else {
            return Ok(Torso {
                link: base.body,
                joint: None,
                limits: Limits {
                    lower: 0.0,
                    upper: 0.0,
                },
                start: 0.0,
            });
        };
        let (joint, limits) = self.limited_joint(record.required("joint")?)?;
        let start = record.required("start")?;
        let height = start.number()?;
        if !limits.contains(height) {
            let Limits { lower, upper } = limits;
            return Err(start.expected(&format!("a height from {lower} to {upper}")));
        }
        Ok(Torso {
            link: self.link(record.required("link")?)?,
            joint: Some(joint),
            limits,
            start: height,
        })
    }

    fn neck(&self, camera: &Camera) -> Result<Neck, DataError> {
        let aim = Aim::Camera(camera.frame);
        let Some(record) = self.optional("neck")? else {
            let joints = Vec::new();
            return Ok(Neck { joints, aim });
        };
        if let Some(joints) = record.optional("joints") {
            let joints = joints.list()?;
            let joints = joints.iter().map(|node| self.moving_joint(*node));
            return Ok(Neck {
                joints: joints.collect::<Result<_, _>>()?,
                aim,
            });
        }
        let joints = [
            record.required("pan-joint")?,
            record.required("tilt-joint")?,
        ];
        let [pan_joint, tilt_joint] = joints;
        Ok(Neck {
            joints: vec![
                self.limited_joint(pan_joint)?.0,
                self.limited_joint(tilt_joint)?.0,
            ],
            aim: Aim::PanTilt {
                pan: self.link(record.required("pan-link")?)?,
                tilt: self.link(record.required("tilt-link")?)?,
            },
        })
    }

    /// The frames of cameras that stand where the URDF has none.
    fn mounted_frames(&self) -> Result<Vec<MountedFrame>, DataError> {
        let mut frames: Vec<MountedFrame> = Vec::new();
        for record in self.all("camera") {
            let Some(at) = record.optional("at") else {
                if let Some(node) = record.optional("looks-at") {
                    return Err(node.expected("no :looks-at without :at, where the camera stands"));
                }
                continue;
            };
            let thing = record.thing("name")?;
            let name = MountedFrame::name_of(thing.symbol()?);
            let is_taken = frames.iter().any(|frame| frame.name == name);
            if is_taken || self.tree.link_named(&name).is_some() {
                return Err(thing.error(DataProblem::Repeated(format!("the link {name}"))));
            }
            frames.push(MountedFrame {
                name,
                parent: self.link(record.required("frame")?)?,
                at: aimed(at, record.required("looks-at")?)?,
            });
        }
        Ok(frames)
    }

    fn camera(&self, record: &Record<'_>) -> Result<Camera, DataError> {
        let view = record.required("vertical-view")?;
        let vertical_view = view.positive()?;
        if vertical_view >= std::f64::consts::PI {
            return Err(view.expected("an angle below pi"));
        }
        let far = record.required("far")?;
        let name = record.thing("name")?.symbol()?.to_owned();
        let frame = match record.optional("at") {
            // It has been mounted.
            Some(node) => {
                let mounted = self.tree.link_named(&MountedFrame::name_of(&name));
                mounted.ok_or_else(|| node.expected("a frame that has been mounted"))?
            }
            None => self.link(record.required("frame")?)?,
        };
        let camera = Camera {
            name,
            frame,
            width: record.required("width")?.count()?,
            height: record.required("height")?.count()?,
            vertical_view,
            near: record.required("near")?.positive()?,
            far: far.positive()?,
            visible_share: record.required("visible-share")?.positive()?,
        };
        if camera.far <= camera.near {
            return Err(far.expected("a distance above :near"));
        }
        Ok(camera)
    }

    fn arms(&self, base: &Base, torso: &Torso) -> Result<Vec<Arm>, DataError> {
        let mut arms = Vec::new();
        for side in Side::BOTH {
            if let Some(record) = self.sided("arm", side)? {
                arms.push(self.arm(record, side, base, torso)?);
            }
        }
        match arms.is_empty() {
            true => Err(self.missing("arm")),
            false => Ok(arms),
        }
    }

    fn arm(
        &self,
        record: &Record<'_>,
        side: Side,
        base: &Base,
        torso: &Torso,
    ) -> Result<Arm, DataError> {
        let arm_base = record.required("base")?;
        let wrist = record.required("wrist")?;
        let (base_link, wrist_link) = (self.link(arm_base)?, self.link(wrist)?);
        if !self.tree.carries(base.frame, base_link) {
            return Err(arm_base.expected("a link that hangs on the base"));
        }
        let kinematics = ArmKinematics::new(self.tree, base_link, wrist_link)
            .map_err(|e| wrist.error(DataProblem::Invalid(e.to_string())))?;
        let postures = self.postures(record.required("postures")?, kinematics.joints())?;
        let start = record.required("start")?;
        let start_name = start.symbol()?;
        let start = postures.iter().find(|(name, _)| name == start_name);
        let (_, start) = start.ok_or_else(|| {
            let names = postures.iter().map(|(name, _)| name.as_str());
            let closest = closest_name(start_name, names);
            record.node().unknown("posture", start_name, closest)
        })?;
        let tool_offset = record.required("tool-offset")?.number()?;
        let (tool_axes, ahead) = rotation(record.required("tool-axes")?)?;
        let kinematics = kinematics.with_tool_at(ahead * tool_offset);
        let with_lift = torso
            .joint
            .and_then(|lift| kinematics.with_lift(self.tree, (base.frame, wrist_link), lift));
        Ok(Arm {
            side,
            base: base_link,
            wrist: wrist_link,
            tool: self.link(record.required("tool")?)?,
            tool_offset,
            tool_at: ahead * tool_offset,
            tool_axes,
            start: *start,
            payload: optional_positive(record, "payload")?,
            map: kinematics.map(ahead * tool_offset),
            with_lift,
            kinematics,
            postures,
            gripper: self.gripper(side)?,
        })
    }

    /// Postures within the hard limits of the joints.
    fn postures(
        &self,
        node: Node<'_>,
        joints: &[JointId],
    ) -> Result<Vec<(String, ArmPositions)>, DataError> {
        let mut postures = Vec::new();
        for posture in node.list()? {
            let items = posture.list()?;
            let name = posture.head()?;
            let numbers = items.iter().skip(1).map(Node::number);
            let numbers: Vec<f64> = numbers.collect::<Result<_, _>>()?;
            let positions = ArmPositions::try_from(numbers.as_slice()).ok();
            let Some(positions) = positions.filter(|all| all.len() == joints.len()) else {
                let wanted = format!("a name and {} joint positions", joints.len());
                return Err(posture.expected(&wanted));
            };
            for (i, (joint, position)) in joints.iter().zip(positions).enumerate() {
                let joint = self.tree.joint(*joint);
                if let Some(limits) = joint.limits.filter(|l| !l.contains(position)) {
                    let Limits { lower, upper } = limits;
                    let wanted = format!("a position of {} from {lower} to {upper}", joint.name);
                    // One item per position, after the name.
                    let item = items.get(i + 1).unwrap_or(&posture);
                    return Err(item.expected(&wanted));
                }
            }
            postures.push((name.to_owned(), positions));
        }
        Ok(postures)
    }

    /// The joint that moves the fingers of a gripper, and those that move as it does.
    fn finger_joints<'r>(
        &self,
        record: &Record<'r>,
    ) -> Result<(Node<'r>, Vec<Node<'r>>), DataError> {
        let Some(joints) = record.optional("joints") else {
            return Ok((record.required("joint")?, Vec::new()));
        };
        match joints.list()?.as_slice() {
            [] => Err(joints.expected("the joints of the fingers")),
            [first, others @ ..] => Ok((*first, others.to_vec())),
        }
    }

    /// The joints of fingers that move as another one does, each with that one.
    fn joined(&self) -> Result<Vec<(JointId, JointId)>, DataError> {
        let mut joined = Vec::new();
        for record in self.all("gripper") {
            let (leader, followers) = self.finger_joints(record)?;
            let leader = self.limited_joint(leader)?.0;
            for follower in followers {
                joined.push((self.limited_joint(follower)?.0, leader));
            }
        }
        Ok(joined)
    }

    fn gripper(&self, side: Side) -> Result<Gripper, DataError> {
        let record = self.sided("gripper", side)?;
        let record = record.ok_or_else(|| self.missing(&format!("gripper {side}")))?;
        let (joint, limits) = self.limited_joint(self.finger_joints(record)?.0)?;
        let palm = self.link(record.required("palm")?)?;
        let fingers = [
            self.links(&record.required("left-finger")?.list()?)?,
            self.links(&record.required("right-finger")?.list()?)?,
        ];
        let jaws = match record.optional("tip-joint") {
            Some(tip) => {
                let tip = self.tree.joint(self.joint(tip)?).origin.translation.vector;
                let finger = self.tree.joint(joint).origin.translation.vector;
                Jaws::Turning {
                    tip: [tip.x, tip.y.abs()],
                    pad: finger.y.abs() - record.required("pad-face")?.number()?,
                }
            }
            None => {
                let measured = JawGap::measure(
                    self.tree,
                    palm,
                    &[joint],
                    fingers.each_ref().map(Vec::as_slice),
                );
                let wrong = |error: JawGapError| DataProblem::Invalid(error.to_string());
                Jaws::Measured(measured.map_err(|error| record.node().error(wrong(error)))?)
            }
        };
        Ok(Gripper {
            palm,
            joint,
            limits,
            fingers,
            joint_per_metre: optional_positive(record, "joint-per-metre")?,
            effort: optional_positive(record, "effort")?.unwrap_or(UNKNOWN_EFFORT),
            pad_size: match (record.optional("pad-size"), &jaws) {
                (Some(size), _) => Some(pad_size(size)?),
                (None, Jaws::Measured(gap)) => Some(gap.pad_size),
                (None, Jaws::Turning { .. }) => None,
            },
            jaws,
        })
    }

    /// The speed of every joint: its own, or the default within what the URDF allows.
    fn speeds(&self) -> Result<Vec<Speed>, DataError> {
        let default = speed(self.single("default-speed")?, "velocity", "acceleration")?;
        let mut speeds: Vec<Speed> = self
            .tree
            .joints()
            .map(|(_, joint)| {
                let limit = joint.max_velocity.unwrap_or(default.velocity);
                Speed {
                    velocity: default.velocity.min(limit),
                    ..default
                }
            })
            .collect();
        for record in self.all("speed") {
            let node = record.thing("joint")?;
            let joint = self.joint(node)?;
            if self.tree.joint(joint).kind == JointKind::Fixed {
                return Err(node.expected("a joint that moves"));
            }
            if let Some(own) = speeds.get_mut(joint.index()) {
                *own = speed(record, "velocity", "acceleration")?;
            }
        }
        Ok(speeds)
    }
}
