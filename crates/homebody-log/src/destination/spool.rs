//! Keeps rows while a destination is away: the run fails, waits, or spools them on disk.
//!
//! A spool is a file of rows that their destination has not taken yet. Its size is bounded, and it is removed once the destination has all
//! rows. The spool of a killed program is useless: the resumed run makes these rows again.

mod frame;

use super::timed_sink::TimedSink;
use crate::error::{LogError, place_of};
use crate::files::{OpenMode, open};
use crate::policy::SinkMetrics;
use crate::sink::{Begin, Sink, Watermark};
use crate::table::Batch;
use frame::{read_frame, write_frame};
use homebody_core::time::RunTime;
use std::fs::{self, File};
use std::io::{BufReader, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The reaction of a run to the absence of one of its destinations.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum WhenDown {
    /// It ends with an error; what the destination has confirmed is safe there.
    #[default]
    Error,
    /// It waits until the destination is back, for so long at most.
    Retry(Duration),
    /// The run continues. Rows are spooled in this folder, in at most so many bytes, and handed over once the destination is back.
    Spool(PathBuf, u64),
}

/// First and longest wait between two attempts to reach an unavailable destination (our choice).
const FIRST_WAIT: Duration = Duration::from_millis(100);
const LONGEST_WAIT: Duration = Duration::from_secs(5);

/// The number of batches that may wait while a destination does not answer.
pub(crate) const BATCHES_WAITING: usize = 256;

/// The interval of checks for the answer of a destination.
const ANSWER_LOOK: Duration = Duration::from_millis(250);

/// Time to wait for a destination at the end of a run (our choice): a restart of a server takes less.
const END_WAITS: Duration = Duration::from_secs(60);

pub(crate) fn file_name(place: &str) -> String {
    let plain: String = place.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).take(80).collect();
    plain.split('-').filter(|part| !part.is_empty()).collect::<Vec<_>>().join("-")
}

/// A destination whose rows are put aside while it is away.
pub(crate) struct Spooled {
    place: String,
    inner: TimedSink,
    path: PathBuf,
    most_bytes: u64,
    beginning: Option<Begin>,
    has_begun: bool,
    /// Rows that it has already and that are still to come, by table: known where it could not be asked at the beginning.
    there: Vec<u64>,
    /// Its watermark at the last request.
    durable: Watermark,
    /// While it is away.
    away: Option<Spooling>,
    meter: Arc<SinkMetrics>,
}

struct Spooling {
    file: BufWriter<File>,
    written_bytes: u64,
    /// Up to where the destination has it.
    read_bytes: u64,
    /// No rows, and the texts of all that were put aside.
    texts: Batch,
    wait: Duration,
    next_try: Instant,
}

impl Spooled {
    pub fn new(place: String, inner: TimedSink, folder: &Path, most_bytes: u64, meter: Arc<SinkMetrics>) -> Spooled {
        let path = folder.join(format!("{}.spool", file_name(&place)));
        Spooled {
            place,
            inner,
            path,
            most_bytes,
            beginning: None,
            has_begun: false,
            there: Vec::new(),
            durable: Watermark::none(),
            away: None,
            meter,
        }
    }

    fn is_stopped(&self) -> bool {
        self.beginning.as_ref().is_some_and(|beginning| beginning.cancel.is_cancelled())
    }

    /// From now on rows are put aside, as the destination is away.
    fn goes_away(&mut self, error: &LogError) -> Result<(), LogError> {
        let opened = open(&self.path, OpenMode::Kept).and_then(|file| file.set_len(0).map(|()| file));
        let file = BufWriter::new(opened.map_err(|error| LogError::file(&self.path, error))?);
        let next_try = Instant::now() + FIRST_WAIT;
        self.meter.is_away(&self.place, error, None);
        self.away = Some(Spooling {
            file,
            written_bytes: 0,
            read_bytes: 0,
            texts: Batch::default(),
            wait: FIRST_WAIT,
            next_try,
        });
        Ok(())
    }

    fn put_aside(&mut self, batch: &Batch) -> Result<(), LogError> {
        let Some(away) = &mut self.away else { return Ok(()) };
        let frame = write_frame(batch);
        if away.written_bytes + frame.len() as u64 > self.most_bytes {
            return Err(LogError::SpoolFull {
                place: self.place.clone(),
                spool: place_of(&self.path),
                most_mb: self.most_bytes >> 20,
            });
        }
        away.file.write_all(&frame).map_err(|error| LogError::file(&self.path, error))?;
        away.written_bytes += frame.len() as u64;
        self.meter.puts_aside(away.written_bytes - away.read_bytes);
        away.texts = Batch::default().with_texts_of(batch);
        Ok(())
    }

    /// Hands over what was put aside if it is time to try; an error that passes means that the destination is still away. Nobody waits
    /// here for one that takes long to answer: its answer is heard later.
    fn catch_up(&mut self, now: bool) -> Result<(), LogError> {
        if self.away.as_ref().is_none_or(|away| !now && Instant::now() < away.next_try) {
            return Ok(());
        }
        match self.hand_over() {
            Ok(false) => {
                if let Some(away) = &mut self.away {
                    away.next_try = Instant::now() + ANSWER_LOOK;
                }
                Ok(())
            }
            Ok(true) => {
                self.away = None;
                self.meter.puts_aside(0);
                self.meter.is_there(&self.place);
                let _ = fs::remove_file(&self.path);
                Ok(())
            }
            Err(error) if error.passes() => {
                self.meter.tries_again();
                self.meter.is_away(&self.place, &error, None);
                if let Some(away) = &mut self.away {
                    away.wait = (2 * away.wait).min(LONGEST_WAIT);
                    away.next_try = Instant::now() + away.wait;
                }
                Ok(())
            }
            Err(error) => Err(error),
        }
    }

    /// Hands over what was put aside. False where the destination has not answered yet: then the same is asked again.
    fn hand_over(&mut self) -> Result<bool, LogError> {
        if let (false, Some(beginning)) = (self.has_begun, &self.beginning) {
            let Some(there) = self.inner.begin_briefly(beginning)? else { return Ok(false) };
            (self.there, self.has_begun) = (there.0, true);
        }
        let Some(away) = &mut self.away else { return Ok(true) };
        let failed = |path: &Path| {
            let path = path.to_owned();
            move |error| LogError::file(&path, error)
        };
        away.file.flush().map_err(failed(&self.path))?;
        let mut file = File::open(&self.path).map_err(failed(&self.path))?;
        file.seek(SeekFrom::Start(away.read_bytes)).map_err(failed(&self.path))?;
        let mut file = BufReader::with_capacity(1 << 16, file);
        while away.read_bytes < away.written_bytes {
            let (batch, bytes) = read_frame(&mut file, &away.texts).map_err(failed(&self.path))?;
            // Existing rows are skipped once: the same frame may be tried again.
            let mut there = self.there.clone();
            let rest = batch.beyond(&mut there);
            if !rest.is_empty() && self.inner.write_briefly(&rest)?.is_none() {
                return Ok(false);
            }
            self.there = there;
            away.read_bytes += bytes;
        }
        let Some(durable) = self.inner.make_durable_briefly()? else { return Ok(false) };
        self.durable = durable;
        Ok(true)
    }
}

impl Sink for Spooled {
    fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError> {
        // The resumed run makes the rows of a dead program again.
        if let Err(error) = fs::remove_file(&self.path)
            && error.kind() != std::io::ErrorKind::NotFound
        {
            return Err(LogError::file(&self.path, error));
        }
        self.beginning = Some(begin.clone());
        match self.inner.begin(begin) {
            Err(error) if error.passes() => {
                self.goes_away(&error)?;
                Ok(Watermark::none())
            }
            begun => {
                self.has_begun = begun.is_ok();
                begun
            }
        }
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        self.catch_up(false)?;
        if self.away.is_some() {
            return self.put_aside(batch);
        }
        let mut there = self.there.clone();
        let rest = batch.beyond(&mut there);
        match self.inner.write(&rest) {
            Err(error) if error.passes() => {
                self.goes_away(&error)?;
                self.put_aside(batch)
            }
            written => {
                self.there = there;
                written
            }
        }
    }

    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        self.catch_up(false)?;
        if self.away.is_none() {
            match self.inner.make_durable() {
                Err(error) if error.passes() => self.goes_away(&error)?,
                settled => self.durable = settled?,
            }
        }
        Ok(self.durable.clone())
    }

    fn finish(&mut self, end: RunTime) -> Result<(), LogError> {
        let until = Instant::now() + END_WAITS;
        loop {
            self.catch_up(true)?;
            if self.away.is_none() {
                match self.inner.finish(end) {
                    Err(error) if error.passes() => self.goes_away(&error)?,
                    finished => return finished,
                }
            }
            if let Some(why) = self.meter.why_away().filter(|_| self.is_stopped()) {
                return Err(LogError::StoppedAway { place: self.place.clone(), why });
            }
            if Instant::now() >= until {
                return Err(LogError::StillAway { place: self.place.clone(), seconds: END_WAITS.as_secs() });
            }
            std::thread::sleep(FIRST_WAIT);
        }
    }

    fn is_behind(&self) -> bool {
        self.away.is_some()
    }
}

impl Drop for Spooled {
    fn drop(&mut self) {
        // The resumed run makes these rows again.
        if self.away.take().is_some() {
            let _ = fs::remove_file(&self.path);
        }
    }
}
