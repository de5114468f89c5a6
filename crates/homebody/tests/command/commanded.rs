//! A home in real time gets commands from a broker: it records them, resumes with them, and replays to the same bytes.

use crate::folder::{Ends, Folder, signal};
use crate::mosquitto::Broker;
use serde_json::{Value, json};
use std::fs;
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

/// Gives a home an order until it is not refused because the home is away or catches up; the answer.
fn order(folder: &Folder, port: u16, number: u32, mut order: Value) -> Value {
    order["id"] = number.into();
    let port = port.to_string();
    let place = ["-h", "127.0.0.1", "-p", &port, "-q", "1"];
    for _ in 0..200 {
        let answers = folder.path("answer.json");
        let file = fs::File::create(&answers).unwrap();
        let mut listener = Command::new("mosquitto_sub");
        listener.args(place).args(["-t", "homebody/studio/command/result"]).stdout(file).stderr(Stdio::null());
        let _listener = Ends(listener.spawn().unwrap());
        thread::sleep(Duration::from_millis(100));
        let text = order.to_string();
        let said =
            Command::new("mosquitto_pub").args(place).args(["-t", "homebody/studio/command", "-m", &text]).status();
        assert!(said.unwrap().success());
        for _ in 0..40 {
            thread::sleep(Duration::from_millis(25));
            let read = fs::read_to_string(&answers).unwrap();
            let mut answers = read.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
            match answers.rfind(|answer| answer["id"] == number) {
                Some(answer) if answer["why"] == "the run is still repeating its stored part" => break,
                Some(answer) => return answer,
                None => {}
            }
        }
    }
    panic!("nobody has answered {order}");
}

#[test]
fn what_a_broker_orders_is_noted_gone_on_with_and_replayed() {
    let folder = Folder::new();
    let Some(broker) = Broker::start() else { return };
    let port = broker.port;
    folder.copy_scenario("studio");
    folder.edit("studio/logger.json", "casas:log.txt", "sqlite:log.db");
    let live = format!("live studio --folder home --quiet --out mqtt://127.0.0.1:{port}/homebody");
    let begin = || Ends(folder.command(&live).stdout(Stdio::null()).spawn().unwrap());
    let says = |what: &str| {
        let query = format!("SELECT count(*) FROM firing WHERE value = '{what}'");
        folder.path("home/log.db").exists() && folder.query("home/log.db", &query) != ["0"]
    };

    let home = begin();
    let opened = order(&folder, port, 1, json!({ "do": "open", "thing": "front door" }));
    assert!(opened["ok"] == true && opened["sim_time"].as_str().is_some(), "{opened}");
    let again = order(&folder, port, 2, json!({ "do": "open", "thing": "front door" }));
    assert!(again["ok"] == false && again["why"].as_str().unwrap().contains("already"), "{again}");
    let fallen = order(&folder, port, 3, json!({ "do": "fall", "resident": "walter", "minutes": 0.05 }));
    assert_eq!(fallen["ok"], true, "{fallen}");
    folder.until("the door has said so", |_| says("OPEN"));
    // It dies, and is gone on with: what was noted is done again.
    drop(home);
    let mut home = begin();
    let shut = order(&folder, port, 4, json!({ "do": "close", "thing": "front door" }));
    assert_eq!(shut["ok"], true, "{shut}");
    let dead = order(&folder, port, 5, json!({ "do": "fault", "sensor": "hall motion", "kind": "dead" }));
    assert_eq!(dead["ok"], true, "{dead}");
    folder.until("the door has said so", |_| says("CLOSE"));
    signal(&home.0, "TERM");
    assert_eq!(home.0.wait().unwrap().code(), Some(143));

    let words = "--out sqlite:again.db --truth sqlite:again-truth.db";
    folder.run(&format!("replay home/recording.json {words}")).ok();
    assert_eq!(folder.dump("home/log.db"), folder.dump("again.db"));
    assert_eq!(folder.dump("home/truth.db"), folder.dump("again-truth.db"));
    let done = folder.query("home/truth.db", "SELECT what, name FROM outside ORDER BY at");
    assert_eq!(done, ["on|front door", "fall|walter", "off|front door", "battery|hall motion"]);

    // The control: without the note of what was ordered, the replay is another life.
    let mut recording = folder.json("home/recording.json");
    assert!(recording.as_object_mut().unwrap().remove("outside").is_some());
    folder.write("forgotten.json", recording.to_string());
    let forgotten = folder.run("replay forgotten.json --quiet --out sqlite:forgotten.db");
    assert!(forgotten.code == Some(2) && forgotten.err.contains("the replay differs"), "{}", forgotten.err);
}
