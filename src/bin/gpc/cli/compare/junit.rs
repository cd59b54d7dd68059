//! JUnit reports, which the forges of continuous integration show among the results of tests.

use super::folders::{ComparedImage, Status};
use gpc::names::name;
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

/// A report of a test suite with one test case for each image.
pub fn report(suite: &str, images: &[ComparedImage]) -> anyhow::Result<String> {
    let mut cases = TestSuite::new(suite);
    for image in images {
        let status = if image.status == Status::Equal {
            TestCaseStatus::success()
        } else {
            let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
            status.set_type(name(&image.status));
            if let Some(reason) = &image.reason {
                status.set_message(reason.as_str());
            }
            status
        };
        cases.add_test_case(TestCase::new(image.name.as_str(), status));
    }
    let mut report = Report::new("gpc compare");
    report.add_test_suite(cases);
    Ok(report.to_string()?)
}
