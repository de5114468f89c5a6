//! The possible contents of a disk after a loss of power: everything that was synced, and any part of the rest.
//!
//! Of the writes to a file that are not durable, each sector may be there or not, in any order, and so may each change of its size. The
//! names of a folder change in their order, and changes that are not durable may be missing from some point on.

use super::trace::Event;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Bytes that are written whole or not at all.
const SECTOR: usize = 512;

/// The durable part of a disk.
#[derive(Default)]
struct Disk {
    /// By the number of a file, its bytes.
    files: Vec<Vec<u8>>,
    names: BTreeMap<PathBuf, usize>,
}

/// The part of the other writes that is there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Luck {
    None,
    All,
    /// As if by chance, from this seed.
    Some(u64),
}

/// Requests that are not durable.
struct Asked<'e> {
    number: usize,
    what: &'e Event,
    file: usize,
}

/// Writes into a folder what is on the disk when the power is lost after so many events. `heeds` says whether it heeds a wish to be sure.
pub fn lose_power(events: &[Event], luck: Luck, heeds: bool, from: &Path, into: &Path) {
    let mut disk = Disk::default();
    let (mut now, mut renamed, mut unsure) = (BTreeMap::<&Path, usize>::new(), Vec::new(), Vec::<Asked>::new());
    for (number, event) in events.iter().enumerate() {
        match event {
            Event::Create(file) => {
                if !now.contains_key(&**file) {
                    disk.files.push(Vec::new());
                    now.insert(file, disk.files.len() - 1);
                    renamed.push((number, event, disk.files.len() - 1));
                }
            }
            Event::Write { file, .. } | Event::Truncate { file, .. } => {
                if let Some(&of) = now.get(&**file) {
                    unsure.push(Asked { number, what: event, file: of });
                }
            }
            Event::Remove(file) => {
                if let Some(of) = now.remove(&**file) {
                    renamed.push((number, event, of));
                }
            }
            Event::Rename { from, to } => {
                if let Some(of) = now.remove(&**from) {
                    now.insert(to, of);
                    renamed.push((number, event, of));
                }
            }
            Event::Synced { file, before } if heeds => {
                if file == from {
                    let sure = renamed.iter().take_while(|(number, _, _)| number < before).count();
                    renamed.drain(..sure).for_each(|(_, event, of)| disk.name(event, of));
                } else if let Some(&of) = now.get(&**file) {
                    let (sure, rest) =
                        unsure.into_iter().partition(|asked: &Asked| asked.file == of && asked.number < *before);
                    unsure = rest;
                    for asked in sure {
                        disk.write(asked.file, asked.what, &mut |_| true);
                    }
                }
            }
            Event::Synced { .. } | Event::Confirmed(_) => {}
        }
    }
    let mut chance = Chance(if let Luck::Some(seed) = luck { seed } else { 0 });
    let named = match luck {
        Luck::None => 0,
        Luck::All => renamed.len(),
        Luck::Some(_) => chance.below(renamed.len() as u64 + 1) as usize,
    };
    renamed.drain(..named).for_each(|(_, event, of)| disk.name(event, of));
    for asked in unsure {
        // Some writes are there as a whole, some not at all, and some in part.
        let whole = chance.below(3);
        disk.write(asked.file, asked.what, &mut |_| match luck {
            Luck::None => false,
            Luck::All => true,
            Luck::Some(_) => whole == 0 || whole == 1 && chance.below(2) == 0,
        });
    }
    for (name, of) in &disk.names {
        fs::write(into.join(name.strip_prefix(from).unwrap()), &disk.files[*of]).unwrap();
    }
}

impl Disk {
    fn name(&mut self, event: &Event, of: usize) {
        match event {
            Event::Create(file) => drop(self.names.insert(file.clone(), of)),
            Event::Remove(file) => drop(self.names.remove(file)),
            Event::Rename { from, to } => {
                self.names.remove(from);
                self.names.insert(to.clone(), of);
            }
            _ => {}
        }
    }

    /// Brings those sectors of a write in that are there.
    fn write(&mut self, of: usize, event: &Event, is_there: &mut dyn FnMut(usize) -> bool) {
        let file = &mut self.files[of];
        match event {
            Event::Truncate { bytes, .. } if is_there(0) => file.resize(*bytes as usize, 0),
            Event::Write { at, bytes, .. } => {
                let mut begin = 0;
                while begin < bytes.len() {
                    let place = *at as usize + begin;
                    let end = bytes.len().min(begin + SECTOR - place % SECTOR);
                    if is_there(place) {
                        let needed = place + end - begin;
                        if file.len() < needed {
                            file.resize(needed, 0);
                        }
                        file[place..needed].copy_from_slice(&bytes[begin..end]);
                    }
                    begin = end;
                }
            }
            _ => {}
        }
    }
}

/// Numbers as if by chance, the same in each run of a test.
struct Chance(u64);

impl Chance {
    fn below(&mut self, end: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % end
    }
}
