use super::comparison::{Comparison, Finding, RoomComparison, SensorFigures};
use homebody::shared::TextTable;
use std::fmt;

/// Largest ratio of two counts or durations that agree (our choice, except for kappa).
const LIKE_FACTOR: f64 = 1.5;
/// Shares agree if they differ by no more than this.
const LIKE_SHARE: f64 = 0.15;
/// Latencies agree if they differ by no more than this.
const LIKE_LATENCY_S: f64 = 2.0;
/// From here on agreement is called moderate (Landis & Koch 1977).
const LIKE_KAPPA: f64 = 0.4;
/// Visits below which a room is left out of the share of visits seen and of the latency (our choice).
const LEAST_VISITS: usize = 3;
/// Time ON, in the truth and in the simulation, below which a sensor is left out of the ON times (our choice).
const LEAST_ON_S: f64 = 10.0;

/// Measures that are judged, room by room.
struct RoomMeasure {
    name: &'static str,
    /// Real and simulated; `None` with too little data.
    of: fn(&RoomComparison) -> Option<(f64, f64)>,
    agrees: fn(f64, f64) -> bool,
    show: fn(f64) -> String,
}

const MEASURES: [RoomMeasure; 6] = [
    RoomMeasure {
        name: "intervals",
        of: |room| either(room, |figures| figures.intervals as f64),
        agrees: within_factor,
        show: |count| format!("{count:.0}"),
    },
    RoomMeasure {
        name: "time ON",
        of: |room| either(room, |figures| figures.on_s),
        agrees: within_factor,
        show: |span_s| format!("{span_s:.0} s"),
    },
    RoomMeasure {
        name: "visits seen",
        of: |room| {
            let seen = |figures: &SensorFigures| figures.visits_seen as f64 / room.visits as f64;
            (room.visits >= LEAST_VISITS).then(|| (seen(&room.real), seen(&room.simulated)))
        },
        agrees: |real, simulated| (real - simulated).abs() <= LIKE_SHARE,
        show: percent,
    },
    RoomMeasure {
        name: "latency",
        of: |room| {
            let enough = room.real.visits_seen.min(room.simulated.visits_seen) >= LEAST_VISITS;
            room.real.latency_s.zip(room.simulated.latency_s).filter(|_| enough)
        },
        agrees: |real, simulated| (real - simulated).abs() <= LIKE_LATENCY_S,
        show: |span_s| format!("{span_s:.1} s"),
    },
    RoomMeasure {
        name: "precision",
        of: |room| room.real.precision.zip(room.simulated.precision),
        agrees: |real, simulated| (real - simulated).abs() <= LIKE_SHARE,
        show: percent,
    },
    RoomMeasure {
        name: "recall",
        of: |room| room.real.recall.zip(room.simulated.recall),
        agrees: |real, simulated| (real - simulated).abs() <= LIKE_SHARE,
        show: percent,
    },
];

fn either(room: &RoomComparison, of: fn(&SensorFigures) -> f64) -> Option<(f64, f64)> {
    (room.real.on_s.max(room.simulated.on_s) >= LEAST_ON_S).then(|| (of(&room.real), of(&room.simulated)))
}

fn within_factor(real: f64, simulated: f64) -> bool {
    real.max(simulated) <= LIKE_FACTOR * real.min(simulated)
}

/// The results: for each measure all rooms together, then the rooms that agree, then each that does not.
pub fn findings(rooms: &[RoomComparison], overall: &RoomComparison) -> Vec<Finding> {
    let mut findings = Vec::new();
    for measure in &MEASURES {
        if let Some((real, simulated)) = (measure.of)(overall) {
            findings.push(measure.finding("all rooms together", real, simulated));
        }
        let judged = rooms.iter().filter_map(|room| Some((room, (measure.of)(room)?)));
        let (alike, unlike): (Vec<_>, Vec<_>) =
            judged.partition(|(_, (real, simulated))| (measure.agrees)(*real, *simulated));
        let alike: Vec<&str> = alike.iter().map(|(room, _)| room.room.as_str()).collect();
        if !alike.is_empty() {
            findings.push(Finding { agrees: true, what: format!("{}: alike in {}", measure.name, alike.join(", ")) });
        }
        findings.extend(unlike.iter().map(|(room, (real, simulated))| measure.finding(&room.room, *real, *simulated)));
    }
    if let Some(kappa) = overall.kappa {
        let what = format!("second by second, beyond chance: kappa {kappa:.2}");
        findings.push(Finding { agrees: kappa >= LIKE_KAPPA, what });
    }
    findings
}

impl RoomMeasure {
    fn finding(&self, where_: &str, real: f64, simulated: f64) -> Finding {
        let (name, show) = (self.name, self.show);
        let what = format!("{name}, {where_}: real {}, simulated {}", show(real), show(simulated));
        Finding { agrees: (self.agrees)(real, simulated), what }
    }
}

/// A table of the rooms with the real figure before the simulated one, then the results.
impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let minutes = self.annotated_s / 60.0;
        write!(f, "{} recordings, {minutes:.0} minutes annotated", self.recordings)?;
        if let Some(agreement) = self.annotator_agreement {
            write!(f, "; two annotators name the same room {} of the time", percent(agreement))?;
        }
        writeln!(f, "\n\nreal | simulated")?;
        let table = TextTable::new(
            "-10 room|6 visits|7 there|12 intervals|14 ON|10 seen|12 latency|12 precision|12 recall|6 kappa",
        );
        f.write_str(&table.heading())?;
        for row in self.rooms.iter().chain([&self.overall]) {
            let RoomComparison { room, visits, in_room_s, real, simulated, kappa } = row;
            let there = format!("{in_room_s:.0} s");
            let pair = |of: fn(&SensorFigures) -> String| format!("{} | {}", of(real), of(simulated));
            let intervals = pair(|figures| figures.intervals.to_string());
            let on = pair(|figures| format!("{:.0} s", figures.on_s));
            let seen = pair(|figures| figures.visits_seen.to_string());
            let latency = pair(|figures| figures.latency_s.map_or("-".into(), |span_s| format!("{span_s:.1} s")));
            let precision = pair(|figures| figures.precision.map_or("-".into(), percent));
            let recall = pair(|figures| figures.recall.map_or("-".into(), percent));
            let kappa = kappa.map_or("-".into(), |kappa| format!("{kappa:.2}"));
            let cells: [&dyn fmt::Display; 10] =
                [room, visits, &there, &intervals, &on, &seen, &latency, &precision, &recall, &kappa];
            f.write_str(&table.row(&cells))?;
        }
        writeln!(
            f,
            "\nLatency is from entry to the first ON, and 0 where the sensor was ON already, as one is that looks out of the door."
        )?;
        writeln!(
            f,
            "Alike means: counts and times within a factor of {LIKE_FACTOR}, shares within {} points, latencies within \
             {LIKE_LATENCY_S} s, kappa from {LIKE_KAPPA}.",
            LIKE_SHARE * 100.0
        )?;
        for (agrees, heading) in [(true, "Agrees:"), (false, "Does not agree:")] {
            writeln!(f, "\n{heading}")?;
            for finding in self.findings.iter().filter(|finding| finding.agrees == agrees) {
                writeln!(f, "  {}", finding.what)?;
            }
        }
        Ok(())
    }
}

fn percent(share: f64) -> String {
    format!("{:.0} %", share * 100.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn room(name: &str, real: SensorFigures, simulated: SensorFigures) -> RoomComparison {
        RoomComparison { room: name.into(), visits: 10, in_room_s: 100.0, real, simulated, kappa: Some(0.3) }
    }

    fn figures(intervals: usize, on_s: f64, visits_seen: usize) -> SensorFigures {
        let (precision, recall) = (Some(0.9), Some(on_s / 100.0));
        SensorFigures { intervals, on_s, visits_seen, latency_s: Some(2.0), precision, recall }
    }

    #[test]
    fn thresholds_separate_agreement_from_disagreement() {
        let rooms = [
            room("hall", figures(2, 8.0, 1), figures(20, 60.0, 10)),
            room("kitchen", figures(20, 50.0, 10), figures(30, 60.0, 9)),
            room("study", figures(0, 0.0, 0), figures(1, 2.0, 0)),
        ];
        let overall = room("all rooms", figures(22, 58.0, 11), figures(51, 122.0, 19));
        let findings = findings(&rooms, &overall);
        let said = |agrees, what: &str| findings.contains(&Finding { agrees, what: what.into() });
        assert!(said(false, "intervals, all rooms together: real 22, simulated 51"), "{findings:#?}");
        assert!(said(true, "intervals: alike in kitchen"));
        assert!(said(false, "visits seen, hall: real 10 %, simulated 100 %"));
        assert!(said(true, "visits seen: alike in kitchen, study"));
        assert!(said(true, "latency: alike in kitchen"), "one visit seen says nothing about the latency");
        assert!(said(false, "second by second, beyond chance: kappa 0.30"));
    }

    #[test]
    fn the_table_has_a_line_for_every_room() {
        let rooms = vec![room("hall", figures(2, 8.0, 1), figures(20, 60.0, 10))];
        let overall = rooms[0].clone();
        let findings = findings(&rooms, &overall);
        let (recordings, annotated_s, annotator_agreement) = (5, 7200.0, Some(0.987));
        let table = Comparison { recordings, annotated_s, annotator_agreement, rooms, overall, findings }.to_string();
        assert!(
            table
                .starts_with("5 recordings, 120 minutes annotated; two annotators name the same room 99 % of the time")
        );
        assert!(table.contains("\nhall           10   100 s       2 | 20     8 s | 60 s     1 | 10"), "{table}");
        assert!(table.lines().all(|line| line.len() <= 120), "{table}");
    }
}
