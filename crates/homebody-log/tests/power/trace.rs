//! The file operations of a program, in order, as strace reports them.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// One thing that was asked of a file, by its name at that time.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    Create(PathBuf),
    Write {
        file: PathBuf,
        at: u64,
        bytes: Vec<u8>,
    },
    Truncate {
        file: PathBuf,
        bytes: u64,
    },
    /// All that was asked of a file, or of a folder's names, before this one began is on the disk.
    Synced {
        file: PathBuf,
        before: usize,
    },
    Remove(PathBuf),
    Rename {
        from: PathBuf,
        to: PathBuf,
    },
    /// The program has told that so many rows are safe.
    Confirmed(u64),
}

const CALLS: &str = "openat,lseek,pwrite64,write,pwritev,pwritev2,fsync,fdatasync,ftruncate,rename,renameat,renameat2,unlink,unlinkat,fallocate,mmap";

/// Why strace cannot be used here; None where it can.
pub fn missing() -> Option<String> {
    let tried = Command::new("strace").args(["-f", "-o", "/dev/null", "true"]).stderr(Stdio::null()).status();
    match tried {
        Err(_) => Some("strace is not installed".into()),
        Ok(status) if !status.success() => Some("strace may not look at programs here".into()),
        Ok(_) => None,
    }
}

/// Runs a program and returns what it asked of the files in a folder.
pub fn trace(program: &mut Command, folder: &Path) -> Vec<Event> {
    let told = folder.with_extension("trace");
    let mut command = Command::new("strace");
    command.args(["-f", "-y", "-xx", "-s", "100000000", "-e"]).arg(format!("trace={CALLS}")).arg("-o").arg(&told);
    command.arg(program.get_program()).args(program.get_args());
    for (name, value) in program.get_envs() {
        command.env(name, value.unwrap());
    }
    let ended = command.stdout(Stdio::null()).status().unwrap();
    assert!(ended.success(), "the traced program comes to its end");
    let text = std::fs::read_to_string(&told).unwrap();
    std::fs::remove_file(&told).unwrap();
    parse(&text, folder)
}

/// The events of a trace.
fn parse(text: &str, folder: &Path) -> Vec<Event> {
    let mut events = Vec::new();
    // By process: what it has begun and not ended yet, and how many events there were then.
    let mut begun: HashMap<&str, (String, usize)> = HashMap::new();
    // The position of writes without one.
    let mut places: HashMap<String, u64> = HashMap::new();
    for line in text.lines() {
        let Some((process, call)) = line.split_once(' ') else { continue };
        let call = call.trim_start();
        let (call, before) = if let Some(first) = call.strip_suffix("<unfinished ...>") {
            begun.insert(process, (first.trim_end().to_owned(), events.len()));
            // A write may reach the disk from now on.
            if !first.contains("write") {
                continue;
            }
            (format!("{first}) = 0"), events.len())
        } else if call.starts_with("<...") {
            let Some((first, before)) = begun.remove(process) else { continue };
            if first.contains("write") {
                continue;
            }
            let rest = call.split_once("resumed>").map_or("", |(_, rest)| rest);
            (format!("{first}{rest}"), before)
        } else {
            (call.to_owned(), events.len())
        };
        if let Some(event) = event(&call, before, folder, &mut places) {
            events.push(event);
        }
    }
    events
}

/// The event of a call for the folder; None for a failed call, or one about something else.
fn event(call: &str, before: usize, folder: &Path, places: &mut HashMap<String, u64>) -> Option<Event> {
    let (name, rest) = call.split_once('(')?;
    let (arguments, result) = rest.rsplit_once(") = ")?;
    if result.starts_with('-') {
        return None;
    }
    let parts: Vec<&str> = arguments.split(", ").collect();
    let of_folder =
        |path: PathBuf| (path.starts_with(folder) && !path.to_string_lossy().ends_with("-shm")).then_some(path);
    let opened = |part: &str| of_folder(path(part.split_once('<')?.1.trim_end_matches('>')));
    let named = |part: &str| of_folder(path(quoted(part)?));
    match name {
        "openat" => {
            places.remove(result);
            // The name is below the folder of the descriptor before it.
            let below = parts[0].split_once('<').map_or("", |(_, below)| below.trim_end_matches('>'));
            let created = || of_folder(path(below).join(path(quoted(parts[1])?))).map(Event::Create);
            arguments.contains("O_CREAT").then(created)?
        }
        "lseek" => {
            places.insert(parts[0].to_owned(), result.parse().ok()?);
            None
        }
        "write" => {
            let bytes = unhex(quoted(parts[1])?);
            let text = String::from_utf8_lossy(&bytes);
            if let Some(rows) = text.trim().strip_prefix("confirmed ").and_then(|rows| rows.parse().ok()) {
                return Some(Event::Confirmed(rows));
            }
            let place = places.entry(parts[0].to_owned()).or_default();
            let at = *place;
            *place += bytes.len() as u64;
            Some(Event::Write { file: opened(parts[0])?, at, bytes })
        }
        "pwrite64" => {
            let file = opened(parts[0])?;
            Some(Event::Write { file, at: parts[3].parse().ok()?, bytes: unhex(quoted(parts[1])?) })
        }
        "pwritev" | "pwritev2" | "fallocate" => {
            assert!(opened(parts[0]).is_none(), "the disk does not know this: {name}");
            None
        }
        "mmap" => {
            let is_written = arguments.contains("MAP_SHARED") && arguments.contains("PROT_WRITE");
            let file = parts.iter().find(|part| part.contains('<')).and_then(|part| opened(part));
            assert!(!is_written || file.is_none(), "no file is written through memory: {call}");
            None
        }
        "fsync" | "fdatasync" => opened(parts[0]).map(|file| Event::Synced { file, before }),
        "ftruncate" => Some(Event::Truncate { file: opened(parts[0])?, bytes: parts[1].parse().ok()? }),
        "unlink" => named(parts[0]).map(Event::Remove),
        "unlinkat" => named(parts[1]).map(Event::Remove),
        "rename" => Some(Event::Rename { from: named(parts[0])?, to: named(parts[1])? }),
        "renameat" | "renameat2" => Some(Event::Rename { from: named(parts[1])?, to: named(parts[3])? }),
        _ => None,
    }
}

/// The text in quotes.
fn quoted(part: &str) -> Option<&str> {
    part.split('"').nth(1)
}

/// A path, which may be in hexadecimal digits.
fn path(text: &str) -> PathBuf {
    match text.starts_with("\\x") {
        true => String::from_utf8(unhex(text)).unwrap().into(),
        false => text.into(),
    }
}

/// The bytes of `\x2f\x00`.
fn unhex(text: &str) -> Vec<u8> {
    let digit = |byte: u8| (byte as char).to_digit(16).unwrap() as u8;
    text.as_bytes().chunks(4).map(|byte| digit(byte[2]) << 4 | digit(byte[3])).collect()
}
