//! A user controls a resident with keys, and the program is killed: acts of a second before are kept, and nothing is doubled.

use crate::folder::Folder;
use crate::resumed::kills;
use crate::served::{address_of, page_of};
use std::fs;
use std::net::TcpStream;
use std::process::{Child, Stdio};
use std::thread;
use std::time::{Duration, Instant};
use tungstenite::{Message, WebSocket};

/// Acts of this age survive a kill.
const SECOND: Duration = Duration::from_secs(1);

/// A server of its own, and a page that drives.
struct Driven {
    server: Child,
    socket: WebSocket<TcpStream>,
}

impl Driven {
    fn begin(folder: &Folder) -> Driven {
        let mut command = folder.command("serve by-hand --no-open --port 0");
        let mut server = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
        let (address, token) = address_of(&mut server);
        let mut driven = Driven { server, socket: page_of(&address, &token) };
        driven.say(r#"{"say":"start","driven":0}"#);
        driven.say(r#"{"say":"play"}"#);
        driven
    }

    fn say(&mut self, say: &str) {
        self.socket.send(Message::Text(say.into())).unwrap();
    }

    /// Holds one key after the other, and kills the program after so long; how many were held more than a second before.
    fn drive(mut self, for_so_long: Duration) -> usize {
        const KEYS: [&str; 4] = ["right", "up", "left", "down"];
        let begun = Instant::now();
        let mut held = Vec::new();
        for key in KEYS.iter().cycle() {
            let pause = Duration::from_millis(120).min(for_so_long.saturating_sub(begun.elapsed()));
            thread::sleep(pause);
            if begun.elapsed() >= for_so_long {
                break;
            }
            self.say(&format!(r#"{{"say":"hold","keys":["{key}"]}}"#));
            held.push(Instant::now());
        }
        self.server.kill().unwrap();
        let killed = Instant::now();
        self.server.wait().unwrap();
        held.iter().filter(|at| killed.duration_since(**at) > SECOND).count()
    }
}

#[test]
fn acts_of_a_second_before_survive_a_kill() {
    let folder = Folder::with("by-hand");
    let (mut most_held, kills) = (0, kills());
    for kill in 0..kills {
        let for_so_long = Duration::from_millis(300 + kill * 7919 % 2_500);
        let held = Driven::begin(&folder).drive(for_so_long);
        most_held = most_held.max(held);
        let runs = fs::read_dir(folder.path("runs")).map_or(0, Iterator::count);
        if runs == 0 {
            // It was killed before the run was begun.
            assert_eq!(held, 0, "kill {kill}");
            continue;
        }
        let run = "runs/by-hand-1";
        let recording = folder.json(&format!("{run}/recording.json"));
        let keys = recording["files"]["visitor.keys.json"].as_str().unwrap_or_default();
        let kept = keys.matches("\"held\": [").count();
        assert!(kept >= held, "kill {kill} after {for_so_long:?}: {kept} of {held} are kept");
        // Lived to its end, its log has what the recording gives, each row once.
        folder.run(&format!("run --resume {run} --quiet")).ok();
        folder.run(&format!("replay {run}/recording.json --out csv:again.csv --force --quiet")).ok();
        let of = |log: &str| folder.run(&format!("convert {log} --out csv:rows.csv --force")).ok();
        of(&format!("{run}/log.db"));
        let rows = folder.read("rows.csv");
        of("again.csv");
        assert_eq!(rows, folder.read("rows.csv"), "kill {kill} after {for_so_long:?}");
        fs::remove_dir_all(folder.path(run)).unwrap();
    }
    assert!(kills < 5 || most_held > 3, "only {most_held} keys were held");
}
