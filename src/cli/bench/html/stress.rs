//! The section on the stress suite.

use super::escape;
use crate::cli::bench::results::Stress;
use crate::cli::bench::stress::{figure, verdict};
use gpc::bench::stress::Finding;

/// The section; empty where the suite was not run.
pub fn section(suite: &[Stress]) -> String {
    if suite.is_empty() {
        return String::new();
    }
    let findings = || suite.iter().flat_map(|stress| &stress.findings);
    let bounded = findings().filter(|finding| finding.allowed.is_some());
    let failed = findings().filter(|finding| !finding.holds()).count();
    let parts: String = suite.iter().map(part).collect();
    format!(
        "<section>\n<h2>Numerical stress</h2>\n<p class=\"note\">{} bounds on {} findings, {failed} exceeded.</p>\n\
         {parts}</section>\n",
        bounded.count(),
        findings().count(),
    )
}

fn part(stress: &Stress) -> String {
    let row = |finding: &Finding| {
        format!(
            "<tr><th class=\"name\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td class=\"name\">{}</td></tr>",
            escape(&finding.case),
            finding.checked,
            figure(finding.measured),
            finding.allowed.map_or_else(|| "–".to_owned(), figure),
            verdict(finding),
            escape(finding.unit),
        )
    };
    // What failed must not be hidden.
    let open = if stress.findings.iter().all(Finding::holds) {
        ""
    } else {
        " open"
    };
    let checked: u64 = stress.findings.iter().map(|finding| finding.checked).sum();
    let table = super::tables::table(
        "<th class=\"name\">case</th><th>checked</th><th>found</th><th>allowed</th><th></th><th class=\"name\">what</th>",
        stress.findings.iter().map(row),
        "",
    );
    format!(
        "<details{open}><summary>{}: {} findings, {checked} checked in {:.0} s</summary>{table}</details>\n",
        escape(stress.about),
        stress.findings.len(),
        stress.seconds
    )
}
