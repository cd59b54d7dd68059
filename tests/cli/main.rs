//! The built command: its output, its files and its errors.

mod camera;
mod ci;
#[path = "../common/command.rs"]
mod command;
mod compare;
mod environment;
mod info;
mod locations;
mod malformed;
mod parts;
mod render;
#[path = "../common/scene_builder.rs"]
mod scene_builder;
#[path = "../common/shadowed_floor.rs"]
mod shadowed_floor;
mod shadows;
#[path = "../common/shared.rs"]
mod shared;
mod usage;
mod video;
mod zoom;
