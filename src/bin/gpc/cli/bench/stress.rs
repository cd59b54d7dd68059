//! The stress suite at its full length.

use super::columns::{Cell, Column, Study, column};
use super::measurement::stress::{Check, Finding, Length};
use super::results::Stress;
use super::subject::Bench;
use std::time::Instant;

impl Bench<'_> {
    /// Runs one check of the suite.
    pub fn stress(&mut self, check: Check) -> anyhow::Result<Stress> {
        self.progress.begin(check.name);
        let start = Instant::now();
        let findings = check.run(&mut self.headless, Length { is_long: true })?;
        Ok(Stress { about: check.name, seconds: start.elapsed().as_secs_f64(), findings })
    }
}

impl Study for Stress {
    type Row = Finding;
    const FILE: &'static str = "stress.csv";

    fn title(&self) -> String {
        let failed = self.findings.iter().filter(|finding| !finding.holds()).count();
        format!(
            "{}: {} findings in {:.0} s, {failed} beyond their bound",
            self.about,
            self.findings.len(),
            self.seconds
        )
    }

    fn rows(&self) -> &[Finding] {
        &self.findings
    }

    fn columns() -> Vec<Column<Self, Finding>> {
        vec![
            column("check", "", |check: &Self, _| Cell::text(check.about)),
            column("case", "case", |_, finding: &Finding| Cell::text(&finding.case)),
            column("checked", "checked", |_, finding: &Finding| Cell::Count(finding.checked)),
            column("found", "found", |_, finding: &Finding| figure(finding.measured)),
            column("allowed", "allowed", |_, finding: &Finding| Cell::optional(finding.allowed, figure)),
            column("verdict", "verdict", |_, finding: &Finding| Cell::text(verdict(finding))),
            column("unit", "what", |_, finding: &Finding| Cell::text(finding.unit)),
        ]
    }
}

/// Verdict on a finding: empty if it is only measured for comparison, otherwise whether it holds.
fn verdict(finding: &Finding) -> &'static str {
    match finding.allowed {
        None => "",
        Some(_) if finding.holds() => "holds",
        Some(_) => "FAILS",
    }
}

/// A whole number without a point, other numbers with digits that show them.
fn figure(value: f64) -> Cell {
    Cell::Number(
        value,
        if value.fract() == 0.0 {
            0
        } else if value.abs() < 1e-3 {
            8
        } else {
            4
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_fails_is_counted_and_named() {
        let finding =
            |measured| Finding { case: "order".to_owned(), checked: 1, unit: "pixels", measured, allowed: Some(1.0) };
        let stress = Stress { about: "order", seconds: 1.0, findings: vec![finding(0.5), finding(2.0)] };
        assert!(stress.title().contains("1 beyond"));
        assert_eq!(stress.findings.iter().map(verdict).collect::<Vec<_>>(), ["holds", "FAILS"]);
    }
}
