//! Each measure on a small run made by hand, with known results.

use super::*;
use homebody_core::calendar::Calendar;
use homebody_core::event::{Events, Fact, Firing, Value};
use homebody_core::geometry::Point;
use homebody_core::ids::{ResidentId, RoomId, SensorId};
use homebody_core::motion::MotionState;
use homebody_core::posture::Posture;
use homebody_core::time::{HOUR, MINUTE, RunTime, SECOND, Span};
use homebody_timeline::TimelineBuilder;

const HERE: Point = Point::ZERO;

/// Hours and minutes of a day, the run's first being 0.
fn at(day: i64, hour: i64, minute: i64) -> RunTime {
    RunTime::START + (day * 24 + hour) * HOUR + minute * MINUTE
}

/// Two whole days after the first evening: every night to bed at 23:00, asleep at 23:30, to the toilet at 2:00 and, in the
/// second night, at 4:00, up at 7:00.
fn life() -> Events {
    let mut events = Events::default();
    let mut tell = |at: RunTime, name: &str| {
        events.facts.push(Fact::Activity { resident: ResidentId(0), at, name: Some(name.into()) });
    };
    tell(RunTime::START, "relaxing");
    for day in 1..3 {
        tell(at(day - 1, 22, 50), "using_bathroom");
        tell(at(day - 1, 22, 55), "going_to_bed");
        tell(at(day - 1, 23, 30), "sleeping");
        tell(at(day, 2, 0), "using_bathroom");
        tell(at(day, 2, 6), "sleeping");
        if day == 2 {
            tell(at(day, 4, 0), "using_bathroom");
            tell(at(day, 4, 4), "sleeping");
        }
        tell(at(day, 6, 30), "lying_awake");
        tell(at(day, 7, 0), "getting_up");
        tell(at(day, 7, 10), "using_bathroom");
        tell(at(day, 7, 20), "eating_breakfast");
        tell(at(day, 8, 0), "watching_television");
        if day == 1 {
            tell(at(day, 12, 0), "eating_lunch");
            tell(at(day, 12, 30), "napping");
            tell(at(day, 13, 30), "drinking");
            tell(at(day, 13, 40), "leaving_home");
            tell(at(day, 14, 0), "away");
            tell(at(day, 17, 0), "coming_home");
        }
        tell(at(day, 18, 0), "eating_dinner");
        tell(at(day, 18, 30), "telephoning");
        tell(at(day, 19, 0), "relaxing");
    }
    bodies(&mut events);
    // Other people do not count.
    events.facts.push(Fact::Activity { resident: ResidentId(1), at: at(1, 9, 0), name: Some("napping".into()) });
    events
}

/// Lying down at 23:00 each night; two risings and three walks on the second day, through rooms 0 (the hall) and 1.
fn bodies(events: &mut Events) {
    let mut move_to = |begin: RunTime, end: RunTime, doing: MotionState, posture: Posture| {
        events.facts.push(Fact::Movement { resident: ResidentId(0), begin, end, doing, posture });
    };
    let rest = MotionState::Rest { at: HERE };
    for day in 0..3 {
        let up = if day == 0 { RunTime::START } else { at(day, 7, 0) };
        move_to(up, at(day, 22, 0), rest, Posture::Sitting);
        for (minute, metres, seconds) in [(0, 2.0, 4), (1, 3.0, 3), (2, 0.5, 1)] {
            let begin = at(day, 22, minute);
            let stride = MotionState::Stride { from: HERE, to: Point::new(metres, 0.0) };
            move_to(begin, begin + seconds * SECOND, stride, Posture::Standing);
            move_to(begin + seconds * SECOND, begin + MINUTE, rest, Posture::Sitting);
        }
        move_to(at(day, 22, 3), at(day, 23, 0), rest, Posture::Standing);
        move_to(at(day, 23, 0), at(day + 1, 7, 0), rest, Posture::Lying);
    }
    for (at, room) in [(at(0, 1, 0), 1), (at(1, 9, 0), 0), (at(1, 9, 1), 1), (at(1, 9, 2), 1), (at(2, 9, 0), 0)] {
        events.facts.push(Fact::Room { resident: ResidentId(0), at, room: Some(RoomId(room)) });
        events.facts.push(Fact::Room { resident: ResidentId(0), at: at + SECOND, room: None });
    }
}

fn measure(events: &Events) -> PersonFigures {
    let calendar = Calendar::new("2011-06-06T00:00:00", "America/Los_Angeles").expect("a date and a zone");
    let mut timeline = TimelineBuilder::new(vec!["her".into()], vec!["hall".into(), "kitchen".into()]);
    timeline.take(&events.facts);
    PersonFigures::measure(&PersonRecord {
        events,
        resident: ResidentId(0),
        timeline: &timeline.finish(calendar.instant(3, Span::ZERO)).people[0],
        calendar: &calendar,
        days: 1..3,
        hall: Some("hall"),
        is_motion: &[true, true, false],
        hold: 4 * SECOND,
    })
}

fn close(ours: Option<f64>, expected: f64) {
    let ours = ours.expect("there is enough to tell");
    assert!((ours - expected).abs() < 1e-9, "{ours} is not {expected}");
}

#[test]
fn nights_are_measured_from_lying_down_to_getting_up() {
    let nights = measure(&life()).nights;
    assert_eq!(nights.nights, 2);
    close(nights.to_bed_h, 23.0);
    close(nights.to_bed_sd_h, 0.0);
    close(nights.up_h, 7.0);
    close(nights.in_bed_h, 8.0);
    close(nights.latency_min, 30.0);
    // 23:30 to 6:30 less the time on the toilet: 6 minutes, and 10.
    close(nights.asleep_h, 7.0 - 8.0 / 60.0);
    close(nights.awake_min, 38.0);
    close(nights.trips, 1.5);
    close(nights.any_trip, 1.0);
    close(nights.two_trips, 0.5);
    close(nights.trip_min, 16.0 / 3.0);
}

#[test]
fn days_are_measured_from_midnight_to_midnight() {
    let days = measure(&life()).days;
    assert_eq!(days.days, 2);
    // First thing on both days; before bed on one of the two evenings that count.
    close(Some(days.toilet), 1.5);
    close(days.toilet_min, 25.0 / 3.0);
    close(Some(days.meals), 2.5);
    close(Some(days.three_meals), 0.5);
    close(Some(days.occasions), 3.0);
    close(Some(days.away_h), 1.5);
    close(Some(days.naps), 0.5);
    close(days.nap_min, 60.0);
    assert_eq!(days.nap_half_hours.iter().position(|&hours| hours > 0.0), Some(25));
    close(Some(days.nap_half_hours.iter().sum()), 1.0);
    let hours = |of: TimeUse| Some(days.hours[of as usize]);
    close(hours(TimeUse::Company), 0.5);
    close(hours(TimeUse::Eating), (40.0 + 30.0 + 10.0 + 30.0 + 40.0 + 30.0) / 120.0);
    // 13:40 to 18:00 on the first day.
    close(hours(TimeUse::Out), 13.0 / 6.0);
    close(Some(days.hours.iter().sum()), 24.0);
    for hour in days.by_hour {
        close(Some(hour.iter().sum()), 1.0);
    }
    close(Some(days.by_hour[3][TimeUse::Sleep as usize]), 1.0);
}

#[test]
fn ways_are_counted() {
    let days = measure(&life()).days;
    // Into the hall and back, into the hall.
    close(Some(days.rooms), 1.5);
    close(Some(days.hall), 1.0);
    // Three on each evening, and one from bed on each morning is to a chair.
    close(Some(days.rises), 4.0);
    // The third is too short to tell.
    close(days.pace_mps, 0.75);
}

#[test]
fn measures_sensors_as_in_logs() {
    let mut events = life();
    let second = |day: i64, second: i64| at(day, 10, 0) + second * SECOND;
    // A firing while ON prolongs it; one sensor does not detect motion; the first day does not count.
    let fired = [
        (second(0, 0), 0),
        (second(1, 0), 0),
        (second(1, 2), 1),
        (second(1, 3), 0),
        (second(1, 10), 0),
        (second(1, 11), 2),
        (second(2, 0), 1),
    ];
    for (seq, (at, sensor)) in (0..).zip(fired) {
        events.firings.push(Firing { seq, at, sensor: SensorId(sensor), value: Value::Fire });
    }
    let sensing = measure(&events).sensing;
    // 0 from 0 to 7, 1 from 2 to 6, 0 from 10 to 14; a day later 1 from 0 to 4.
    close(Some(sensing.ons), 2.0);
    close(sensing.ons_sd, 2.0_f64.sqrt());
    assert_eq!(sensing.ons_next_day, None);
    close(sensing.gaps_s[0], 8.0);
    close(sensing.gaps_over_an_hour, 1.0 / 3.0);
    close(sensing.on_s[1], 4.0);
    close(sensing.again_s[2], 10.0);
    let [one, two, three] = sensing.at_once.expect("some are ON");
    close(Some(one), 11.0 / 15.0);
    close(Some(two), 4.0 / 15.0);
    assert_eq!(three, 0.0);
}

#[test]
fn an_empty_run_is_too_short() {
    let person = measure(&Events::default());
    assert_eq!((person.nights.nights, person.nights.in_bed_h), (0, None));
    assert_eq!((person.sensing.gaps_s[0], person.sensing.at_once), (None, None));
    let experiment = DailyLifeExperiment::from_people(vec![person], 1);
    assert!(experiment.to_string().contains("too little to tell"));
}

#[test]
fn reports_figures_outside_with_reasons() {
    let experiment = DailyLifeExperiment::from_people(vec![measure(&life()); 3], 1);
    let outside: Vec<&FigureLine> = experiment.outside().collect();
    // The norm is a hundred passes of the hall.
    assert!(outside.iter().any(|line| line.what == "passes of the hall a day"));
    let report = experiment.to_string();
    let (_, named) = report.split_once("Outside, and why that may be").expect("something lies outside");
    for line in &outside {
        assert!(named.contains(&format!("  {}: ", line.what)), "{}", line.what);
        assert!(named.contains(line.guess), "{}", line.what);
    }
    // Figures inside, such as the time in bed, are not listed there.
    let inside = experiment.lines.iter().find(|line| line.what == "time in bed").expect("there is such a line");
    assert_eq!(inside.inside, Some(true));
    assert!(!named.contains("time in bed:"));
}

#[test]
fn every_line_with_a_norm_has_a_reason_and_a_range() {
    for line in &DailyLifeExperiment::from_people(Vec::new(), 1).lines {
        assert!(line.range.is_none_or(|[low, high]| low < high && !line.guess.is_empty()), "{}", line.what);
        assert!(!line.source.is_empty() && !line.published.is_empty(), "{}", line.what);
        assert_eq!((line.ours, line.inside), (None, None), "{}", line.what);
    }
}

#[test]
fn charts_show_the_figures_of_the_report() {
    let experiment = DailyLifeExperiment::from_people(vec![measure(&life()); 2], 1);
    let chart = experiment.chart();
    assert!(chart.starts_with("<svg") && chart.contains("time in bed") && chart.contains("8.00 h"));
    let hours = experiment.hours();
    assert!(hours.starts_with("<svg") && hours.contains("television"));
}
