//! What presses on objects, as arrows with their forces, for viewers that do not know our messages.

use nalgebra::{UnitQuaternion, Vector3};

use super::message::{
    ArrowPrimitive, Color, PoseMessage, Quaternion, SceneEntity, TextPrimitive, Time,
};
use super::shapes::{MAP, tidy};
use crate::watch::{FORCE_SCALE, Frame, Press};

/// The greatest length (m) of an arrow, and its thickness (m).
const LONGEST: f32 = 0.4;
const THICKNESS: f32 = 0.006;

/// Height (m) of the letters.
const LETTERS: f32 = 0.025;

const COLOR: Color = Color {
    r: 0.85,
    g: 0.2,
    b: 0.55,
    a: 1.0,
};

/// All contacts of a frame as an entity: arrows that end where they press, as long as the force
/// is great ([`FORCE_SCALE`]), each with its force.
pub(super) fn contacts(frame: &Frame) -> SceneEntity {
    SceneEntity {
        timestamp: Time::new(frame.time),
        frame_id: MAP.to_owned(),
        id: "contacts".to_owned(),
        arrows: frame.presses.iter().filter_map(arrow).collect(),
        texts: frame.presses.iter().filter_map(text).collect(),
        ..SceneEntity::default()
    }
}

/// The direction of a force and the length (m) of its arrow; none for no force, as in recordings
/// of earlier versions.
fn direction(press: &Press) -> Option<(Vector3<f32>, f32)> {
    let force = Vector3::from(press.force);
    let direction = force.try_normalize(1e-3)?;
    Some((direction, (force.norm() * FORCE_SCALE).min(LONGEST)))
}

fn arrow(press: &Press) -> Option<ArrowPrimitive> {
    let (direction, length) = direction(press)?;
    let turn = UnitQuaternion::rotation_between(&Vector3::x(), &direction);
    let turn = turn.unwrap_or_else(|| {
        UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f32::consts::PI)
    });
    let head = (3.0 * THICKNESS).min(0.5 * length);
    Some(ArrowPrimitive {
        pose: PoseMessage {
            position: start(press)?.into(),
            orientation: Quaternion::from(<[f32; 4]>::from(turn.coords).map(tidy)),
        },
        shaft_length: tidy(length - head),
        shaft_diameter: THICKNESS,
        head_length: tidy(head),
        head_diameter: 2.5 * THICKNESS,
        color: COLOR,
    })
}

/// Where the arrow begins (m).
fn start(press: &Press) -> Option<[f32; 3]> {
    let (direction, length) = direction(press)?;
    Some(<[f32; 3]>::from(Vector3::from(press.at) - direction * length).map(tidy))
}

fn text(press: &Press) -> Option<TextPrimitive> {
    let force = Vector3::from(press.force).norm();
    Some(TextPrimitive {
        pose: PoseMessage {
            position: start(press)?.into(),
            ..PoseMessage::default()
        },
        billboard: true,
        font_size: LETTERS,
        color: COLOR,
        text: format!("{force:.1} N"),
        ..TextPrimitive::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arrow_ends_where_the_body_presses() {
        let press = Press {
            body: None,
            object: 1,
            at: [1.0, 2.0, 0.8],
            force: [0.0, 0.0, 2.0],
        };
        let frame = Frame {
            presses: vec![press],
            ..Frame::default()
        };
        let entity = contacts(&frame);
        let [arrow] = entity.arrows.as_slice() else {
            panic!("{:?}", entity.arrows);
        };
        let length = arrow.shaft_length + arrow.head_length;
        assert!((length - 2.0 * FORCE_SCALE).abs() < 1e-4);
        assert!((arrow.pose.position.z - (0.8 - length)).abs() < 1e-4);
        assert_eq!(entity.texts[0].text, "2.0 N");
    }
}
