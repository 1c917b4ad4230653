//! The catalogue of stiff and extreme cases: each of its 73 cases by number and name, in `f32` and `f64`.
//!
//! What is measured and what is expected stands in lab/stability/src/catalogue, which `scanray stability` prints, too.
//! A case's figures, seeds and bounds are shown with `cargo test -p scanray-stability --test numerics case_26 -- --nocapture`;
//! `SEED=7` tries other random numbers.

mod geometry;
mod image;
mod input;
mod reference;
mod shading;

use scanray_stability::catalogue::{Case, Effort, Finding, Group, ScalarName};

/// Tests of cases, by what is `case_NUMBER_NAME`: one for each scalar.
macro_rules! cases {
    ($($case:ident,)*) => {
        /// The cases that are tested here.
        pub(crate) const CASES: &[&str] = &[$(stringify!($case)),*];

        $(mod $case {
            use scanray_stability::catalogue::ScalarName;

            #[test]
            fn f32() {
                crate::check(stringify!($case), ScalarName::F32);
            }

            #[test]
            fn f64() {
                crate::check(stringify!($case), ScalarName::F64);
            }
        })*
    };
}
use cases;

/// What a case's tests are called.
fn test_name(case: &Case) -> String {
    format!("case_{:02}_{}", case.number, case.name)
}

fn in_words(finding: &Finding) -> String {
    let Finding {
        what,
        measured,
        bound,
        of,
        seed,
        textbook,
        ..
    } = finding;
    let mut words = format!("{what}: {measured:e} of {of}");
    if let Some(bound) = bound {
        words += &format!(", at most {bound:e}");
    }
    if let Some(seed) = seed {
        words += &format!(", seed {seed}");
    }
    if let Some(textbook) = textbook {
        words += &format!(" (textbook: {textbook:e})");
    }
    words
}

/// Measures a case; prints all figures and fails with those that exceed their bounds.
fn check(name: &str, scalar: ScalarName) {
    let cases = Case::all();
    let case = cases
        .iter()
        .find(|case| test_name(case) == name)
        .expect("the catalogue has the case");
    println!("{name}: {}", case.expected);
    let findings = case.measure(scalar, Effort::Quick);
    assert!(!findings.is_empty(), "nothing was measured");
    let mut failed = Vec::new();
    for finding in &findings {
        let words = in_words(finding);
        println!("{} {words}", if finding.pass { "ok    " } else { "FAILED" });
        if !finding.pass {
            failed.push(words);
        }
    }
    assert!(
        failed.is_empty(),
        "{name} in {}: {failed:#?}",
        scalar.name()
    );
}

#[test]
fn all_73_cases_are_tested_in_their_groups() {
    let cases = Case::all();
    let numbers: Vec<u8> = cases.iter().map(|case| case.number).collect();
    assert_eq!(numbers, (1..=73).collect::<Vec<u8>>());
    for (group, tested) in [
        (Group::Geometry, geometry::CASES),
        (Group::Shading, shading::CASES),
        (Group::Image, image::CASES),
        (Group::Input, input::CASES),
    ] {
        let catalogue: Vec<_> = cases
            .iter()
            .filter(|case| case.group == group)
            .map(test_name)
            .collect();
        assert_eq!(tested, catalogue, "{group:?}");
    }
}

#[test]
fn titles_have_numbers_in_them() {
    let title = |number: usize| Case::all()[number - 1].title();
    assert_eq!(title(3), "sphere at radius over distance 1e-4");
    assert_eq!(title(41), "mirrors of 0.9 at depth 16");
    assert_eq!(title(31), "shell of 1e-3 radii");
    assert_eq!(title(56), "field of view of 179.9 degrees");
    assert_eq!(title(69), "single precision on every scene");
}
