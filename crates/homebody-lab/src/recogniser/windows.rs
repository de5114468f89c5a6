//! A log cut into windows, each with features of its sensors and with a class of activity.
//!
//! The features of a window are: for each sensor, the share of the window in which it was ON, and if it was ON at all; the sensor with the
//! last start before the window; if all sensors were OFF; and the hour of the day. ONs of a sensor with less than a minute between them are
//! one, as in data sets of intervals.
//!
//! The class of a window is the one that fills most of it, if activities with a class fill at least half of it. Other windows are left out.

use super::classes::{COUNT, class_of};
use homebody_core::time::{HOUR, Interval, MINUTE, Span, WallTime};
use homebody_log::Log;

pub const WINDOW: Span = MINUTE.times(5);

/// Time between ONs of a sensor below which they are one (our choice).
const FUSED: Span = MINUTE;

/// Time after which the start of a sensor's ON no longer makes it the last sensor (our choice).
const REMEMBERED: Span = HOUR.times(12);

#[derive(Clone, Debug, PartialEq)]
pub struct Window {
    pub begin: WallTime,
    pub figures: Vec<f64>,
    pub class: usize,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct On {
    pub sensor: usize,
    pub time: Interval<WallTime>,
}

/// The ON times of these sensors, in order of start; other sensors of the log do not count.
pub fn ons(log: &Log, sensors: &[String]) -> Vec<On> {
    let index: Vec<Option<usize>> =
        log.sensors.iter().map(|name| sensors.iter().position(|wanted| wanted == name)).collect();
    let mut open: Vec<Option<WallTime>> = vec![None; sensors.len()];
    let mut ons: Vec<On> = Vec::new();
    let mut last: Vec<Option<usize>> = vec![None; sensors.len()];
    for event in log.in_order() {
        let Some(sensor) = index[event.sensor as usize] else { continue };
        match log.value(event) {
            "ON" | "OPEN" => open[sensor] = open[sensor].or(Some(event.at)),
            "OFF" | "CLOSE" => {
                let Some(begin) = open[sensor].take() else { continue };
                match last[sensor].filter(|&last| begin - ons[last].time.end < FUSED) {
                    Some(last) => ons[last].time.end = event.at,
                    None => {
                        last[sensor] = Some(ons.len());
                        ons.push(On { sensor, time: Interval::new(begin, event.at) });
                    }
                }
            }
            _ => {}
        }
    }
    ons.sort_by_key(|on| (on.time.begin, on.sensor));
    ons
}

pub fn windows(log: &Log, sensors: &[String], span: Interval<WallTime>) -> Vec<Window> {
    let ons = ons(log, sensors);
    let count = (span.length() / WINDOW).max(0) as usize;
    let at = |window: usize| span.begin + window as i64 * WINDOW;
    let mut shares = vec![vec![0.0; sensors.len()]; count];
    for on in &ons {
        for (window, share) in parts(on.time, span) {
            // An ON of an instant counts, too.
            shares[window][on.sensor] += share.max(f64::MIN_POSITIVE);
        }
    }
    let mut classes = vec![[0.0; COUNT]; count];
    for activity in &log.activities {
        let Some(class) = class_of(&activity.label) else { continue };
        for (window, share) in parts(activity.time, span) {
            classes[window][class] += share;
        }
    }
    let mut all = Vec::new();
    let mut begun = 0;
    for window in 0..count {
        while ons.get(begun).is_some_and(|on| on.time.begin < at(window)) {
            begun += 1;
        }
        let filled = &classes[window];
        if filled.iter().sum::<f64>() < 0.5 {
            continue;
        }
        let class = (0..COUNT).rev().max_by(|&a, &b| filled[a].total_cmp(&filled[b])).unwrap_or(0);
        let last = begun.checked_sub(1).map(|last| ons[last]).filter(|last| at(window) - last.time.begin < REMEMBERED);
        let figures = figures(&shares[window], last.map(|last| last.sensor), at(window));
        all.push(Window { begin: at(window), figures, class });
    }
    all
}

fn figures(shares: &[f64], last: Option<usize>, begin: WallTime) -> Vec<f64> {
    let mut figures: Vec<f64> = shares.iter().map(|share| share.min(1.0)).collect();
    figures.extend(shares.iter().map(|share| f64::from(u8::from(*share > 0.0))));
    figures.extend((0..shares.len()).map(|sensor| f64::from(u8::from(last == Some(sensor)))));
    figures.push(f64::from(u8::from(shares.iter().all(|share| *share == 0.0))));
    figures.push(begin.time_of_day().seconds() / 3600.0);
    figures
}

/// The windows that overlap with a time, and the share of each.
fn parts(time: Interval<WallTime>, span: Interval<WallTime>) -> impl Iterator<Item = (usize, f64)> {
    let Interval { begin, end } = time;
    let (from, to) = (begin.max(span.begin), end.min(span.end - Span::MICROSECOND).max(begin));
    let window = |at: WallTime| (at - span.begin).div_euclid(WINDOW);
    let windows = if from < span.end && to >= span.begin { window(from)..window(to) + 1 } else { 0..0 };
    windows.map(move |window| {
        let of = Interval::starting(span.begin + window * WINDOW, WINDOW);
        (window as usize, time.overlap(of).ratio(WINDOW))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::{DAY, SECOND};
    use homebody_log::Event;
    use homebody_timeline::Episode;

    fn minute(number: i64) -> WallTime {
        WallTime::EPOCH + number * MINUTE
    }

    /// A fridge that is open from 00:04 to 00:06, and a seat that is taken from 00:10 to 00:20 but for half a minute.
    fn log() -> Log {
        let events = [
            (minute(4), 0, 0),
            (minute(6), 0, 1),
            (minute(10), 1, 2),
            (minute(12), 1, 3),
            (minute(12) + 30 * SECOND, 1, 2),
            (minute(20), 1, 3),
        ];
        Log {
            sensors: vec!["fridge".into(), "seat".into()],
            values: ["OPEN", "CLOSE", "ON", "OFF"].map(String::from).into(),
            events: events.map(|(at, sensor, value)| Event { at, sensor, value }).into(),
            activities: [("Breakfast", 3, 8), ("Dancing", 8, 10), ("Spare_Time/TV", 10, 20)]
                .map(|(name, begin, end)| Episode::new(name.to_owned(), Interval::new(minute(begin), minute(end))))
                .into(),
            ..Log::default()
        }
    }

    fn sensors() -> Vec<String> {
        vec!["fridge".into(), "seat".into()]
    }

    #[test]
    fn ons_that_are_less_than_a_minute_apart_are_one() {
        let on = |sensor, begin, end| On { sensor, time: Interval::new(minute(begin), minute(end)) };
        assert_eq!(ons(&log(), &sensors()), [on(0, 4, 6), on(1, 10, 20)]);
    }

    #[test]
    fn windows_have_features_and_a_class() {
        let all = windows(&log(), &sensors(), Interval::new(minute(0), minute(20)));
        let classes: Vec<(WallTime, usize)> = all.iter().map(|window| (window.begin, window.class)).collect();
        let [breakfast, spare] = ["Breakfast", "Spare_Time/TV"].map(|name| class_of(name).unwrap());
        // Of the first five minutes two are breakfast's, which is too little.
        assert_eq!(classes, [(minute(5), breakfast), (minute(10), spare), (minute(15), spare)]);
        // Shares ON, whether ON, which began last, whether none was ON, the hour.
        assert_eq!(all[0].figures, [0.2, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 5.0 / 60.0]);
        assert_eq!(all[1].figures, [0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 0.0, 10.0 / 60.0]);
        assert_eq!(all[2].figures[4..6], [0.0, 1.0]);
    }

    #[test]
    fn times_outside_the_span_do_not_count() {
        let day = windows(&log(), &sensors(), Interval::new(minute(15), minute(25)));
        assert_eq!(day.len(), 1);
        assert_eq!(day[0].figures[..4], [0.0, 1.0, 0.0, 1.0]);
        let next_day = Interval::starting(WallTime::EPOCH + DAY, 10 * MINUTE);
        assert!(windows(&log(), &sensors(), next_day).is_empty());
    }
}
