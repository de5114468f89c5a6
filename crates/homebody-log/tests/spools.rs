//! A destination is unavailable while rows go into a spool on disk: later it gets each row once and in order, and no other destination
//! waits.

use crate::stage::{self, Folder};
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{RunTime, Span};
use homebody_log::destination::Note;
use homebody_log::run_log::destinations;
use homebody_log::table::{Batch, Cell};
use homebody_log::{
    Begin, Cancel, Destination, LogError, Logger, Policy, Sink, Stored, Watermark, WhenDown, WriteMode,
};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

const ROWS: u64 = 60_000;

const PLENTY_BYTES: u64 = 64 << 20;

/// A server that is there or away by how often it was asked for anything.
#[derive(Clone)]
struct Server {
    got: Arc<Mutex<Got>>,
    asked: Arc<AtomicUsize>,
    is_away: IsAway,
}

/// Whether it is away, by how often it was asked before.
type IsAway = fn(usize) -> bool;

/// The numbers and texts of its rows, some of them not durable yet, and whether the run has ended.
#[derive(Default)]
struct Got {
    rows: Vec<(i64, String)>,
    ended: bool,
}

impl Server {
    fn new(is_away: IsAway) -> Server {
        Server { got: Arc::default(), asked: Arc::default(), is_away }
    }

    fn answers(&self) -> Result<(), LogError> {
        match (self.is_away)(self.asked.fetch_add(1, Ordering::Relaxed)) {
            true => Err(LogError::destination("a server", "it is away").passing()),
            false => Ok(()),
        }
    }

    fn is_whole(&self) -> bool {
        let got = self.got.lock().unwrap();
        let sensors = stage::sensors();
        got.ended
            && got.rows.iter().map(|(number, _)| *number).eq(0..ROWS as i64)
            && got.rows.iter().all(|(_, sensor)| sensors.contains(sensor))
    }
}

impl Sink for Server {
    fn begin(&mut self, _: &Begin) -> Result<Watermark, LogError> {
        self.answers()?;
        Ok(Watermark(vec![self.got.lock().unwrap().rows.len() as u64]))
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        self.answers()?;
        let row = |cells: &[Cell]| match cells {
            [Cell::Integer(number), _, Cell::Text(sensor), ..] => (*number, batch.text(*sensor).to_owned()),
            _ => panic!("a row of a log"),
        };
        self.got.lock().unwrap().rows.extend(batch.rows().map(|found| row(found.cells)));
        Ok(())
    }

    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        self.answers()?;
        Ok(Watermark(vec![self.got.lock().unwrap().rows.len() as u64]))
    }

    fn finish(&mut self, _: RunTime) -> Result<(), LogError> {
        self.answers()?;
        self.got.lock().unwrap().ended = true;
        Ok(())
    }
}

/// Stores a run into a file and a server, with what becomes of it while the server is away.
fn stored(folder: &Folder, server: &Server, when: &WhenDown) -> Result<Stored, LogError> {
    let mut all = destinations(&[folder.url("csv:log.csv")], WriteMode::Overwrite)?;
    all.push(Destination::own("a server", server.clone(), Policy::default()).when_down(when));
    let logger = Logger::open(all, &LoggerFile::default(), &Arc::new(stage::run()), WriteMode::Overwrite)?;
    stage::store(logger, &stage::firings(ROWS), 1000)
}

fn spool(folder: &Folder, most_bytes: u64) -> WhenDown {
    WhenDown::Spool(folder.path().into(), most_bytes)
}

#[test]
fn a_returning_destination_gets_every_row_once_and_no_spool_is_left() {
    let ways: [(&str, IsAway); 5] = [
        ("in-the-middle", |asked| (3..9).contains(&asked)),
        ("at-the-beginning", |asked| asked < 4),
        ("again-and-again", |asked| asked % 3 == 1),
        ("until-the-end", |asked| (2..12).contains(&asked)),
        ("never", |_| false),
    ];
    for (name, is_away) in ways {
        let (folder, server) = (Folder::new(name), Server::new(is_away));
        let stored = stored(&folder, &server, &spool(&folder, PLENTY_BYTES)).unwrap();
        assert_eq!((stored.rows, server.is_whole()), (ROWS, true), "{name}");
        assert_eq!(folder.files(), ["log.csv"], "{name}");
    }
    // The control: without a spool, the first time away ends the run.
    let (folder, server) = (Folder::new("without"), Server::new(|asked| asked == 3));
    assert!(stored(&folder, &server, &WhenDown::Error).is_err() && !server.is_whole());
}

#[test]
fn a_destination_with_the_beginning_gets_the_rest() {
    let folder = Folder::new("beginning");
    let server = Server::new(|asked| asked < 2);
    let sensor = stage::sensors()[0].clone();
    server.got.lock().unwrap().rows.extend((0..12_345).map(|number| (number, sensor.clone())));
    let stored = stored(&folder, &server, &spool(&folder, PLENTY_BYTES)).unwrap();
    assert_eq!((stored.rows, server.is_whole()), (ROWS, true));
}

/// A destination that counts what it was given since it was begun, and cannot say what it had before.
#[derive(Clone, Default)]
struct Forgetful(Arc<Mutex<Vec<i64>>>, Arc<AtomicUsize>);

impl Sink for Forgetful {
    fn begin(&mut self, _: &Begin) -> Result<Watermark, LogError> {
        self.1.store(0, Ordering::Relaxed);
        Ok(Watermark::none())
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        self.1.fetch_add(batch.len(), Ordering::Relaxed);
        let number = |cell: &Cell| if let Cell::Integer(number) = *cell { number } else { panic!("a number") };
        self.0.lock().unwrap().extend(batch.rows().map(|row| number(&row.cells[0])));
        Ok(())
    }

    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        Ok(Watermark(vec![self.1.load(Ordering::Relaxed) as u64]))
    }

    fn finish(&mut self, _: RunTime) -> Result<(), LogError> {
        Ok(())
    }
}

#[test]
fn confirmed_rows_do_not_go_to_a_forgetful_destination_again() {
    let (folder, forgetful) = (Folder::new("forgetful"), Forgetful::default());
    let lived = |rows, how| {
        let own = Destination::own("a pipe", forgetful.clone(), Policy::default()).remembered_in(folder.path());
        let logger = Logger::open(vec![own], &LoggerFile::default(), &Arc::new(stage::run()), how).unwrap();
        stage::store(logger, &stage::firings(rows), 1000).unwrap();
    };
    lived(ROWS / 3, WriteMode::Create);
    lived(ROWS / 2, WriteMode::Resume);
    lived(ROWS, WriteMode::Resume);
    assert!(forgetful.0.lock().unwrap().iter().copied().eq(0..ROWS as i64));
    // The control: nothing is left out for a run that begins anew.
    lived(ROWS, WriteMode::Create);
    assert_eq!(forgetful.0.lock().unwrap().len() as u64, 2 * ROWS);
}

#[test]
fn confirmed_rows_stay_noted_while_a_destination_is_away() {
    // It begins, takes and confirms three times, takes once more, and is away from then on.
    let (folder, server, cancel) = (Folder::new("noted"), Server::new(|asked| asked >= 8), Cancel::new());
    let own = Destination::own("a server", server.clone(), Policy::default());
    let own = own.when_down(&spool(&folder, PLENTY_BYTES)).remembered_in(folder.path());
    let own = Destination { cancel: cancel.clone(), ..own };
    let mut logger =
        Logger::open(vec![own], &LoggerFile::default(), &Arc::new(stage::run()), WriteMode::Create).unwrap();
    for step in stage::firings(10_000).chunks(1000) {
        logger.store(step, step[step.len() - 1].at + Span::MICROSECOND).unwrap();
        logger.make_durable().unwrap();
        logger.wait_durable().unwrap();
    }
    cancel.cancel();
    assert!(matches!(logger.finish().unwrap().away, Some(LogError::StoppedAway { .. })));
    let note = Note::read(&folder.path().join("a-server.confirmed.json")).unwrap();
    assert_eq!((note.rows, server.got.lock().unwrap().rows.len()), (vec![3000], 4000));
}

#[test]
fn a_full_spool_ends_the_run_and_says_how_to_resume() {
    let (folder, server) = (Folder::new("full"), Server::new(|asked| asked > 2));
    let error = stored(&folder, &server, &spool(&folder, 1 << 20)).unwrap_err();
    assert!(matches!(error, LogError::SpoolFull { most_mb: 1, .. }), "{error}");
    assert!(!folder.files().iter().any(|name| name.ends_with(".spool")), "whoever goes on makes its rows again");
}
