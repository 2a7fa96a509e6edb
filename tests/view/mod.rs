//! What can be seen: pictures, live view, recordings.

mod halts;
mod hostile_clients;
mod live_view;
mod pictures;
mod pictures_at_the_prompt;
mod recording;
mod recording_attachment;
mod run_file;
mod viewed;
