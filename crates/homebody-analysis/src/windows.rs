//! A log cut into windows of one length, for recognisers to be trained on: what each sensor said in a window, and what somebody did.
//!
//! A row is of one resident and one window, from the first window that begins at a whole multiple of its length on. Its features are
//! those of the log alone, and so the same for all residents: how often each sensor said something that is no end, and which spoke last.
//! Its label is the activity that the truth tells for most of the window.
//!
//! Left out: who of several people it was that a sensor saw. That is what `label` joins, row by row.

use crate::signs::{Says, says};
use homebody_core::time::Micros;
use homebody_log::source::Activity;
use homebody_log::{Life, Log};
use std::ops::Range;

/// There are no more windows (ours): those of a minute for twenty years.
pub const MOST: i64 = 10_000_000;

/// Windows of a log.
#[derive(Clone, Debug, PartialEq)]
pub struct Windows {
    /// The names of the sensors, in the order of `counts`.
    pub sensors: Vec<String>,
    /// In order of their beginnings, and of residents.
    pub rows: Vec<Window>,
}

/// What was said in a window, and what one resident did.
#[derive(Clone, Debug, PartialEq)]
pub struct Window {
    /// When it begins, on the log's clock.
    pub begin: Micros,
    /// Whose activity the label is; none where nobody is known.
    pub resident: Option<usize>,
    /// The activity for most of the window.
    pub label: Option<String>,
    /// Where somebody was for most of the window.
    pub room: Option<String>,
    /// By sensor: how often it said something that is no end.
    pub counts: Vec<u32>,
    /// Which sensor spoke last, in this window or before.
    pub last: Option<u32>,
}

/// Cuts a log into windows of a length, from its first row to its last; `lives` are on its clock.
///
/// # Errors
///
/// In words, if there would be more than [`MOST`], or the length is none.
pub fn windows(log: &Log, lives: &[Life], span: Micros) -> Result<Windows, String> {
    if span <= 0 {
        return Err("a window is longer than nothing".into());
    }
    let events = log.in_order();
    let (Some(first), Some(last)) = (events.first(), events.last()) else {
        return Ok(Windows { sensors: log.sensors.clone(), rows: Vec::new() });
    };
    let (first, last) = (first.at.div_euclid(span), last.at.div_euclid(span));
    if last - first >= MOST {
        return Err(format!("it would be {} windows, and {MOST} are the most", last - first + 1));
    }
    let counted: Vec<bool> = log.values.iter().map(|value| !matches!(says(value), Says::Ends | Says::Closes)).collect();
    let nobody = [Life::default()];
    let people = if lives.is_empty() { &nobody[..] } else { lives };
    let mut rows = Vec::new();
    let (mut next, mut spoke) = (0, None);
    for number in first..=last {
        let within = number * span..(number + 1) * span;
        let mut counts = vec![0; log.sensors.len()];
        while let Some(event) = events.get(next).filter(|event| event.at < within.end) {
            counts[event.sensor as usize] += u32::from(counted[event.value as usize]);
            spoke = Some(event.sensor);
            next += 1;
        }
        for (index, life) in people.iter().enumerate() {
            rows.push(Window {
                begin: within.start,
                resident: (!lives.is_empty()).then_some(index),
                label: longest(&life.activities, &within),
                room: longest(&life.rooms, &within),
                counts: counts.clone(),
                last: spoke,
            });
        }
    }
    Ok(Windows { sensors: log.sensors.clone(), rows })
}

/// What goes on for most of a span; of two as long, what came first.
fn longest(spans: &[Activity], within: &Range<Micros>) -> Option<String> {
    let first = spans.partition_point(|span| span.end <= within.start);
    let mut best: Option<(Micros, &str)> = None;
    for span in spans[first..].iter().take_while(|span| span.begin < within.end) {
        let lasts = span.end.min(within.end) - span.begin.max(within.start);
        if best.is_none_or(|(most, _)| lasts > most) {
            best = Some((lasts, &span.name));
        }
    }
    best.map(|(_, name)| name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::SECOND;
    use homebody_log::Event;

    #[test]
    fn a_window_counts_what_begins_and_is_labelled_by_what_lasts_longest() {
        let event = |at_s: i64, sensor, value| Event { at: at_s * SECOND, sensor, value };
        let log = Log {
            sensors: vec!["bed".into(), "hall".into()],
            values: vec!["ON".into(), "OFF".into()],
            events: vec![event(61, 0, 0), event(62, 0, 1), event(70, 1, 0), event(185, 0, 0)],
            ..Log::default()
        };
        let doing = |name: &str, begin_s: i64, end_s: i64| Activity {
            name: name.into(),
            begin: begin_s * SECOND,
            end: end_s * SECOND,
        };
        let activities = vec![doing("sleeping", 0, 85), doing("walking", 85, 118)];
        let life = Life { resident: "ada".into(), activities, rooms: Vec::new() };
        let cut = windows(&log, std::slice::from_ref(&life), 60 * SECOND).unwrap();
        let told: Vec<_> =
            cut.rows.iter().map(|row| (row.begin / SECOND, row.counts.clone(), row.label.as_deref())).collect();
        assert_eq!(
            told,
            [(60, vec![1, 1], Some("walking")), (120, vec![0, 0], None), (180, vec![1, 0], None)],
            "33 s of walking are more than 25 s of sleep in the first"
        );
        assert_eq!(cut.rows[1].last, Some(1), "who spoke last is known on");
        let nobody = windows(&log, &[], 60 * SECOND).unwrap();
        assert_eq!((nobody.rows.len(), nobody.rows[0].resident), (3, None));
        assert!(windows(&log, &[], 0).is_err() && windows(&log, &[], 1).is_err());
    }
}
