//! Cohorts from a list of profiles: their members, and invalid lists.

use crate::flat::flat;
use crate::folder::{Folder, says};
use serde_json::Value;
use std::process::Stdio;

/// The example's apartment and a list of people.
fn listed(list: &str) -> Folder {
    let folder = Folder::with("tigerplace");
    folder.write("people.csv", list);
    folder
}

const LIVE: &str = "run tigerplace --profiles people.csv --for 1d --quiet";

fn life(folder: &Folder, member: &str) -> [String; 3] {
    let path = |name: &str| format!("runs/{member}/{name}");
    let log = folder.query(&path("log.db"), "SELECT ts_local, sensor_id, event_code FROM event ORDER BY seq");
    [log.join("\n"), folder.truth_sha256(&path("truth.db")), folder.read(&path("recording.json"))]
}

fn files(folder: &Folder, member: &str) -> Value {
    let recording = folder.json(&format!("runs/{member}/recording.json"));
    recording["files"].clone()
}

fn routine_of(folder: &Folder, member: &str, resident: &str) -> String {
    let files = files(folder, member);
    let resident: Value = serde_json::from_str(files[format!("{resident}.json")].as_str().unwrap()).unwrap();
    files[resident["driver"]["routine"].as_str().unwrap()].as_str().unwrap().to_owned()
}

fn routine(folder: &Folder, member: &str) -> String {
    routine_of(folder, member, "margaret")
}

#[test]
fn every_member_lives_as_the_list_says() {
    let folder = listed(
        "name;seed;age;pace_mps;conditions;severity;onset;over;until\n\
         Anna Öz;;75;0.5;;;;;\n\
         bea;7;;;depression + Urinary tract infection;severe + ;week 6 + 2009-03-20;4 weeks + ;+ day 40\n\
         carl;;;;;;;;\n",
    );
    folder.run(LIVE).ok();
    let list = folder.json("runs/tigerplace-1/cohort.json");
    let members = list["members"].as_array().unwrap();
    let names: Vec<_> = members.iter().map(|member| member["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["Anna Öz", "bea", "carl"]);
    assert_eq!(members[0]["profile"]["pace_mps"], "0.5");
    assert_eq!((&members[1]["seed"], &members[1]["profile"]["until"]), (&Value::from(7), &Value::from("+ day 40")));
    assert_eq!((&members[2]["profile"], &members[2]["days"]), (&serde_json::json!({}), &Value::from(1.0)));
    let anna = routine(&folder, "tigerplace-1/Anna Öz");
    assert!(anna.contains("\nThe person is 75. The person walks at 0.5 m/s.\n"), "{anna}");
    assert!(!anna.contains("82") && !anna.contains("0.65"), "{anna}");
    let bea = routine(&folder, "tigerplace-1/bea");
    let conditions = "From week 6, over 4 weeks, the person shows severe depression.\n\
                      From 2009-03-20, until day 40, the person shows Urinary tract infection.\n";
    assert!(bea.ends_with(conditions), "{bea}");
    let given = folder.read("tigerplace/margaret.routine");
    assert_eq!(routine(&folder, "tigerplace-1/carl"), given);
    // A given pace is the pace of that member alone.
    let pace = |member: &str| {
        let steps = "SELECT to_x - from_x, to_y - from_y, (julianday(end_at) - julianday(begin_at)) * 86400 \
                     FROM movement WHERE kind = 'stride'";
        let steps = folder.query(&format!("runs/tigerplace-1/{member}/truth.db"), steps);
        let step = |row: &String| {
            let of: Vec<f64> = row.split('|').map(|number| number.parse().unwrap()).collect();
            (of[0].hypot(of[1]), of[2])
        };
        let (way, took) = steps.iter().map(step).fold((0.0, 0.0), |(way, took), step| (way + step.0, took + step.1));
        way / took
    };
    let (given, usual) = (pace("Anna Öz"), pace("carl"));
    assert!((0.35..0.5).contains(&given) && !(0.35..0.5).contains(&usual), "{given} m/s, {usual} m/s");
    folder.run("replay runs/tigerplace-1/bea/recording.json --out csv:b.csv").ok();
}

#[test]
fn a_members_life_depends_on_their_profile_and_seed_alone() {
    let head = "name,seed,conditions,onset\n";
    let (anna, bea) = ("anna,,depression,day 1\n", "bea,5,frailty,week 1\n");
    let folder = listed(&format!("{head}{anna}{bea}"));
    folder.run(LIVE).ok();
    let others: String = (0..6).map(|number| format!("other {number},{number},grief,\n")).collect();
    folder.write("people.csv", format!("{head}{others}{bea}{anna}"));
    folder.run(LIVE).ok();
    folder.write("people.csv", format!("{head}{bea}"));
    folder.run(LIVE).ok();
    for (member, cohorts) in [("anna", &[2][..]), ("bea", &[2, 3])] {
        let first = life(&folder, &format!("tigerplace-1/{member}"));
        for cohort in cohorts {
            assert!(first == life(&folder, &format!("tigerplace-{cohort}/{member}")), "{member} in {cohort}");
        }
    }
    // And alone in a thread, as a replay is.
    folder.run("replay runs/tigerplace-2/anna/recording.json --out csv:a.csv").ok();
    // A negative control: another name without a seed, and another seed, are other lives.
    folder.write("people.csv", format!("{head}ann,,depression,day 1\nbea,6,frailty,week 1\n"));
    folder.run(LIVE).ok();
    assert!(life(&folder, "tigerplace-1/anna")[0] != life(&folder, "tigerplace-4/ann")[0]);
    assert!(life(&folder, "tigerplace-1/bea")[0] != life(&folder, "tigerplace-4/bea")[0]);
}

#[test]
fn a_twin_is_the_same_until_the_onset() {
    let folder = listed("name,seed,conditions,severity,onset\nill,1,depression + insomnia,severe,day 2\nwell,1,,,\n");
    let live = "run tigerplace --profiles people.csv --for 2d --quiet";
    folder.run(live).ok();
    let days = |member: &str| {
        let sql = "SELECT ts_local, sensor_id FROM event WHERE ts_local";
        let of = |which: &str| folder.query(&format!("runs/{member}/log.db"), &format!("{sql} {which} '2009-03-03'"));
        (of("<"), of(">="))
    };
    let (ill, well) = (days("tigerplace-1/ill"), days("tigerplace-1/well"));
    assert!(ill.0 == well.0 && ill.0.len() > 1000);
    assert!(ill.1 != well.1);
    // Nobody has it, where anybody did.
    folder.run(&format!("{live} --without depression --without insomnia")).ok();
    assert!(days("tigerplace-2/ill") == well);
    folder.run("replay runs/tigerplace-2/ill/recording.json --out csv:a.csv").ok();
    let said = folder.run(&format!("{live} --without depresion --without grief")).fails(2, "2 problems").err;
    says(
        &said,
        &[
            "people.csv: error[members::no-condition]: no member of the list shows \"depresion\"\n  hint: did you mean \"depression\"?",
            "people.csv: error[members::no-condition]: no member of the list shows \"grief\"\n  hint: name a condition that the members show: depression, insomnia",
        ],
    );
}

#[test]
fn conditions_of_the_scenario_go_where_a_row_has_its_own() {
    let folder = Folder::with("tigerplace-depression");
    folder.write("people.csv", "name,conditions,severity\nas it is,,\nwell,none,\nfrail,frailty,mild\n");
    folder.run("run tigerplace-depression --profiles people.csv --for 1d --quiet").ok();
    let shows = |member: &str| {
        let routine = routine(&folder, &format!("tigerplace-depression-1/{member}"));
        let lines: Vec<String> = routine.lines().filter(|line| line.contains(" shows ")).map(String::from).collect();
        lines
    };
    assert!(shows("as it is")[0].contains("depression"));
    assert_eq!(shows("well"), [""; 0]);
    assert_eq!(shows("frail"), ["The person shows mild frailty."]);
}

#[test]
fn another_routine_and_one_of_several_residents_may_be_meant() {
    let folder = Folder::with("couple-with-cat");
    folder.write("couple-with-cat/early.routine", "She gets up at 05:00.\n");
    folder.write("people.csv", "name,resident,routine,age\nearly,Ruth,early.routine,70\nold,henry,,99\n");
    folder.run("run couple-with-cat --profiles people.csv --for 1d --quiet").ok();
    let routine = |member: &str, resident: &str| routine_of(&folder, &format!("couple-with-cat-1/{member}"), resident);
    assert_eq!(routine("early", "ruth"), "She gets up at 05:00.\n\nThe person is 70.\n");
    assert!(routine("old", "henry").contains("The person is 99."));
    folder.run("replay runs/couple-with-cat-1/early/recording.json --out csv:a.csv").ok();
    folder.write("people.csv", "name,resident,age\na,,70\nb,minka,12\nc,hnery,7x\nd,,\n");
    let said = folder.run("run couple-with-cat --profiles people.csv").fails(2, "4 problems").err;
    says(
        &said,
        &[
            "people.csv:2:4: error[members::which-resident]",
            "hint: add a column \"resident\" with the value henry or ruth",
            "people.csv:3:3: error[members::no-resident]: no resident with a routine is called \"minka\"",
            "people.csv:4:3: error[members::no-resident]",
            "did you mean \"henry\"?",
            "people.csv:4:9: error[members::number]: \"7x\"",
        ],
    );
}

#[test]
fn homes_may_be_mixed_each_with_the_ids_that_it_has() {
    let folder = Folder::with("studio");
    folder.copy_scenario("older-adult");
    let other = folder.read("older-adult/home.json");
    folder.write("studio/other.json", &other);
    folder.write("people.csv", "name,home,pace_mps\nhere,,\nthere,other.json,0.5\nback,home.json,\n");
    folder.run("run studio --profiles people.csv --for 1d --quiet").ok();
    let told = |member: &str| {
        let home = folder.query(&format!("runs/studio-1/{member}/truth.db"), "SELECT file, name FROM home");
        (home, files(&folder, &format!("studio-1/{member}")))
    };
    let ((here, own), (there, others), (back, same)) = (told("here"), told("there"), told("back"));
    assert_eq!((here, back), (vec!["home.json|Studio".to_owned()], vec!["home.json|Studio".to_owned()]));
    let name = serde_json::from_str::<Value>(&other).unwrap()["name"].as_str().unwrap().to_owned();
    assert_eq!(there, [format!("other.json|{name}")]);
    assert_eq!(own, same, "who is said to live where the scenario has it lives there");
    assert!(others["other.json"] == other.as_str() && others["home.json"].is_null());
    // The logger has ids of sensors that this home lacks: those that it has keep theirs.
    let ids = |files: &Value| {
        let logger: Value = serde_json::from_str(files["logger.json"].as_str().unwrap()).unwrap();
        logger["ids"].as_object().unwrap().keys().cloned().collect::<Vec<_>>()
    };
    assert!(ids(&others).len() < ids(&own).len());
    assert!(ids(&others).iter().all(|sensor| other.contains(&format!("{sensor:?}"))), "{:?}", ids(&others));
    let list = folder.json("runs/studio-1/cohort.json");
    let homes: Vec<_> = list["members"].as_array().unwrap().iter().map(|member| &member["profile"]["home"]).collect();
    assert_eq!(homes, ["home.json", "other.json", "home.json"]);
    folder.run("replay runs/studio-1/there/recording.json --out csv:a.csv").ok();
    // A missing member is simulated again, in the earlier home.
    let left = |name: &str| folder.read(&format!("runs/studio-1/there/{name}"));
    let before = ["log.txt", "recording.json"].map(left);
    folder.write("studio/other.json", folder.read("studio/home.json"));
    std::fs::remove_dir_all(folder.path("runs/studio-1/there")).unwrap();
    folder.run("run --resume runs/studio-1 --quiet").ok();
    assert!(["log.txt", "recording.json"].map(left) == before);
    // Problems with a home have the place of the row.
    folder.write("studio/broken.json", other.replacen("\"motion\"", "\"notion\"", 1));
    folder.write("people.csv", "name,home\na,none.json\nb,../home.json\nc,broken.json\n");
    let said = folder.run("run studio --profiles people.csv --for 1d").fails(2, "3 problems").err;
    says(
        &said,
        &[
            "people.csv:2:3: error[members::unreadable]: cannot read \"none.json\": there is no such file\n",
            "hint: name the file of a home in the scenario's folder",
            "people.csv:3:3: error[file::outside-folder]: \"../home.json\"",
            "people.csv:4:1: error[members::scenario]: the values of this row cause a problem at broken.json:",
        ],
    );
}

#[test]
fn refuses_options_that_a_cohort_does_not_have() {
    let folder = flat();
    let asked = "run flat --members 2 --for 1m --truth t.db --recording r.json --force --speed 60 --metrics 9464";
    let said = folder.run(asked).fails(2, "5 problems").err;
    says(
        &said,
        &[
            "error[run::cohort-option]: --truth: ",
            "error[run::cohort-option]: --recording: ",
            "error[run::cohort-option]: --force: ",
            "error[run::cohort-option]: --speed, --paused and --control: ",
            "error[run::cohort-option]: --metrics: ",
        ],
    );
    folder.run("run flat --for 1m --truth-tables brief").fails(2, "error[run::truth-tables]");
    assert!(!folder.path("runs").exists());
    // It begins where nothing is, but for what is hidden.
    folder.write("mine/mine.txt", "mine");
    folder
        .run("run flat --members 2 --for 1m --out csv:mine")
        .fails(1, "[kit::not-empty]: mine already contains mine.txt");
    folder.write("new/.hidden", "");
    folder.run("run flat --members 2 --for 1m --quiet --out csv:new").ok();
    folder.run("run flat --members 2 --for 1m --quiet --out csv:new").fails(1, "kit::not-empty");
}

#[test]
fn a_brief_truth_keeps_small_tables_and_replay_restores_the_others() {
    let folder = Folder::with("studio");
    let run = "run studio --members 1 --for 1d --quiet";
    folder.run(&format!("{run} --truth-tables brief")).ok();
    folder.run(&format!("{run} --truth-tables all")).ok();
    let tables = |run: &str| {
        let sql = "SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name";
        folder.query(&format!("runs/{run}/0001/truth.db"), sql)
    };
    let (brief, all) = (tables("studio-1"), tables("studio-2"));
    let gone: Vec<_> = all.iter().filter(|name| !brief.contains(name)).collect();
    assert_eq!(gone, ["cause", "lost", "movement", "off"]);
    folder.run("doctor runs/studio-1/0001").ok();
    folder.run("day runs/studio-1/0001 first").ok();
    let log = "label runs/studio-1/0001 --out csv:labelled.csv";
    folder.run(log).fails(1, "[log::table-left-out]");
    folder.run("replay runs/studio-1/0001/recording.json --out csv:log.csv --truth again.db").ok();
    let rooms = |place: &str| folder.query(place, "SELECT resident, at, room FROM room ORDER BY rowid");
    assert_eq!(rooms("again.db"), rooms("runs/studio-1/0001/truth.db"));
    let causes = |place: &str| folder.query(place, "SELECT count(*) FROM cause");
    assert_eq!(causes("again.db"), causes("runs/studio-2/0001/truth.db"));
    // A member of it that was killed goes on with what it keeps.
    std::fs::remove_file(folder.path("runs/studio-1/0001/truth.db")).unwrap();
    folder.run("run --resume runs/studio-1 --quiet").ok();
    assert_eq!(tables("studio-1"), brief);
}

#[test]
fn a_large_cohort_says_before_what_it_writes_and_leaves_out() {
    let folder = Folder::with("studio");
    let mut command = folder.command("run studio --members 100000 --for 365d --out parquet:cohort");
    let mut running = command.stderr(Stdio::piped()).spawn().unwrap();
    folder.until("a member is lived", |folder| folder.path("cohort/members/000001").exists());
    running.kill().unwrap();
    let said = String::from_utf8(running.wait_with_output().unwrap().stderr).unwrap();
    assert!(
        said.contains(
            "a large cohort stores no truth tables cause, off, movement and lost: --truth-tables all stores them"
        ),
        "{said}"
    );
    assert!(
        said.contains("100,000 members: about ") && said.contains(" billion rows and ") && said.contains(" GB, "),
        "{said}"
    );
    assert!(folder.read("cohort/cohort.json").contains("\"truth\": \"brief\""));
}

#[test]
fn a_row_of_the_list_changes_only_its_member() {
    let folder = Folder::with("couple-with-cat");
    let given = "\u{feff}Henry gets up at 05:00.\nHe is 85.\nHe shows depression. He walks at 0.7 m/s.\n";
    folder.write("couple-with-cat/henry.routine", given);
    let own = folder.read("couple-with-cat/ruth.routine");
    // Two who live by one text, and a row that names the other's.
    folder.write("couple-with-cat/both.routine", "\u{feff}The person gets up at 06:00. The person is 80.\n");
    for resident in ["henry", "ruth"] {
        let file = format!("couple-with-cat/{resident}.json");
        let json = folder.read(&file).replace(&format!("{resident}.routine"), "both.routine");
        folder.write(&file, json);
    }
    folder.write(
        "people.csv",
        "name,resident,routine,age,pace_mps,conditions\n\
         a,ruth,,70,0.4,grief\nb,ruth,ruth.routine,,0.3,\nc,ruth,henry.routine,60,,none\n",
    );
    folder.run("run couple-with-cat --profiles people.csv --for 1d --quiet").fails(2, "this routine is about \"ruth\"");
    folder.write("couple-with-cat/henry.routine", given.replace("Henry", "He"));
    folder.run("run couple-with-cat --profiles people.csv --for 1d --quiet").ok();
    let of = |member: &str, resident: &str| routine_of(&folder, &format!("couple-with-cat-1/{member}"), resident);
    let both = "The person gets up at 06:00. The person is 80.\n";
    let a = "The person gets up at 06:00. The person is 70.\n\nThe person walks at 0.4 m/s.\nThe person shows grief.\n";
    assert_eq!((of("a", "ruth").as_str(), of("a", "henry").as_str()), (a, both));
    assert_eq!(of("b", "ruth"), own.replace("She walks at about 0.7 m/s", "The person walks at 0.3 m/s") + "\n");
    let c = "He gets up at 05:00.\nThe person is 60.\n.................... He walks at 0.7 m/s.\n\n";
    assert_eq!((of("c", "ruth").as_str(), of("c", "henry").as_str()), (c, both));
    for member in ["a", "b", "c"] {
        folder.run(&format!("replay runs/couple-with-cat-1/{member}/recording.json --out csv:{member}.csv")).ok();
    }
}

#[test]
fn all_that_is_wrong_with_a_list_is_said_at_once() {
    let folder = listed(
        "name,seed,age,pace,conditions,severity,onset,over,routine,Name\n\
         anna,x,abc,,depresion,sever,weak 6,,none.routine\n\
         a/b,-1,200,,depression,,,4 weeks\n\
         ANNA,,,,none,severe\n\
         ,,80\n\
         eva,,,,grief + frailty,mild + mild + mild,\n\
         fay,,,,grief + Grief,,2009-13-01,4 weekz,../a.routine,,more\n\
         gil,,,,depression. She naps,,,,other.routine\n\
         hal,,0x1f,,\n\
         ida,,,,urinary tract infection + Urinary-tract-infection,slight + strong\n\
         jon,,,,depression + mild depression\n\
         ,-1,x,,depresion + grief,mild + + mild\n",
    );
    folder.write("tigerplace/other.routine", "She reeds.\n");
    let given = folder.files();
    let done = folder.run("run tigerplace --profiles people.csv --for 5000w").fails(2, "problems");
    says(
        &done.err,
        &[
            "people.csv:1:15: error[members::unknown-column]: there is no column \"pace\"",
            "hint: did you mean \"pace_mps\"?",
            "people.csv:1:59: error[members::same-column]",
            "people.csv:2:6: error[members::seed]: \"x\"",
            "people.csv:2:8: error[members::number]: \"abc\" is not a valid age in years",
            "people.csv:2:13: error[routine::unknown-condition]: \"depresion\"",
            "hint: did you mean \"depression\"?",
            "people.csv:2:23: error[members::severity]: \"sever\"",
            "hint: did you mean \"severe\"?",
            "people.csv:2:29: ",
            "people.csv:2:37: error[members::unreadable]: cannot read \"none.routine\"",
            "people.csv:3:1: error[members::bad-name]: the member name \"a/b\" is not valid as the name of a folder",
            "people.csv:3:5: error[members::seed]: \"-1\"",
            "people.csv:3:8: error[routine::age]",
            "people.csv:3:26: error[routine::no-beginning]",
            "people.csv:4:1: error[members::same-name]: two members are called \"ANNA\"",
            "people.csv:4:14: error[members::no-condition-in-row]",
            "people.csv:5:3: error[members::no-name]",
            "people.csv:6:24: error[members::value-count]: the cell has 3 values for 2 conditions",
            "people.csv:7:16: error[members::same-condition]: the condition \"Grief\"",
            "people.csv:7:23: error[routine::no-date]",
            "people.csv:7:34: ",
            "people.csv:7:42: error[file::outside-folder]: \"../a.routine\"",
            "people.csv:7:56: error[members::no-column]",
            "people.csv:8:8: error[members::not-plain]: cannot read \"depression. She naps\"",
            "other.routine:1:5: error[routine::unknown-verb]: \"reeds\"",
            "people.csv:9:6: error[members::number]: \"0x1f\"",
            "people.csv:10:34: error[members::same-condition]: the condition \"Urinary-tract-infection\"",
            "people.csv:11:21: error[members::same-condition]: the condition \"mild depression\"",
            "people.csv:12:2: error[members::no-name]",
            "people.csv:12:2: error[members::seed]: \"-1\"",
            "people.csv:12:5: error[members::number]: \"x\" is not a valid age in years",
            "people.csv:12:8: error[routine::unknown-condition]: \"depresion\"",
            "people.csv:12:26: error[members::value-count]: the cell has 3 values for 2 conditions",
        ],
    );
    assert_eq!(folder.files(), given);
}

#[test]
fn help_documents_and_program_know_the_same_columns() {
    let folder = listed("name,qqqqqq\n");
    let said = folder.run("run tigerplace --profiles people.csv").fails(2, "error[members::unknown-column]").err;
    let (_, known) = said.split_once("hint: there are ").unwrap();
    let known: Vec<&str> = known.lines().next().unwrap().split(", ").collect();
    let help = folder.run("run --help").ok().out;
    let (_, help) = help.split_once("Columns of --profiles:\n").unwrap();
    let helped: Vec<&str> = help.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert_eq!(helped, known);
    let document = include_str!("../../../../docs/how-to/simulate-a-cohort.md");
    let told: Vec<&str> = document.lines().filter_map(|line| line.strip_prefix("| `")?.split('`').next()).collect();
    assert_eq!(told, known);
}

#[test]
fn a_list_that_is_none_is_refused() {
    let folder = flat();
    folder.run("run flat --profiles people.csv").fails(1, "error[members::no-file]: people.csv: there is no such file");
    folder.run("run flat --profiles flat").fails(1, "error[members::folder]: flat: ");
    for (text, said) in [
        (&b""[..], "people.csv: error[members::no-name-column]"),
        (b"name,age\n", "people.csv: error[members::no-members]"),
        (b"name\n\"anna\nbea\n", "people.csv:2:2: error[members::open-quote]"),
        (b"name\n\xff\n", "people.csv: error[members::not-utf-8]"),
        (b"name,age\nanna,80\n", "people.csv:2:6: error[members::no-routine]"),
    ] {
        folder.write("people.csv", text);
        folder.run("run flat --profiles people.csv").fails(2, said);
    }
    folder.run("run flat --profiles people.csv --members 3").fails(2, "cannot be used with");
    // A member without differences may be on the list of any scenario.
    folder.write("people.csv", "name,seed\nanna,1\n");
    folder.run("run flat --profiles people.csv --for 1m").ok();
    assert!(folder.path("runs/flat-1/anna/log.db").is_file());
}

#[test]
fn a_long_list_of_faults_is_cut() {
    let rows: String = (0..300).map(|row| format!("m{row},x\n")).collect();
    let folder = listed(&format!("name,age\n{rows}"));
    let said = folder.run("run tigerplace --profiles people.csv").fails(2, "there are 200 more problems").err;
    assert_eq!(said.matches("error[members::number]").count(), 100);
}
