//! `scanray tune`.

use crate::program::{Folder, SMALL_SCENE};

/// Runs `tune` on the small scene with a budget and more; returns exit code and JSON.
fn tuned(budget: &str, more: &[&str]) -> (i32, serde_json::Value) {
    let folder = Folder::new();
    folder.write("a.txt", SMALL_SCENE);
    let fixed = [
        "tune", "a.txt", "--target", "M4F", "--clock", "100MHz", "--size", "16x12", "--json",
        "--budget", budget,
    ];
    let run = folder.run(&[&fixed, more].concat());
    let json = serde_json::from_slice(&run.stdout).unwrap_or_else(|_| panic!("{}", run.stderr));
    (run.code, json)
}

#[test]
fn more_time_is_never_worse_and_is_kept_to() {
    let mut last = f64::INFINITY;
    for (budget, limit) in [("1ms", 1.0), ("5ms", 5.0), ("40ms", 40.0), ("10s", 1e4)] {
        let (code, json) = tuned(budget, &[]);
        assert_eq!(code, 0, "{json}");
        let best = &json["best"];
        let most = best["milliseconds"]["most"].as_f64().unwrap();
        let least = best["milliseconds"]["least"].as_f64().unwrap();
        assert!(least < most && most <= limit, "{json}");
        assert!((1..100).contains(&json["instructions_within_percent"].as_u64().unwrap()));
        let error = best["error"].as_f64().unwrap();
        assert!(error <= last);
        last = error;
        if let Some(better) = json["better"].as_object() {
            assert!(better["milliseconds"]["most"].as_f64().unwrap() > limit);
            assert!(better["error"].as_f64().unwrap() < error);
        }
        if let Some(cheaper) = json["cheaper"].as_object() {
            assert!(cheaper["instructions"].as_f64() < best["instructions"].as_f64());
            assert!(cheaper["error"].as_f64().unwrap() > error);
        }
    }
}

#[test]
fn wait_states_cost() {
    let most = |more: &[&str]| {
        let (_, json) = tuned("10s", more);
        json["best"]["milliseconds"]["most"].as_f64().unwrap()
    };
    assert!(most(&["--wait-states", "5"]) > 2.0 * most(&[]));
}

#[test]
fn tells_how_a_program_draws_with_the_best() {
    let code = |budget: &str, more: &[&str]| {
        let (_, json) = tuned(budget, more);
        let settings = json["best"]["settings"].clone();
        let lines = json["code"].as_array().unwrap().iter();
        let code: Vec<_> = lines
            .map(|line| line.as_str().unwrap().to_owned())
            .collect();
        (settings, code.join("\n"))
    };
    for budget in ["1ms", "3ms", "10ms", "40ms", "10s"] {
        let (settings, code) = code(budget, &["--color", "rgb565", "--dither"]);
        assert!(
            code.contains(".with_resolution(Resolution { width: 16, height: 12 });"),
            "{code}"
        );
        assert!(code.ends_with(".dithered().draw(&mut display)?;"), "{code}");
        let depth = settings["max_depth"].as_u64().unwrap();
        assert_eq!(code.contains("stack = "), depth != 5, "{code}");
        let needs_more = depth == 0 || depth > 5;
        assert_eq!(
            code.contains(&format!(".with_max_depth({depth})?")),
            needs_more,
            "{code}"
        );
        let cutoff = settings["cutoff"].as_f64().unwrap();
        assert_eq!(code.contains("cutoff = 1.0 / "), cutoff > 0.0, "{code}");
        let is_adaptive = settings["adaptive"].is_number();
        assert_eq!(code.contains("&mut centers"), is_adaptive, "{code}");
        let samples = settings["samples"].as_u64().unwrap();
        assert_eq!(
            code.contains(&format!("<_, {samples}>::new(")),
            samples > 1,
            "{code}"
        );
    }
    let (_, plain) = code("10ms", &[]);
    assert!(!plain.contains("dithered"), "{plain}");
}

#[test]
fn says_when_nothing_fits() {
    let (code, json) = tuned("1us", &[]);
    assert_eq!(code, 1);
    assert!(
        ["best", "better", "cheaper"]
            .iter()
            .all(|which| json[which].is_null())
    );
    let settings = &json["cheapest"]["settings"];
    assert!(
        settings["max_depth"].is_u64()
            && settings["cutoff"].is_f64()
            && settings["dither"] == false,
        "{json}"
    );
    let folder = Folder::new();
    folder.write("a.txt", SMALL_SCENE);
    let run = folder.run(&[
        "tune", "a.txt", "--target", "m0", "--clock", "8 MHz", "--budget", "1ms", "--size", "8x6",
    ]);
    assert_eq!(run.code, 1);
    let said = String::from_utf8(run.stdout).unwrap();
    assert!(
        said.contains("nothing fits") && said.contains("the cheapest"),
        "{said}"
    );
}

#[test]
fn errors_are_those_that_the_display_is_seen_with() {
    let error = |more: &[&str]| {
        let (_, json) = tuned("10s", more);
        let measure = json["error_measure"].as_str().unwrap().to_owned();
        (measure, json["best"]["error"].as_f64().unwrap())
    };
    let (measure, of_colours) = error(&[]);
    assert_eq!(measure, "rmse");
    // Greys are compared with greys: that the colours are gone is no error.
    let (measure, of_greys) = error(&["--color", "gray8"]);
    assert_eq!(measure, "rmse");
    assert!(of_greys < 2.0 * of_colours, "{of_greys}, {of_colours}");
    // The mean square would say that dither makes black and white worse.
    let (_, plain) = error(&["--color", "binary"]);
    let (measure, dithered) = error(&["--color", "binary", "--dither"]);
    assert_eq!(measure, "flip");
    assert!(plain > 1.0 && dithered < 1.0, "{plain}, {dithered}");
}

#[test]
fn scenes_with_a_bvh_are_predicted() {
    let folder = Folder::new();
    let (header, sphere) = SMALL_SCENE.trim_end().rsplit_once('\n').unwrap();
    let (_, material) = sphere.split_once("3  1 ").unwrap();
    let spheres = (0..80).map(|i| {
        let (x, y) = (
            f64::from(i % 10) * 0.3 - 1.35,
            f64::from(i / 10) * 0.3 - 1.05,
        );
        format!("0  {x} {y} 3  0.12 {material}\n")
    });
    let header = header.replacen('1', "80", 1);
    folder.write(
        "gem.txt",
        format!("{header}\n{}", spheres.collect::<String>()),
    );
    let run = folder.succeed(&[
        "tune", "gem.txt", "--target", "m3", "--clock", "72MHz", "--budget", "1s", "--size", "8x6",
        "--json",
    ]);
    let json: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    assert!(
        json["best"]["instructions"].as_f64().unwrap() > 1e4,
        "{json}"
    );
}

#[test]
fn units_are_asked_for() {
    let folder = Folder::new();
    for (clock, budget, words) in [
        ("168", "100ms", "such as 168MHz"),
        ("0MHz", "100ms", "such as 168MHz"),
        ("168MHz", "100", "such as 100ms"),
        ("168MHz", "-1ms", "such as 100ms"),
    ] {
        let clock = format!("--clock={clock}");
        let budget = format!("--budget={budget}");
        let said = folder.fail(2, &["tune", "--target", "m4f", &clock, &budget]);
        assert!(said.contains(words), "{said}");
    }
    let said = folder.fail(
        2,
        &[
            "tune", "--target", "m7", "--clock", "1MHz", "--budget", "1s",
        ],
    );
    assert!(said.contains("m4f, m3, m0"), "{said}");
}
