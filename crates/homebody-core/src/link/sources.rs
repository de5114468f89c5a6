//! Messages of sensors without a cause: false firings by chance, and the repetitions of a stuck sensor.

use super::message::Draws;
use crate::calendar::time_of_day;
use crate::ids::SensorId;
use crate::link::form::{FaultFile, LinkFile};
use crate::random::Stream;
use crate::time::{DAY, Interval, RunTime, Span};

/// Everything that makes sensors say something for no reason, in the order of sensors.
#[derive(Clone, Debug)]
pub struct UtteranceSources {
    sources: Vec<UtteranceSource>,
    /// The next instant, and its source.
    next: (RunTime, usize),
}

#[derive(Clone, Debug)]
struct UtteranceSource {
    sensor: SensorId,
    kind: SourceKind,
    until: RunTime,
    next: RunTime,
    stream: Stream,
}

#[derive(Clone, Copy, Debug)]
enum SourceKind {
    /// By chance, so often an hour on average, within these times of day.
    Chance {
        per_h: f64,
        hours: DailyHours,
    },
    Repeat {
        every: Span,
    },
}

/// From one time of day to another, perhaps over midnight, on a clock that showed `start` as the run began.
#[derive(Clone, Copy, Debug)]
struct DailyHours {
    start: Span,
    from: Span,
    span: Span,
}

/// Something that a sensor says for no reason.
#[derive(Clone, Copy, Debug)]
pub struct Utterance {
    pub at: RunTime,
    pub sensor: SensorId,
    /// Whether it is stuck and repeats itself.
    pub repeats: bool,
    pub draws: Draws,
}

impl UtteranceSources {
    /// The sources of the file for sensors with these names, with the rate of false firings of each from other causes.
    pub fn new(file: &LinkFile, sensors: &[(&str, f64)], start_of_day: Span, seed: u64) -> UtteranceSources {
        let mut sources = Vec::new();
        for (sensor, &(name, per_h)) in sensors.iter().enumerate() {
            let mut add = |kind, span: Interval<RunTime>, stream: &str| {
                let stream = Stream::named(seed, &format!("sensor/{name}/{stream}"));
                let mut source =
                    UtteranceSource { sensor: SensorId::new(sensor), kind, until: span.end, next: span.begin, stream };
                source.begin();
                sources.push(source);
            };
            let always = DailyHours { start: start_of_day, from: Span::ZERO, span: DAY };
            add(SourceKind::Chance { per_h, hours: always }, Interval::new(RunTime::START, RunTime::NEVER), "false");
            let own = file.faults.iter().filter(|fault| fault.sensor() == Some(name));
            for (number, fault) in own.enumerate() {
                match fault {
                    FaultFile::FalseFires(file) => {
                        let hours = file.between.as_ref().map_or(always, |[from, to]| {
                            let [from, to] = [from, to].map(|text| time_of_day(text).unwrap_or_default());
                            DailyHours { from, span: (to - from).rem_euclid(DAY), ..always }
                        });
                        let stream = format!("false/{number}");
                        add(SourceKind::Chance { per_h: file.per_h, hours }, fault.span(), &stream);
                    }
                    FaultFile::Stuck(file) => {
                        let Some(every) = file.every_s.map(Span::from_seconds) else { continue };
                        add(SourceKind::Repeat { every }, fault.span(), &format!("stuck/{number}"));
                    }
                    _ => {}
                }
            }
        }
        let mut sources = UtteranceSources { sources, next: (RunTime::NEVER, 0) };
        sources.find_next();
        sources
    }

    /// From the beginning of a span to its end a sensor repeats itself.
    pub fn repeat(&mut self, sensor: SensorId, every: Span, span: Interval<RunTime>, stream: Stream) {
        let kind = SourceKind::Repeat { every };
        self.sources.push(UtteranceSource { sensor, kind, until: span.end, next: span.begin, stream });
        self.find_next();
    }

    /// When the next of them speaks.
    pub fn next(&self) -> RunTime {
        self.next.0
    }

    /// The next message.
    pub fn speak(&mut self) -> Option<Utterance> {
        let source = self.sources.get_mut(self.next.1)?;
        let repeats = matches!(source.kind, SourceKind::Repeat { .. });
        let told =
            Utterance { at: source.next, sensor: source.sensor, repeats, draws: Draws::draw(&mut source.stream) };
        source.draw_next();
        self.find_next();
        Some(told)
    }

    fn find_next(&mut self) {
        let order = self.sources.iter().enumerate().map(|(index, source)| (source.next, index));
        self.next = order.min().unwrap_or((RunTime::NEVER, 0));
    }
}

impl UtteranceSource {
    /// Chance does not begin with a firing, a sensor that gets stuck does.
    fn begin(&mut self) {
        match self.kind {
            SourceKind::Chance { per_h, .. } if per_h <= 0.0 => self.next = RunTime::NEVER,
            SourceKind::Chance { .. } => self.draw_next(),
            SourceKind::Repeat { .. } => {}
        }
    }

    fn draw_next(&mut self) {
        self.next = match self.kind {
            SourceKind::Repeat { every } => self.next.saturating_add(every),
            SourceKind::Chance { per_h, hours } => loop {
                // Poisson: waits are exponential. Times outside the hours are skipped.
                let wait = -libm::log(1.0 - self.stream.unit()) * 3600.0 / per_h;
                self.next = self.next.saturating_add(Span::from_seconds(wait).max(Span::MICROSECOND));
                if self.next >= self.until || hours.contain(self.next) {
                    break self.next;
                }
            },
        };
        if self.next >= self.until {
            self.next = RunTime::NEVER;
        }
    }
}

impl DailyHours {
    fn contain(&self, at: RunTime) -> bool {
        (at.since_zero() % DAY + self.start - self.from).rem_euclid(DAY) < self.span
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::time::{HOUR, SECOND};
    use serde_json::json;

    /// The messages of one sensor without a cause within some days of a run that began at 22:00.
    fn said(per_h: f64, faults: serde_json::Value, days: i64) -> Vec<Utterance> {
        let file: LinkFile = serde_json::from_value(json!({ "faults": faults })).unwrap();
        let mut sources = UtteranceSources::new(&file, &[("other", 0.0), ("hall", per_h)], 22 * HOUR, 3);
        let mut said = Vec::new();
        while sources.next() < RunTime::START + days * DAY {
            said.extend(sources.speak());
        }
        said
    }

    #[test]
    fn false_firings_come_as_often_as_they_should_and_by_chance() {
        let said = said(0.5, json!([]), 2000);
        assert!((said.len() as f64 / 24_000.0 - 1.0).abs() < 0.03, "{}", said.len());
        let waits: Vec<f64> = said.windows(2).map(|pair| (pair[1].at - pair[0].at).ratio(2 * HOUR)).collect();
        let mean = waits.iter().sum::<f64>() / waits.len() as f64;
        let variance = waits.iter().map(|wait| (wait - mean) * (wait - mean)).sum::<f64>() / waits.len() as f64;
        assert!((variance - 1.0).abs() < 0.05, "{variance}");
        assert!(said.iter().all(|told| told.sensor == SensorId(1) && !told.repeats));
    }

    #[test]
    fn the_sun_shines_at_its_hours() {
        let fault = |from: &str, to: &str| {
            json!([{ "kind": "false_fires", "sensor": "hall", "per_h": 4, "between": [from, to], "from_day": 1.5,
                "days": 100 }])
        };
        for (from, to, hours) in [("10:00", "15:00", 5), ("23:00", "01:30", 2)] {
            let said = said(0.0, fault(from, to), 400);
            let expected = 400 * hours + if hours == 2 { 200 } else { 0 };
            assert!(said.len().abs_diff(expected) < expected / 10, "{} from {from} to {to}", said.len());
            for told in said {
                let at = told.at.since_zero();
                let (time, at) = ((at + 22 * HOUR) % DAY, at.ratio(DAY));
                let [from, to] = [from, to].map(|text| time_of_day(text).unwrap());
                let is_in = if from < to { from <= time && time < to } else { from <= time || time < to };
                assert!(is_in && (1.5..101.5).contains(&at), "at {at}");
            }
        }
    }

    #[test]
    fn a_stuck_sensor_repeats_itself() {
        let fault = json!([{ "kind": "stuck", "sensor": "hall", "from_day": 1, "days": 0.001, "every_s": 7 }]);
        let times: Vec<i64> = said(0.0, fault, 2).iter().map(|told| (told.at.since_zero() - DAY) / SECOND).collect();
        assert_eq!(times, (0..13).map(|index| index * 7).collect::<Vec<_>>());
    }
}
