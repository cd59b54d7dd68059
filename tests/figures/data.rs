//! Measurements in `docs/bench`.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// A file of measurements: a head of lines `# key: value`, then comma-separated values with a header.
pub struct Measurement {
    head: HashMap<String, String>,
    pub rows: Vec<Row>,
}

/// A row of a file, by the names of its columns.
pub struct Row(HashMap<String, String>);

/// Keys that the head of every file must have.
const HEAD: [&str; 5] = ["driver", "machine", "date", "commit", "size"];

pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All files `KIND-*.csv`, sorted by name.
pub fn load(kind: &str) -> Vec<Measurement> {
    let paths = paths(kind);
    assert!(!paths.is_empty(), "no docs/bench/{kind}-*.csv");
    paths.iter().map(|path| Measurement::read(path)).collect()
}

fn paths(kind: &str) -> Vec<PathBuf> {
    let mut paths: Vec<PathBuf> = std::fs::read_dir(root().join("docs/bench"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| {
            let name = path.file_name().unwrap().to_string_lossy();
            name.starts_with(&format!("{kind}-")) && name.ends_with(".csv")
        })
        .collect();
    paths.sort();
    paths
}

/// What the first page shows: views that fill a frame where these were measured, otherwise the textured objects in small images.
pub struct Front {
    pub of: Measurement,
    has_views: bool,
}

pub fn front() -> Front {
    Front::new(true)
}

/// The textured objects in small images, which were measured at every number of samples.
pub fn thumbnails() -> Front {
    Front::new(false)
}

impl Front {
    fn new(has_views: bool) -> Self {
        let all = load(if has_views { "views" } else { "quality" });
        let of = all.into_iter().find(|of| !of.samples("superpixel").is_empty());
        Self { of: of.expect("no measurement has superpixels"), has_views }
    }

    pub fn scenes(&self) -> Vec<&str> {
        let mut scenes = self.of.scenes();
        scenes.retain(|scene| self.has_views || self.of.textured(scene));
        scenes
    }

    /// What the scenes are and the size of their images.
    pub fn title(&self) -> String {
        let kind = if self.has_views { "views that fill the frame" } else { "textured objects in small images" };
        format!("{} {kind}, {} pixels", self.scenes().len(), self.of.size())
    }
}

impl Measurement {
    fn read(path: &Path) -> Self {
        let text = std::fs::read_to_string(path).unwrap();
        let head: HashMap<_, _> = text
            .lines()
            .filter_map(|line| line.strip_prefix("# ")?.split_once(": "))
            .map(|(key, value)| (key.to_owned(), value.to_owned()))
            .collect();
        for key in HEAD {
            assert!(head.contains_key(key), "{}: no line \"# {key}: ...\"", path.display());
        }
        let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
        let rows = reader.deserialize().map(|row| Row(row.unwrap())).collect();
        Self { head, rows }
    }

    /// Value of a key in the head.
    pub fn head(&self, key: &str) -> &str {
        &self.head[key]
    }

    /// Size of the images as text, width x height.
    pub fn size(&self) -> String {
        self.head("size").replace('x', " x ")
    }

    /// One line that says where the figures come from.
    pub fn source(&self) -> String {
        format!(
            "{}; {}; {}, commit `{}`{}",
            self.head("driver"),
            self.head("machine"),
            self.head("date"),
            self.head("commit"),
            self.note(),
        )
    }

    /// What the reader of the figures has to know besides, after a semicolon; empty if nothing.
    pub fn note(&self) -> String {
        self.head.get("note").map_or_else(String::new, |note| format!("; {note}"))
    }

    /// Names of the scenes, in the order of the file.
    pub fn scenes(&self) -> Vec<&str> {
        let mut scenes: Vec<&str> = Vec::new();
        for row in &self.rows {
            if !scenes.contains(&row.scene()) {
                scenes.push(row.scene());
            }
        }
        scenes
    }

    /// Numbers of samples at which a method was measured, in ascending order.
    pub fn samples(&self, method: &str) -> Vec<u32> {
        let of = self.rows.iter().filter(|row| row.text("method") == method);
        let mut samples: Vec<u32> = of.map(Row::samples).collect();
        samples.sort_unstable();
        samples.dedup();
        samples
    }

    /// Methods, in the order of the file.
    pub fn methods(&self) -> Vec<&str> {
        let mut methods: Vec<&str> = Vec::new();
        for row in &self.rows {
            if !methods.contains(&row.text("method")) {
                methods.push(row.text("method"));
            }
        }
        methods
    }

    /// Numbers of samples at which both superpixels and supersampling were measured, in ascending order.
    pub fn compared_samples(&self) -> Vec<u32> {
        let supersampling = self.samples("ssaa");
        let mut samples = self.samples("superpixel");
        samples.retain(|n| supersampling.contains(n));
        samples
    }

    /// Row of a scene, a method and a number of samples.
    pub fn find(&self, scene: &str, method: &str, samples: u32) -> Option<&Row> {
        self.rows.iter().find(|row| row.scene() == scene && row.text("method") == method && row.samples() == samples)
    }

    /// Whether a scene has textures.
    pub fn textured(&self, scene: &str) -> bool {
        let row = self.rows.iter().find(|row| row.scene() == scene);
        row.is_some_and(|row| row.text("textured") == "true")
    }
}

impl Row {
    pub fn text(&self, column: &str) -> &str {
        let value = self.0.get(column);
        value.unwrap_or_else(|| panic!("no column {column}"))
    }

    pub fn number(&self, column: &str) -> f64 {
        let text = self.text(column);
        text.parse().unwrap_or_else(|_| panic!("{column}: \"{text}\" is not a number"))
    }

    pub fn samples(&self) -> u32 {
        self.text("samples").parse().unwrap()
    }

    /// Name of the scene in the documents, which differs from that of its file.
    pub fn scene(&self) -> &str {
        match self.text("scene") {
            "dutch_ship_medium_1k" => "DutchShip",
            "garage" => "WebXRGarage",
            "room" => "GodotRoom",
            "MetalRoughSpheresNoTextures" => "MetalRoughSpheres",
            "vintageFan_animated" => "DeskFanAnimated",
            "zdm2" => "SauerbratenZdm2",
            name => name,
        }
    }

    /// Median milliseconds on the device.
    pub fn ms(&self) -> f64 {
        self.number("gpu_ms_median")
    }
}

/// A median, and the largest value with its name.
pub struct Spread<'a> {
    pub median: f64,
    pub worst: (f64, &'a str),
}

/// Spread of named values; `None` without values.
pub fn spread<'a>(mut values: Vec<(f64, &'a str)>) -> Option<Spread<'a>> {
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let middle = values.len() / 2;
    let median = match values.len() {
        0 => return None,
        odd if odd % 2 == 1 => values[middle].0,
        _ => 0.5 * (values[middle - 1].0 + values[middle].0),
    };
    Some(Spread { median, worst: *values.last()? })
}
