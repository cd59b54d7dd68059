//! `report.html`: tables and pictures in a single file that needs no other.

use super::columns::{self, Shown, Study};
use super::gallery::{Gallery, Version};
use super::pictures::BRIGHTEST;
use super::results::Results;

const STYLE: &str = include_str!("style.css");

/// The whole page.
pub fn page(results: &Results) -> String {
    let [width, height] = results.size;
    let machine = &results.machine;
    let sections = [
        results.summary.iter().map(|study| section(study, "")).collect::<String>(),
        results.scenes.iter().map(|scene| section(scene, &pictures(&scene.gallery))).collect(),
        results.motion.iter().map(|study| section(study, "")).collect(),
        results.motion_summary.iter().map(|study| section(study, "")).collect(),
        results.variants.iter().map(|study| section(study, "")).collect(),
        results.choices.iter().map(|study| section(study, "")).collect(),
        results.growth.iter().map(|study| section(study, "")).collect(),
        results.stress.iter().map(|study| section(study, "")).collect(),
    ]
    .concat();
    let device = escape(&results.device);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>gpc bench, {device}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<h1>Error against time</h1>\n\
         <p>{device}, {driver}; {cpu}, {threads} threads, {os}; {width} x {height} pixels; gpc {version}, {date}; medians \
         of up to {repeat} frames, at most {budget} s a method</p>\n{sections}{NOTES}\
         <p>Error maps run from black (no error) to light yellow (an error of {BRIGHTEST} and above), as the square root \
         of the error.</p>\n</body>\n</html>\n",
        driver = escape(&results.driver),
        cpu = escape(&machine.cpu),
        threads = machine.threads,
        os = escape(&machine.os),
        version = results.version,
        date = results.date,
        repeat = results.repeat,
        budget = results.budget_seconds,
    )
}

/// What the columns mean.
const NOTES: &str = "<h2>How this was measured</h2>\n<ul>\n\
    <li>GPU ms is the device's own time, from timestamps around the passes; wall ms goes from recording to the image in \
    host memory. Each method renders one frame that does not count, and then the methods take turns.</li>\n\
    <li>The reference is supersampling with thousands of samples a pixel, whose grid moves by an Owen-scrambled Sobol set. \
    It reads textures at a 64th of a pixel's side.</li>\n\
    <li>RMSE, PSNR, max and removed are of sRGB-encoded values of 0 to 1. Removed is the share of the squared error of \
    one sample that is gone. Needless is the share of pixels that were right with one sample and are further off now. \
    FLIP is the mean of the error map of Andersson et al. (2020).</li>\n\
    <li>At equal time, the RMSE is divided by that which brute force (one sample, ssaa, accumulate or rotated, whichever is \
    best) reaches in the same time.</li>\n\
    <li>With llvmpipe, msaa is that software driver's multisampling, not a GPU's.</li>\n</ul>\n";

fn section<S: Study>(study: &S, pictures: &str) -> String {
    let notes: String = study.notes().iter().map(|note| format!("<p>{}</p>\n", escape(note))).collect();
    let tables: String = columns::shown(study).iter().map(table).collect();
    format!("<section>\n<h2>{}</h2>\n{notes}{pictures}{tables}</section>\n", escape(&study.title()))
}

fn table(table: &Shown) -> String {
    let row = |tag: &str, cells: &mut dyn Iterator<Item = &str>| {
        let cells: String = cells
            .zip(&table.is_text)
            .map(|(text, is_text)| {
                let class = if *is_text { " class=\"name\"" } else { "" };
                format!("<{tag}{class}>{}</{tag}>", escape(text))
            })
            .collect();
        format!("<tr>{cells}</tr>\n")
    };
    let rows: String = table.rows.iter().map(|cells| row("td", &mut cells.iter().map(String::as_str))).collect();
    format!(
        "<div class=\"wide\"><table><caption>{}</caption><thead>{}</thead>\n<tbody>\n{rows}</tbody></table></div>\n",
        escape(table.caption),
        row("th", &mut table.heads.iter().copied()),
    )
}

fn pictures(gallery: &Gallery) -> String {
    let figures = |versions: &[Version]| {
        let figures: String = versions.iter().map(figure).collect();
        format!("<div class=\"pictures\">{figures}</div>\n")
    };
    let parts: String = gallery
        .parts
        .iter()
        .map(|part| {
            let ([x, y], [width, height]) = (part.window.low, part.window.size);
            let title = escape(&part.title);
            format!("<h3>{title}, {width} x {height} pixels at ({x}, {y})</h3>\n{}", figures(&part.versions))
        })
        .collect();
    figures(&gallery.overview) + &parts
}

fn figure(Version { caption, data }: &Version) -> String {
    format!("<figure><img alt=\"{caption}\" src=\"{data}\"><figcaption>{caption}</figcaption></figure>")
}

/// Text with the special characters of HTML escaped.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_cannot_become_markup() {
        assert_eq!(escape("<a href=\"x\">&"), "&lt;a href=&quot;x&quot;&gt;&amp;");
    }
}
