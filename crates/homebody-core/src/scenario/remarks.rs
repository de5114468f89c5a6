//! What is not wrong with a scenario, but hardly meant: faults that come when the run is over, sensors that always speak at
//! once on one channel.

use super::check::link::LinkMessage;
use super::home::SensorFile;
use super::link::{FaultFile, LinkFile};
use super::load::Scenario;
use super::source::Source;
use crate::problem::Problem;
use crate::sensors::form::Moment;
use crate::time::Micros;
use std::collections::BTreeMap;

/// What is to be said of a scenario whose run is so long. Nothing of it keeps anybody from running it.
pub fn of(scenario: &Scenario, length: Micros) -> Vec<Problem> {
    let Some((name, link)) = scenario.file.link.as_ref().zip(scenario.link.as_ref()) else { return Vec::new() };
    let text = scenario.sources.get(name).map(String::as_str).unwrap_or_default();
    let Ok(source) = Source::parse(name, text) else { return Vec::new() };
    let mut remarks = too_late(&source, link, scenario, length);
    remarks.extend(at_once(&source, link, &scenario.home.sensors));
    remarks
}

/// Faults that begin when the run is over.
fn too_late(source: &Source, link: &LinkFile, scenario: &Scenario, length: Micros) -> Vec<Problem> {
    let calendar = &scenario.calendar;
    let begins = |fault: &FaultFile| fault.span_from(calendar.start_of_day()).begin;
    let faults = link.faults.iter().enumerate().filter(|(_, fault)| begins(fault) >= length);
    let remark = |(index, fault): (usize, &FaultFile)| {
        let (kind, sensor) = (fault.kind().to_owned(), fault.sensor().map(str::to_owned));
        let on_wall = |at: Micros| calendar.local(at).strftime("%Y-%m-%d at %H:%M").to_string();
        let (begin, end) = (on_wall(begins(fault)), on_wall(length));
        let message = LinkMessage::FaultAfterEnd { kind, sensor, begin, end };
        source.problem(&format!("/faults/{index}"), message, None)
    };
    faults.map(remark).collect()
}

/// Sensors of one thing that always have something to say at the same instant, on a channel on which nobody waits.
fn at_once(source: &Source, link: &LinkFile, sensors: &[SensorFile]) -> Vec<Problem> {
    if link.channel().is_none() {
        return Vec::new();
    }
    let mut speakers: BTreeMap<Moment, Vec<&str>> = BTreeMap::new();
    for sensor in sensors {
        if let Some(instant) = sensor.moment() {
            speakers.entry(instant).or_default().push(sensor.name());
        }
    }
    let together = speakers.into_iter().filter(|(_, names)| names.len() > 1);
    let remark = |(instant, names): (Moment, Vec<&str>)| {
        let (Moment::Pressed(thing, _) | Moment::Used(thing)) = instant;
        let (sensors, thing) = (names.into_iter().map(str::to_owned).collect(), thing.to_owned());
        let at = if link.radio.is_some() { "/radio" } else { "/preset" };
        source.problem(at, LinkMessage::Simultaneous { sensors, thing }, None)
    };
    together.map(remark).collect()
}
