//! The movements that a motion sensor notices: the chance that a movement in its field is seen.
//!
//! A passive infrared sensor answers to changes of heat on its element. A small movement, a distant one, or one at the
//! edge of the lens's view changes little; a step sideways may fall between two facets. So real sensors miss some
//! movements, notice others late, and neighbours disagree in the overlap of their fields.
//!
//! We assume that a sensor looks now and then, once in each slot of `1 / looks_per_s` at an instant that is evenly
//! spread in it, and that a look notices a body that moves in the field with the chance `size * edge`, each look by
//! itself. With the angle `a` by which the body moves in a second as seen from the lens, `size = min(1, (a / sure)^2)`:
//! heat on an element falls with the square of distance. With the depth `d` of the body's middle inside the field,
//! below 0 outside, and its radius `r`, `edge = min(1, (d + r) / edge_m)`: 0 if the body only just touches the field.
//! The file of each kind of sensor gives the position of its lens. In addition, of spans of 4 s a share `missed` is
//! lost: a body that passes then, along a facet or between two, is not seen at all.
//!
//! Looks and their marks are not drawn one after the other but belong to the number of their slot, so that it does not matter
//! when and how often the world asks: time may be cut anywhere. Each body has marks of its own.
//!
//! Left out: which way a body moves, how warm it and the room are. A sensor at level `sensitivity` has its threshold besides.

use crate::random::{DrawnValue, Marks};
use crate::time::{RunTime, SECOND, Span};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

/// Angle in a second of a movement that is always noticed, in degrees (our choice, fitted: see
/// `docs/explanation/realism.md`).
const SURE_DEG: f64 = 22.0;

/// The same angle for the wide sensors of CASAS homes, which see only large movements (our choice, also fitted).
const SURE_OF_WIDE_DEG: f64 = 64.0;

/// Duration of a miss, a span without a notice of a body (our choice): about the time that a person takes to pass.
const MISSED_FOR: Span = SECOND.times(4);

/// Distance below which a movement looks no larger (our choice).
const NEAREST_M: f64 = 0.5;

/// The chance that a sensor notices a movement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoticeChance {
    /// The length of a slot, with one look in each.
    pub slot: Span,
    /// Smallest angle per second of a movement that is surely noticed, in radians.
    pub sure_rad: f64,
    /// The width of the soft edge, in metres.
    pub edge_m: f64,
    /// The share of spans of 4 s in which no movement is noticed.
    pub missed: f64,
}

/// A body as seen from a sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// From the lens to the middle of the body, in metres.
    pub distance_m: f64,
    /// The depth of the middle of the body in the field, in metres; below 0 outside.
    pub depth_m: f64,
}

/// One look of a sensor at one body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glance {
    /// When it looks.
    pub at: RunTime,
    /// It notices what has a greater chance than this.
    pub mark: f64,
}

impl NoticeChance {
    /// The chance of a checked sensor with this notice, which is one of the wide ones of CASAS homes or not; `None` for a
    /// sensor that notices all.
    pub fn new(notice: Notice, is_wide: bool) -> Option<NoticeChance> {
        let usual_deg = if is_wide { SURE_OF_WIDE_DEG } else { SURE_DEG };
        match notice {
            Notice::All => None,
            Notice::Chance(chance) => Some(NoticeChance {
                slot: Span::from_micros((SECOND.micros() as f64 / chance.looks_per_s) as i64).max(Span::MICROSECOND),
                sure_rad: chance.sure_deg.unwrap_or(usual_deg).to_radians(),
                edge_m: chance.edge_m,
                missed: chance.missed,
            }),
        }
    }

    /// The chance that a look notices a body of this radius which is there and moves so far within a second.
    pub fn of(&self, there: View, moved_m: f64, radius_m: f64) -> f64 {
        let size = moved_m / there.distance_m.max(NEAREST_M) / self.sure_rad;
        let inside_m = there.depth_m + radius_m;
        let edge = if self.edge_m > 0.0 { (inside_m / self.edge_m).clamp(0.0, 1.0) } else { 1.0 };
        (size * size).min(1.0) * edge
    }

    /// Whether nothing of a body is noticed at an instant.
    pub fn misses(&self, marks: Marks, body: u32, at: RunTime) -> bool {
        // Beside the numbers of the slots.
        marks.of(!(at.since_zero().div_euclid(MISSED_FOR) as u64)).unit(body + 1) < self.missed
    }

    /// The looks at a body in a span.
    pub fn looks(self, marks: Marks, body: u32, span: RangeInclusive<RunTime>) -> impl Iterator<Item = Glance> {
        let slot_of = |at: &RunTime| at.since_zero().div_euclid(self.slot);
        let slots = slot_of(span.start())..=slot_of(span.end());
        let look = move |slot: i64| {
            let drawn: DrawnValue = marks.of(slot as u64);
            let within = Span::from_micros((drawn.unit(0) * self.slot.micros() as f64) as i64);
            let at = RunTime::START + slot * self.slot + within;
            Glance { at, mark: drawn.unit(body + 1) }
        };
        slots.map(look).filter(move |look| span.contains(&look.at))
    }
}

/// Which movements in its field a motion sensor notices.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(title = "notice")]
pub enum Notice {
    /// Every movement, at once, as the sensor of Godsey & Skubic 2009.
    All,
    /// By chance: sooner if a movement looks larger, and if it is further from the edge of the field.
    Chance(ChanceFile),
}

/// Probability that a motion sensor notices a movement. A sensor at level `zones` counts pulses instead.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(title = "chance of notice")]
pub struct ChanceFile {
    /// Number of looks a second. Each look notices a movement or not, independently.
    #[schemars(range(min = 0.01, max = 50))]
    pub looks_per_s: f64,
    /// Angle within a second, seen from the lens, of a movement that a look always notices. A look notices a quarter of
    /// the movements of half that angle. The default is 22; for a wall sensor with a CASAS preset it is 64, because
    /// such a sensor watches a whole room and misses much.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 360))]
    pub sure_deg: Option<f64>,
    /// Width of the soft edge of the field. The nearer a body is to the end of the field, the less likely a look
    /// notices it.
    #[schemars(range(min = 0, max = 10))]
    pub edge_m: f64,
    /// Share of the spans of 4 s with a passing body that the sensor misses.
    #[schemars(range(min = 0, max = 1))]
    pub missed: f64,
}

/// Ours: the first three fitted, the share missed read off a real home whose narrow sensors see 82 to 91 % of those who pass. See
/// `docs/explanation/realism.md`.
impl Default for ChanceFile {
    fn default() -> Self {
        ChanceFile { looks_per_s: 7.0, sure_deg: None, edge_m: 0.25, missed: 0.12 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensors::kinds::SensorFile;
    use serde_json::json;

    fn chance(file: serde_json::Value) -> Option<NoticeChance> {
        let file: SensorFile = serde_json::from_value(file).expect("a sensor");
        file.notice_chance()
    }

    const CHANCE: NoticeChance =
        NoticeChance { slot: Span::from_millis(500), sure_rad: 0.25, edge_m: 0.5, missed: 0.0 };

    fn close(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
    }

    #[test]
    fn presets_of_real_devices_notice_by_chance_and_the_papers_all() {
        let area = json!([[0, 0], [1, 0], [1, 1], [0, 1]]);
        let of = |more: serde_json::Value| {
            let mut file = json!({ "kind": "ceiling_motion", "name": "m", "area": area });
            file.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
            chance(file)
        };
        assert_eq!(of(json!({})), None);
        let sure_deg = |chance: Option<NoticeChance>| chance.map(|chance| chance.sure_rad.to_degrees().round());
        assert_eq!(sure_deg(of(json!({ "preset": "casas_pulse" }))), Some(22.0));
        let wall =
            |preset: &str| json!({ "kind": "motion", "name": "m", "at": [0, 0], "facing_deg": 0, "preset": preset });
        assert_eq!(["casas_follow", "hue"].map(|preset| sure_deg(chance(wall(preset)))), [Some(64.0), Some(22.0)]);
        assert_eq!(of(json!({ "preset": "casas_pulse", "notice": "all" })), None);
        let own = json!({ "notice": { "chance": { "looks_per_s": 4, "sure_deg": 45, "edge_m": 0, "missed": 0.5 } } });
        let quarter_turn = std::f64::consts::FRAC_PI_4;
        assert_eq!(of(own), Some(NoticeChance { slot: SECOND / 4, sure_rad: quarter_turn, edge_m: 0.0, missed: 0.5 }));
        let zones = json!({ "kind": "motion", "name": "m", "at": [0, 0], "facing_deg": 0, "preset": "hue",
            "level": { "zones": {} } });
        assert_eq!(chance(zones), None);
    }

    #[test]
    fn a_look_notices_less_of_what_is_small_far_or_at_the_edge() {
        let of = |distance_m, depth_m, moved_m| CHANCE.of(View { distance_m, depth_m }, moved_m, 0.2);
        // 1.5 m away 0.375 m are 0.25 rad; half of that, or twice as far, is a quarter as sure.
        close(of(1.5, 1.0, 0.375), 1.0);
        close(of(1.5, 1.0, 0.1875), 0.25);
        close(of(3.0, 1.0, 0.375), 0.25);
        close(of(1.5, 1.0, 5.0), 1.0);
        // At the edge 0.2 m of the body are inside the field, of 0.5 m; 0.2 m outside nothing is.
        close(of(1.5, 0.0, 5.0), 0.4);
        close(of(1.5, -0.2, 5.0), 0.0);
        close(of(1.5, 0.1, 5.0), 0.6);
    }

    #[test]
    fn a_share_of_spans_of_four_seconds_is_missed() {
        let (chance, marks) = (NoticeChance { missed: 0.3, ..CHANCE }, Marks::named(1, "missed"));
        let spans = 10_000;
        let missed = (0..spans).filter(|&span| chance.misses(marks, 0, RunTime::START + span * MISSED_FOR)).count();
        assert!((missed as f64 / spans as f64 - 0.3).abs() < 0.015, "{missed}");
        let whole = |span: i64| {
            let within = [Span::ZERO, Span::MICROSECOND, SECOND, MISSED_FOR - Span::MICROSECOND];
            within.map(|within| chance.misses(marks, 0, RunTime::START + span * MISSED_FOR + within))
        };
        assert!((0..100).all(|span| whole(span) == [whole(span)[0]; 4]));
        let always = NoticeChance { missed: 1.0, ..CHANCE };
        assert!(!CHANCE.misses(marks, 0, RunTime::START) && always.misses(marks, 0, RunTime::START));
    }

    #[test]
    fn looks_are_the_same_however_a_span_is_cut() {
        let marks = Marks::named(1, "looks");
        let (start, end) = (RunTime::START, RunTime::START + 100 * SECOND);
        let whole: Vec<Glance> = CHANCE.looks(marks, 0, start..=end - Span::MICROSECOND).collect();
        assert_eq!(whole.len(), 200);
        assert!(whole.iter().enumerate().all(|(slot, look)| look.at.since_zero() / CHANCE.slot == slot as i64));
        let mut cut = Vec::new();
        let mut from = start;
        for length in [1, 7, 100_000, 16_667, 999_999].into_iter().cycle() {
            let to = (from + Span::from_micros(length)).min(end);
            cut.extend(CHANCE.looks(marks, 0, from..=to - Span::MICROSECOND));
            from = to;
            if from == end {
                break;
            }
        }
        assert_eq!(cut, whole);
        // Bodies are looked at together, and noticed or not each by itself.
        let other: Vec<Glance> = CHANCE.looks(marks, 1, start..=end - Span::MICROSECOND).collect();
        assert!(whole.iter().zip(&other).all(|(a, b)| a.at == b.at && a.mark != b.mark));
    }
}
