//! The page of `scanray report`, opened in a real browser.

use std::fs;
use std::io::{self, Write as _};
use std::path::Path;
use std::process::{Command, Stdio};

/// Says why a test did not look. What a test prints is shown when it fails, so that this is written past the harness.
fn skipped(why: &str) {
    let _ = writeln!(io::stderr(), "skipped: {why}");
}

/// Knobs that every plot shows, and the points of each; `true` where turning the knob moves the point in every plot.
const KNOBS: [(&str, usize, bool); 11] = [
    ("max_depth", 8, true),
    ("cut-off", 6, true),
    ("samples_a_pixel", 4, true),
    ("adaptive,_up_to_16_samples", 6, true),
    ("preview,_coarse_to_fine", 3, true),
    ("formulas", 2, true),
    ("ray_offset", 2, false),
    ("scalar", 2, false),
    // Equal to the model, and all but equal in the picture.
    ("power_routine", 2, false),
    ("colour_depth", 4, false),
    ("colour_depth,_dithered", 4, false),
];

/// Checks the lines of a plot: one for each knob, within the plot, through distinct points.
fn check_lines(plot: &str) {
    let lines: Vec<Vec<&str>> = plot
        .split('/')
        .map(|line| line.split(':').collect())
        .collect();
    for (name, points, moves) in KNOBS {
        let line = lines.iter().find(|line| line[0] == name);
        let line = line.unwrap_or_else(|| panic!("no line for {name}: {plot}"));
        assert_eq!(line[1], points.to_string(), "{name}: {plot}");
        let distinct: usize = line[2].parse().unwrap();
        assert!(distinct >= if moves { 2 } else { 1 }, "{name}: {plot}");
        assert_eq!(line[3], "true", "{name}: {plot}");
    }
    assert!(
        lines.iter().any(|line| line[0] == "tune's_choices"),
        "{plot}"
    );
}

/// The browser's name, if one is installed.
fn browser() -> Option<&'static str> {
    ["chromium", "chromium-browser", "google-chrome"]
        .into_iter()
        .find(|name| {
            let version = Command::new(name)
                .arg("--version")
                .stdout(Stdio::null())
                .status();
            version.is_ok_and(|status| status.success())
        })
}

/// Opens a page; returns the document as it is once its scripts have run.
fn open(browser: &str, folder: &Path, page: &Path) -> String {
    let output = Command::new(browser)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-quic",
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
            "--host-resolver-rules=MAP * ~NOTFOUND",
            "--virtual-time-budget=10000",
            "--window-size=1280,900",
            "--dump-dom",
        ])
        .arg(format!(
            "--user-data-dir={}",
            folder.join("profile").display()
        ))
        .arg(format!("file://{}", page.display()))
        .stderr(Stdio::null())
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{browser} ended with {}",
        output.status
    );
    String::from_utf8(output.stdout).unwrap()
}

/// Begins to note down what the page wants from outside, which its policy refuses.
const WATCH: &str = "<script>const refused = [];\
    addEventListener('securitypolicyviolation', (event) => refused.push(event.blockedURI));</script>";

/// Writes down, at the end of the page, what the browser made of it.
const PROBE: &str = "<script>addEventListener('load', () => {\
    const all = (what) => Array.from(document.querySelectorAll(what));\
    const seen = (box) => box.width > 50 && box.height > 30;\
    const report = document.createElement('pre');\
    report.id = 'probe';\
    report.textContent = [\
        all('.plot svg').length,\
        all('.plot svg').slice(0, 2).filter((s) => seen(s.getBoundingClientRect())).length,\
        all('.plot svg').map((s) => Array.from(s.querySelectorAll('polyline.knob'))\
            .map((line) => `${line.dataset.knob}:${line.points.length}:${new Set(Array.from(line.points)\
                .map((p) => `${p.x},${p.y}`)).size}:${Array.from(line.points).every((p) =>\
                p.x > 50 && p.x < 460 && p.y > 0 && p.y < 330)}`).join('/')).join('//').replaceAll(' ', '_'),\
        all('img').length,\
        all('img').filter((i) => i.complete && i.naturalWidth === 16 && i.naturalHeight === 12).length,\
        all('img').filter((i) => seen(i.getBoundingClientRect())).length,\
        document.documentElement.scrollWidth <= document.documentElement.clientWidth,\
        refused.length + performance.getEntriesByType('resource')\
            .filter((r) => !r.name.startsWith('data:')).length,\
    ].join(' ');\
    document.body.append(report);\
});</script>";

/// What [`PROBE`] writes down.
fn probe(browser: &str, folder: &Path, page: &str) -> Vec<String> {
    let file = folder.join("probed.html");
    let page = page.replacen("<title>", &format!("{WATCH}<title>"), 1);
    fs::write(&file, page + PROBE).unwrap();
    let document = open(browser, folder, &file);
    let (_, rest) = document
        .split_once("<pre id=\"probe\">")
        .expect("the page was shown");
    let (words, _) = rest.split_once("</pre>").unwrap();
    words.split(' ').map(str::to_owned).collect()
}

#[test]
fn a_browser_shows_plots_and_pictures_and_fetches_nothing() {
    let Some(browser) = browser() else {
        skipped("no Chromium is installed (Debian package chromium)");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/default.txt");
    let report = Command::new(env!("CARGO_BIN_EXE_scanray-lab"))
        .current_dir(folder.path())
        .args(["report", "-o", "out", "--size", "16x12"])
        .arg(&scene)
        .output()
        .unwrap();
    assert!(report.status.success());
    let page = fs::read_to_string(folder.path().join("out/index.html")).unwrap();

    let seen = probe(browser, folder.path(), &page);
    let [
        plots,
        shown,
        lines,
        pictures,
        decoded,
        visible,
        fits,
        fetched,
    ] = &seen[..]
    else {
        panic!("{seen:?}");
    };
    assert_eq!((plots.as_str(), shown.as_str()), ("12", "2"));
    assert_eq!(lines.split("//").count(), 12);
    lines.split("//").for_each(check_lines);
    assert!(pictures.parse::<u32>().unwrap() > 40);
    assert_eq!((pictures, pictures), (decoded, visible));
    assert_eq!((fits.as_str(), fetched.as_str()), ("true", "0"));
    for word in ["src=\"http", "href=\"http", "url(http", "@import"] {
        assert!(!page.contains(word), "{word}");
    }

    // What would be fetched from outside is noticed.
    let outside = "<img src=\"https://example.invalid/a.png\"></main>";
    let seen = probe(
        browser,
        folder.path(),
        &page.replacen("</main>", outside, 1),
    );
    assert_ne!(seen[7], "0");
}
