//! Recordings of sessions as MCAP files.
