//! Charts of the study, as SVG.

use super::{StudyError, rounded};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// One bar, with the interval of its uncertainty.
pub(super) struct Bar {
    /// Index of the series that it belongs to.
    pub(super) series: usize,
    /// Its end.
    pub(super) value: f64,
    /// Lower end of the interval.
    pub(super) low: f64,
    /// Upper end of the interval.
    pub(super) high: f64,
}

/// Bars that stand together under one name.
pub(super) struct Group {
    /// The name.
    pub(super) name: String,
    /// The bars, from above.
    pub(super) bars: Vec<Bar>,
}

const WIDTH: u32 = 960;
const BAR_HEIGHT: u32 = 18;
const GAP: u32 = 22;
/// Caption and legend above the bars, axis below.
const MARGINS: u32 = 130;
/// Colours that remain apart in print and for the colour-blind (Okabe and Ito 2008).
const COLOURS: [RGBColor; 4] =
    [RGBColor(0, 114, 178), RGBColor(86, 180, 233), RGBColor(230, 159, 0), RGBColor(0, 158, 115)];

/// Horizontal bars from 1 to each ratio, on a logarithmic axis.
///
/// # Errors
/// The chart cannot be drawn.
pub(super) fn ratios(caption: &str, series: &[&str], groups: &[Group]) -> Result<String, StudyError> {
    let bars = groups.iter().map(|group| u32::try_from(group.bars.len()).unwrap_or(0)).sum::<u32>();
    let height = MARGINS + bars * BAR_HEIGHT + u32::try_from(groups.len()).unwrap_or(0) * GAP;
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, (WIDTH, height)).into_drawing_area();
        area.fill(&WHITE)?;
        draw(&area, caption, series, groups)?;
        area.present()?;
    }
    Ok(text)
}

type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;

fn draw(area: &Area<'_>, caption: &str, series: &[&str], groups: &[Group]) -> Result<(), StudyError> {
    let extremes = groups
        .iter()
        .flat_map(|group| &group.bars)
        .fold((1.0_f64, 1.0_f64), |(low, high), bar| (low.min(bar.low), high.max(bar.high)));
    // Room for the labels at the ends of the bars.
    let (low, high) = ((extremes.0 * 0.7).min(0.5), extremes.1 * 3.0);
    // Ordinates run from the top of the plot, about a pixel a unit.
    let rows = groups.iter().map(|group| group.bars.len() as f64 * f64::from(BAR_HEIGHT) + f64::from(GAP)).sum::<f64>();
    let area = area.titled(caption, ("sans-serif", 18))?;
    let (legend, plot) = area.split_vertically(30);
    draw_legend(&legend, series)?;
    let mut chart = ChartBuilder::on(&plot)
        .margin_right(20)
        .x_label_area_size(40)
        .y_label_area_size(190)
        .build_cartesian_2d((low..high).log_scale(), rows..0.0)?;
    chart
        .configure_mesh()
        .disable_y_mesh()
        .disable_y_axis()
        .y_labels(0)
        .x_label_style(("sans-serif", 14))
        .x_label_formatter(&|value| format!("{value}"))
        .light_line_style(WHITE.mix(0.0))
        .bold_line_style(BLACK.mix(0.15))
        .draw()?;
    let mut y = f64::from(GAP) / 2.0;
    for group in groups {
        let height = group.bars.len() as f64 * f64::from(BAR_HEIGHT);
        let style = TextStyle::from(("sans-serif", 15)).pos(Pos::new(HPos::Right, VPos::Center));
        let (x0, y0) = chart.backend_coord(&(low, y + height / 2.0));
        // Absolute pixels: the names stand outside the plot.
        plot.draw(&Text::new(group.name.clone(), relative_to(&plot, (x0 - 12, y0)), style))?;
        for bar in &group.bars {
            draw_bar(&mut chart, bar, y)?;
            y += f64::from(BAR_HEIGHT);
        }
        y += f64::from(GAP);
    }
    chart.draw_series([PathElement::new([(1.0, 0.0), (1.0, rows)], BLACK.stroke_width(1))])?;
    Ok(())
}

type Plot<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<LogCoord<f64>, RangedCoordf64>>;

/// The bar, its interval as a line, and its value behind it.
fn draw_bar(chart: &mut Plot<'_>, bar: &Bar, y: f64) -> Result<(), StudyError> {
    let colour = COLOURS[bar.series % COLOURS.len()];
    let (top, bottom) = (y + 2.0, y + f64::from(BAR_HEIGHT) - 2.0);
    let middle = f64::midpoint(top, bottom);
    chart.draw_series([Rectangle::new([(1.0, top), (bar.value, bottom)], colour.filled())])?;
    chart.draw_series([PathElement::new([(bar.low, middle), (bar.high, middle)], BLACK)])?;
    let style = TextStyle::from(("sans-serif", 13)).pos(Pos::new(HPos::Left, VPos::Center));
    let end = (bar.high.max(1.0), middle);
    chart.draw_series([EmptyElement::at(end) + Text::new(rounded(bar.value), (6, 0), style)])?;
    Ok(())
}

/// Pixels of the whole picture as pixels of one area of it.
fn relative_to(area: &Area<'_>, (x, y): (i32, i32)) -> (i32, i32) {
    let (left, top) = area.get_base_pixel();
    (x - left, y - top)
}

fn draw_legend(area: &Area<'_>, series: &[&str]) -> Result<(), StudyError> {
    for (index, name) in series.iter().enumerate() {
        let left = 190 + 190 * i32::try_from(index).unwrap_or(0);
        area.draw(&Rectangle::new([(left, 8), (left + 14, 20)], COLOURS[index % COLOURS.len()].filled()))?;
        let style = TextStyle::from(("sans-serif", 14)).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new(*name, (left + 20, 14), style))?;
    }
    Ok(())
}
