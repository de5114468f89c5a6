//! Logs that users open in the page: locating people in the background, and playback.

use super::served::{Answer, Served};
use homebody_simulation::Destinations;
use serde_json::Value;
use std::path::Path;
use std::time::{Duration, Instant};
use std::{fs, thread};

const MINUTE: i64 = 60_000_000;

impl Served {
    /// Simulates some days of the scenario, and writes the log as CSV.
    fn lived(&self, scenario: &str, days: f64) -> (String, Vec<u8>) {
        let (folder, runs) = (self.folder.path(), self.folder.path().join("runs"));
        let run = || homebody_simulation::open(folder.join(scenario)).unwrap().run().days(days).start().unwrap();
        run().store(&Destinations::new_folder_in(&runs), |_| ()).unwrap();
        let csv = folder.join("log.csv");
        run().store(&Destinations::log(&format!("csv:{}", csv.display())).unwrap(), |_| ()).unwrap();
        (format!("{scenario}-1"), fs::read(csv).unwrap())
    }

    /// The result of the log that was opened last.
    fn walked(&self) -> Value {
        let begun = Instant::now();
        loop {
            let now: Value = serde_json::from_slice(&self.api("/api/walk").body).unwrap();
            if !["coming", "walking"].contains(&now["state"].as_str().unwrap_or_default()) {
                return now;
            }
            assert!(begun.elapsed() < Duration::from_secs(180), "{now}");
            thread::sleep(Duration::from_millis(50));
        }
    }

    fn view(&self, run: &str) -> Value {
        let answer = self.api(&format!("/api/runs/{}", run.replace('/', "%2F")));
        assert_eq!(answer.code, 200, "{}", text(&answer));
        serde_json::from_slice(&answer.body).unwrap()
    }

    fn day(&self, run: &str, day: usize) -> Value {
        let answer = self.api(&format!("/api/runs/{}/days/{day}", run.replace('/', "%2F")));
        assert_eq!(answer.code, 200, "{}", text(&answer));
        rmp_serde::from_slice(&answer.body).unwrap()
    }
}

fn text(answer: &Answer) -> String {
    String::from_utf8_lossy(&answer.body).into_owned()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect()
}

/// The room of the last span that has begun.
fn room_at(spans: &Value, at: i64) -> Option<i64> {
    let span = spans.as_array()?.iter().rev().find(|span| span[0].as_i64() <= Some(at))?;
    (span[1].as_i64() > Some(at)).then(|| span[2].as_i64())?
}

/// The most likely place at an instant.
fn likeliest(chances: &Value, at: i64) -> Option<i64> {
    let mut known = std::collections::BTreeMap::new();
    for chance in chances.as_array()?.iter().take_while(|chance| chance[0].as_i64() <= Some(at)) {
        known.insert(chance[1].as_i64()?, chance[2].as_f64()?);
    }
    known.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(place, _)| place)
}

#[test]
fn locates_logs_in_the_background_and_plays_them() {
    let served = Served::scenario("studio");
    assert_eq!(served.api("/api/walk").body, b"null");
    let (run, log) = served.lived("studio", 1.0);
    let answer = served.send("POST", "/api/walk/real%20week.csv", &log);
    assert_eq!(answer.code, 200, "{}", text(&answer));
    assert_eq!(served.api("/api/runs").code, 200, "others are answered meanwhile");
    let done = served.walked();
    assert_eq!((&done["state"], &done["run"]), (&"done".into(), &"real-week-walked-1/run".into()), "{done}");

    let list: Value = serde_json::from_slice(&served.api("/api/runs").body).unwrap();
    let listed = list.as_array().unwrap().iter().find(|stored| stored["name"] == done["run"]).unwrap();
    assert_eq!(listed["walked_back"], "real week.csv");
    let walked = done["run"].as_str().unwrap();
    let (view, day) = (served.view(walked), served.day(walked, 0));
    assert_eq!((&view["walk"]["log"], &view["has_truth"]), (&"real week.csv".into(), &true.into()));
    // The rows are those of the original log.
    let (of_run, truth) = (served.view(&run), served.day(&run, 0));
    assert_eq!(day["rows"].as_array().unwrap().len(), log.iter().filter(|&&byte| byte == b'\n').count() - 1);
    let named = |view: &Value, day: &Value| -> Vec<(i64, String, String)> {
        let text =
            |list: &str, number: &Value| view[list][number.as_u64().unwrap() as usize].as_str().unwrap().to_owned();
        let sensor = |number: &Value| view["home"]["sensors"][number.as_u64().unwrap() as usize]["name"].to_string();
        let rows = day["rows"].as_array().unwrap().iter();
        rows.map(|row| (row[0].as_i64().unwrap(), sensor(&row[1]), text("values", &row[2]))).collect()
    };
    assert_eq!(named(&view, &day), named(&of_run, &truth));

    // The resident is most likely where the ground truth says.
    let (mut right, mut drawn, mut minutes) = (0, 0, 0);
    for minute in 1..1439 {
        let at = minute * MINUTE;
        let Some(room) = room_at(&truth["lives"][0]["rooms"], at) else { continue };
        minutes += 1;
        right += usize::from(likeliest(&day["lives"][0]["chances"], at) == Some(room));
        drawn += usize::from(room_at(&day["lives"][0]["rooms"], at) == Some(room));
    }
    assert!(minutes > 700 && right * 10 > minutes * 9 && drawn * 10 > minutes * 8, "{right}, {drawn} of {minutes}");
    let stays = view["walk"]["stays"][0].as_array().unwrap();
    assert!(stays.len() > 5 && stays.windows(2).all(|two| two[0][1].as_i64() <= two[1][0].as_i64()), "{stays:?}");
}

#[test]
fn reports_logs_that_it_cannot_locate_and_leaves_no_files() {
    let served = Served::scenario("studio");
    let (run, log) = served.lived("studio", 0.5);
    let before = names(&served.folder.path().join("runs"));
    let strange = String::from_utf8(log.clone()).unwrap().replace(['M', 'D', 'T'], "Q");
    let header = String::from_utf8(log.clone()).unwrap().lines().next().unwrap().to_owned() + "\n";
    for (body, said) in [
        (strange.as_bytes(), "no sensor of the log is a sensor of the home. the log has"),
        (header.as_bytes(), "no rows"),
        (&b""[..], "is empty"),
        (&b"Dear reader,\nthis is no log.\n"[..], "line"),
        (&[0, 159, 146, 150, 0, 0][..], ""),
    ] {
        assert_eq!(served.send("POST", "/api/walk/a.csv", body).code, 200);
        let failed = served.walked();
        let problem = failed["problem"].as_str().unwrap().to_lowercase();
        assert!(failed["state"] == "failed" && problem.contains(said) && !problem.contains(".walk-"), "{failed}");
    }
    // The log fits the home of its own run; an unknown home is refused.
    assert_eq!(served.send("POST", &format!("/api/walk/..%2Fup.csv/{run}"), &log).code, 200);
    let done = served.walked();
    assert_eq!((&done["state"], &done["run"]), (&"done".into(), &"log-walked-1/run".into()), "{done}");
    assert_eq!(served.send("POST", "/api/walk/a.csv/..%2Fstudio", &log).code, 200);
    assert_eq!(served.walked()["problem_code"], "page::no-run");
    let mut after = names(&served.folder.path().join("runs"));
    after.retain(|name| name != "log-walked-1");
    assert_eq!(after, before);
    assert_eq!(names(served.folder.path()), ["log.csv", "log.sensors.csv", "runs", "studio"]);
}

#[test]
fn rejects_large_logs_by_their_announced_length() {
    let served = Served::scenario("studio");
    let (address, token) = (served.address, &served.token);
    let head = format!(
        "POST /api/walk/a.csv HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\nx-homebody-token: {token}\r\n\
         Content-Length: {}\r\n\r\n",
        65 << 20
    );
    let answer = served.ask(head.as_bytes());
    assert_eq!(answer.code, 413);
    let told = answer.refusal();
    assert_eq!((&told["code"], &told["data"]["limit_mb"]), (&"page::log-too-large".into(), &64.into()), "{told}");
    assert_eq!(names(&served.folder.path().join("runs")), Vec::<String>::new());
    // A few rows over two years are too long a log.
    let far = "time,sensor,value\n2001-01-01 10:00:00,M001,ON\n2026-01-01 10:00:00,M001,ON\n";
    served.send("POST", "/api/walk/far.csv", far.as_bytes());
    assert_eq!(served.walked()["problem_code"], "page::too-many-days");
    assert_eq!(served.send("POST", "/api/walk/a.csv", b"").code, 200);
    let stranger = format!("POST /api/walk/a.csv HTTP/1.1\r\nHost: {address}\r\nContent-Length: 1\r\n\r\na");
    assert_eq!(served.ask(stranger.as_bytes()).code, 401);
}

#[test]
fn locates_one_log_at_a_time_and_stops_on_request() {
    let mut served = Served::scenario("tigerplace");
    let (run, log) = served.lived("tigerplace", 30.0);
    assert_eq!(served.send("POST", "/api/walk/month.csv", &log).code, 200);
    let busy = served.send("POST", "/api/walk/other.csv", &log);
    assert_eq!(busy.code, 409);
    assert_eq!(
        busy.refusal()["what"],
        "Homebody is still locating people in month.csv. Wait until it has finished, or stop it."
    );
    assert_eq!(served.send("DELETE", "/api/walk", b"").code, 200);
    let stopped = served.walked();
    assert_eq!((&stopped["state"], &stopped["run"]), (&"stopped".into(), &Value::Null), "{stopped}");
    let runs = served.folder.path().join("runs");
    assert_eq!(names(&runs), std::slice::from_ref(&run));
    // A server that ends leaves no partial results.
    assert_eq!(served.send("POST", "/api/walk/month.csv", &log).code, 200);
    served.close();
    assert_eq!(names(&runs), [run]);
}

#[test]
fn serves_the_pages_of_inspect_and_realism() {
    let served = Served::scenario("studio");
    let (run, log) = served.lived("studio", 3.0);
    let page = |path: &str, code: u16| {
        let answer = served.api(path);
        assert_eq!(answer.code, code, "{path}: {}", text(&answer));
        text(&answer)
    };
    let look = page(&format!("/api/runs/{run}/look"), 200);
    assert!(look.contains("<svg") && look.contains("room motion") && look.contains("Rows of each sensor by day"));
    let alone = page(&format!("/api/runs/{run}/realism/{run}"), 200);
    assert!(alone.contains("firings a day"), "{alone}");

    served.send("POST", "/api/walk/week.csv", &log);
    let walked = served.walked()["run"].as_str().unwrap().replace('/', "%2F");
    let look = page(&format!("/api/runs/{walked}/look"), 200);
    assert!(look.contains("<title>week.csv") || look.contains("week.csv"), "{look}");
    let relived = page(&format!("/api/runs/{walked}/realism/{walked}"), 200);
    assert!(relived.contains("A: week.csv") && relived.contains("B: the run simulated from it"), "{relived}");
    let beside = page(&format!("/api/runs/{walked}/realism/{run}"), 200);
    assert!(beside.contains(&format!("B: {run}")));
    page("/api/runs/nowhere/look", 404);
    page("/api/runs/nowhere/care", 404);
    for run in [&run, &walked] {
        let care: Value = serde_json::from_str(&page(&format!("/api/runs/{run}/care"), 200)).unwrap();
        let remarks = care["remarks"].to_string();
        assert!(remarks.contains("needed for a summary") && !care["charts"].as_array().unwrap().is_empty(), "{care}");
    }
    page(&format!("/api/runs/{run}/realism/nowhere"), 404);
    // Less than a day cannot be compared.
    let short = Served::scenario("studio");
    let (run, _) = short.lived("studio", 0.4);
    let answer = short.api(&format!("/api/runs/{run}/realism/{run}"));
    assert_eq!(answer.code, 422);
    assert_eq!(answer.refusal()["code"], "realism::no-whole-day");
}

#[test]
fn notes_are_in_the_folder_of_their_run_and_visible_to_others() {
    let served = Served::scenario("studio");
    let (run, log) = served.lived("studio", 1.0);
    served.send("POST", "/api/walk/day.csv", &log);
    let walked = served.walked()["run"].as_str().unwrap().to_owned();
    let runs = served.folder.path().join("runs");
    let note = |day: &str, note: &str| serde_json::json!({ "day": day, "about": "episode", "seen": true, "note": note, "who": "" });
    let post = |run: &str, body: &Value| {
        let (address, token, body) = (served.address, &served.token, body.to_string());
        let path = format!("/api/runs/{}/notes", run.replace('/', "%2F"));
        let head = format!(
            "POST {path} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\nx-homebody-token: {token}\r\n\
             Content-Type: application/json\r\nContent-Length: {}\r\n\r\n",
            body.len()
        );
        served.ask(&[head.as_bytes(), body.as_bytes()].concat())
    };
    for (of, place) in [(&run, run.clone()), (&walked, "day-walked-1".to_owned())] {
        let cold = serde_json::json!({ "before": null, "note": note("2009-03-02", "a cold") });
        assert_eq!(post(of, &cold).code, 200);
        assert!(runs.join(&place).join("care-notes.json").is_file(), "{place}");
        let mut kept: Value =
            serde_json::from_slice(&served.api(&format!("/api/runs/{}/notes", of.replace('/', "%2F"))).body).unwrap();
        let stored = kept[0].as_object_mut().unwrap();
        assert!(stored.remove("at").is_some_and(|at| at.as_str().is_some_and(|at| at.contains('T'))));
        assert_eq!(kept, serde_json::json!([note("2009-03-02", "a cold")]));
        // A note is not replaced by a page that has not read it.
        let unseen = serde_json::json!({ "before": null, "note": note("2009-03-02", "") });
        assert_eq!(post(of, &unseen).code, 409);
    }
    let wrong = serde_json::json!({ "before": null, "note": note("today", "") });
    assert_eq!((post(&run, &wrong).code, post("nowhere", &wrong).code), (422, 422));
    let fine = serde_json::json!({ "before": null, "note": note("2009-03-03", "") });
    assert_eq!(post("../studio", &fine).code, 404);
    // Without the token, notes can be neither read nor written.
    let address = served.address;
    let stranger = format!("GET /api/runs/{run}/notes HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\r\n");
    assert_eq!(served.ask(stranger.as_bytes()).code, 401);
}

#[test]
fn stores_logs_without_a_home_for_the_care_view() {
    let served = Served::scenario("studio");
    let day = |day: u32| {
        let row = |hour: u32| {
            format!("2024-01-{day:02} {hour:02}:10:00\tKitchenA\tON\n2024-01-{day:02} {hour:02}:20:00\tBedroomA\tON\n")
        };
        (0..24).map(row).collect::<String>()
    };
    let log: String = (1..=9).map(day).collect();
    assert_eq!(served.send("POST", "/api/logs/flat.txt", log.as_bytes()).code, 200);
    let done = served.walked();
    assert_eq!((&done["state"], &done["run"]), (&"done".into(), &"flat-log-1".into()), "{done}");
    let kept: Value = serde_json::from_slice(&served.api("/api/logs").body).unwrap();
    assert_eq!(kept, serde_json::json!([{ "name": "flat-log-1", "log": "flat.txt" }]));
    let care: Value = serde_json::from_slice(&served.api("/api/runs/flat-log-1/care").body).unwrap();
    assert_eq!((&care["walks"], care["days"].as_array().unwrap().len()), (&"no_home".into(), 9), "{care}");
    assert!(!care["remarks"].to_string().contains("--home"), "{care}");
    // A kept log is not in the list of runs.
    assert_eq!((served.api("/api/runs").body, served.api("/api/runs/flat-log-1").code), (b"[]".to_vec(), 404));
    // An invalid log leaves no files.
    served.send("POST", "/api/logs/letter.txt", b"Dear reader,\nthis is no log.\n");
    assert_eq!(served.walked()["state"], "failed");
    assert_eq!(names(&served.folder.path().join("runs")), ["flat-log-1"]);
}
