//! `link.json`: sensors that there are, spans that run forward, faults that can be at once.

use super::home::check_mounting;
use super::{HomeInCheck, ProblemReport};
use crate::calendar::{TimeMessage, time_of_day};
use crate::home::form::HomeFile;
use crate::link::form::{FaultFile, LinkFile, MovedFile};
use crate::link::moved_sensor;
use crate::problem::Problem;
use crate::scenario::source::{JsonSource, pointer_part};
use crate::sensor_set::MAX_SENSORS;
use crate::sensors::messages::SensorMessage;
use crate::time::{DAY, RunTime};

crate::messages! {
    /// Problems with the link between sensors and logger.
    pub enum LinkMessage in "link" {
        /// The interval of a day begins and ends at the same time. An interval that ends before it begins goes over midnight.
        EmptyInterval { from: String, to: String }
            error "empty-interval" ("the interval from {from:?} to {to:?} is empty")
            hint ("remove \"between\" for a whole day");
        /// A sensor has one clock, and the fault gives its drift for the whole run.
        TwoDrifts { sensor: String } error "two-drifts" ("the drift of {sensor:?} is given twice")
            hint ("remove one of them");
        /// A sensor can be moved once at an instant.
        MovedTwice { sensor: String, day: String } error "moved-twice" ("{sensor:?} is moved twice {day}")
            hint ("remove one of the moves, or put it on another day");
        /// Two faults of a sensor exclude each other, such as an empty battery and a stuck sensor. A fault without `days` lasts until the end
        /// of the run.
        FaultsOverlap {
            sensor: String,
            kind: String,
            days: String,
            other: String,
            /// The days of the other fault, in words.
            other_days: String,
            /// Whether the other fault has an end.
            other_ends: bool,
        } error "faults-overlap" ("{sensor:?} cannot have the fault {kind:?} {days}: it has the fault {other:?} {other_days}")
            advice (Some(match other_ends {
                _ if other == "moved" => "remove one of the two faults".to_owned(),
                true => "end one of the two faults before the other begins".to_owned(),
                false => format!("give the fault {other:?} an end with \"days\""),
            }));
        /// Motion sensors fire without a cause now and then. Other kinds of sensors do not.
        NotMotion { sensor: String }
            error "not-a-motion-sensor" ("{sensor:?} is not a motion sensor, so it has no false firings")
            hint ("remove this value, or name a motion sensor");
        /// A motion sensor on a wall can be moved to another wall. Other sensors belong to a thing or to an area.
        CannotMove { sensor: String }
            error "cannot-move" ("{sensor:?} cannot be moved: it is not a motion sensor on a wall")
            hint ("name a sensor of kind \"motion\"");
        /// A place that a sensor is moved to counts as a sensor, because the program computes its view, too.
        TooManyPlaces { most: usize }
            error "too-many-places" ("the sensors and the places to which faults move them add up to more than {most}")
            hint ("move fewer sensors");
        /// The fault is valid, and it begins after the end of the run, so it has no effect.
        FaultAfterEnd {
            kind: String,
            /// The sensor, where the fault has one.
            sensor: Option<String>,
            /// The begin of the fault, in local time.
            begin: String,
            /// The end of the run, in local time.
            end: String,
        } warning "fault-after-end"
            ("the fault {kind:?}{whose} begins on {begin}, after the run ends on {end}", whose = of_sensor(sensor))
            hint ("days count from 0: let the fault begin before the end, or run longer with --for");
        /// The sensors send at the same instants. On this kind of radio no sensor waits for another, so their messages collide and are lost.
        Simultaneous { sensors: Vec<String>, thing: String } warning "simultaneous-messages"
            ("{names} report {thing:?} at the same instants, and their messages collide", names = together(sensors))
            hint ("remove one of them, or choose another network");
    }
}

fn of_sensor(sensor: &Option<String>) -> String {
    sensor.as_ref().map_or(String::new(), |sensor| format!(" of {sensor:?}"))
}

fn together(names: &[String]) -> String {
    names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(" and ")
}

pub fn check(source: &JsonSource, file: &LinkFile, surroundings: &HomeInCheck, problems: &mut Vec<Problem>) {
    let report = &mut ProblemReport { source, problems };
    check_delay(report, "/delay_s", file.rates.delay_s);
    for (name, sensor) in &file.sensors {
        check_delay(report, &format!("/sensors/{}/delay_s", pointer_part(name)), sensor.delay_s);
    }
    for (index, fault) in file.faults.iter().enumerate() {
        check_times(report, index, fault);
    }
    for (second, fault) in file.faults.iter().enumerate() {
        let others = file.faults[..second].iter().filter(|other| other.sensor() == fault.sensor());
        if let Some(other) = others.into_iter().find(|other| contradict(other, fault)) {
            report_contradiction(report, second, other, fault);
        }
    }
    if let Some(home) = surroundings.home {
        check_sensors(report, file, home);
        check_places(report, file, home, surroundings);
    }
}

fn check_delay(report: &mut ProblemReport, pointer: &str, delay: Option<[f64; 2]>) {
    if let Some(range) = delay {
        report.range(pointer, "delay_s", range);
    }
}

/// Checks that times of day exist.
fn check_times(report: &mut ProblemReport, index: usize, fault: &FaultFile) {
    let mut wrong = |pointer: &str, text: &str| {
        let is_wrong = time_of_day(text).is_none();
        if is_wrong {
            report.add(pointer, TimeMessage::InvalidTimeOfDay { text: text.to_owned() });
        }
        is_wrong
    };
    match fault {
        FaultFile::FalseFires(fault) => {
            let Some([from, to]) = &fault.between else { return };
            let pointer = format!("/faults/{index}/between");
            let any = wrong(&format!("{pointer}/0"), from) | wrong(&format!("{pointer}/1"), to);
            if !any && time_of_day(from) == time_of_day(to) {
                report.add(&pointer, LinkMessage::EmptyInterval { from: from.clone(), to: to.clone() });
            }
        }
        FaultFile::Outage(fault) => {
            if let Some(at) = &fault.at {
                wrong(&format!("/faults/{index}/at"), at);
            }
        }
        _ => {}
    }
}

fn contradict(one: &FaultFile, other: &FaultFile) -> bool {
    use FaultFile::{BadLink, Battery, Drift, FallsOff, Moved, Stuck};
    let overlap = one.span().overlaps(other.span());
    match (one, other) {
        (Moved(one), Moved(other)) => one.from_day == other.from_day,
        // A sensor on the floor is not moved to another wall; a sensor that was moved may fall off there.
        (FallsOff(_), Moved(_)) => one.span().contains(other.span().begin),
        (Moved(_), FallsOff(_)) => other.span().contains(one.span().begin),
        (Battery(_) | Stuck(_) | FallsOff(_), Battery(_) | Stuck(_) | FallsOff(_)) => overlap,
        (BadLink(_), BadLink(_)) | (Drift(_), Drift(_)) => overlap,
        _ => false,
    }
}

fn report_contradiction(report: &mut ProblemReport, index: usize, one: &FaultFile, other: &FaultFile) {
    let sensor = other.sensor().unwrap_or_default().to_owned();
    let message = match (one, other) {
        (FaultFile::Drift(_), _) => LinkMessage::TwoDrifts { sensor },
        (FaultFile::Moved(_), FaultFile::Moved(_)) => LinkMessage::MovedTwice { sensor, day: days(other) },
        _ => LinkMessage::FaultsOverlap {
            sensor,
            kind: other.kind().to_owned(),
            days: days(other),
            other: one.kind().to_owned(),
            other_days: days(one),
            other_ends: one.span().end != RunTime::NEVER,
        },
    };
    report.add(&format!("/faults/{index}"), message);
}

fn days(fault: &FaultFile) -> String {
    let span = fault.span();
    let day = |at: RunTime| (at.since_zero().ratio(DAY) * 1000.0).round() / 1000.0;
    match fault {
        FaultFile::Moved(_) => format!("on day {}", day(span.begin)),
        _ if span.end == RunTime::NEVER => format!("from day {} on", day(span.begin)),
        _ => format!("from day {} to {}", day(span.begin), day(span.end)),
    }
}

fn check_sensors(report: &mut ProblemReport, file: &LinkFile, home: &HomeFile) {
    let names = home.sensors.iter().map(|sensor| sensor.name());
    let of_name = |name: &str| home.sensors.iter().find(|sensor| sensor.name() == name);
    let unknown = |report: &ProblemReport, name: &str| {
        let (nearest, known) = report.names_for(name, names.clone());
        SensorMessage::Unknown { sensor: name.to_owned(), nearest, known }
    };
    for (name, own) in &file.sensors {
        let pointer = format!("/sensors/{}", pointer_part(name));
        match of_name(name) {
            None => {
                let message = unknown(report, name);
                report.add_to_key(&pointer, message);
            }
            Some(sensor) if own.false_fires_per_h.is_some() && !sensor.senses_motion() => {
                let message = LinkMessage::NotMotion { sensor: name.clone() };
                report.add(&format!("{pointer}/false_fires_per_h"), message);
            }
            Some(_) => {}
        }
    }
    for (index, fault) in file.faults.iter().enumerate() {
        let Some(name) = fault.sensor() else { continue };
        let pointer = format!("/faults/{index}/sensor");
        match (of_name(name), fault) {
            (None, _) => {
                let message = unknown(report, name);
                report.add(&pointer, message);
            }
            (Some(sensor), FaultFile::FalseFires(_)) if !sensor.senses_motion() => {
                report.add(&pointer, LinkMessage::NotMotion { sensor: name.to_owned() });
            }
            (Some(_), FaultFile::Moved(moved)) if moved_sensor(moved, &home.sensors).is_none() => {
                report.add(&pointer, LinkMessage::CannotMove { sensor: name.to_owned() });
            }
            _ => {}
        }
    }
}

/// Checks places that sensors are moved to; each counts as one more sensor for the computation of views.
fn check_places(report: &mut ProblemReport, file: &LinkFile, home: &HomeFile, surroundings: &HomeInCheck) {
    let moved = file.faults.iter().enumerate().filter_map(|(index, fault)| match fault {
        FaultFile::Moved(moved) => Some((index, moved)),
        _ => None,
    });
    let mut sensors = home.sensors.len();
    for (index, moved) in moved {
        sensors += 1;
        if sensors == MAX_SENSORS + 1 {
            report.add(&format!("/faults/{index}"), LinkMessage::TooManyPlaces { most: MAX_SENSORS });
        }
        check_place(report, index, moved, home, surroundings);
    }
}

fn check_place(
    report: &mut ProblemReport,
    index: usize,
    moved: &MovedFile,
    home: &HomeFile,
    surroundings: &HomeInCheck,
) {
    let Some(plan) = surroundings.plan else { return };
    if let Some(sensor) = moved_sensor(moved, &home.sensors) {
        check_mounting(report, &format!("/faults/{index}"), &sensor, home, plan);
    }
}
