//! `link.json`: sensors that there are, spans that run forward, faults that can be at once.

use super::home::check_mounting;
use super::{Report, Surroundings};
use crate::link::moved_sensor;
use crate::problem::Problem;
use crate::scenario::calendar::time_of_day;
use crate::scenario::home::{HomeFile, SensorFile};
use crate::scenario::link::{FaultFile, LinkFile, MovedFile};
use crate::scenario::source::{Source, pointer_part};
use crate::sensor_set::MAX_SENSORS;
use crate::time::{DAY, Micros, NEVER};

pub fn check(source: &Source, file: &LinkFile, surroundings: &Surroundings, problems: &mut Vec<Problem>) {
    let report = &mut Report { source, problems };
    check_delay(report, "/delay_s", file.delay_s);
    for (name, sensor) in &file.sensors {
        check_delay(report, &format!("/sensors/{}/delay_s", pointer_part(name)), sensor.delay_s);
    }
    for (index, fault) in file.faults.iter().enumerate() {
        check_times(report, index, fault);
    }
    for (second, fault) in file.faults.iter().enumerate() {
        let others = file.faults[..second].iter().filter(|other| other.sensor() == fault.sensor());
        if let Some(other) = others.into_iter().find(|other| contradict(other, fault)) {
            tell_contradiction(report, second, other, fault);
        }
    }
    if let Some(home) = surroundings.home {
        check_sensors(report, file, home);
        check_places(report, file, home, surroundings);
    }
}

fn check_delay(report: &mut Report, pointer: &str, delay: Option<[f64; 2]>) {
    if let Some([least, most]) = delay.filter(|[least, most]| least > most) {
        let what = format!("the least of \"delay_s\", {least}, is more than its most, {most}");
        report.hinted(pointer, what, format!("write [{most}, {least}]"));
    }
}

/// Times of day that there are.
fn check_times(report: &mut Report, index: usize, fault: &FaultFile) {
    const HINT: &str = "write it as \"07:30\" or \"07:30:15.5\", from \"00:00\" to \"23:59:59.999999\"";
    let mut wrong = |pointer: &str, text: &str| {
        let is_wrong = time_of_day(text).is_none();
        if is_wrong {
            report.hinted(pointer, format!("{text:?} is no time of day"), HINT);
        }
        is_wrong
    };
    match fault {
        FaultFile::FalseFires(fault) => {
            let Some([from, to]) = &fault.between else { return };
            let pointer = format!("/faults/{index}/between");
            let any = wrong(&format!("{pointer}/0"), from) | wrong(&format!("{pointer}/1"), to);
            if !any && time_of_day(from) == time_of_day(to) {
                let hint = "leave \"between\" out if it is at any time";
                report.hinted(&pointer, format!("nothing is between {from:?} and {to:?}"), hint);
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

/// Whether one sensor cannot have both faults.
fn contradict(one: &FaultFile, other: &FaultFile) -> bool {
    use FaultFile::{BadLink, Battery, Drift, FallsOff, Moved, Stuck};
    let overlap = one.span().overlaps(&other.span());
    match (one, other) {
        (Moved(one), Moved(other)) => one.from_day == other.from_day,
        // Nobody hangs up elsewhere what lies on the floor; what hangs elsewhere may fall off there.
        (FallsOff(_), Moved(_)) => one.span().contains(other.span().begin),
        (Moved(_), FallsOff(_)) => other.span().contains(one.span().begin),
        (Battery(_) | Stuck(_) | FallsOff(_), Battery(_) | Stuck(_) | FallsOff(_)) => overlap,
        (BadLink(_), BadLink(_)) | (Drift(_), Drift(_)) => overlap,
        _ => false,
    }
}

fn tell_contradiction(report: &mut Report, index: usize, one: &FaultFile, other: &FaultFile) {
    let name = other.sensor().unwrap_or_default();
    let pointer = format!("/faults/{index}");
    let (of_one, of_other) = (days(one), days(other));
    let what = match (one, other) {
        (FaultFile::Drift(_), _) => format!("{name:?} has but one clock, and its drift is given twice"),
        (FaultFile::Moved(_), FaultFile::Moved(_)) => format!("{name:?} is moved twice {of_other}"),
        _ => {
            let (kind, other) = (one.kind(), other.kind());
            format!("{name:?} cannot be {other:?} {of_other}: it is {kind:?} {of_one}")
        }
    };
    let hint = match one.span().end {
        _ if matches!(one, FaultFile::Drift(_) | FaultFile::Moved(_)) => "keep the one that is meant",
        NEVER => "a fault without \"days\" never ends: say how long it lasts",
        _ => "let one end before the other begins",
    };
    report.hinted(&pointer, what, hint);
}

/// When a fault is, in words.
fn days(fault: &FaultFile) -> String {
    let span = fault.span();
    let day = |at: Micros| (at as f64 / DAY as f64 * 1000.0).round() / 1000.0;
    match fault {
        FaultFile::Moved(_) => format!("on day {}", day(span.begin)),
        _ if span.end == NEVER => format!("from day {} on", day(span.begin)),
        _ => format!("from day {} to {}", day(span.begin), day(span.end)),
    }
}

fn check_sensors(report: &mut Report, file: &LinkFile, home: &HomeFile) {
    let names = home.sensors.iter().map(|sensor| sensor.name());
    let of_name = |name: &str| home.sensors.iter().find(|sensor| sensor.name() == name);
    let unknown = |report: &Report, name: &str| {
        (format!("the home has no sensor {name:?}"), report.did_you_mean(name, names.clone()))
    };
    for (name, own) in &file.sensors {
        let pointer = format!("/sensors/{}", pointer_part(name));
        match of_name(name) {
            None => {
                let (what, hint) = unknown(report, name);
                report.problems.push(report.source.problem_with_key(&pointer, what, hint));
            }
            Some(sensor) if own.false_fires_per_h.is_some() && !sensor.senses_motion() => {
                let what = format!("{name:?} is no motion sensor: it does not fire for no reason");
                report.add(&format!("{pointer}/false_fires_per_h"), what);
            }
            Some(_) => {}
        }
    }
    for (index, fault) in file.faults.iter().enumerate() {
        let Some(name) = fault.sensor() else { continue };
        let pointer = format!("/faults/{index}/sensor");
        match (of_name(name), fault) {
            (None, _) => {
                let (what, hint) = unknown(report, name);
                report.problem(&pointer, what, hint);
            }
            (Some(sensor), FaultFile::FalseFires(_)) if !sensor.senses_motion() => {
                report.add(&pointer, format!("{name:?} is no motion sensor: it does not fire for no reason"));
            }
            (Some(sensor), FaultFile::Moved(_)) if !matches!(sensor, SensorFile::Motion(_)) => {
                let what = format!("{name:?} cannot be moved: only motion sensors on walls can");
                report.add(&pointer, what);
            }
            _ => {}
        }
    }
}

/// Places to which sensors are moved; a place is a sensor more for whoever reckons what is seen.
fn check_places(report: &mut Report, file: &LinkFile, home: &HomeFile, surroundings: &Surroundings) {
    let moved = file.faults.iter().enumerate().filter_map(|(index, fault)| match fault {
        FaultFile::Moved(moved) => Some((index, moved)),
        _ => None,
    });
    let mut sensors = home.sensors.len();
    for (index, moved) in moved {
        sensors += 1;
        if sensors == MAX_SENSORS + 1 {
            let what = format!("the sensors and the places they are moved to are more than {MAX_SENSORS}");
            report.add(&format!("/faults/{index}"), what);
        }
        check_place(report, index, moved, home, surroundings);
    }
}

fn check_place(report: &mut Report, index: usize, moved: &MovedFile, home: &HomeFile, surroundings: &Surroundings) {
    let Some(plan) = surroundings.plan else { return };
    if let Some(SensorFile::Motion(motion)) = moved_sensor(moved, &home.sensors) {
        check_mounting(report, &format!("/faults/{index}"), &motion, home, plan);
    }
}
