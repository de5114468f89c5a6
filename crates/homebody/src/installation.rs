//! Checks of the installation: the features of the build, and the resources of the machine.

use homebody_core::calendar::Calendar;
use homebody_core::scenario::scheme::SCHEMES;
use homebody_log::examine::sqlite_version;
use homebody_query::Check;
use homebody_simulation::VERSION;
use homebody_web::has_page;
use jiff::Timestamp;
use jiff::tz::TimeZone;
use std::env;
use std::io::{IsTerminal, stderr, stdout};
use std::path::Path;

/// A clock with an earlier year was never set (our choice): this program is from this year.
const FIRST_YEAR: i16 = 2026;

/// A clock with a later year is wrong (our choice).
const LAST_YEAR: i16 = 2100;

/// Doctor warns of less free space (our choice): a year of a home takes about 150 MB.
const LEAST_BYTES: u64 = 1 << 30;

/// Checks the installation; `folder` is that of runs.
pub fn examine(folder: &Path) -> Vec<Check> {
    let mut checks = vec![
        Check::ok("version", format!("homebody {VERSION} on {} {}", env::consts::OS, env::consts::ARCH)),
        features(),
        page(),
        database(),
        zones(),
        clock(Timestamp::now()),
    ];
    checks.extend(room(folder));
    checks.push(terminal());
    checks
}

fn features() -> Check {
    let built = [
        ("postgresql", cfg!(feature = "postgresql")),
        ("parquet", cfg!(feature = "parquet")),
        ("mqtt", cfg!(feature = "mqtt")),
    ];
    let mut features: Vec<&str> = SCHEMES.iter().filter_map(|row| row.feature).collect();
    features.dedup();
    let absent: Vec<&str> = features.iter().copied().filter(|feature| !built.contains(&(feature, true))).collect();
    match absent.is_empty() {
        true => Check::ok("features", format!("built with {}", features.join(", "))),
        false => Check::warning(
            "features",
            format!("built without {}", absent.join(", ")),
            format!("to add them: cargo install --path crates/homebody --features {}", absent.join(",")),
        ),
    }
}

fn page() -> Check {
    match has_page() {
        true => Check::ok("page", "homebody serve has its page"),
        false => Check::warning(
            "page",
            "homebody serve has no page, because the build could not make it; everything else works",
            "install Node.js 20.19 or newer with npm, touch web/package.json, and build again",
        ),
    }
}

fn database() -> Check {
    match sqlite_version() {
        Ok(version) => Check::ok("database", format!("SQLite {version} writes and reads rows")),
        Err(error) => Check::of_error("database", &error),
    }
}

fn zones() -> Check {
    let is_known = ["America/Chicago", "Europe/Berlin", "Asia/Kolkata"].iter().all(|zone| Calendar::zone(zone).is_ok());
    match is_known {
        true => Check::ok("time zones", "built in"),
        false => Check::wrong("time zones", "this build has no time zones", "build it with its time zones"),
    }
}

fn clock(now: Timestamp) -> Check {
    let at = now.to_zoned(TimeZone::UTC);
    let says = format!("{} in UTC", at.strftime("%Y-%m-%d %H:%M:%S"));
    match at.year() {
        FIRST_YEAR..LAST_YEAR => Check::ok("clock", says),
        _ => Check::wrong("clock", says, "set the clock, best by the network: a home in real time depends on it"),
    }
}

/// Checks that runs can be written into the folder.
#[cfg(unix)]
fn room(folder: &Path) -> Vec<Check> {
    use nix::sys::statvfs::statvfs;
    use nix::unistd::{AccessFlags, access};
    let there = folder.ancestors().find(|folder| folder.is_dir()).unwrap_or(Path::new("."));
    let shown = there.display();
    let mut checks = Vec::new();
    checks.push(match access(there, AccessFlags::W_OK | AccessFlags::X_OK) {
        Ok(()) => Check::ok("folder", format!("{shown} is writable")),
        Err(why) => Check::wrong(
            "folder",
            format!("{shown} is not writable: {}", why.desc()),
            "change to a folder of yours, or name another with --out",
        ),
    });
    if let Ok(found) = statvfs(there) {
        // Their types differ from system to system.
        #[allow(clippy::unnecessary_cast, reason = "elsewhere these are 32 bits wide")]
        let (free, files, all) = (
            found.blocks_available() as u64 * found.fragment_size() as u64,
            found.files_available() as u64,
            found.files() as u64,
        );
        let says = format!("{:.1} GB free in {shown}", free as f64 / 1e9);
        checks.push(match free {
            _ if all > 0 && files == 0 => {
                Check::wrong("room", format!("{shown} can hold no more files"), "remove some files")
            }
            LEAST_BYTES.. => Check::ok("room", says),
            _ => Check::warning("room", says, "free some space: a year of a home takes about 150 MB"),
        });
    }
    checks
}

#[cfg(not(unix))]
fn room(_: &Path) -> Vec<Check> {
    Vec::new()
}

fn terminal() -> Check {
    let says = |what: &str| env::var(what).ok().filter(|value| !value.is_empty());
    let locale = ["LC_ALL", "LC_CTYPE", "LANG"].iter().find_map(|name| says(name)).unwrap_or_default();
    let is_utf8 = locale.to_lowercase().replace('-', "").contains("utf8");
    match (stdout().is_terminal() || stderr().is_terminal(), is_utf8 || cfg!(not(unix))) {
        (false, _) => Check::ok("terminal", "none; progress is not drawn"),
        (true, true) => Check::ok("terminal", "UTF-8"),
        (true, false) => {
            Check::warning("terminal", "not UTF-8: names such as Öz may look wrong", "export LANG=C.UTF-8")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_query::CheckVerdict;

    #[test]
    fn reports_a_clock_that_was_never_set() {
        let at = |year: i64| Timestamp::from_second((year - 1970) * 31_557_600).unwrap();
        assert_eq!(clock(at(2027)).verdict, CheckVerdict::Ok);
        for year in [1971, 2000, 2200] {
            assert_eq!(clock(at(year)).verdict, CheckVerdict::Wrong, "{year}");
        }
    }
}
