//! The section on the stress suite.

use super::{escape, thousands};
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
            thousands(finding.checked),
            figure(finding.measured),
            finding.allowed.map_or_else(|| "–".to_owned(), figure),
            verdict(finding),
            escape(finding.unit),
        )
    };
    // A part with a failure is unfolded, so that nobody misses it.
    let open = if stress.findings.iter().all(Finding::holds) { "" } else { " open" };
    let checked: u64 = stress.findings.iter().map(|finding| finding.checked).sum();
    let table = super::tables::table(
        "<th class=\"name\">case</th><th>checked</th><th>found</th><th>allowed</th><th></th><th class=\"name\">what</th>",
        stress.findings.iter().map(row),
        "",
    );
    format!(
        "<details{open}><summary>{}: {} findings, {} checked in {:.0} s</summary>{table}</details>\n",
        escape(stress.about),
        stress.findings.len(),
        thousands(checked),
        stress.seconds
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_fails_is_shown_open() {
        let finding = |measured| Finding {
            case: "a < b".to_owned(),
            checked: 12_345,
            unit: "pixels",
            measured,
            allowed: Some(1.0),
        };
        let stress =
            |measured| Stress { about: "order", seconds: 1.0, findings: vec![finding(0.5), finding(measured)] };
        let [good, bad] = [0.0, 2.0].map(|measured| section(&[stress(measured)]));
        assert!(good.contains("0 exceeded") && !good.contains("FAILS"), "{good}");
        assert!(bad.contains("1 exceeded") && bad.contains("<details open>"), "{bad}");
        assert!(bad.contains("a &lt; b") && bad.contains("12,345"), "{bad}");
        assert_eq!(section(&[]), "");
    }
}
