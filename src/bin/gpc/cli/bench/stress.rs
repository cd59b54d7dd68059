//! The stress suite at its full length.

use super::results::Stress;
use super::subject::Bench;
use crate::cli::print;
use gpc::bench::stress::{Check, Finding, Length};
use std::time::Instant;

impl Bench<'_> {
    /// Runs one check of the suite.
    pub fn stress(&mut self, check: Check) -> anyhow::Result<Stress> {
        self.progress.begin(check.name);
        let start = Instant::now();
        let findings = check.run(&mut self.headless, Length::Long)?;
        Ok(Stress { about: check.name, seconds: start.elapsed().as_secs_f64(), findings })
    }
}

/// Prints the findings of a check.
pub fn print(stress: &Stress) -> anyhow::Result<()> {
    print::line(&format!("\n{}, {:.0} s:", stress.about, stress.seconds))?;
    for finding in &stress.findings {
        print::line(&format!(
            "  {} {}: {} {} of {}",
            verdict(finding),
            finding.case,
            figure(finding.measured),
            finding.unit,
            finding.checked
        ))?;
    }
    Ok(())
}

/// Verdict on a finding: `-` if it is only measured for comparison, otherwise whether it holds.
pub fn verdict(finding: &Finding) -> &'static str {
    match finding.allowed {
        None => "-",
        Some(_) if finding.holds() => "holds",
        Some(_) => "FAILS",
    }
}

/// A whole number as it is, other numbers with three digits.
pub fn figure(value: f64) -> String {
    if value.fract() == 0.0 {
        format!("{value:.0}")
    } else if value.abs() < 1e-3 {
        format!("{value:.2e}")
    } else {
        format!("{value:.4}")
    }
}
