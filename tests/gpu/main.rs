//! The renderer on a device under the validation layer, compared with the exact twins in `twins/`.

mod bare;
mod blend;
mod coverage;
mod dense;
mod detect;
mod devices;
#[path = "../common/difference.rs"]
mod difference;
mod distribute;
mod edges;
mod encode;
mod environment;
mod extremes;
mod files;
mod filter;
mod golden;
#[path = "../common/golden.rs"]
mod goldens;
mod grow;
mod host;
mod instances;
mod invariance;
mod lines;
mod lobes;
mod locations;
mod mask;
mod memory;
mod merge;
#[path = "../common/meshes.rs"]
mod meshes;
mod methods;
mod normals;
mod partition;
mod pixel_filter;
mod pose;
mod prefilter;
mod region;
mod rounds;
#[path = "../common/scene_builder.rs"]
mod scene_builder;
mod scenes;
mod schedule;
mod shade;
#[path = "../common/shared.rs"]
mod shared;
mod shared_queue;
mod soundness;
#[path = "../../src/bin/gpc/cli/bench/measurement/stress/soup.rs"]
mod soup;
mod stage;
mod stop;
mod stroke;
mod submit;
mod teams;
mod texture;
mod ties;
mod timers;
mod twin;
mod variation;
mod visibility;
