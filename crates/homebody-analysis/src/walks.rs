//! The order in which sensors fire, the times between, and the activities meanwhile: the ways in a home without a plan.
//!
//! | figure | definition |
//! |---|---|
//! | way | two sensors, one of which fires within `SOON` after the other, and none in between |
//! | soon | the lower quartile of these times: a walk without a stop |
//! | before and after silence | the number of times that a sensor is the last before `SILENCE`, or the first after it |
//!
//! A sensor fires as movement begins, and as a door opens or closes.

use crate::signs::{Kind, RowMeaning, Says, kinds, said, spans};
use homebody_core::time::{Interval, MINUTE, SECOND, Span, WallTime};
use homebody_log::Log;
use std::collections::BTreeMap;

/// Longest walk from one sensor to the next without a firing (our choice).
pub const SOON: Span = SECOND.times(15);

/// Shortest silence of a person who is out, asleep or still (our choice).
pub const SILENCE: Span = MINUTE.times(30);

#[derive(Clone, Debug, Default, PartialEq)]
pub struct SensorWalks {
    pub sensors: Vec<WalkSensor>,
    /// The ways between two of them, by their numbers, the lower first.
    pub ways: Vec<SensorWay>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct WalkSensor {
    pub id: String,
    pub kind: Kind,
    pub firings: u64,
    /// The first decile, the median and the last decile of the lengths of its ONs; `None` where it reports no end.
    pub on_s: Option<[f64; 3]>,
    /// By label, the firings during that activity, as the log notes it.
    pub done: BTreeMap<String, u64>,
    /// The times that it was the last before a silence, or the first after it.
    pub at_silence: u64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorWay {
    pub between: [usize; 2],
    pub times: u64,
    pub soon_s: f64,
}

pub fn walks(log: &Log) -> SensorWalks {
    let kinds = kinds(log);
    let speaks = |sensor: usize, said: &RowMeaning| match kinds[sensor] {
        Kind::Motion | Kind::Used => said.says == Says::Begins && !said.is_restored,
        Kind::Contact => said.is_sign(),
        Kind::Reading | Kind::Other => false,
    };
    let events = log.events.iter().map(|event| (event.at, event.sensor as usize)).zip(said(log));
    let mut spoken: Vec<(WallTime, usize)> =
        events.filter(|((_, sensor), said)| speaks(*sensor, said)).map(|(spoken, _)| spoken).collect();
    spoken.sort_unstable();
    let lengths = spans(log).into_iter().map(|spans| on_lengths(&spans));
    let mut sensors: Vec<WalkSensor> = log
        .sensors
        .iter()
        .zip(&kinds)
        .zip(lengths)
        .map(|((id, &kind), on_s)| WalkSensor {
            id: id.clone(),
            kind,
            firings: 0,
            on_s,
            done: BTreeMap::new(),
            at_silence: 0,
        })
        .collect();
    spoken.iter().for_each(|&(_, sensor)| sensors[sensor].firings += 1);
    note_what_was_done(log, &spoken, &mut sensors);
    let mut ways: BTreeMap<[usize; 2], Vec<Span>> = BTreeMap::new();
    for pair in spoken.windows(2) {
        let [(from, a), (to, b)] = [pair[0], pair[1]];
        if to - from >= SILENCE {
            sensors[a].at_silence += 1;
            sensors[b].at_silence += 1;
        } else if a != b && to - from <= SOON {
            ways.entry([a.min(b), a.max(b)]).or_default().push(to - from);
        }
    }
    let ways = ways.into_iter().map(|(between, mut times)| {
        times.sort_unstable();
        SensorWay { between, times: times.len() as u64, soon_s: times[times.len() / 4].seconds() }
    });
    SensorWalks { sensors, ways: ways.collect() }
}

/// The deciles of lengths; `None` where all are instants.
fn on_lengths(spans: &[Interval<WallTime>]) -> Option<[f64; 3]> {
    let mut lengths: Vec<Span> = spans.iter().map(|span| span.length()).filter(|&length| length > Span::ZERO).collect();
    lengths.sort_unstable();
    let decile = |tenth: usize| Some(lengths.get(lengths.len() * tenth / 10)?.seconds());
    Some([decile(1)?, decile(5)?, decile(9)?])
}

fn note_what_was_done(log: &Log, spoken: &[(WallTime, usize)], sensors: &mut [WalkSensor]) {
    let mut activities: Vec<_> = log.activities.iter().collect();
    activities.sort_by_key(|activity| activity.begin());
    let mut to_come = activities.into_iter().peekable();
    let mut going_on = Vec::new();
    for &(at, sensor) in spoken {
        while let Some(begun) = to_come.next_if(|activity| activity.begin() <= at) {
            going_on.push(begun);
        }
        going_on.retain(|activity| activity.end() > at);
        for activity in &going_on {
            *sensors[sensor].done.entry(activity.label.clone()).or_insert(0) += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::{at, log, parsed};
    use homebody_timeline::Episode;

    #[test]
    fn counts_ways_and_their_times() {
        let mut log = log(&parsed(
            "0 hall ON, 1 hall OFF, 4 bed ON, 5 bed OFF, 100 bed ON, 102 hall ON, 104 front door OPEN, \
             5000 front door CLOSE, 5001 T1 21.5",
        ));
        log.activities = vec![Episode::new("Sleep".to_owned(), Interval::new(at(4), at(101)))];
        let walks = walks(&log);
        let ids: Vec<&str> = walks.sensors.iter().map(|sensor| sensor.id.as_str()).collect();
        assert_eq!(ids, ["hall", "bed", "front door", "T1"]);
        let firings: Vec<u64> = walks.sensors.iter().map(|sensor| sensor.firings).collect();
        assert_eq!(firings, [2, 2, 2, 0]);
        let way = |between, times, soon_s| SensorWay { between, times, soon_s };
        assert_eq!(walks.ways, [way([0, 1], 2, 2.0), way([0, 2], 1, 2.0)]);
        assert_eq!((walks.sensors[2].at_silence, walks.sensors[1].done.get("Sleep")), (2, Some(&2)));
    }
}
