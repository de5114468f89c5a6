//! Debug dump of routines.
#![allow(clippy::disallowed_methods, clippy::print_stdout, dead_code)]
#[path = "../tests/home/mod.rs"]
mod home;
use home::{home, short};
use homebody_routine::language::{KnownNames, condition, routine};
use homebody_routine::routine::Activity;

fn main() {
    let mut known = KnownNames { usual: Activity::OWN_WAYS.to_vec(), ..home() };
    for extra in ["sewing chair", "computer", "club", "balcony", "desk"] {
        known.places.push(extra.into());
        known.things.push(extra.into());
    }
    for condition in ["grief", "frailty", "recovery", "insomnia"] {
        known.conditions.push(condition.into());
    }
    let mode = std::env::args().nth(1).unwrap();
    let start = std::time::Instant::now();
    for file in std::env::args().skip(2) {
        let text = std::fs::read_to_string(&file).unwrap();
        let show = |text: &str| {
            let name = text.lines().find_map(|line| line.split_once(" is ").map(|(name, _)| name.to_owned()));
            let mut known = known.clone();
            known.person = name.filter(|name| {
                !name.contains(' ') && name.starts_with(char::is_uppercase) && name != "She" && name != "He"
            });
            if known.person.is_none() {
                known.person = Some("Margaret".into());
            }
            let (routine, problems) =
                if text.contains("CONDITION") || file.contains("conditions/") || file.contains("ordinary") {
                    condition("x", text, &known)
                } else {
                    routine("x", text, &known)
                };
            for problem in &problems {
                println!(
                    "    PROBLEM {}:{} {} | {}",
                    problem.line,
                    problem.column,
                    problem.what,
                    problem.hint.as_deref().unwrap_or("")
                );
            }
            println!("    {}", short(&routine).replace(" & ", "\n    & "));
            for remark in &routine.remarks {
                println!("    remark: {}", remark.text);
            }
        };
        println!("== {file}");
        if mode == "lines" {
            for line in text.lines().filter(|line| !line.trim().is_empty()) {
                let said = match serde_json::from_str::<serde_json::Value>(line) {
                    Ok(value) => value["text"].as_str().or(value["say"].as_str()).unwrap_or_default().to_owned(),
                    Err(_) => line.to_owned(),
                };
                println!("{said}");
                show(&said);
            }
        } else {
            show(&text);
        }
    }
    eprintln!("{:?}", start.elapsed());
}
