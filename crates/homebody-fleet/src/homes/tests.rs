use super::*;
use crate::{Churn, FleetSetup};
use homebody_core::event::Value;
use homebody_core::ids::SensorId;
use homebody_simulation::VariantOptions;
use std::collections::BTreeMap;

/// The delivered rows of each home: number, time, sensor and value, with the time from the start until they were due.
type RowsByHome = BTreeMap<String, Vec<(u64, RunTime, SensorId, Value, Span)>>;

const HOURS: i64 = 20;
/// The start of delivery.
const BEGIN: UtcTime = UtcTime::EPOCH.saturating_add(SECOND.times(1_000_000));

fn seeded(seed: u64) -> VariantOptions {
    VariantOptions { seed: Some(seed), ..VariantOptions::default() }
}

fn setup(homes: u32) -> FleetSetup {
    let scenario = |name: &str| homebody_simulation::template(name).unwrap().starting("2026-11-01T06:00:00").unwrap();
    FleetSetup {
        scenarios: vec![scenario("studio"), scenario("tigerplace")],
        homes,
        first: 1,
        variant: seeded(11),
        speed: Some(1.0),
        skew: Span::ZERO,
        churn: None,
        outages: None,
    }
}

/// Simulates a fleet with a fake clock that advances by `look`.
fn delivered(setup: FleetSetup, look: Span) -> (RowsByHome, FleetSimulation) {
    let fleet = setup.make(|_| ()).unwrap();
    let names: Vec<String> = fleet.fleet.homes.iter().map(|home| home.name.clone()).collect();
    let mut rows: RowsByHome = names.iter().map(|name| (name.clone(), Vec::new())).collect();
    let mut fleet = FleetSimulation::new(fleet, BEGIN);
    let mut now = BEGIN;
    while now < BEGIN + HOURS * HOUR {
        let mut due = Vec::new();
        fleet.due(now, usize::MAX, &mut due);
        for event in due {
            let FleetEvent::Row(row) = event else { continue };
            assert!(row.due <= now, "a message before it is due");
            let name = &names[row.home as usize];
            rows.get_mut(name).unwrap().push((row.seq, row.at, row.sensor, row.value, row.due - BEGIN));
        }
        while fleet.advance_one(now) {}
        assert!(fleet.simulated_to() >= now + AHEAD);
        now += look;
    }
    (rows, fleet)
}

/// The rows without the times of their delivery.
fn events(rows: &RowsByHome) -> BTreeMap<&str, Vec<(u64, RunTime, u32, String)>> {
    let event =
        |&(seq, at, sensor, value, _): &(u64, RunTime, SensorId, Value, Span)| (seq, at, sensor.0, value.to_string());
    // Messages that are due near the end may be missing, depending on the steps of the clock.
    let is_before = |(_, at, ..): &&(u64, RunTime, SensorId, Value, Span)| *at < RunTime::START + (HOURS - 1) * HOUR;
    rows.iter().map(|(name, rows)| (name.as_str(), rows.iter().filter(is_before).map(event).collect())).collect()
}

#[test]
fn a_home_is_the_same_whatever_becomes_of_the_fleet() {
    let (alone, _) = delivered(FleetSetup { first: 3, ..setup(1) }, 7 * SECOND);
    let (alone, three) = (events(&alone), "home00003");
    assert!(alone[three].len() > 50, "{}", alone[three].len());
    let outages = Outages::new(5 * MINUTE, 30 * SECOND);
    for (how, other) in [
        ("among others", setup(5)),
        ("with outages", FleetSetup { outages, ..setup(4) }),
        ("with clocks that differ", FleetSetup { skew: 90 * SECOND, ..setup(4) }),
        ("at another pace", FleetSetup { speed: Some(60.0), ..setup(4) }),
    ] {
        let (all, _) = delivered(other, if how == "at another pace" { SECOND / 2 } else { 11 * SECOND });
        assert_eq!(events(&all)[three], alone[three], "{how}");
    }
    // The controls: another home, and another seed.
    let (others, _) = delivered(setup(5), 7 * SECOND);
    assert_ne!(events(&others)["home00001"], alone[three]);
    assert_ne!(events(&others)["home00001"], events(&others)["home00005"]);
    let (reseeded, _) = delivered(FleetSetup { variant: seeded(12), first: 3, ..setup(1) }, 7 * SECOND);
    assert_ne!(events(&reseeded)[three], alone[three]);
}

#[test]
fn home_k_is_member_k_of_a_cohort() {
    let (rows, _) = delivered(FleetSetup { scenarios: setup(1).scenarios.split_off(1), ..setup(2) }, 7 * SECOND);
    let scenario = homebody_simulation::template("tigerplace").unwrap().starting("2026-11-01T06:00:00").unwrap();
    let cohort = scenario.cohort(2).seed(11).days(2).start().unwrap();
    let members = cohort.run_each(|_, mut run| {
        let mut firings = Vec::new();
        while let Some(batch) = run.next_batch()? {
            firings.extend(batch.firings.iter().map(|firing| (firing.seq, firing.at, firing.sensor.0, firing.value)));
        }
        Ok::<_, homebody_simulation::SimulationError>(firings)
    });
    for (member, rows) in members.unwrap().iter().zip(events(&rows).values()) {
        let is_before = |(_, at, ..): &&(u64, RunTime, u32, _)| *at < RunTime::START + (HOURS - 1) * HOUR;
        let member =
            member.iter().filter(is_before).map(|&(seq, at, sensor, value)| (seq, at, sensor, value.to_string()));
        assert_eq!(member.collect::<Vec<_>>(), *rows);
    }
}

#[test]
fn skew_and_outages_change_only_the_delivery() {
    let skew = 2 * SECOND;
    let outages = Outages::new(10 * MINUTE, MINUTE).unwrap();
    let fleet = FleetSetup { skew, ..setup(4) }.make(|_| ()).unwrap();
    let skews: Vec<Span> = (0..4).map(|home| fleet.skew(home)).collect();
    assert!(skews.iter().all(|&of| of != Span::ZERO && of.abs() <= skew), "{skews:?}");
    let (skewed, _) = delivered(FleetSetup { skew, ..setup(4) }, SECOND);
    for (rows, of) in skewed.values().zip(&skews) {
        let late = rows.iter().find(|(_, at, _, _, due)| *due - at.since_zero() != -*of);
        assert_eq!(late, None, "a clock that is ahead delivers earlier");
    }
    let (interrupted, fleet) = delivered(FleetSetup { outages: Some(outages), ..setup(4) }, SECOND);
    assert_eq!(fleet.outages(BEGIN + 1250 * SECOND), (2, false));
    let (mut held, mut all) = (0, 0);
    for (_, at, _, _, due) in interrupted.values().flatten() {
        assert_eq!(*due, outages.delivery(at.since_zero()));
        (held, all) = (held + usize::from(*due > at.since_zero()), all + 1);
    }
    assert!(held > all / 50 && held < all / 3, "{held} of {all}");
}

#[test]
fn an_offline_home_sends_nothing_and_others_are_the_same() {
    let churn = Some(Churn { stays: 30 * MINUTE, away: 10 * MINUTE });
    let (all, _) = delivered(setup(6), 7 * SECOND);
    let (some, fleet) = delivered(FleetSetup { churn, ..setup(6) }, 7 * SECOND);
    assert!(fleet.came > 50 && fleet.went > 50 && fleet.there <= 6);
    let (all, some) = (events(&all), events(&some));
    let count = |rows: Vec<usize>| rows.into_iter().sum::<usize>() as f64;
    let share = count(some.values().map(Vec::len).collect()) / count(all.values().map(Vec::len).collect());
    assert!((0.5..0.95).contains(&share), "{share}");
    for (name, rows) in &some {
        assert!(rows.iter().all(|row| all[name].contains(row)), "{name}");
    }
}

#[test]
fn rejects_empty_and_large_fleets() {
    for wrong in [
        setup(0),
        FleetSetup { first: 0, ..setup(1) },
        FleetSetup { first: 99_999, ..setup(2) },
        FleetSetup { speed: Some(0.0), ..setup(1) },
        FleetSetup { skew: -Span::MICROSECOND, ..setup(1) },
    ] {
        assert!(matches!(wrong.make(|_| ()), Err(crate::FleetError::Setup(_))));
    }
}
