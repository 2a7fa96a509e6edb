//! A run as one HTML file: the page, with everything for which it would otherwise ask the server.
//!
//! The file needs no other file and no network, and its page may not reach for any. What it
//! contains is compressed (zlib) and written as base64 in a JSON object: `head` is a JSON object
//! with views, nodes, news, the span of time and how the run has ended, `meshes` are those that the server sends, and
//! `pieces` are stretches of the past, each with the time at which it begins.

use std::sync::Arc;

use serde_json::{Value, json};

use super::event_json;
use super::frame_json::frames_json;
use super::history::History;
use super::mesh_bytes::mesh_bytes;
use super::page::page_of_run;
use super::views::Views;
use crate::watch::Frame;
use crate::watch::base64::base64;

/// Number of frames in a piece, which the page unpacks at once.
const PIECE: usize = 64;

/// How hard to compress: harder takes much longer, and gains a hundredth.
const LEVEL: u8 = 7;

/// The text of the file that shows a history.
pub fn run_file(history: &History, views: &Views) -> String {
    let nodes = history.nodes_from(0);
    let frames = history.past(f64::NEG_INFINITY, f64::INFINITY, usize::MAX);
    let span = match (frames.first(), frames.last()) {
        (Some(first), Some(last)) => [first.time, last.time],
        _ => [0.0; 2],
    };
    let news = history.news();
    let told: Vec<Value> = news.iter().map(|news| event_json::news(news)).collect();
    let listed: Vec<Value> = nodes.iter().map(|n| event_json::node(n)).collect();
    let halt = history.halt();
    let head = json!({
        "views": views.0,
        "span": span,
        "nodes": listed,
        "news": told,
        "halt": halt.as_deref().map(event_json::halt),
    });
    let pieces: Vec<Value> = frames.chunks(PIECE).map(piece).collect();
    let run = json!({
        "head": packed(head.to_string().as_bytes()),
        "meshes": packed(&mesh_bytes(&nodes)),
        "pieces": pieces,
    });
    page_of_run(&run.to_string())
}

fn piece(frames: &[Arc<Frame>]) -> Value {
    let begin = frames.first().map_or(0.0, |frame| frame.time);
    json!([begin, packed(frames_json(frames).as_bytes())])
}

fn packed(bytes: &[u8]) -> String {
    base64(&miniz_oxide::deflate::compress_to_vec_zlib(bytes, LEVEL))
}
