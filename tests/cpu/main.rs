//! Cameras, sample patterns and CPU twins. No test here needs a device.

mod camera;
mod coverage_chart;
mod reference;
mod sampling;
