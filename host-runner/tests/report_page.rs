//! The page of `scanray report`, opened in a real browser.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

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
        all('.plot svg').filter((s) => s.querySelectorAll('polyline').length > 7).length,\
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
        println!("skipped: no Chromium is installed (Debian package chromium)");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/default.txt");
    let report = Command::new(env!("CARGO_BIN_EXE_scanray"))
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
        with_lines,
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
    assert_eq!(plots, with_lines, "a line for each knob");
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
