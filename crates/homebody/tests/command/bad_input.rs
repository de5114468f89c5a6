//! The command reports the problems of any files and arguments, and never panics.

use crate::flat::flat;
use crate::folder::{Folder, says};
use std::fs;

#[test]
fn all_that_is_wrong_is_said_at_once() {
    let folder = Folder::new();
    folder.copy_hand_written_day();
    folder.edit("tigerplace/scenario.json", "America/Chicago", "America/Chikago");
    folder.edit("tigerplace/home.json", "\"name\": \"bed\", \"at\"", "\"name\": \"bed\", \"att\"");
    folder.edit("tigerplace/logger.json", "\"fire_only\"", "\"fire-only\"");
    folder.edit("tigerplace/day.path.json", "\"02:41\"", "\"2:411\"");
    let given = folder.files();
    let places = [
        ("scenario.json:6:16: ", "did you mean \"America/Chicago\"?"),
        ("home.json:34:22: error[schema::unknown-key]", "did you mean \"at\"?"),
        ("logger.json:26:15: ", "did you mean \"fire_only\"?"),
        ("day.path.json:10:32: ", "from \"00:00\" to \"23:59:59.999999\""),
    ];
    for words in ["check tigerplace", "run tigerplace", "coverage tigerplace --svg map.svg"] {
        let said = folder.run(words).fails(2, "problems").err;
        let mut rest = said.as_str();
        for (place, hint) in places {
            let from = rest.find(place).unwrap_or_else(|| panic!("{place} is not told in its turn\n{said}"));
            rest = &rest[from..];
            let problem = &rest[..rest.find("\n\n").unwrap()];
            assert!(problem.lines().any(|line| line.ends_with('^')), "{problem}");
            assert!(problem.contains("\n  hint: ") && problem.contains(hint), "{problem}");
        }
        assert_eq!(folder.files(), given, "{words}");
    }
    let json = folder.run("check tigerplace --json");
    let problems = json.json()["problems"].as_array().unwrap().clone();
    for (place, _) in places {
        let of = |problem: &serde_json::Value| {
            format!("{}:{}:{}: ", problem["file"].as_str().unwrap(), problem["line"], problem["column"])
        };
        let problem = problems.iter().find(|problem| place.starts_with(&of(problem)));
        assert!(problem.is_some_and(|problem| problem["hint"].is_string() && problem["what"].is_string()), "{place}");
    }
    assert!(json.err.contains(&format!("{} problems", problems.len())));
}

#[test]
fn problems_of_routines_come_with_the_others() {
    let folder = Folder::with("tigerplace");
    folder.edit("tigerplace/scenario.json", "America/Chicago", "America/Chikago");
    folder.edit("tigerplace/logger.json", "\"fire_only\"", "\"fire-only\"");
    folder.edit("tigerplace/margaret.routine", "she watches television", "she wtches television");
    folder.edit("tigerplace/margaret.routine", "naps in the armchair", "naps in the armchiar");
    for words in ["check tigerplace", "routine check tigerplace", "run tigerplace"] {
        let said = folder.run(words).fails(2, "4 problems").err;
        says(
            &said,
            &["America/Chikago", "\"fire-only\"", "\"wtches", "did you mean \"watches television\"", "armchair"],
        );
    }
}

#[test]
fn refuses_wrong_arguments() {
    let folder = flat();
    let given = folder.files();
    for (words, said) in [
        ("", "Usage: homebody"),
        ("fly", "unrecognized subcommand 'fly'"),
        ("run", "required arguments were not provided"),
        ("run flat --for 7", "write a number with its unit"),
        ("run flat --days 7", "--for sets the duration, such as --for 7d"),
        ("run flat --day 7", "--for sets the duration, such as --for 7d"),
        ("run flat --day=7", "--for sets the duration, such as --for 7d"),
        ("run flat --fo 7d", "a similar argument exists: '--for'"),
        ("run flat --for 0s", "a duration is longer than 0 and at most 100 years"),
        ("run flat --for -1d", "'-1"),
        ("run flat --for 101000w", "a duration is longer than 0 and at most 100 years"),
        ("run flat --speed 0.05", "write a number from 0.1 to 1000, or max"),
        ("run flat --speed 1001", "write a number from 0.1 to 1000, or max"),
        ("run flat --speed NaN", "write a number from 0.1 to 1000, or max"),
        ("run flat --destination-timeout 0s", "such as 10s"),
        ("run flat --destination-timeout 10", "such as 10s"),
        ("run flat --destination-timeout 2h", "such as 10s"),
        ("run flat --destination-timeout soon", "such as 10s"),
        ("run flat --destination-timeout NaNs", "such as 10s"),
        ("run flat --destination-timeout 50ms", "such as 10s"),
        ("run flat --seed -1", "'-1"),
        ("run flat --seed 18446744073709551616", "invalid value"),
        ("run flat --paused", "--control"),
        ("run flat --out log.txt", "did you mean \"casas:log.txt\", or \"csv:log.txt\"?"),
        ("run flat --out week.xyz", "csv:FILE"),
        ("run flat --out week", "csv:FILE"),
        ("run flat --out mysql:log", "write sqlite:FILE, csv:FILE, casas:FILE"),
        ("run flat --out csv:", "does not name a file"),
        ("run flat --owt csv:a", "--out"),
        (
            "new home --template castle",
            "there is no such template; templates are: empty, by-hand, cameras, couple-with-cat, dark-hall, door-bell, house-two-floors, older-adult, postures, robot, sphere-house, studio, tigerplace, \
             tigerplace-decline, tigerplace-depression",
        ),
        ("convert flat/home.json --out csv:a --time-zone Mars/Olympus", "Mars/Olympus"),
        ("convert flat/home.json", "--out <DESTINATION>"),
        ("coverage flat --width 10", "200..=8000"),
        ("plan flat", "error[picture::no-file]"),
        (
            "plan flat --png a.jpg",
            "error[picture::form]: --png cannot write the file a.jpg, because its name ends in .jpg\n  hint: name the file a.png",
        ),
        (
            "plan flat --svg a.png",
            "error[picture::form]: --svg cannot write the file a.png, because its name ends in .png\n  hint: use --png for this file",
        ),
        ("serve flat --no-open --bind 192.0.2.1", "error[serve::foreign-address]"),
        ("experiment realism --data a", "--package homebody-lab -- realism"),
        ("completions klingon", "bash"),
    ] {
        folder.run(words).fails(2, said);
    }
    // A seed that is the largest there is, and a span as long as allowed, are fine.
    folder.run("run flat --seed 18446744073709551615 --for 1s --quiet --out csv:log.csv").ok();
    ["log.csv", "log.sensors.csv"].iter().for_each(|name| fs::remove_file(folder.path(name)).unwrap());
    assert_eq!(folder.files(), given);
}

#[test]
fn reports_why_a_path_is_not_a_scenario() {
    let folder = flat();
    fs::create_dir(folder.path("empty")).unwrap();
    folder.write("latin/scenario.json", b"{ \"name\": \"\xe9\" }");
    folder.write("folders/scenario.json/file", "");
    folder.write("other/scenario.json", folder.read("flat/home.json"));
    for command in ["check", "run", "coverage", "plan --svg plan.svg"] {
        for (scenario, code, said) in [
            (
                "nowhere",
                1,
                "error[open::no-scenario]: nowhere: there is no such scenario\n  hint: name a scenario's folder",
            ),
            ("flot", 1, "flot: there is no such scenario\n  hint: did you mean \"flat\"?"),
            ("empty", 1, "error[open::no-scenario-file]: empty/scenario.json: there is no such file"),
            ("folders", 1, "error[open::not-plain]: folders/scenario.json"),
            ("latin", 2, "cannot read \"scenario.json\": line 1 is not text in UTF-8\n  hint: save it as UTF-8"),
            ("other", 2, "scenario.json: error[file::wrong-kind]"),
            ("flat/home.json", 2, "home.json: error[file::wrong-kind]"),
        ] {
            folder.run(&format!("{command} {scenario}")).fails(code, said);
        }
    }
    assert!(!folder.path("runs").exists());
    folder.edit("flat/scenario.json", "\"home.json\"", "\"../flat/home.json\"");
    folder.run("check flat").fails(2, "error[file::outside-folder]");
}

/// Numbers as if by chance, the same each time.
struct Chance(u64);

impl Chance {
    fn below(&mut self, limit: usize) -> usize {
        // Marsaglia's xorshift.
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % limit as u64) as usize
    }
}

/// The signs of JSON's grammar, and characters that texts cannot contain.
const BYTES: &[u8] = b"{}[],:\"-.0123456789e\\\n\0 tfn\xff\xc3";

#[test]
fn no_file_makes_the_command_break_down() {
    let folder = Folder::with("tigerplace");
    let names = folder.files();
    let whole: Vec<Vec<u8>> = names.iter().map(|name| fs::read(folder.path(name)).unwrap()).collect();
    let mut chance = Chance(2009);
    let mut ended = [0, 0];
    for round in 0..100 {
        let which = chance.below(names.len());
        let mut bytes = whole[which].clone();
        let at = chance.below(bytes.len());
        match round % 5 {
            0 => bytes.truncate(at),
            1 => bytes[at] = BYTES[chance.below(BYTES.len())],
            2 => bytes.insert(at, BYTES[chance.below(BYTES.len())]),
            3 => drop(bytes.remove(at)),
            _ => {
                let digits: Vec<usize> = (0..bytes.len()).filter(|&at| bytes[at].is_ascii_digit()).collect();
                let place = digits[chance.below(digits.len())];
                bytes[place] = b"0123456789"[chance.below(10)];
            }
        }
        folder.write(&names[which], &bytes);
        let done = folder.run("check tigerplace");
        let what = format!("{} changed at byte {at}, round {round}: {}", names[which], done.err);
        match done.code {
            Some(0) => {
                ended[0] += 1;
                // Accepted files can be simulated.
                let lived = folder.run("run tigerplace --for 4h --quiet --force --out csv:log.csv");
                assert_eq!(lived.code, Some(0), "{what}{}", lived.err);
            }
            Some(2) => {
                ended[1] += 1;
                let names_a_file = done.err.contains(".json") || done.err.contains(".routine");
                assert!(names_a_file && done.err.contains("problem"), "{what}");
            }
            _ => panic!("{what}"),
        }
        folder.write(&names[which], &whole[which]);
    }
    assert!(ended[0] > 10 && ended[1] > 30, "{ended:?}");
}
