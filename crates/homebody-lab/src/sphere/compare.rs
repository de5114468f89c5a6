//! Real and simulated motion sensors of the same recordings, in numbers.
//!
//! Only the annotated span counts, and only rooms with a sensor. Every figure is of sums over all
//! recordings, so a long recording counts more than a short one.

use super::comparison::{Comparison, RoomComparison, SensorFigures};
use super::words;
use super::{AnnotatedRun, Interval, at_moment, moments};
use homebody_core::statistics::quantile;

/// Compares one recording; `rooms` are those that have a sensor.
pub fn compare_run(run: &AnnotatedRun, simulated: &[Interval], rooms: &[String]) -> Comparison {
    compare_runs(&[(run, simulated)], rooms)
}

/// Compares recordings, each with the intervals in which simulated sensors were ON: named by the sensor's
/// room, in seconds of the recording.
pub fn compare_runs(runs: &[(&AnnotatedRun, &[Interval])], rooms: &[String]) -> Comparison {
    let mut tallies: Vec<RoomTally> = rooms.iter().map(|_| RoomTally::default()).collect();
    for (run, simulated) in runs {
        for (room, tally) in rooms.iter().zip(&mut tallies) {
            tally.add(run, simulated, room);
        }
    }
    let mut all = RoomTally::default();
    tallies.iter().for_each(|tally| all.merge(tally));
    let compared: Vec<RoomComparison> = rooms.iter().zip(&tallies).map(|(room, tally)| tally.compare(room)).collect();
    let overall = all.compare("all rooms");
    let annotated_twice = runs.iter().filter_map(|(run, _)| run.annotators_agree());
    let (same, all) = annotated_twice.fold((0, 0), |sums, (same, all)| (sums.0 + same, sums.1 + all));
    Comparison {
        recordings: runs.len(),
        annotated_s: runs.iter().map(|(run, _)| run.end_s() - run.begin_s()).sum(),
        annotator_agreement: share(same as f64, all as f64),
        findings: words::findings(&compared, &overall),
        rooms: compared,
        overall,
    }
}

/// The ON intervals of sensors, which stay ON for `hold_s` after each firing. Firings (seconds and index of the sensor) are in order of
/// time, `rooms` by sensor.
///
/// The same as the ON and OFF of the logger: a firing at the instant of an OFF starts a new interval.
pub fn hold(firings: impl IntoIterator<Item = (f64, usize)>, rooms: &[String], hold_s: f64) -> Vec<Interval> {
    let mut last: Vec<Option<usize>> = vec![None; rooms.len()];
    let mut intervals: Vec<Interval> = Vec::new();
    for (at_s, sensor) in firings {
        match last[sensor].filter(|&index| at_s < intervals[index].end_s) {
            Some(index) => intervals[index].end_s = at_s + hold_s,
            None => {
                last[sensor] = Some(intervals.len());
                intervals.push(Interval { start_s: at_s, end_s: at_s + hold_s, name: rooms[sensor].clone() });
            }
        }
    }
    intervals
}

#[derive(Default)]
struct RoomTally {
    visits: usize,
    in_room_s: f64,
    real: Tally,
    simulated: Tally,
    /// Seconds by state of the real and of the simulated sensor.
    seconds: [[u64; 2]; 2],
}

#[derive(Default)]
struct Tally {
    intervals: usize,
    on_s: f64,
    on_in_room_s: f64,
    latencies_s: Vec<f64>,
}

impl RoomTally {
    fn add(&mut self, run: &AnnotatedRun, simulated: &[Interval], room: &str) {
        let (begin_s, end_s) = (run.begin_s(), run.end_s());
        let of_room = |intervals: &[Interval]| {
            let clip = |on: &Interval| Interval {
                start_s: on.start_s.max(begin_s),
                end_s: on.end_s.min(end_s),
                name: on.name.clone(),
            };
            let clipped = intervals.iter().filter(|on| on.name == room).map(clip);
            clipped.filter(|on| on.end_s > on.start_s).collect::<Vec<Interval>>()
        };
        let visits = of_room(&run.rooms);
        let (real, simulated) = (of_room(&run.pir), of_room(simulated));
        self.visits += visits.len();
        self.in_room_s += visits.iter().map(|visit| visit.end_s - visit.start_s).sum::<f64>();
        self.real.add(&real, &visits);
        self.simulated.add(&simulated, &visits);
        for at_s in moments(begin_s, end_s) {
            let is_on = |intervals: &[Interval]| usize::from(at_moment(intervals, at_s).is_some());
            self.seconds[is_on(&real)][is_on(&simulated)] += 1;
        }
    }

    fn merge(&mut self, other: &RoomTally) {
        self.visits += other.visits;
        self.in_room_s += other.in_room_s;
        self.real.merge(&other.real);
        self.simulated.merge(&other.simulated);
        for (sums, seconds) in self.seconds.iter_mut().zip(other.seconds) {
            sums.iter_mut().zip(seconds).for_each(|(sum, seconds)| *sum += seconds);
        }
    }

    fn compare(&self, room: &str) -> RoomComparison {
        RoomComparison {
            room: room.into(),
            visits: self.visits,
            in_room_s: self.in_room_s,
            real: self.real.figures(self.in_room_s),
            simulated: self.simulated.figures(self.in_room_s),
            kappa: kappa(self.seconds),
        }
    }
}

impl Tally {
    fn add(&mut self, on: &[Interval], visits: &[Interval]) {
        self.intervals += on.len();
        self.on_s += on.iter().map(|on| on.end_s - on.start_s).sum::<f64>();
        for visit in visits {
            let within = on.iter().filter(|on| on.start_s < visit.end_s && on.end_s > visit.start_s);
            let common = |on: &Interval| on.end_s.min(visit.end_s) - on.start_s.max(visit.start_s);
            self.on_in_room_s += within.clone().map(common).sum::<f64>();
            // A sensor that was ON already has no latency.
            let entries = within.map(|on| (on.start_s - visit.start_s).max(0.0));
            self.latencies_s.extend(entries.min_by(f64::total_cmp));
        }
    }

    fn merge(&mut self, other: &Tally) {
        self.intervals += other.intervals;
        self.on_s += other.on_s;
        self.on_in_room_s += other.on_in_room_s;
        self.latencies_s.extend(&other.latencies_s);
    }

    fn figures(&self, in_room_s: f64) -> SensorFigures {
        SensorFigures {
            intervals: self.intervals,
            on_s: self.on_s,
            visits_seen: self.latencies_s.len(),
            latency_s: quantile(&self.latencies_s, 0.5),
            precision: share(self.on_in_room_s, self.on_s),
            recall: share(self.on_in_room_s, in_room_s),
        }
    }
}

fn share(part: f64, whole: f64) -> Option<f64> {
    (whole > 0.0).then(|| part / whole)
}

/// Agreement beyond chance (Cohen 1960).
fn kappa(seconds: [[u64; 2]; 2]) -> Option<f64> {
    let [[off_off, off_on], [on_off, on_on]] = seconds.map(|row| row.map(|count| count as f64));
    let all = off_off + off_on + on_off + on_on;
    let by_chance = ((off_off + off_on) * (off_off + on_off) + (on_off + on_on) * (off_on + on_on)) / (all * all);
    (by_chance < 1.0).then(|| ((off_off + on_on) / all - by_chance) / (1.0 - by_chance))
}

#[cfg(test)]
pub mod tests {
    use super::*;

    fn on(start_s: f64, end_s: f64, name: &str) -> Interval {
        Interval { start_s, end_s, name: name.into() }
    }

    fn names(names: &[&str]) -> Vec<String> {
        names.iter().map(|name| name.to_string()).collect()
    }

    /// Ten seconds in the hall, ninety in the kitchen, then ten in the hall again.
    fn recording(pir: &[Interval]) -> AnnotatedRun {
        let rooms = vec![on(10.0, 20.0, "hall"), on(20.0, 110.0, "kitchen"), on(110.0, 120.0, "hall")];
        AnnotatedRun { rooms, room_lines: vec![2, 3, 4], movements: Vec::new(), pir: pir.to_vec(), second_rooms: None }
    }

    #[test]
    fn figures_by_hand() {
        // Before the recording; over its beginning; in the kitchen's first seconds.
        let run = recording(&[on(2.0, 5.0, "hall"), on(8.0, 12.0, "hall"), on(26.0, 30.0, "hall")]);
        let simulated = [on(13.0, 17.0, "hall"), on(112.0, 116.0, "hall"), on(24.0, 60.0, "kitchen")];
        let comparison = compare_run(&run, &simulated, &names(&["hall", "kitchen"]));
        let hall = &comparison.rooms[0];
        assert_eq!((hall.visits, hall.in_room_s), (2, 20.0));
        let real = SensorFigures {
            intervals: 2,
            on_s: 6.0,
            visits_seen: 1,
            latency_s: Some(0.0),
            precision: Some(2.0 / 6.0),
            recall: Some(2.0 / 20.0),
        };
        assert_eq!(hall.real, real);
        let simulated = SensorFigures {
            intervals: 2,
            on_s: 8.0,
            visits_seen: 2,
            latency_s: Some(2.5),
            precision: Some(1.0),
            recall: Some(8.0 / 20.0),
        };
        assert_eq!(hall.simulated, simulated);
        // Of 110 seconds, 6 real and 8 simulated ones are ON, none of them in common.
        let by_chance = (104.0 * 102.0 + 6.0 * 8.0) / (110.0 * 110.0);
        let kappa = (96.0 / 110.0 - by_chance) / (1.0 - by_chance);
        assert!((hall.kappa.unwrap() - kappa).abs() < 1e-12);

        let kitchen = &comparison.rooms[1];
        assert_eq!((kitchen.real.precision, kitchen.real.recall, kitchen.real.latency_s), (None, Some(0.0), None));
        assert_eq!(kitchen.simulated.recall, Some(0.4));
        assert_eq!(comparison.overall.visits, 3);
        assert_eq!(comparison.overall.simulated.on_s, 44.0);
    }

    #[test]
    fn equal_sensors_agree() {
        let pir = [on(11.0, 14.0, "hall"), on(22.0, 80.0, "kitchen"), on(111.0, 119.0, "hall")];
        let run = recording(&pir);
        let comparison = compare_run(&run, &pir, &names(&["hall", "kitchen"]));
        for room in comparison.rooms.iter().chain([&comparison.overall]) {
            assert_eq!(room.real, room.simulated);
            assert_eq!(room.kappa, Some(1.0));
        }
        assert!(comparison.findings.iter().all(|finding| finding.agrees), "{:?}", comparison.findings);
    }

    #[test]
    fn recordings_add_up() {
        let (run, simulated) = (recording(&[on(11.0, 14.0, "hall")]), [on(12.0, 14.0, "hall")]);
        let one = compare_run(&run, &simulated, &names(&["hall"]));
        let two = compare_runs(&[(&run, &simulated), (&run, &simulated)], &names(&["hall"]));
        assert_eq!(two.annotated_s, 2.0 * one.annotated_s);
        assert_eq!(two.rooms[0].real.on_s, 2.0 * one.rooms[0].real.on_s);
        assert_eq!(two.rooms[0].kappa, one.rooms[0].kappa);
    }

    #[test]
    fn annotators_agree_by_the_second() {
        let second = |rooms: &[Interval]| AnnotatedRun { second_rooms: Some(rooms.to_vec()), ..recording(&[]) };
        // Twenty of twenty seconds the same, then none of the ten that both name.
        let (alike, unlike) = (second(&[on(20.0, 40.0, "kitchen")]), second(&[on(10.0, 20.0, "kitchen")]));
        let comparison = compare_runs(&[(&alike, &[]), (&unlike, &[])], &names(&["hall"]));
        assert_eq!(comparison.annotator_agreement, Some(20.0 / 30.0));
        assert_eq!(compare_run(&second(&[]), &[], &names(&["hall"])).annotator_agreement, None);
    }

    #[test]
    fn firings_are_held() {
        let firings = [(1.0, 0), (2.5, 0), (3.0, 1), (4.0, 0), (9.0, 0), (11.0, 0)];
        let held = hold(firings, &names(&["hall", "kitchen"]), 2.0);
        assert_eq!(
            held,
            [on(1.0, 6.0, "hall"), on(3.0, 5.0, "kitchen"), on(9.0, 11.0, "hall"), on(11.0, 13.0, "hall")]
        );
    }
}
