//! A target that fails in each way that there is, so that who looks for failures is seen to find them.

use crate::dice::Dice;
use crate::target::{self, Files, Target, Verdict};
use std::path::Path;
use std::thread;
use std::time::Duration;

pub const TARGET: Target =
    Target { name: "trial", about: "failures of each kind, to be found", cases: 8, corpus, mutate, run };

/// What each case does; the last is begun by a mutant.
const WAYS: [&str; 7] = ["accept", "refuse", "panic", "panic elsewhere", "break", "hang", "eat"];

fn corpus() -> Vec<Files> {
    WAYS.iter().map(|way| Files::from([("way".to_owned(), way.as_bytes().to_vec())])).collect()
}

fn mutate(files: &mut Files, _: &[Files], _: &mut Dice) {
    files.insert("way".to_owned(), b"die".to_vec());
}

fn run(files: &Files, _: &Path) -> Result<Verdict, String> {
    match target::text(files, "way") {
        "accept" => Ok(Verdict::Accepted),
        "panic" => panic!("a panic"),
        "panic elsewhere" => {
            let _ = thread::spawn(|| panic!("a panic of another thread")).join();
            Ok(Verdict::Accepted)
        }
        "break" => Err("an invariant".into()),
        "hang" => {
            thread::sleep(Duration::from_secs(3600));
            Ok(Verdict::Accepted)
        }
        "eat" => {
            let much: Vec<u8> = vec![1; 400 << 20];
            Ok(if much.len() > 7 { Verdict::Accepted } else { Verdict::Refused })
        }
        "die" => std::process::abort(),
        _ => Ok(Verdict::Refused),
    }
}
