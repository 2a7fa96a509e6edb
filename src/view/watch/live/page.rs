//! The page, assembled from its parts.

use serde_json::json;

use super::token::word_of;
use crate::picture::floor;
use crate::picture::shade::LAMP;
use crate::watch::FORCE_SCALE;

/// Parts of the page's script, in the order of definition.
const SCRIPTS: [&str; 27] = [
    include_str!("page/algebra.js"),
    include_str!("page/program.js"),
    include_str!("page/floor.js"),
    include_str!("page/orbit.js"),
    include_str!("page/scene.js"),
    include_str!("page/forces.js"),
    include_str!("page/stage.js"),
    include_str!("page/tasks.js"),
    include_str!("page/log.js"),
    include_str!("page/past.js"),
    include_str!("page/run.js"),
    include_str!("page/state.js"),
    include_str!("page/halt.js"),
    include_str!("page/session.js"),
    include_str!("page/card.js"),
    include_str!("page/forms.js"),
    include_str!("page/views.js"),
    include_str!("page/tabs.js"),
    include_str!("page/pointer.js"),
    include_str!("page/time.js"),
    include_str!("page/lanes.js"),
    include_str!("page/address.js"),
    include_str!("page/scene_tree.js"),
    include_str!("page/joints.js"),
    include_str!("page/capture.js"),
    include_str!("page/inset.js"),
    include_str!("page/draw.js"),
];

const STYLE: &str = include_str!("page/style.css");
const FRAME: &str = include_str!("page/page.html");

/// The page; `word` is the nonce that tells the browser that style and script are the page's
/// own.
pub(super) fn page(word: &str) -> String {
    filled(word, "", "")
}

/// The page as a part of another one, which provides, by a script, what it otherwise asks its server
/// for.
pub fn embedded_page(script: &str) -> String {
    filled("", "", &format!("<script>{script}</script>"))
}

/// The page of a saved run, which is a JSON text without `<`. It is in a file, so the policy that
/// the server would send is in its head: nothing from elsewhere, and no way to anywhere.
pub(crate) fn page_of_run(run: &str) -> String {
    let word = word_of(run);
    let policy = format!(
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
         script-src 'nonce-{word}'; style-src 'nonce-{word}'; img-src data: blob:; \
         base-uri 'none'; form-action 'none'\">"
    );
    let run = format!("<script type=\"application/json\" id=\"run\">{run}</script>");
    filled(&word, &policy, &run)
}

/// What the page has in common with pictures and recordings.
fn constants() -> String {
    let floor = json!({
        "board": floor::BOARD,
        "width": floor::BOARD_WIDTH,
        "length": floor::BOARD_LENGTH,
        "gap": floor::BOARD_GAP,
        "variety": floor::VARIETY,
        "shade": floor::GAP_SHADE,
        "fade": floor::FADE,
    });
    let lamp = json!(LAMP);
    format!("const FLOOR = {floor}, LAMP = {lamp}, FORCE_SCALE = {FORCE_SCALE};\n")
}

fn filled(word: &str, policy: &str, run: &str) -> String {
    // What comes last is longest; nothing in it is mistaken for a placeholder.
    FRAME
        .replace("{word}", word)
        .replace("<!--policy-->", policy)
        .replace("{style}", STYLE)
        .replace("{script}", &(constants() + &SCRIPTS.concat()))
        .replace("<!--run-->", run)
}
