use super::*;
use crate::routine::USUAL;
use homebody_core::home::form::HomeFile;
use homebody_core::plan::Plan;
use homebody_walk::Mesh;
use std::collections::BTreeSet;

/// The places of an activity in the example apartment, over many days, by name.
fn ways(activity: &Activity, places: &HomePlaces) -> BTreeSet<String> {
    let steps = (0..40).flat_map(|seed| {
        let mut stream = Stream::named(seed, "script");
        let at = places.for_role(Role::Armchair).unwrap().at;
        let mut setting = ActivitySetting {
            places,
            at,
            stream: &mut stream,
            forgotten: Vec::new(),
            spared: Vec::new(),
            movement: 1.0,
        };
        script(activity, None, 20 * MINUTE, None, &mut setting)
    });
    let goes = steps.filter_map(|step| match step {
        ActivityStep::Go(spot) => Some(spot.name),
        _ => None,
    });
    goes.collect()
}

#[test]
fn the_roles_that_are_acted_on_are_those_of_the_scripts() {
    let home = include_str!("../../../../../scenarios/tigerplace/home.json");
    let home: HomeFile = serde_json::from_str(&home.replace("\"nightstand\"", "\"medicine cabinet\"")).unwrap();
    let plan = Plan::new(&home);
    let places = HomePlaces::new(&home, &plan, &Mesh::new(&plan, 0.22), "margaret");
    let mut acted = BTreeSet::new();
    for activity in USUAL.iter().chain(&[Activity::Shower, Activity::TakeMedicine, Activity::Visit]) {
        for seed in 0..40 {
            let (mut stream, at) = (Stream::named(seed, "script"), places.for_role(Role::Armchair).unwrap().at);
            let mut setting = ActivitySetting {
                places: &places,
                at,
                stream: &mut stream,
                forgotten: Vec::new(),
                spared: Vec::new(),
                movement: 1.0,
            };
            let steps = script(activity, None, 20 * MINUTE, None, &mut setting);
            acted.extend(steps.into_iter().filter_map(|step| match step {
                ActivityStep::Act(thing, _) => Some(places.thing_name(thing).to_owned()),
                _ => None,
            }));
        }
    }
    let things = ACTED_ON.iter().filter_map(|&role| places.thing(role));
    assert_eq!(acted, things.map(|thing| places.thing_name(thing).to_owned()).collect());
}

#[test]
fn the_roles_of_an_activity_are_those_that_its_script_goes_to() {
    let home = include_str!("../../../../../scenarios/tigerplace/home.json");
    let home: HomeFile = serde_json::from_str(home).unwrap();
    let plan = Plan::new(&home);
    let places = HomePlaces::new(&home, &plan, &Mesh::new(&plan, 0.22), "margaret");
    let more = [
        Activity::Shower,
        Activity::TakeMedicine,
        Activity::Nap,
        Activity::Exercise,
        Activity::UseComputer,
        Activity::Relax,
        Activity::ComeHome,
        Activity::Other("knits".into()),
    ];
    for activity in USUAL.iter().chain(&more) {
        // The night and rising have steps of their own.
        if matches!(activity, Activity::GetUp | Activity::GoToBed) {
            continue;
        }
        let names = activity.roles().iter().map(|&role| places.for_role(role).unwrap().name.clone());
        assert_eq!(ways(activity, &places), names.collect(), "{activity:?}");
    }
    // A visitor's seat is not part of the host's steps.
    let names = [Role::FrontDoor, Role::Armchair].map(|role| places.for_role(role).unwrap().name.clone());
    assert_eq!(ways(&Activity::Visit, &places), names.into());
}
