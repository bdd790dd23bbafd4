//! The built command line against a real server: files to a scene to volumes to verified answers,
//! hostile input, planted faults and Ctrl-C.

mod bench;
mod formats;
mod generate;
mod import;
mod render;
mod usage;
mod verify;
