//! A target that fails in each way, as a control of the tests.

use crate::choices::Choices;
use crate::target::{self, CaseFiles, ReadVerdict, Target};
use std::path::Path;
use std::thread;
use std::time::Duration;

pub const TARGET: Target = Target { name: "trial", cases: 1, seeds: Vec::new, mutate, run };

fn mutate(_: &mut CaseFiles, _: &[CaseFiles], _: &mut Choices) {}

fn run(files: &CaseFiles, _: &Path) -> Result<ReadVerdict, String> {
    match target::text(files, "way") {
        "accept" => Ok(ReadVerdict::Accepted),
        "panic" => panic!("a panic"),
        "panic elsewhere" => {
            let _ = thread::spawn(|| panic!("a panic of another thread")).join();
            Ok(ReadVerdict::Accepted)
        }
        "break" => Err("an invariant".into()),
        "hang" => {
            thread::sleep(Duration::from_secs(3600));
            Ok(ReadVerdict::Accepted)
        }
        "eat" => {
            let much: Vec<u8> = vec![1; 400 << 20];
            Ok(if much.len() > 7 { ReadVerdict::Accepted } else { ReadVerdict::Refused })
        }
        "devour" => {
            let much: Vec<u8> = vec![1; 1200 << 20];
            thread::sleep(Duration::from_secs(1));
            Ok(if much.len() > 7 { ReadVerdict::Accepted } else { ReadVerdict::Refused })
        }
        "die" => std::process::abort(),
        _ => Ok(ReadVerdict::Refused),
    }
}
