//! Creating scenarios: templates, schemas, completions.

use crate::folder::{Folder, ROOT};
use std::fs;
use std::path::Path;

fn names(folder: &str) -> Vec<String> {
    let entries = fs::read_dir(Path::new(ROOT).join(folder)).unwrap();
    let mut names: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn given_file(scenario: &str, file: &str) -> String {
    fs::read_to_string(Path::new(ROOT).join("scenarios").join(scenario).join(file)).unwrap()
}

/// A scenario is a folder by itself, so these are copies; they must not drift apart.
#[test]
fn the_tigerplace_scenarios_have_one_home() {
    for copy in ["tigerplace-depression", "tigerplace-decline"] {
        for file in ["home.json", "logger.json", "margaret.json"] {
            assert!(given_file("tigerplace", file) == given_file(copy, file), "{file} of {copy} is another");
        }
    }
}

#[test]
fn every_template_is_new_checked_and_run() {
    let folder = Folder::new();
    let templates = names("scenarios");
    assert!(templates.len() >= 9, "{templates:?}");
    for template in &templates {
        folder
            .run(&format!("new homes/{template} --template {template}"))
            .ok()
            .says(&[&format!("homebody run homes/{template}")]);
        folder.run(&format!("check homes/{template}")).ok();
        let scenario = folder.json(&format!("homes/{template}/scenario.json"));
        // A day of those that last for weeks.
        let span = if scenario["days"].as_f64().unwrap() > 1.0 { "--for 1d" } else { "" };
        folder.run(&format!("run homes/{template} {span} --quiet --out csv:{template}.csv")).ok();
        let part = if span.is_empty() { "" } else { "--for 12h" };
        folder.run(&format!("run {ROOT}/scenarios/{template} {part} --quiet --out csv:{template}-given.csv")).ok();
        let given = folder.read(&format!("{template}-given.csv"));
        assert!(folder.read(&format!("{template}.csv")).starts_with(&given), "{template}");
        assert!(folder.read(&format!("{template}.csv")).lines().count() > 5, "{template}");
        // Each file names an existing schema.
        let json = names(&format!("scenarios/{template}")).into_iter().filter(|name| name.ends_with(".json"));
        for name in json {
            let file = folder.json(&format!("homes/{template}/{name}"));
            let schema = file["$schema"].as_str().unwrap();
            assert!(folder.path(&format!("homes/{template}")).join(schema).is_file(), "{name}: {schema}");
            let given: serde_json::Value = serde_json::from_str(&given_file(template, &name)).unwrap();
            let schema = Path::new(ROOT).join("scenarios").join(template).join(given["$schema"].as_str().unwrap());
            assert!(schema.is_file(), "{name}: {}", schema.display());
        }
    }
    folder.run("new home").ok();
    assert!(folder.read("home/scenario.json").contains("\"name\": \"home\""), "it has the name of its folder");
    assert!(folder.path("home/margaret.json").is_file(), "the first example is the default");
}

#[test]
fn an_empty_home_says_what_it_lacks_until_it_is_drawn() {
    let folder = Folder::new();
    folder.run("new flat --template empty").ok().says(&["flat is ready, and empty", "homebody serve flat"]);
    folder.run("check flat").fails(2, "\"rooms\" must have");
    let home = r#"{ "name": "flat",
        "rooms": [{ "name": "room", "outline": [[0, 0], [6, 0], [6, 5], [0, 5]] }],
        "walls": [{ "from": [0, 0], "to": [6, 0] }, { "from": [6, 0], "to": [6, 5] },
                  { "from": [6, 5], "to": [0, 5] }, { "from": [0, 5], "to": [0, 0] }] }"#;
    folder.write("flat/home.json", home);
    folder.run("check flat").fails(2, "error[need::no-bed]");
    let bed =
        r#""furniture": [{ "name": "bed", "at": [1.2, 4], "size_m": [2, 0.9], "height_m": 0.6, "enterable": true }] }"#;
    folder.write("flat/home.json", home.replace("\"to\": [0, 0] }] }", &format!("\"to\": [0, 0] }}], {bed}")));
    folder
        .run("check flat")
        .fails(2, "error[need::no-toilet]")
        .says(&["error[need::no-seat]", "error[need::no-kitchen]"]);
    folder.run("new other --template nothing").fails(2, "templates are: empty, by-hand");
}

#[test]
fn a_picture_lies_below_an_empty_home() {
    let folder = Folder::new();
    let mut picture = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".to_vec();
    picture.extend(1_000_u32.to_be_bytes().into_iter().chain(500_u32.to_be_bytes()));
    folder.write("plan.png", picture);
    let known = "--known 0,500=0,0 --known 1000,500=10,0";
    folder
        .run(&format!("new flat --image plan.png {known}"))
        .ok()
        .says(&["draw over the image", "homebody serve flat"]);
    assert!(folder.path("flat/plan.png").is_file() && folder.read("flat/underlay.json").contains("\"width_m\": 10.0"));
    folder.run("check flat").fails(2, "\"rooms\" must have");
    // A plan of another program's form is sent there.
    folder.run("import plan.png other").fails(2, "it is an image in PNG\n  hint: homebody new my-home --image");
    folder.run("new second --image plan.png").fails(2, "--known 120,340=0,0");
    folder.run(&format!("new third --image plan.png {known} --template studio")).fails(2, "--template");
    assert!(!folder.path("other").exists() && !folder.path("second").exists());
}

#[test]
fn the_help_names_every_template() {
    let help = Folder::new().run("new --help").ok().out;
    for template in names("scenarios") {
        let line = help.lines().find(|line| line.trim_start().starts_with(&format!("{template} ")));
        let about: serde_json::Value = serde_json::from_str(&given_file(&template, "scenario.json")).unwrap();
        let words =
            line.unwrap_or_else(|| panic!("{template} is not in\n{help}")).trim_start()[template.len()..].trim();
        assert!(!words.is_empty() && about["about"].as_str().unwrap().starts_with(words), "{words}");
    }
}

#[test]
fn creates_nothing_over_existing_files() {
    let folder = Folder::new();
    folder.write("full/precious", "mine");
    folder.write("file", "mine");
    fs::create_dir(folder.path("empty")).unwrap();
    let given = folder.files();
    for place in ["full", "file", "empty", ".", "typo/..", "full/."] {
        folder.run(&format!("new {place}")).fails(1, "kit::exists");
    }
    assert_eq!(folder.files(), given);
}

#[test]
fn the_schemas_are_those_of_the_repository() {
    let folder = Folder::new();
    let told = folder.run("schema some/schemas").ok().err;
    let checked_in = names("schemas");
    assert!(checked_in.len() >= 6);
    assert_eq!(folder.files(), checked_in.iter().map(|name| format!("some/schemas/{name}")).collect::<Vec<_>>());
    for name in checked_in {
        let ours = fs::read_to_string(Path::new(ROOT).join("schemas").join(&name)).unwrap();
        assert!(folder.read(&format!("some/schemas/{name}")) == ours, "{name}: homebody schema schemas");
        assert!(told.contains(&name));
    }
    // Once more, over older ones.
    folder.write("some/schemas/home.schema.json", "{}");
    folder.run("schema some/schemas").ok();
    assert!(folder.read("some/schemas/home.schema.json").len() > 100);
}

#[test]
fn shells_complete_every_command() {
    let folder = Folder::new();
    let help = folder.run("help").ok().out;
    let commands: Vec<&str> = help
        .lines()
        .skip_while(|line| *line != "Simulate:")
        .take_while(|line| *line != "Options:")
        .filter(|line| line.starts_with("  "))
        .map(|line| line.split_whitespace().next().unwrap())
        .collect();
    assert!(commands.len() >= 10, "{commands:?}");
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = folder.run(&format!("completions {shell}")).ok().out;
        for command in &commands {
            // Words alone stand in any script; this is how each names a command of the program's.
            let form = match shell {
                "bash" => format!("homebody,{command})"),
                "zsh" => format!("'homebody {command} commands'"),
                "fish" => format!("needs_command\" -f -a \"{command}\""),
                "powershell" => format!("'homebody;{command}'"),
                _ => format!("&'homebody;{command}'="),
            };
            assert!(script.contains(&form), "{shell} {command}");
        }
    }
}
