//! Real plans of Sweet Home 3D, which are not in the repository: the number of valid homes, and of homes with an ordinary day.
//!
//! `HOMEBODY_PLANS` names a folder with `.sh3d` files. Without it, the tests use plans that they write.

use crate::drawn_plans::whole_plans;
use crate::folder::Folder;
use crate::imports::day;
use homebody_core::home::form::HomeFile;
use homebody_core::plan::Plan;
use homebody_core::role::Role;
use homebody_routine::behaviour::places::HomePlaces;
use homebody_walk::Mesh;
use std::fs;
use std::path::PathBuf;

/// Furniture for an ordinary routine, and its names in messages.
const NEEDED: [(&str, &[Role]); 4] = [
    ("bed", &[Role::Bed]),
    ("seat", &[Role::Armchair, Role::Sofa, Role::DiningSeat]),
    ("toilet", &[Role::Toilet]),
    ("kitchen", &[Role::Fridge, Role::Stove]),
];

/// An older adult's body.
const BODY_M: f64 = 0.22;

/// Least share of the plans with all furniture in which the routine runs.
const LEAST_SHARE: f64 = 0.9;

/// Least values of an ordinary day: hours asleep, meals, visits to the bathroom (our choice).
const LEAST: [f64; 3] = [4.0, 2.0, 2.0];

struct Found {
    has_all: bool,
    is_lived_in: bool,
    told: String,
}

/// The files to go through, each with its name.
fn plans() -> Vec<(String, Vec<u8>)> {
    let Some(folder) = std::env::var_os("HOMEBODY_PLANS").map(PathBuf::from) else { return whole_plans() };
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> = files.filter(|path| path.extension().is_some_and(|end| end == "sh3d")).collect();
    files.sort();
    let name = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().into_owned();
    files.iter().map(|path| (name(path), fs::read(path).unwrap())).collect()
}

fn found(bytes: &[u8]) -> Found {
    let folder = Folder::new();
    folder.write("plan.sh3d", bytes);
    let imported = folder.run("import plan.sh3d mine");
    if imported.code != Some(0) {
        let told = imported.err.lines().next().unwrap_or_default().to_owned();
        return Found { has_all: false, is_lived_in: false, told };
    }
    let home: HomeFile = serde_json::from_str(&folder.read("mine/home.json")).unwrap();
    let plan = Plan::new(&home);
    let places = HomePlaces::new(&home, &plan, &Mesh::new(&plan, BODY_M), "anna");
    let has = |roles: &[Role]| roles.iter().any(|&role| places.has(role));
    let has_all = NEEDED.iter().all(|(_, roles)| has(roles));
    let needed: Vec<String> =
        NEEDED.iter().map(|(name, roles)| format!("{name} {}", if has(roles) { "yes" } else { "no" })).collect();
    let reached = places.all().iter().filter(|spot| spot.is_reachable).count();
    let lacks: Vec<&str> = imported.err.lines().filter(|line| line.contains("[new-home::routine-lacks]")).collect();
    let day = lacks.is_empty().then(|| day(&folder, "mine"));
    let is_lived_in = day.is_some_and(|day| day.iter().zip(LEAST).all(|(had, least)| *had >= least));
    let day = match day {
        Some([asleep_h, meals, visits]) => {
            format!("asleep {asleep_h:.1} h, {meals} meals, {visits} visits to the bathroom")
        }
        None => lacks.join("; "),
    };
    let told = format!(
        "{} rooms, {} doors, way out {}, {} of {} spots reached, {}; lived in: {} ({day})",
        home.rooms.len(),
        home.doors.len(),
        if home.doors.iter().any(|door| door.outside) { "yes" } else { "no" },
        reached,
        places.all().len(),
        needed.join(", "),
        if is_lived_in { "yes" } else { "no" },
    );
    Found { has_all, is_lived_in, told }
}

#[test]
fn in_nine_of_ten_plans_that_have_what_a_life_needs_somebody_lives() {
    let (mut whole, mut lived_in) = (0, 0);
    let plans = plans();
    for (name, bytes) in &plans {
        let Found { has_all, is_lived_in, told } = found(bytes);
        println!("{name}: {told}");
        whole += usize::from(has_all);
        lived_in += usize::from(has_all && is_lived_in);
    }
    println!(
        "{} plans, {whole} with a bed, a seat, a toilet and a kitchen; somebody lives in {lived_in} of these",
        plans.len()
    );
    assert!(
        lived_in as f64 >= LEAST_SHARE * whole as f64,
        "somebody lives in {lived_in} of {whole} plans that have all"
    );
    assert!(whole > 0 || std::env::var_os("HOMEBODY_PLANS").is_some());
}
