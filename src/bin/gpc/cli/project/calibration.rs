//! Projectors from files.

use super::ProjectArgs;
use crate::cli::{csv, values};
use anyhow::Context;
use gpc::camera::projector::{Correspondence, Homography, Projector};
use gpc::output::{self, OutputError};
use serde::Serialize;
use std::path::Path;

/// A projector, and how well its correspondences fit.
pub struct Calibrated {
    pub projector: Projector,
    pub fit: Option<HomographyFit>,
}

/// Figures of the homography that was fitted to a projector's correspondences.
#[derive(Clone, Copy, Serialize)]
pub struct HomographyFit {
    correspondences: usize,
    agreeing: usize,
}

/// The projectors that the options name.
pub fn read(args: &ProjectArgs) -> anyhow::Result<Vec<Calibrated>> {
    let sizes = values::each("--projector", args.projector.len(), "--projector-size", &args.projector_size)?;
    let projectors = args.projector.iter().zip(sizes);
    projectors
        .map(|(path, size)| {
            let name = path.display().to_string();
            let bytes = std::fs::read(path).map_err(|source| OutputError::Read { path: path.clone(), source })?;
            match path.extension() {
                Some(ending) if ending.eq_ignore_ascii_case("exr") => dense(&bytes, &name),
                _ => planar(args, &bytes, size, path).with_context(|| name),
            }
        })
        .collect()
}

/// Calibration from an image that holds a location for each of the projector's pixels.
fn dense(bytes: &[u8], name: &str) -> anyhow::Result<Calibrated> {
    let (size, pixels) = output::decode_linear(bytes, name)?;
    let location = |[u, v, _, alpha]: [f32; 4]| match alpha {
        0.0 => [f64::NAN; 2],
        _ => [f64::from(u), f64::from(v)],
    };
    let locations = pixels.into_iter().map(location).collect();
    Ok(Calibrated { projector: Projector::dense(size, locations).with_context(|| name.to_owned())?, fit: None })
}

/// Calibration from correspondences, for a plane wall.
fn planar(args: &ProjectArgs, bytes: &[u8], size: [u32; 2], path: &Path) -> anyhow::Result<Calibrated> {
    let (_, numbers) = csv::numbers(bytes, &[&["x", "y", "u", "v"]]).map_err(|reason| anyhow::anyhow!(reason))?;
    let (rows, _) = numbers.as_chunks::<4>();
    let pair = |[x, y, u, v]: &[f64; 4]| Correspondence { place: [*x, *y], location: [*u, *v] };
    let pairs: Vec<_> = rows.iter().map(pair).collect();
    let (homography, agree) = Homography::fit_robust(&pairs, args.tolerance, args.seed)?;
    let agreeing = agree.iter().filter(|agrees| **agrees).count();
    log::info!("{}: {agreeing} of {} correspondences agree", path.display(), pairs.len());
    Ok(Calibrated {
        projector: Projector::planar(size, homography)?,
        fit: Some(HomographyFit { correspondences: pairs.len(), agreeing }),
    })
}
