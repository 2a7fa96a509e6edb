//! What a camera sees.

use std::time::Duration;

use super::header;
use crate::value::Value;
use robotics::perception::Camera;
use spatial::trig;
use view::picture::Image;

/// A picture in the optical frame of a camera.
pub fn image(stamp: Duration, frame: &str, image: &Image) -> Value {
    let number = |size: usize| Value::Integer(i64::try_from(size).unwrap_or(i64::MAX));
    Value::record([
        ("header", header(stamp, frame)),
        ("height", number(image.height())),
        ("width", number(image.width())),
        ("encoding", "rgb8".into()),
        ("is_bigendian", Value::Integer(0)),
        ("step", number(3 * image.width())),
        ("data", Value::Bytes(image.bytes().to_vec())),
    ])
}

/// How a camera sees: without distortion.
pub fn camera_info(stamp: Duration, frame: &str, camera: &Camera) -> Value {
    let number = |size: usize| Value::Integer(i64::try_from(size).unwrap_or(i64::MAX));
    let [width, height] = [camera.width as f64, camera.height as f64];
    let (sine, cosine) = trig::sin_cos(camera.vertical_fov / 2.0);
    let focus = height / 2.0 * cosine / sine;
    let (x, y) = (width / 2.0, height / 2.0);
    let matrix = [focus, 0.0, x, 0.0, focus, y, 0.0, 0.0, 1.0];
    let straight = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let projection = [focus, 0.0, x, 0.0, 0.0, focus, y, 0.0, 0.0, 0.0, 1.0, 0.0];
    Value::record([
        ("header", header(stamp, frame)),
        ("height", number(camera.height)),
        ("width", number(camera.width)),
        ("distortion_model", "plumb_bob".into()),
        ("d", Value::floats([0.0; 5])),
        ("k", Value::floats(matrix)),
        ("r", Value::floats(straight)),
        ("p", Value::floats(projection)),
    ])
}
