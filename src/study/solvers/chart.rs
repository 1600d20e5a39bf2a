//! Diagrams of work against precision: error against evaluations, a panel a case, a line a method.

use crate::study::StudyError;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// The points of one method.
pub(super) struct Curve {
    /// Its name.
    pub(super) name: String,
    /// Evaluations, error in m.
    pub(super) points: Vec<(f64, f64)>,
}

const PANEL: (u32, u32) = (560, 430);
const COLUMNS: u32 = 2;
/// Below, rounding draws the lines.
const LEAST_ERROR: f64 = 1e-14;
/// Above, nothing is left of the solution, and the scale would be lost to it.
const LARGEST_ERROR: f64 = 1e2;

#[derive(Clone, Copy)]
enum Marker {
    Dot,
    Ring,
    Square,
    Triangle,
    Cross,
}

struct Style {
    name: &'static str,
    colour: RGBColor,
    marker: Marker,
    dashed: bool,
}

const fn style(name: &'static str, (r, g, b): (u8, u8, u8), marker: Marker, dashed: bool) -> Style {
    Style { name, colour: RGBColor(r, g, b), marker, dashed }
}

/// The colours of Okabe and Ito (2008), without yellow; methods of one colour differ in marker and line.
const STYLES: [Style; 11] = [
    style("euler", (0, 0, 0), Marker::Cross, true),
    style("rk4", (0, 0, 0), Marker::Dot, false),
    style("rk4_doubling", (0, 114, 178), Marker::Ring, true),
    style("cash_karp", (86, 180, 233), Marker::Square, false),
    style("tsit5", (0, 114, 178), Marker::Dot, false),
    style("dop853", (0, 158, 115), Marker::Triangle, false),
    style("verlet", (230, 159, 0), Marker::Square, false),
    style("yoshida4", (213, 94, 0), Marker::Ring, true),
    style("yoshida6", (213, 94, 0), Marker::Triangle, false),
    style("xpbd, sweeps", (204, 121, 167), Marker::Cross, true),
    style("xpbd, direct", (204, 121, 167), Marker::Dot, false),
];

type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;

/// A panel for each case, and the legend in the last.
///
/// # Errors
/// The chart cannot be drawn.
pub(super) fn work_precision(panels: &[(&str, Vec<Curve>)]) -> Result<String, StudyError> {
    let rows = u32::try_from(panels.len() + 1).unwrap_or(1).div_ceil(COLUMNS);
    let mut text = String::new();
    {
        let size = (COLUMNS * PANEL.0, rows * PANEL.1);
        let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
        area.fill(&WHITE)?;
        let areas = area.split_evenly((rows as usize, COLUMNS as usize));
        for ((name, curves), area) in panels.iter().zip(&areas) {
            panel(area, name, curves)?;
        }
        if let Some(area) = areas.get(panels.len()) {
            legend(area, panels)?;
        }
        area.present()?;
    }
    Ok(text)
}

fn panel(area: &Area<'_>, name: &str, curves: &[Curve]) -> Result<(), StudyError> {
    let points = || curves.iter().flat_map(|curve| &curve.points).map(|point| clipped(*point));
    let span = |of: fn((f64, f64)) -> f64| {
        let values = points().map(of).fold((f64::INFINITY, 0.0), |(low, high), x| (x.min(low), x.max(high)));
        // Room for markers.
        if values.1 > 0.0 { values.0 / 1.5..values.1 * 1.5 } else { 1.0..10.0 }
    };
    let mut chart = ChartBuilder::on(area)
        .caption(name, ("sans-serif", 18))
        .margin(12)
        .x_label_area_size(42)
        .y_label_area_size(58)
        .build_cartesian_2d(span(|(x, _)| x).log_scale(), span(|(_, y)| y).log_scale())?;
    chart
        .configure_mesh()
        .x_desc("evaluations")
        .y_desc("error at the end, m")
        .label_style(("sans-serif", 13))
        .axis_desc_style(("sans-serif", 14))
        .x_label_formatter(&|value| format!("{value:.0e}"))
        .y_label_formatter(&|value| format!("{value:.0e}"))
        .y_labels(8)
        .light_line_style(WHITE.mix(0.0))
        .bold_line_style(BLACK.mix(0.15))
        .draw()?;
    for curve in curves {
        let Some(style) = STYLES.iter().find(|style| style.name == curve.name) else {
            continue;
        };
        let (left, top) = area.get_base_pixel();
        let pixel = |point: &(f64, f64)| {
            let (x, y) = chart.backend_coord(&clipped(*point));
            (x - left, y - top)
        };
        line(area, style, curve.points.iter().map(pixel).collect())?;
    }
    Ok(())
}

fn clipped((evaluations, error): (f64, f64)) -> (f64, f64) {
    (evaluations, error.clamp(LEAST_ERROR, LARGEST_ERROR))
}

fn line(area: &Area<'_>, style: &Style, pixels: Vec<(i32, i32)>) -> Result<(), StudyError> {
    let stroke = style.colour.stroke_width(2);
    for at in &pixels {
        mark(area, style, *at)?;
    }
    if style.dashed {
        area.draw(&DashedPathElement::new(pixels, 6, 4, stroke))?;
    } else {
        area.draw(&PathElement::new(pixels, stroke))?;
    }
    Ok(())
}

fn mark(area: &Area<'_>, style: &Style, (x, y): (i32, i32)) -> Result<(), StudyError> {
    /// Half the size of a marker, pixels.
    const HALF: i32 = 4;
    let (filled, stroke) = (style.colour.filled(), style.colour.stroke_width(2));
    match style.marker {
        Marker::Dot => area.draw(&Circle::new((x, y), HALF, filled))?,
        Marker::Ring => area.draw(&Circle::new((x, y), HALF, stroke))?,
        Marker::Square => area.draw(&Rectangle::new([(x - HALF, y - HALF), (x + HALF, y + HALF)], filled))?,
        Marker::Triangle => area.draw(&TriangleMarker::new((x, y), HALF + 2, filled))?,
        Marker::Cross => area.draw(&Cross::new((x, y), HALF, stroke))?,
    }
    Ok(())
}

/// The methods that appear.
fn legend(area: &Area<'_>, panels: &[(&str, Vec<Curve>)]) -> Result<(), StudyError> {
    let appears = |style: &&Style| {
        panels.iter().flat_map(|(_, curves)| curves).any(|curve| curve.name == style.name && !curve.points.is_empty())
    };
    let mut y = 50;
    for style in STYLES.iter().filter(appears) {
        line(area, style, vec![(70, y), (100, y), (130, y)])?;
        let text = TextStyle::from(("sans-serif", 15)).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new(style.name.replace('_', " "), (145, y), text))?;
        y += 26;
    }
    let note = TextStyle::from(("sans-serif", 13)).pos(Pos::new(HPos::Left, VPos::Center));
    area.draw(&Text::new(
        "Steps by powers of two, tolerances by powers of ten; lower left is better.",
        (70, y + 10),
        note,
    ))?;
    Ok(())
}
