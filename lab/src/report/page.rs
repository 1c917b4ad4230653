//! The report as a page for a browser, which needs nothing else.

use std::io;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::document::{Configuration, Cost, Document, Emulation, Measure, SceneReport, Verdict};
use super::plot::{self, number};
use super::{method, table};
use scanray_host::compare::{level_legend, level_map};
use scanray_host::image::{self, Image, ImageFormat};

/// The whole page.
///
/// # Errors
///
/// When a picture cannot be made.
pub(crate) fn write(document: &Document) -> io::Result<String> {
    let scenes = document
        .scenes
        .iter()
        .map(|report| scene(report, &document.emulation))
        .collect::<io::Result<Vec<_>>>()?;
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                // Nothing is fetched, not even by mistake.
                meta http-equiv="Content-Security-Policy"
                    content="default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";
                link rel="icon" href="data:,";
                title { "scanray: error against run time" }
                style { (PreEscaped(include_str!("page.css"))) }
            }
            body {
                header {
                    h1 { "Error against run time" }
                    p {
                        "What each setting of the renderer costs and what it buys. Each line turns one knob; points further to \
                         the left cost less, points further down are closer to the reference. Ringed points are on the Pareto \
                         front of their plot: of the settings with the same colours and dither, everything else is matched or \
                         beaten in both."
                    }
                    nav {
                        @for scene in &document.scenes {
                            a href={ "#" (anchor(scene)) } { (scene.name) }
                        }
                        a href="#method" { "method" }
                    }
                }
                main {
                    @for scene in scenes { (scene) }
                    section id="method" {
                        h2 { "How the figures came about" }
                        dl {
                            @for (heading, words) in method::paragraphs(document) {
                                dt { (heading) }
                                dd { (words) }
                            }
                        }
                        p { "scanray " (document.version) }
                    }
                }
                script { (PreEscaped(include_str!("page.js"))) }
            }
        }
    };
    Ok(page.into_string())
}

/// No other section has it, whatever the scene's name.
fn anchor(scene: &SceneReport) -> String {
    format!("scene-{}", scene.slug)
}

fn scene(scene: &SceneReport, emulation: &Emulation) -> io::Result<Markup> {
    let diagram = |cost, measure| diagram(scene, emulation, cost, measure);
    let cards = scene
        .configurations
        .iter()
        .map(|configuration| card(scene, configuration))
        .collect::<io::Result<Vec<_>>>()?;
    let reference = data_uri(&scene.reference)?;
    let size = scene.size;
    Ok(html! {
        section id=(anchor(scene)) {
            h2 { (scene.name) " " small { (size.width) "×" (size.height) } }
            div.plots {
                (diagram(Cost::ALL[0], Measure::Total))
                (diagram(Cost::ALL[0], Measure::BeforeQuantisation))
            }
            details {
                summary { "Other costs: M3, M0, rays, tests, host time" }
                div.plots {
                    @for cost in &Cost::ALL[1..] {
                        @for measure in Measure::ALL { (diagram(*cost, measure)) }
                    }
                }
            }
            h3 { "Worth having" }
            (table_of(scene, emulation, &table::brief(), |c| c.verdict == Verdict::Best))
            (list("Equal", &table::equal(scene), ""))
            (list("Dominated", &table::dominated(scene), ""))
            (list("Failed", &table::failed(scene), "failed"))
            details {
                summary { "All figures" }
                (table_of(scene, emulation, &table::COLUMNS.iter().collect::<Vec<_>>(), |_| true))
            }
            details open {
                summary { "Pictures, and how they differ from the reference" }
                p.legend {
                    "Left as shown, right the largest difference of a pixel's channels, in levels of 255: "
                    @for (label, [r, g, b]) in level_legend() {
                        span { i style={ "background:rgb(" (r) "," (g) "," (b) ")" } {} (label) } " "
                    }
                    "(grey: none)"
                }
                div.cards {
                    figure.card {
                        img.reference src=(reference) width=(size.width) height=(size.height) alt="reference";
                        figcaption { b { "reference (R2)" } }
                    }
                    @for card in cards { (card) }
                }
            }
        }
    })
}

fn diagram(scene: &SceneReport, emulation: &Emulation, cost: Cost, measure: Measure) -> Markup {
    html! {
        figure.plot {
            @match plot::svg(scene, emulation, cost, measure) {
                Ok(svg) => (PreEscaped(svg)),
                Err(why) => p { (why) },
            }
        }
    }
}

/// A picture beside its differences.
fn card(scene: &SceneReport, configuration: &Configuration) -> io::Result<Markup> {
    let difference = level_map(&scene.reference, &configuration.shown);
    let (shown, difference_uri) = (data_uri(&configuration.shown)?, data_uri(&difference)?);
    let size = scene.size;
    let errors = &configuration.errors;
    Ok(html! {
        figure.card {
            div.pair {
                img src=(shown) width=(size.width) height=(size.height) alt={ "drawn with: " (configuration.name) };
                img src=(difference_uri) width=(difference.width) height=(difference.height)
                    alt={ "differences of: " (configuration.name) };
            }
            figcaption {
                b { (configuration.name) }
                " " span.verdict { (verdict_word(&configuration.verdict)) }
                br;
                "RMSE " (number(errors.total.rmse)) ", " (number(100.0 * errors.total.share_above_a_level))
                " % above a level, FLIP " (number(configuration.flip))
            }
        }
    })
}

fn verdict_word(verdict: &Verdict) -> &'static str {
    match verdict {
        Verdict::Best => "Pareto front",
        Verdict::EqualTo(_) => "equal",
        Verdict::DominatedBy(_) => "dominated",
        Verdict::Failed(_) => "failed",
        Verdict::NotForDevices => "no device",
    }
}

fn table_of(
    scene: &SceneReport,
    emulation: &Emulation,
    columns: &[&table::Column],
    wanted: impl Fn(&Configuration) -> bool,
) -> Markup {
    html! {
        div.scroll {
            table {
                thead {
                    tr {
                        @for column in columns {
                            th title=(column.explanation) { (table::heading(column, emulation)) }
                        }
                    }
                }
                tbody {
                    @for configuration in scene.configurations.iter().filter(|c| wanted(c)) {
                        tr class=(verdict_word(&configuration.verdict).replace(' ', "-")) {
                            @for column in columns { td { ((column.cell)(configuration)) } }
                        }
                    }
                }
            }
        }
    }
}

fn list(heading: &str, lines: &[String], class: &str) -> Markup {
    html! {
        h3 { (heading) }
        @if lines.is_empty() {
            p { "Nothing." }
        } @else {
            ul.columns { @for line in lines { li class=(class) { (line) } } }
        }
    }
}

/// A picture within the page.
fn data_uri(picture: &Image) -> io::Result<String> {
    let mut file = Vec::new();
    let too_large = |_| io::Error::other("a picture has more than 65,535 rows or columns");
    let size = [
        u16::try_from(picture.width).map_err(too_large)?,
        u16::try_from(picture.height).map_err(too_large)?,
    ];
    let mut rows = picture
        .rgb888
        .chunks_exact(3 * picture.width)
        .map(<[u8]>::to_vec);
    image::write(ImageFormat::Png, &mut file, size, None, &mut rows)?;
    Ok(format!("data:image/png;base64,{}", STANDARD.encode(file)))
}
