//! Work-precision diagrams: error over cost, both logarithmic, a line for each knob.

use std::fmt::Write as _;

use plotters::prelude::*;

use super::document::{Configuration, Cost, Emulation, Measure, SceneReport, Verdict};
use super::pareto::Standing;
use super::sweep::front;

/// Size of a diagram in units of its own, which is scaled to where it is shown.
const WIDTH: u32 = 460;
const CHART_HEIGHT: u32 = 330;
const LEGEND_ROW: u32 = 17;

/// Colours: first those that people with any kind of colour vision tell apart (Okabe and Ito 2008). Shapes help.
const COLORS: [RGBColor; 12] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(110, 110, 110),
    RGBColor(140, 86, 75),
    RGBColor(110, 60, 150),
    RGBColor(120, 130, 0),
    RGBColor(0, 130, 140),
    RGBColor(0, 0, 0),
];

/// A point that can be drawn.
struct Mark<'a> {
    label: &'a str,
    configuration: &'a Configuration,
    /// Where it is not known, as on devices for what no device has, the point stands on the right edge.
    cost: Option<f64>,
    error: f64,
    is_on_front: bool,
}

/// The diagram of a scene as SVG; words if nothing can be drawn.
pub(crate) fn svg(
    scene: &SceneReport,
    emulation: &Emulation,
    cost: Cost,
    measure: Measure,
) -> Result<String, String> {
    let standings = front(&scene.configurations, cost, measure);
    let lines: Vec<(&str, Vec<Mark<'_>>)> = scene
        .knobs
        .iter()
        .filter(|line| cost.shows(line))
        .map(|line| {
            (
                line.knob,
                marks(scene, &standings, &line.points, cost, measure),
            )
        })
        .filter(|(_, marks)| !marks.is_empty())
        .collect();
    let all = || lines.iter().flat_map(|(_, marks)| marks);
    let costs = range(all().filter_map(|mark| mark.cost)).ok_or("nothing to draw")?;
    // An error of 0 has no logarithm: it stands on the lower edge.
    let errors =
        range(all().map(|mark| mark.error).filter(|error| *error > 0.0)).unwrap_or((1e-3, 1.0));
    let rows = lines.len().div_ceil(2) as u32 + 1;
    let height = CHART_HEIGHT + rows * LEGEND_ROW + 4;
    let axis = cost.label(emulation);

    let mut svg = String::new();
    let mut drawing = Drawing::default();
    {
        let backend = SVGBackend::with_string(&mut svg, (WIDTH, height));
        let root = backend.into_drawing_area();
        draw_chart(&root, &lines, (costs, errors), &axis, measure, &mut drawing)
            .map_err(|error| error.to_string())?;
        root.present().map_err(|error| error.to_string())?;
    }
    drawing.legend(&lines.iter().map(|(knob, _)| *knob).collect::<Vec<_>>());
    let end = svg.rfind("</svg>").ok_or("the plot has no end")?;
    svg.insert_str(end, &drawing.svg);
    Ok(accessible(&svg, &scene.name, &axis, measure))
}

fn marks<'a>(
    scene: &'a SceneReport,
    standings: &[Option<Standing>],
    points: &'a [(String, usize)],
    cost: Cost,
    measure: Measure,
) -> Vec<Mark<'a>> {
    points
        .iter()
        .filter_map(|(label, index)| {
            let configuration = scene.configurations.get(*index)?;
            Some(Mark {
                label,
                configuration,
                cost: cost.of(configuration).filter(|cost| *cost > 0.0),
                error: measure.of(configuration),
                is_on_front: standings.get(*index) == Some(&Some(Standing::OnFront)),
            })
        })
        .collect()
}

/// The range of an axis, with room at both ends.
fn range(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let (least, most) = values.fold((f64::MAX, 0.0), |(least, most), value| {
        (f64::min(least, value), f64::max(most, value))
    });
    (most > 0.0).then(|| {
        // At least about half a decade, and room for labels, which are above and to the right of their points.
        let room = |least_room: f64| f64::max(least_room, (3.0 * least / most).sqrt());
        (least / room(1.2), most * room(1.6))
    })
}

type Range = (f64, f64);

fn draw_chart<'a>(
    root: &DrawingArea<SVGBackend<'a>, plotters::coord::Shift>,
    lines: &[(&str, Vec<Mark<'_>>)],
    (costs, errors): (Range, Range),
    axis: &str,
    measure: Measure,
    drawing: &mut Drawing,
) -> Result<(), Box<dyn std::error::Error + 'a>> {
    root.fill(&WHITE)?;
    let (upper, _) = root.split_vertically(CHART_HEIGHT);
    let mut chart = ChartBuilder::on(&upper)
        .margin(8)
        .margin_right(14)
        .caption(
            format!("against {}", measure.reference()),
            ("sans-serif", 13),
        )
        .x_label_area_size(42)
        .y_label_area_size(58)
        .build_cartesian_2d(
            (costs.0..costs.1).log_scale(),
            (errors.0..errors.1).log_scale(),
        )?;
    chart
        .configure_mesh()
        .bold_line_style(RGBColor(220, 220, 220))
        .light_line_style(RGBColor(242, 242, 242))
        .axis_style(RGBColor(90, 90, 90))
        .label_style(("sans-serif", 13))
        .axis_desc_style(("sans-serif", 14))
        .x_desc(axis)
        .y_desc(measure.label())
        .x_label_formatter(&|value| number(*value))
        .y_label_formatter(&|value| number(*value))
        .draw()?;
    for (index, (knob, marks)) in lines.iter().enumerate() {
        let place = |mark: &Mark<'_>| {
            let cost = mark.cost.unwrap_or(costs.1);
            chart.backend_coord(&(cost, mark.error.max(errors.0)))
        };
        let places: Vec<_> = marks.iter().map(place).collect();
        drawing.line(index, knob, &places);
        for (mark, at) in marks.iter().zip(places) {
            drawing.mark(index, at, knob, mark);
        }
    }
    Ok(())
}

/// What is drawn over the chart.
#[derive(Default)]
struct Drawing {
    svg: String,
    labels: Vec<(i32, i32)>,
}

impl Drawing {
    /// The line of a knob: through all of its points, in order.
    fn line(&mut self, index: usize, knob: &str, places: &[(i32, i32)]) {
        let color = css(COLORS[index % COLORS.len()]);
        let points: Vec<_> = places.iter().map(|(x, y)| format!("{x},{y}")).collect();
        let _ = write!(
            self.svg,
            "<polyline class=\"knob\" data-knob=\"{}\" points=\"{}\" fill=\"none\" stroke=\"{color}\" \
             stroke-width=\"2\"/>",
            escape(knob),
            points.join(" ")
        );
    }

    /// A point with its label, and what it is when the cursor rests on it.
    fn mark(&mut self, index: usize, (x, y): (i32, i32), knob: &str, mark: &Mark<'_>) {
        let color = css(COLORS[index % COLORS.len()]);
        let configuration = mark.configuration;
        let is_inside = mark.error > 0.0 && mark.cost.is_some();
        let fill = if is_inside { &color } else { "white" };
        let _ = write!(self.svg, "<g class=\"mark\"><title>");
        let _ = write!(
            self.svg,
            "{}: {} ({})&#10;cost {}, error {}</title>",
            escape(knob),
            escape(mark.label),
            escape(&configuration.name),
            mark.cost.map_or("not known".to_owned(), number),
            number(mark.error)
        );
        match configuration.verdict {
            _ if mark.is_on_front => {
                let _ = write!(
                    self.svg,
                    "<circle cx=\"{x}\" cy=\"{y}\" r=\"8\" fill=\"none\" stroke=\"black\" stroke-width=\"1.5\"/>"
                );
            }
            Verdict::Failed(_) => {
                let _ = write!(
                    self.svg,
                    "<path d=\"M{} {}l12 12m0 -12l-12 12\" stroke=\"#c00\" stroke-width=\"2.5\"/>",
                    x - 6,
                    y - 6
                );
            }
            _ => {}
        }
        self.svg.push_str(&shape(index, x, y, &color, fill));
        // Of several labels in one place the first is enough, and long ones are for the cursor.
        let is_free = mark.label.len() < 12
            && self
                .labels
                .iter()
                .all(|(a, b)| (a - x).abs() > 22 || (b - y).abs() > 11);
        if is_free {
            self.labels.push((x, y));
            let (anchor, dx) = if x > WIDTH as i32 - 70 {
                ("end", -9)
            } else {
                ("start", 9)
            };
            let _ = write!(
                self.svg,
                "<text x=\"{}\" y=\"{}\" text-anchor=\"{anchor}\" font-family=\"sans-serif\" font-size=\"11\" \
                 fill=\"{color}\" stroke=\"white\" stroke-width=\"3\" paint-order=\"stroke\">{}</text>",
                x + dx,
                y - 5,
                escape(mark.label)
            );
        }
        self.svg.push_str("</g>");
    }

    fn legend(&mut self, knobs: &[&str]) {
        let place = |index: usize| {
            let column = (index % 2) as i32;
            let row = (index / 2) as i32;
            (
                66 + column * 190,
                CHART_HEIGHT as i32 + 9 + row * LEGEND_ROW as i32,
            )
        };
        let mut text = |(x, y): (i32, i32), words: &str| {
            let _ = write!(
                self.svg,
                "<text x=\"{}\" y=\"{}\" font-family=\"sans-serif\" font-size=\"13\" fill=\"black\">{}</text>",
                x + 14,
                y + 4,
                escape(words)
            );
        };
        for (index, knob) in knobs.iter().enumerate() {
            text(place(index), knob);
        }
        let last = (
            66,
            CHART_HEIGHT as i32 + 9 + knobs.len().div_ceil(2) as i32 * LEGEND_ROW as i32,
        );
        text(last, "Pareto front of this plot");
        text((last.0 + 190, last.1), "hollow: error 0 / no device");
        for index in 0..knobs.len() {
            let (x, y) = place(index);
            let color = css(COLORS[index % COLORS.len()]);
            self.svg.push_str(&shape(index, x, y, &color, &color));
        }
        let (x, y) = last;
        let _ = write!(
            self.svg,
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"7\" fill=\"none\" stroke=\"black\" stroke-width=\"1.5\"/>\
             <circle cx=\"{}\" cy=\"{y}\" r=\"4\" fill=\"white\" stroke=\"black\" stroke-width=\"2\"/>",
            x + 190
        );
    }
}

/// The shape that marks a knob's points.
fn shape(index: usize, x: i32, y: i32, color: &str, fill: &str) -> String {
    let style = format!("fill=\"{fill}\" stroke=\"{color}\" stroke-width=\"2\"");
    match index % 4 {
        0 => format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"3.5\" {style}/>"),
        1 => format!(
            "<rect x=\"{}\" y=\"{}\" width=\"7\" height=\"7\" {style}/>",
            x - 3,
            y - 3
        ),
        2 => format!("<path d=\"M{x} {}l4.5 8h-9z\" {style}/>", y - 5),
        _ => format!("<path d=\"M{x} {}l5 5l-5 5l-5 -5z\" {style}/>", y - 5),
    }
}

fn css(RGBColor(r, g, b): RGBColor) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn escape(words: &str) -> String {
    words
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// A number in few characters.
pub(crate) fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        1e15.. => format!("{value:.0e}"),
        1e12.. => format!("{}T", trimmed(value / 1e12)),
        1e9.. => format!("{}G", trimmed(value / 1e9)),
        1e6.. => format!("{}M", trimmed(value / 1e6)),
        1e4.. => format!("{}k", trimmed(value / 1e3)),
        1e-3.. => trimmed(value),
        _ => format!("{value:.0e}"),
    }
}

/// Three digits that count.
fn trimmed(value: f64) -> String {
    let decimals = match value.abs() {
        100.0.. => 0,
        10.0.. => 1,
        1.0.. => 2,
        0.1.. => 3,
        0.01.. => 4,
        _ => 5,
    };
    let digits = format!("{value:.decimals$}");
    if digits.contains('.') {
        digits
            .trim_end_matches('0')
            .trim_end_matches('.')
            .to_owned()
    } else {
        digits
    }
}

/// Says what the picture is to those who cannot see it.
fn accessible(svg: &str, scene: &str, axis: &str, measure: Measure) -> String {
    let words = format!(
        "{scene}: {} against {}; {axis}",
        measure.label(),
        measure.reference()
    );
    svg.replacen(
        "<svg ",
        &format!("<svg role=\"img\" aria-label=\"{}\" ", escape(&words)),
        1,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let numbers = [
            0.0, 1e-5, 0.02, 0.5, 1.25, 12.0, 123.4, 5000.0, 12_345.0, 2.5e6, 59.9e9, 1e13, 2e15,
        ]
        .map(number);
        assert_eq!(
            numbers,
            [
                "0", "1e-5", "0.02", "0.5", "1.25", "12", "123", "5000", "12.3k", "2.5M", "59.9G",
                "10T", "2e15"
            ]
        );
    }

    #[test]
    fn axes_have_room() {
        assert_eq!(range([].into_iter()), None);
        let (least, most) = range([5.0].into_iter()).unwrap();
        assert!(least < 5.0 && most > 5.0 && most / least > 2.9);
        let (least, most) = range([1.0, 100.0].into_iter()).unwrap();
        assert!(least < 1.0 && most > 100.0 && most / least < 200.0);
    }
}
