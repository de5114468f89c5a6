#![allow(clippy::disallowed_methods)]
mod home;
use home::{home, short};
use homebody_core::problem::Problem;
use homebody_routine::language::{Known, routine};
use homebody_routine::routine::{Activity, Routine};
fn known() -> Known {
    Known { usual: Activity::OWN_WAYS.to_vec(), ..home() }
}
fn read(text: &str) -> (Routine, Vec<Problem>) {
    routine("margaret.routine", text, &known())
}
#[test]
fn scratch() {
    let text = std::fs::read_to_string(std::env::var("SCRATCH").unwrap()).unwrap();
    for (i, line) in text.lines().enumerate() {
        let (found, problems) = read(line);
        let remarks: Vec<_> = found.remarks.iter().map(|r| r.text.clone()).collect();
        if problems.is_empty() {
            println!("{} {line}\n     = {} {remarks:?}", i + 1, short(&found));
        } else {
            println!("{} {line}", i + 1);
            for p in &problems {
                println!("     ! {} | {:?}", p.what, p.hint);
            }
        }
    }
}
