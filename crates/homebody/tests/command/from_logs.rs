//! A schematic home from a log.

use crate::folder::{Folder, says};
use serde_json::Value;

/// Two days of a flat, with the sensor names of CASAS: a person sleeps, washes, cooks, sits and goes out.
fn log() -> String {
    let walk =
        ["BedroomABed", "BedroomAArea", "BedroomADoor", "HallwayA", "BathroomAToilet", "BathroomASink", "HallwayA"];
    let on = ["KitchenASink", "KitchenAStove", "LivingRoomAArea", "LivingRoomAChair", "MainEntryway"];
    let mut log = String::new();
    for (round, minute) in (0..2 * 24 * 60).step_by(20).enumerate() {
        let (day, minute) = (minute / 1440, minute % 1440);
        let places = if round % 3 == 0 { &walk[..] } else { &on[..] };
        for (step, place) in places.iter().enumerate() {
            let at =
                |second: usize| format!("2016-07-{:02} {:02}:{:02}:{second:02}", 12 + day, minute / 60, minute % 60);
            log += &format!("{} {place} ON\n{} {place} OFF\n", at(4 * step), at(4 * step + 1));
        }
    }
    log
}

fn home(folder: &Folder, scenario: &str) -> Value {
    folder.json(&format!("{scenario}/home.json"))
}

fn names<'v>(home: &'v Value, list: &str) -> Vec<&'v str> {
    home[list].as_array().unwrap().iter().map(|one| one["name"].as_str().unwrap()).collect()
}

#[test]
fn a_log_becomes_a_home_in_which_it_is_walked_back() {
    let folder = Folder::new();
    folder.write("week.txt", log());
    folder.run("new flat --from-log week.txt").ok().says(&[
        "flat is ready, with a schematic home: 6 rooms",
        "things that no sensor tells of, and that a life needs, are added: fridge, dining chair",
    ]);
    folder.run("check flat").ok().says(&["no problems"]);
    let home = home(&folder, "flat");
    assert_eq!(names(&home, "rooms"), ["bedroom", "hallway", "bathroom", "kitchen", "living room", "main entryway"]);
    assert!(home["about"].as_str().unwrap().starts_with("Schematic: "), "{home}");
    assert!(home["doors"].as_array().unwrap().iter().any(|door| door["outside"] == true));
    for thing in ["bed", "toilet", "washbasin", "sink", "stove", "armchair"] {
        assert!(names(&home, "furniture").contains(&thing), "{thing}: {home}");
    }
    let logger = folder.json("flat/logger.json");
    assert_eq!(
        (&logger["ids"]["bedroom bed"], &logger["ids"]["kitchen stove"]),
        (&"BedroomABed".into(), &"KitchenAStove".into())
    );
    // A run in the home works, and the log can be located there.
    folder.run("run flat --for 1d --quiet --out casas:lived.txt").ok();
    assert!(folder.read("lived.txt").contains("BedroomABed"));
    let told = folder.run("locate week.txt --home flat --out walked --json").ok().json();
    assert_eq!(told["unknown_sensors"], Value::Array(Vec::new()));
    let told = folder.run("locate lived.txt --home flat --out again --json").ok().json();
    let all = &told["explained"]["all"];
    assert!(all["matched"].as_f64().unwrap() / all["real"].as_f64().unwrap() > 0.7, "{all}");
    // The same log makes the same home.
    folder.run("new more/flat --from-log week.txt").ok();
    assert_eq!(folder.read("more/flat/home.json"), folder.read("flat/home.json"));
}

/// The first bytes of a PNG of 1000 by 500 pixels.
const PICTURE: &[u8] = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x03\xe8\0\0\x01\xf4";

#[test]
fn sensors_on_a_picture_are_where_they_are_and_the_picture_goes_along() {
    let folder = Folder::new();
    let row = |at: usize, id: &str| format!("2016-07-12 08:00:{at:02} {id} ON\n");
    folder.write(
        "week.txt",
        [row(0, "S1"), row(9, "S2"), row(20, "S3"), row(30, "S4"), "2016-07-12 08:01:00 T1 21.5\n".into()].concat(),
    );
    folder.write("plan.png", PICTURE);
    folder.write("sensors.csv", "id,room,place,x,y\nS1,bedroom,bed,100,100\nS2,bathroom,toilet,500,100\nS3,kitchen,stove,900,400\nS4,living room,,300,400\nS9,hall,,0,0\n");
    let known = "--image plan.png --known 0,500=0,0 --known 1000,500=10,0";
    folder
        .run(&format!("new flat --from-log week.txt --sensors sensors.csv {known}"))
        .ok()
        .says(&["the log has nothing of S9", "walls are drawn half way"]);
    folder.run("check flat").ok();
    let home = home(&folder, "flat");
    let area = |name: &str| -> Vec<[f64; 2]> {
        let sensor = home["sensors"].as_array().unwrap().iter().find(|sensor| sensor["name"] == name).unwrap();
        serde_json::from_value(sensor["area"].clone()).unwrap()
    };
    let seen = area("bedroom bed");
    let [x, y] = [0, 1].map(|axis| seen.iter().map(|corner| corner[axis]).sum::<f64>() / seen.len() as f64);
    assert!((x - 1.0).abs() < 0.7 && (y - 4.0).abs() < 0.7, "{x}, {y}");
    let lies = folder.json("flat/underlay.json");
    assert_eq!((&lies["picture"], &lies["width_m"], &lies["at"][0]), (&"plan.png".into(), &10.0.into(), &5.0.into()));
    assert_eq!(std::fs::read(folder.path("flat/plan.png")).unwrap(), PICTURE);
}

#[test]
fn reports_all_problems_at_once_and_writes_nothing() {
    let folder = Folder::new();
    folder.write("codes.txt", "2016-07-12 08:00:00 M1 ON\n2016-07-12 08:00:05 M2 ON\n2016-07-12 08:00:09 D3 OPEN\n");
    folder
        .run("new flat --from-log codes.txt")
        .fails(2, "error[home-from-log::no-rooms-of-sensors]: codes.txt: ")
        .says(&["--sensors FILE"]);
    folder.write("wrong.csv", "id,room,x,y,kind\nM1,hall,1,,motion\nM1,hall,,,\n,kitchen,,,\nM2,hall,a,2,laser\n");
    let said = folder
        .run("new flat --from-log codes.txt --sensors wrong.csv")
        .fails(2, "wrong.csv:2:1: error[new::half-place]");
    says(
        &said.err,
        &[
            "wrong.csv:3:1: error[new::same-sensor]",
            "wrong.csv:4:1: error[new::no-id]",
            "wrong.csv:5:1: error[new::coordinate]: \"a\"",
            "wrong.csv:5:1: error[new::kind]",
        ],
    );
    folder.write("ids.csv", "what,room\nM1,hall\n");
    folder.run("new flat --from-log codes.txt --sensors ids.csv").fails(2, "error[new::no-id-column]: ids.csv:1:1:");
    folder.write("strange.csv", "id,room\nX1,hall\n");
    folder.run("new flat --from-log codes.txt --sensors strange.csv").fails(2, "error[new::other-log]");
    folder.write("numbers.txt", "2016-07-12 08:00:00 T1 21.5\n");
    folder.run("new flat --from-log numbers.txt").fails(2, "error[home-from-log::no-sensors]");
    folder.write("plan.png", PICTURE);
    folder.write("on.csv", "id,room,x,y\nM1,hall,5000,10\nM2,hall,,\nD3,hall,,\n");
    let on = "new flat --from-log codes.txt --sensors on.csv --image plan.png";
    folder.run(on).fails(2, "error[new::known-points]");
    folder.run(&format!("{on} --known 1,1=0,0 --known 1,1=4,4")).fails(2, "error[new::same-point]");
    let said = folder
        .run(&format!("{on} --known 0,0=0,0 --known 900,0=9,0"))
        .fails(2, "error[new::off-picture]: the sensor \"M1\" is outside the image: x is 5000 and y is 10 pixels");
    assert!(said.err.contains("error[new::nothing-on-picture]"), "{}", said.err);
    folder.write("plan.gif", "GIF89a");
    folder
        .run("new flat --from-log codes.txt --image plan.gif --known 0,0=0,0 --known 9,0=9,0")
        .fails(2, "error[new::not-a-picture]: plan.gif: ");
    folder.run("new flat --from-log nothing.txt").fails(1, "[log::not-found]: nothing.txt");
    assert!(!folder.path("flat").exists());
    folder.write("home.txt", log());
    folder.run("new flat --from-log home.txt").ok();
    folder.run("new flat --from-log home.txt").fails(1, "[kit::exists]: flat");
}
