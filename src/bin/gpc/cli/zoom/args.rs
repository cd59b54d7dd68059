//! The options of `gpc zoom`.

use crate::cli::exit::Usage;
use crate::cli::render::args::FilterArgs;
use crate::cli::render::image::ImageArgs;
use crate::cli::report::ReportArgs;
use crate::cli::values;
use clap::Args;
use gpc::camera::zoom::{Shape, Transition, ZoomMap, ZoomRegion};
use std::path::PathBuf;

/// Options of `gpc zoom`.
#[derive(Args)]
pub struct ZoomArgs {
    /// A glTF, OBJ, STL or PLY file, - for one on standard input, or a PNG or JPEG
    #[arg(id = "file", value_name = "SCENE|IMAGE")]
    pub input: PathBuf,
    /// Image to write: .png, .16.png, .jpg or .exr, or - for a PNG on standard output
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// Also write the steps of the zoom, as PNG files named like OUT
    ///
    /// original is the image without a zoom, locations shows some of the sampling locations as dots, resampled has the regions without
    /// transitions, and transition the transitions alone. For scenes, direct is an ordinary image of each region.
    #[arg(long)]
    pub steps: bool,

    #[command(flatten)]
    pub regions: RegionArgs,
    #[command(flatten)]
    pub image: ImageArgs,
    #[command(flatten)]
    pub filter: FilterArgs,
    #[command(flatten)]
    pub report: ReportArgs,
}

/// The regions to enlarge.
#[derive(Args)]
#[command(next_help_heading = "Regions")]
pub struct RegionArgs {
    /// Centre of a region
    #[arg(long, value_name = "X,Y", required = true, allow_hyphen_values = true, value_parser = values::place)]
    center: Vec<[f64; 2]>,
    /// Radius of a region in pixels, or its radii along x and y; of a rectangle, half of its sides
    #[arg(long, value_name = "R|RX,RY", required = true, allow_hyphen_values = true, value_parser = values::radii)]
    radius: Vec<[f64; 2]>,
    /// Multiplicity of a region, above 0 and at most 1: the region is enlarged by 1 / multiplicity
    #[arg(long, value_name = "M", required = true, allow_negative_numbers = true, value_parser = values::finite)]
    multiplicity: Vec<f64>,
    /// Outline of a region; once for all regions, or once for each
    #[arg(long, default_value = "circle")]
    shape: Vec<Shape>,
    /// Transition between a region and the rest; once for all regions, or once for each
    #[arg(long, default_value = "linear")]
    transition: Vec<Transition>,
}

impl RegionArgs {
    /// The map that the options describe.
    pub fn map(&self) -> Result<ZoomMap, Usage> {
        let count = self.center.len();
        let counts = [("radius", self.radius.len()), ("multiplicity", self.multiplicity.len())];
        for (option, found) in counts {
            if found != count {
                return Err(Usage(format!("{count} --center and {found} --{option}; give one for each region")));
            }
        }
        let shapes = values::each("--center", count, "--shape", &self.shape)?;
        let transitions = values::each("--center", count, "--transition", &self.transition)?;
        let places = self.center.iter().zip(&self.radius).zip(&self.multiplicity);
        let regions = places.zip(shapes.into_iter().zip(transitions)).map(
            |(((center, radius), multiplicity), (shape, transition))| ZoomRegion {
                center: *center,
                radius: *radius,
                multiplicity: *multiplicity,
                shape,
                transition,
            },
        );
        ZoomMap::new(regions.collect()).map_err(|error| Usage(error.to_string()))
    }
}
