//! `report.html`: a single file that embeds its pictures and styles.

mod axis;
mod bars;
mod curves;
mod growth;
mod motion;
mod scene;
mod stress;
mod tables;
mod variants;

use super::gallery::Gallery;
use super::pictures::BRIGHTEST;
use super::results::Results;

const STYLE: &str = include_str!("style.css");

/// The whole page; `galleries` are in the order of the scenes.
pub fn page(results: &Results, galleries: &[Gallery]) -> String {
    let [width, height] = results.size;
    let machine = &results.machine;
    let sections: String =
        results.scenes.iter().zip(galleries).map(|(scene, gallery)| scene::section(scene, gallery)).collect();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>gpc bench, {device}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<header>\n\
         <h1>Error against time</h1>\n\
         <p class=\"lead\">What antialiasing costs and what it removes: superpixels beside one sample a pixel, the \
         device's own multisampling and full supersampling, measured in one run of <code>gpc bench</code>.</p>\n\
         <dl class=\"facts\"><div><dt>Device</dt><dd>{device}<br><small>{driver}</small></dd></div>\
         <div><dt>Machine</dt><dd>{cpu}<br><small>{threads} threads, {os}</small></dd></div>\
         <div><dt>Image</dt><dd>{width} × {height}<br><small>truth: {reference} samples a pixel</small></dd></div>\
         <div><dt>Run</dt><dd>{date}<br><small>gpc {version}, medians of up to {repeat} frames</small></dd></div></dl>\n\
         </header>\n<main>\n{summary}{sections}{motion}{variants}{growth}{stress}{method}</main>\n\
         </body>\n</html>\n",
        device = escape(&results.device),
        driver = escape(&results.driver),
        cpu = escape(&machine.cpu),
        threads = machine.threads,
        os = escape(&machine.os),
        reference = results.reference_samples,
        date = results.date,
        version = results.version,
        repeat = results.repeat,
        summary = summary(results),
        motion = motion::section(&results.motion, &results.motion_summary),
        variants = variants::section(&results.variants),
        growth = growth::section(&results.growth),
        stress = stress::section(&results.stress),
        method = method(results),
    )
}

/// The section that sums up all scenes; empty without scenes.
fn summary(results: &Results) -> String {
    if results.scenes.is_empty() {
        return String::new();
    }
    let tables: String = results
        .summary
        .iter()
        .map(|of| {
            let scenes: Vec<_> = results.scenes.iter().filter(|scene| scene.textured == of.textured).collect();
            format!(
                "<h3>{}</h3>\n{}{}{}",
                of.about(),
                tables::summary(of),
                tables::reach(of),
                tables::by_scene(&scenes)
            )
        })
        .collect();
    format!("<section>\n<h2>All scenes</h2>\n{tables}</section>\n")
}

/// The section that says how the figures were measured.
fn method(results: &Results) -> String {
    format!(
        "<section class=\"method\">\n<h2>How this was measured</h2>\n<ul>\n\
         <li><b>Time</b> is the device's own, from timestamps around the passes; <i>wall</i> is by the clock, from \
         recording to the image in host memory. Every method renders one frame that does not count, since drivers \
         compile shaders during it; then the methods take turns, a frame each, so that a machine that slows down slows \
         all of them down. A method stops when its frames have taken {budget} s, but not before one was timed: the \
         column <i>frames</i> has their number, <i>±</i> the distance from the fastest to the slowest.</li>\n\
         <li><b>The truth</b>, against which all errors are, is brute force at {reference} samples a pixel: 16 × 16 \
         supersampling, again and again with the grid moved to another point of an Owen-scrambled Sobol set within its \
         own cell. It reads textures, and the alpha of cut-outs, at a 64th of a pixel's side, so that it is the mean over \
         each pixel of the scene as it is. Supersampling reads them for its own samples, as renderers elsewhere do; one \
         sample and multisampling read them for the pixel. <b>Geometry alone</b> has textures read for a whole pixel in \
         every method and in a reference of its own: it says nothing of how sharp they are.</li>\n\
         <li><b>RMSE, PSNR, max</b> and <b>removed</b> are of sRGB-encoded values of 0 to 1, as a display shows them; \
         <i>linear</i> of linear light. <i>Removed</i> is the share of the squared error of one sample a pixel that is \
         gone. <i>Needless</i> is the share of pixels that were right with one sample, within 1/255, and are further \
         off than that now. <i>Left</i> is told by where it is: in superpixels; in other pixels of several triangles, \
         of too little contrast; in other pixels that hold a triangle or a gap that no centre of the 3 × 3 around saw, of \
         64 looks; and in those of one triangle. In superpixels of several triangles it is put down to <i>edges</i> where at \
         least half of it stays when every sample is shaded; elsewhere, and amid one triangle, to <i>texture</i> or \
         <i>light</i>, whichever errs more at that pixel alone, against a truth of its own: paint alone (every material \
         unlit) or light alone (the mean of its colours in place of each base colour texture). <b>FLIP</b> is the mean of the error map of Andersson et al. (2020).</li>\n\
         <li><b>Error maps</b> run from black (no error) to light yellow (an error of {brightest} and above), as the \
         square root of the error.</li>\n</ul>\n</section>\n",
        budget = results.budget_seconds,
        reference = results.reference_samples,
        brightest = BRIGHTEST,
    )
}

/// Text with the special characters of HTML escaped.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// The ID that links within the page use for a scene.
fn anchor(name: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
    name.chars().map(plain).collect()
}

/// A whole number with a separator between its thousands.
fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A number rounded to three significant digits.
fn short(value: f64) -> String {
    match value {
        v if v >= 99.95 => format!("{v:.0}"),
        v if v >= 9.995 => format!("{v:.1}"),
        v => format!("{v:.2}"),
    }
}

/// A ratio, or a dash.
fn times(ratio: Option<f64>) -> String {
    ratio.map_or_else(|| "–".to_owned(), |ratio| format!("{}×", short(ratio)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_cannot_become_markup() {
        assert_eq!(escape("<a href=\"x\">&"), "&lt;a href=&quot;x&quot;&gt;&amp;");
    }

    #[test]
    fn commas_part_thousands() {
        assert_eq!(thousands(7), "7");
        assert_eq!(thousands(123_456), "123,456");
        assert_eq!(thousands(1_000_000), "1,000,000");
    }

    #[test]
    fn numbers_keep_three_digits() {
        let shown: Vec<_> = [0.1234, 9.999, 12.34, 1234.5].into_iter().map(short).collect();
        assert_eq!(shown, ["0.12", "10.0", "12.3", "1234"]);
    }
}
