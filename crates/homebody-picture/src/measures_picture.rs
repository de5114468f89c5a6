//! Months at a glance: a row for each measure, a column for each day, shaded from the least to the most of the measure.

use super::paint::{DENSITY, HAIRLINE, INK, MUTED, Paint, QUIET};
use super::svg::{Anchor, Px, Svg, Type};
use homebody_analysis::measures::{MEASURES, Measures};
use homebody_core::geometry::Point;
use homebody_core::statistics::quantile;
use std::fmt::Write;

const WIDTH: f64 = 1200.0;
const LEFT: f64 = 210.0;
const RIGHT: f64 = WIDTH - 210.0;
const TOP: f64 = 122.0;
const ROW: f64 = 20.0;
const GAP: f64 = 3.0;
/// The right edges of the columns of figures: the lowest, the median, the highest.
const FIGURES: [f64; 3] = [RIGHT + 52.0, RIGHT + 100.0, RIGHT + 144.0];
const AXIS: Type = Type::new(12.0, MUTED);
const HATCH: &str = "unknown";

pub fn measures_picture(measures: &Measures) -> String {
    let span = match (measures.days.first(), measures.days.last()) {
        (Some(first), Some(last)) => format!("{} to {}", first.date, last.date),
        _ => "without a day".into(),
    };
    let title = "Measures by day";
    let words = format!("{}: {} days, {span}", measures.name, measures.days.len());
    let mut svg = Svg::new(title, &words);
    svg.hatch(HATCH, "#eceef0", "#c4c9cf");
    svg.text(title, Point::new(40.0, 36.0), &Type::new(24.0, INK));
    svg.text(&words, Point::new(40.0, 64.0), &Type::new(14.0, INK));
    legend(&mut svg);
    let shown: Vec<usize> = (0..MEASURES.len()).filter(|&number| !measures.known(number).is_empty()).collect();
    for (row, &number) in shown.iter().enumerate() {
        draw_row(&mut svg, measures, number, TOP + ROW * row as f64);
    }
    let bottom = TOP + ROW * shown.len() as f64;
    let column = (RIGHT - LEFT) / measures.days.len().max(1) as f64;
    let apart = (90.0 / column).ceil().max(1.0) as usize;
    for (number, day) in measures.days.iter().enumerate().step_by(apart) {
        let x = LEFT + column * number as f64;
        svg.line(Point::new(x, bottom), Point::new(x, bottom + 6.0), &Paint::line(MUTED, 1.0));
        svg.text(&day.date.to_string(), Point::new(x, bottom + 18.0), &AXIS);
    }
    for (number, remark) in measures.remarks.iter().enumerate() {
        svg.text(remark, Point::new(40.0, bottom + 48.0 + 18.0 * number as f64), &AXIS);
    }
    svg.finish(WIDTH, bottom + 54.0 + 18.0 * measures.remarks.len() as f64)
}

fn legend(svg: &mut Svg) {
    const Y: f64 = 94.0;
    const BOX: Point = Point::new(26.0, 16.0);
    svg.rectangle(Point::new(40.0, Y - BOX.y / 2.0), BOX, &Paint::fill(&format!("url(#{HATCH})")).outlined(MUTED, 0.8));
    svg.text("not known", Point::new(74.0, Y), &Type::new(13.0, INK));
    let left = RIGHT - BOX.x * DENSITY.len() as f64;
    svg.text("low", Point::new(left - 10.0, Y), &Type::new(13.0, INK).anchored(Anchor::End));
    for (place, colour) in DENSITY.iter().enumerate() {
        svg.rectangle(Point::new(left + BOX.x * place as f64, Y - BOX.y / 2.0), BOX, &Paint::fill(colour));
    }
    svg.text("high", Point::new(RIGHT + 10.0, Y), &Type::new(13.0, INK));
    for (head, right) in ["lowest", "median", "highest"].into_iter().zip(FIGURES) {
        svg.text(head, Point::new(right, TOP - 14.0), &Type::new(11.0, INK).anchored(Anchor::End));
    }
}

fn draw_row(svg: &mut Svg, measures: &Measures, number: usize, top: f64) {
    let measure = &MEASURES[number];
    let mut known = measures.known(number);
    known.sort_by(f64::total_cmp);
    let at = |share: f64| quantile(&known, share).unwrap_or_default();
    let scale = ColourScale::from_sorted(&known);
    let (middle, bottom) = (top + (ROW - GAP) / 2.0, top + ROW - GAP);
    let column = (RIGHT - LEFT) / measures.days.len() as f64;
    svg.rectangle(Point::new(LEFT, top), Point::new(RIGHT - LEFT, bottom - top), &Paint::fill(QUIET));
    svg.rectangle(
        Point::new(LEFT, top),
        Point::new(RIGHT - LEFT, bottom - top),
        &Paint::fill(&format!("url(#{HATCH})")),
    );
    for (shade, colour) in DENSITY.iter().enumerate() {
        let mut path = String::new();
        for (day, value) in measures.days.iter().map(|day| day.values[number]).enumerate() {
            if value.map(|value| scale.level(value)) == Some(shade) {
                let (left, right) = (LEFT + column * day as f64, LEFT + column * (day + 1) as f64);
                let _ = write!(path, "M{} {}H{}V{}H{}Z", Px(left), Px(top), Px(right), Px(bottom), Px(left));
            }
        }
        if !path.is_empty() {
            svg.crisp(|svg| svg.path(&path, &Paint::fill(colour).joined()));
        }
    }
    svg.rectangle(Point::new(LEFT, top), Point::new(RIGHT - LEFT, bottom - top), &Paint::line(HAIRLINE, 1.0));
    svg.text(measure.title, Point::new(LEFT - 8.0, middle), &Type::new(13.0, INK).anchored(Anchor::End));
    // Small values have two decimals.
    let decimals = if at(0.9) < 3.0 { 2 } else { 1 };
    for (share, right) in [0.0, 0.5, 1.0].into_iter().zip(FIGURES) {
        svg.text(&format!("{:.decimals$}", at(share)), Point::new(right, middle), &AXIS.anchored(Anchor::End));
    }
    svg.text(measure.unit.name, Point::new(FIGURES[2] + 8.0, middle), &AXIS);
}

/// The colours of the values of a measure.
struct ColourScale {
    values: Vec<f64>,
    /// True if a few distant values would leave one colour to all others: then the order gives the colour.
    is_by_order: bool,
}

impl ColourScale {
    /// The scale from the lowest to the highest of values in their order.
    fn from_sorted(sorted: &[f64]) -> ColourScale {
        let mut values = sorted.to_vec();
        values.dedup();
        let scale = ColourScale { values, is_by_order: false };
        // Most of the different values would share the palest two colours. This is our choice.
        let pale = scale.values.iter().filter(|&&value| scale.level(value) < 2).count();
        ColourScale { is_by_order: scale.values.len() > 2 && 2 * pale > scale.values.len(), ..scale }
    }

    /// The colour of one of the values. Zero has a colour of its own.
    fn level(&self, value: f64) -> usize {
        let (Some(&low), Some(&high)) = (self.values.first(), self.values.last()) else { return 0 };
        if value <= low || high <= low {
            return 0;
        }
        let share = match self.is_by_order {
            true => self.values.partition_point(|&other| other < value) as f64 / (self.values.len() - 1) as f64,
            false => (value - low) / (high - low),
        };
        let palest = usize::from(low == 0.0);
        let colours = DENSITY.len() - palest;
        palest + ((share * colours as f64) as usize).min(colours - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn levels(values: &[f64]) -> Vec<usize> {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let scale = ColourScale::from_sorted(&sorted);
        values.iter().map(|&value| scale.level(value)).collect()
    }

    #[test]
    fn a_row_goes_from_its_lowest_to_its_highest() {
        // Two rare days stand out, and so does a day of two from one of one.
        let mut rare = vec![0.0; 60];
        (rare[7], rare[30]) = (1.0, 2.0);
        let rare = levels(&rare);
        assert!(rare[0] == 0 && rare[7] > 0 && rare[30] == DENSITY.len() - 1 && rare[7] < rare[30], "{rare:?}");
        assert_eq!(levels(&[6.0, 7.0, 8.0, 9.0]), [0, 2, 5, 7]);
        assert_eq!(levels(&[4.0, 4.0]), [0, 0], "the control: what never changes has one colour");
    }

    #[test]
    fn few_values_far_away_leave_the_order_of_all_others_to_see() {
        let far = levels(&[0.0, 1.0, 2.0, 3.0, 900.0]);
        assert!(far.is_sorted_by(|a, b| a < b), "{far:?}");
        assert_eq!((far[0], far[4]), (0, DENSITY.len() - 1));
        let least = levels(&[0.0, 0.001, 900.0]);
        assert!(least[0] < least[1] && least[1] < least[2], "{least:?}");
    }
}
