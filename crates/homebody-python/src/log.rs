//! Logs with their ground truth: read, cut into windows, label, draw and compare them.

use crate::fault::{json, named, raised};
use crate::scenario::PythonScenario;
use crate::table::TableStream;
use crate::work::PythonProgress;
use arrow_array::{ArrayRef, RecordBatch};
use homebody_analysis::dates::DayChoice;
use homebody_analysis::day::DayRecord;
use homebody_analysis::density::density;
use homebody_analysis::windows::windows;
use homebody_arrow::{ArrowError, ColumnTable, TextColumn, whole_file};
use homebody_core::time::{DAY, Interval, Span, UtcTime, WallTime};
use homebody_log::log::Clock;
use homebody_log::source::TruthValue;
use homebody_log::table::ColumnKind;
use homebody_log::table::truth::tables;
use homebody_log::{Transfer, Url, WriteMode, label};
use homebody_picture::{DayChart, day_chart, density_map, measures_picture};
use homebody_query::{LoadedLog, LogRef, QueryError, UtcLog};
use homebody_tracking::located_folder::locate_into;
use jiff::tz::TimeZone;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// The columns that labels add to a log.
const LABELS: [&str; 5] = ["resident", "room", "activity", "cause", "thing"];

/// A log by its name.
#[pyclass(frozen, name = "Log", module = "homebody._homebody")]
pub struct PythonLog {
    text: String,
    zone: Option<String>,
    instants: OnceLock<UtcLog>,
    on_the_wall: OnceLock<LoadedLog>,
}

impl PythonLog {
    fn named(&self) -> Result<LogRef, QueryError> {
        LogRef::find(&self.text)
    }

    fn instants(&self) -> PyResult<&UtcLog> {
        if let Some(read) = self.instants.get() {
            return Ok(read);
        }
        let read = self.named().and_then(|named| named.instants(self.zone.as_deref())).map_err(raised)?;
        Ok(self.instants.get_or_init(|| read))
    }

    fn on_the_wall(&self) -> PyResult<&LoadedLog> {
        if let Some(read) = self.on_the_wall.get() {
            return Ok(read);
        }
        let read = LoadedLog::read(&self.text, self.zone.as_deref()).map_err(raised)?;
        Ok(self.on_the_wall.get_or_init(|| read))
    }

    /// Some of its rows: time, device, value.
    fn event_batch(&self, rows: Range<usize>) -> PyResult<Result<RecordBatch, ArrowError>> {
        let UtcLog { log, zone, .. } = self.instants()?;
        let events = log.events.get(rows).ok_or_else(|| named("LogError", "its rows have changed meanwhile"))?;
        let times = events.iter().map(|event| Some(event.at.micros())).collect();
        let (mut devices, mut values) =
            (TextColumn::from_texts(log.sensors.clone()), TextColumn::from_texts(log.values.clone()));
        for event in events {
            devices.push_place(Some(event.sensor));
            values.push_place(Some(event.value));
        }
        let frame = ColumnTable::default().instants("time", times, zone.as_deref());
        let frame = frame.texts("device", devices).and_then(|frame| frame.texts("value", values));
        Ok(frame.and_then(ColumnTable::batch))
    }

    /// Some of its rows, as columns with their names.
    fn event_columns(&self, rows: Range<usize>) -> PyResult<Vec<(String, ArrayRef, bool)>> {
        let batch = self.event_batch(rows)?.map_err(|error| named("HomebodyError", error))?;
        let names = batch.schema_ref().fields().iter().map(|field| field.name().clone());
        Ok(names.zip(batch.columns()).map(|(name, column)| (name, column.clone(), true)).collect())
    }

    fn labelled_into(&self, to: &Path) -> Result<(), QueryError> {
        let named = self.named()?;
        let truth = named.truth_that_is_there()?;
        let about = named.survey()?;
        let to: Url = Url::new(homebody_core::scenario::scheme::Scheme::Arrow, to);
        let zone = self.zone.as_deref().unwrap_or("UTC");
        let (from, mapping, name) = (&named.place, &named.mapping, self.text.as_str());
        let transfer = Transfer { from, mapping, to: &to, name, zone, how: WriteMode::Overwrite };
        label(&transfer, &about, &truth, &named.clock_beside(&truth), |_| ())?;
        Ok(())
    }
}

#[pymethods]
impl PythonLog {
    #[new]
    fn new(py: Python<'_>, text: String, zone: Option<String>) -> PyResult<PythonLog> {
        if let Some(zone) = zone.as_deref().filter(|zone| TimeZone::get(zone).is_err()) {
            let hint = "write a name such as Europe/Berlin";
            return Err(PyValueError::new_err(format!(
                "time_zone is {zone:?}: no time zone has this name\n  hint: {hint}"
            )));
        }
        let log = PythonLog { text, zone, instants: OnceLock::new(), on_the_wall: OnceLock::new() };
        py.detach(|| log.named()).map_err(raised)?;
        Ok(log)
    }

    /// The time zone of its home, if known.
    #[getter]
    fn time_zone(&self, py: Python<'_>) -> PyResult<Option<String>> {
        py.detach(|| Ok(self.instants()?.zone.clone()))
    }

    #[getter]
    fn sensors(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        py.detach(|| Ok(self.instants()?.log.sensors.clone()))
    }

    /// The residents of the ground truth.
    #[getter]
    fn residents(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        py.detach(|| Ok(self.instants()?.timeline.people.iter().map(|person| person.name.clone()).collect()))
    }

    /// Sentences about skipped lines.
    #[getter]
    fn remarks(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        py.detach(|| {
            let log = &self.instants()?.log;
            let skipped = log.problems.iter().map(|skipped| format!("line {}: {}", skipped.line, skipped.why));
            let is_of_no_place = log.clock == Clock::Utc && self.zone.is_none() && log.zone.is_none();
            let is_of_no_place = is_of_no_place && self.named().map_err(raised)?.zone().is_none();
            let hours = "its hours are those of UTC: time_zone tells the home's own";
            let hours = is_of_no_place.then(|| hours.to_owned());
            Ok(log.remarks.iter().cloned().chain(hours).chain(skipped).collect())
        })
    }

    /// Its rows: time, device, value.
    fn events(&self, py: Python<'_>) -> PyResult<TableStream> {
        py.detach(|| {
            let rows = self.instants()?.log.events.len();
            TableStream::of(self.event_batch(0..rows)?)
        })
    }

    /// The activities of residents: start_time, end_time, activity, resident; or their rooms, with `room` for the activity.
    fn spans(&self, py: Python<'_>, are_rooms: bool) -> PyResult<TableStream> {
        py.detach(|| {
            let UtcLog { timeline, zone, .. } = self.instants()?;
            let mut spans: Vec<(Interval<UtcTime>, &str, &str)> = Vec::new();
            for person in &timeline.people {
                let of = if are_rooms { &person.rooms } else { &person.activities };
                spans.extend(of.iter().map(|one| (one.time, one.label.as_str(), person.name.as_str())));
            }
            spans.sort();
            let (mut names, mut residents) = (TextColumn::default(), TextColumn::default());
            for (_, name, resident) in &spans {
                names.push(Some(name));
                residents.push(Some(resident).filter(|name| !name.is_empty()).copied());
            }
            let (begins, ends) =
                spans.iter().map(|(span, ..)| (Some(span.begin.micros()), Some(span.end.micros()))).unzip();
            let frame = ColumnTable::default().instants("start_time", begins, zone.as_deref());
            let frame = frame.instants("end_time", ends, zone.as_deref());
            let frame = frame.texts(if are_rooms { "room" } else { "activity" }, names);
            TableStream::of(frame.and_then(|frame| frame.texts("resident", residents)).and_then(ColumnTable::batch))
        })
    }

    /// A table of the truth, as `docs/reference/truth.md` has it.
    fn truth(&self, py: Python<'_>, table: &str) -> PyResult<TableStream> {
        py.detach(|| {
            let zone = self.instants()?.zone.clone();
            let all = tables();
            let columns = all.iter().find(|known| known.name == table).map_or(&[][..], |table| &table.columns);
            let mut cells: Vec<TruthColumn> = columns.iter().map(|column| TruthColumn::of(column.kind)).collect();
            let mut take =
                |row: &[TruthValue<'_>]| cells.iter_mut().zip(row).for_each(|(cells, cell)| cells.push(*cell));
            self.named().and_then(|named| named.truth_rows(table, &mut take)).map_err(raised)?;
            let mut frame = Ok(ColumnTable::default());
            for (column, cells) in columns.iter().zip(cells) {
                frame = frame.and_then(|frame| cells.into_frame(frame, &column.name, zone.as_deref()));
            }
            TableStream::of(frame.and_then(ColumnTable::batch))
        })
    }

    /// Windows of so many seconds: time, resident, label, room, hour, weekday, last, and a count for each sensor.
    fn windows(&self, py: Python<'_>, span_s: f64) -> PyResult<TableStream> {
        py.detach(|| {
            let UtcLog { log, timeline, zone } = self.instants()?;
            let wall = zone.as_deref().and_then(|zone| TimeZone::get(zone).ok()).unwrap_or(TimeZone::UTC);
            let cut = windows(log, &timeline.people, Span::from_seconds(span_s), &wall);
            let cut = cut.map_err(|why| PyValueError::new_err(format!("span is {span_s} s: {why}")))?;
            let (mut residents, mut labels, mut rooms) =
                (TextColumn::default(), TextColumn::default(), TextColumn::default());
            let mut last = TextColumn::from_texts(cut.sensors.clone());
            let (mut times, mut hours, mut weekdays) = (Vec::new(), Vec::new(), Vec::new());
            let mut counts: Vec<Vec<Option<i64>>> = vec![Vec::with_capacity(cut.rows.len()); cut.sensors.len()];
            for row in &cut.rows {
                let name = row.resident.map(|resident| timeline.people[resident].name.as_str());
                residents.push(name.filter(|name| !name.is_empty()));
                labels.push(row.label.as_deref());
                rooms.push(row.room.as_deref());
                last.push_place(row.last);
                times.push(Some(row.begin.micros()));
                let at = row.begin.timestamp().to_zoned(wall.clone());
                hours.push(Some(f64::from(at.hour()) + f64::from(at.minute()) / 60.0));
                weekdays.push(Some(i64::from(at.weekday().to_monday_zero_offset())));
                counts.iter_mut().zip(&row.counts).for_each(|(all, &count)| all.push(Some(count.into())));
            }
            let frame = ColumnTable::default().instants("time", times, zone.as_deref());
            let frame = frame.texts("resident", residents).and_then(|frame| frame.texts("label", labels));
            let frame = frame.and_then(|frame| frame.texts("room", rooms));
            let frame = frame.map(|frame| frame.reals("hour", hours).integers("weekday", weekdays));
            let frame = frame.and_then(|frame| frame.texts("last", last)).map(|frame| {
                let columns = cut.sensors.iter().zip(counts);
                columns.fold(frame, |frame, (sensor, counts)| frame.integers(sensor, counts))
            });
            TableStream::of(frame.and_then(ColumnTable::batch))
        })
    }

    /// The log with labels, by way of a file of Arrow IPC.
    fn labelled(&self, py: Python<'_>, by: PathBuf) -> PyResult<TableStream> {
        py.detach(|| {
            self.labelled_into(&by).map_err(raised)?;
            let (_, batches) = whole_file(&by).map_err(|error| named("LogError", error))?;
            let mut before = 0;
            let batches = batches.iter().map(|batch| {
                let events = self.event_columns(before..before + batch.num_rows())?;
                before += batch.num_rows();
                let labels = LABELS.iter().map(|name| {
                    let column = batch.column_by_name(name).cloned();
                    let missing = || named("LogError", format!("there are no labels {name}"));
                    column.map(|column| ((*name).to_owned(), column, true)).ok_or_else(missing)
                });
                let all: Vec<_> = events.into_iter().map(Ok).chain(labels).collect::<PyResult<_>>()?;
                let whole = RecordBatch::try_from_iter_with_nullable(all);
                whole.map_err(|error| named("HomebodyError", error))
            });
            TableStream::of_parts(batches.collect::<PyResult<_>>()?)
        })
    }

    /// The first and the last of its dates.
    #[getter]
    fn dates(&self, py: Python<'_>) -> PyResult<Option<(String, String)>> {
        let dates = py.detach(|| self.on_the_wall().map(LoadedLog::dates))?;
        Ok(dates.map(|(first, last)| (first.to_string(), last.to_string())))
    }

    /// A day: a date, `first`, `last`, or its number from 0 on. Its figures and its chart.
    fn day(&self, py: Python<'_>, day: &str) -> PyResult<(String, String)> {
        py.detach(|| {
            let read = self.on_the_wall()?;
            let there = read.dates().ok_or_else(|| named("LogError", "it has no rows, so no day"))?;
            let (first, last) = there;
            let date = match day.parse::<i64>() {
                Ok(number) => {
                    let date = (WallTime::midnight(first) + DAY.saturating_mul(number)).date();
                    (first..=last).contains(&date).then_some(date)
                }
                Err(_) => {
                    let wrong = |why| PyValueError::new_err(format!("day is {day:?}: {why}"));
                    day.parse::<DayChoice>().map_err(wrong)?.within(there)
                }
            };
            let no_day = || PyValueError::new_err(format!("day is {day}: the log goes from {first} to {last}"));
            let day = DayRecord::from_log(
                &read.name,
                &read.log,
                &read.timeline.people,
                read.ended(),
                date.ok_or_else(no_day)?,
            );
            Ok((json(&day)?, day_chart(&DayChart::new(&day))))
        })
    }

    /// The density of each hour of each day: figures and a map.
    fn density(&self, py: Python<'_>) -> PyResult<(String, String)> {
        py.detach(|| {
            let read = self.on_the_wall()?;
            let map =
                density((&read.name, &read.log, &read.density_asked()), None).map_err(|why| named("LogError", why))?;
            Ok((json(&map)?, density_map(&map)))
        })
    }

    /// The measures of each day: figures and a picture.
    fn measures(&self, py: Python<'_>) -> PyResult<(String, String)> {
        py.detach(|| {
            let measures = self.on_the_wall()?.measures().map_err(|why| named("LogError", why))?;
            Ok((json(&measures)?, measures_picture(&measures)))
        })
    }
}

/// The cells of a column of the truth.
enum TruthColumn {
    Instants(Vec<Option<i64>>),
    Integers(Vec<Option<i64>>),
    Reals(Vec<Option<f64>>),
    Texts(TextColumn),
}

impl TruthColumn {
    fn of(kind: ColumnKind) -> TruthColumn {
        match kind {
            ColumnKind::Instant => TruthColumn::Instants(Vec::new()),
            ColumnKind::Integer => TruthColumn::Integers(Vec::new()),
            ColumnKind::Real => TruthColumn::Reals(Vec::new()),
            ColumnKind::Text => TruthColumn::Texts(TextColumn::default()),
        }
    }

    fn push(&mut self, cell: TruthValue<'_>) {
        let whole = |cell| if let TruthValue::Integer(number) = cell { Some(number) } else { None };
        match self {
            TruthColumn::Instants(all) | TruthColumn::Integers(all) => all.push(whole(cell)),
            TruthColumn::Reals(all) => all.push(if let TruthValue::Real(number) = cell { Some(number) } else { None }),
            TruthColumn::Texts(all) => match cell {
                TruthValue::Integer(number) => all.push(Some(&number.to_string())),
                TruthValue::Text(text) => all.push(Some(text)),
                _ => all.push(None),
            },
        }
    }

    fn into_frame(self, frame: ColumnTable, name: &str, zone: Option<&str>) -> Result<ColumnTable, ArrowError> {
        Ok(match self {
            TruthColumn::Instants(all) => frame.instants(name, all, zone),
            TruthColumn::Integers(all) => frame.integers(name, all),
            TruthColumn::Reals(all) => frame.reals(name, all),
            TruthColumn::Texts(all) => frame.texts(name, all)?,
        })
    }
}

/// The comparison of two logs, as JSON and in words. Each log comes with its time zone.
#[pyfunction]
pub fn compare(py: Python<'_>, a: (String, Option<String>), b: (String, Option<String>)) -> PyResult<(String, String)> {
    py.detach(|| {
        let find = |text: &str| LogRef::find(text).map_err(raised);
        let found = [find(&a.0)?, find(&b.0)?];
        // A run knows the sensors of the ids in its log, also in a copy of the log.
        let name = |id: &str| found.iter().find_map(|named| named.name_of(id)).unwrap_or(id).to_owned();
        let read = |named: &LogRef, zone: &Option<String>| {
            let mut log = named.with_activities(zone.as_deref()).map_err(raised)?;
            log.sensors.iter_mut().for_each(|sensor| *sensor = name(sensor));
            Ok::<_, PyErr>(log)
        };
        let comparison = homebody_analysis::compare::compare(&read(&found[0], &a.1)?, &read(&found[1], &b.1)?);
        Ok((json(&comparison)?, comparison.to_string()))
    })
}

/// Locates the residents from a log in a home, into a new folder. Returns the report as JSON.
#[pyfunction]
#[pyo3(signature = (text, zone, home, to, progress))]
pub fn translate(
    py: Python<'_>,
    text: &str,
    zone: Option<&str>,
    home: &PythonScenario,
    to: PathBuf,
    progress: Option<Py<PyAny>>,
) -> PyResult<String> {
    let watched = PythonProgress::new(progress);
    let result = py.detach(|| {
        let scenario = home.opened.scenario();
        let zone = zone.unwrap_or(&scenario.file.time_zone);
        let read = LoadedLog::read(text, Some(zone)).map_err(raised)?;
        let progress = |share: f64| watched.tell(share, 1.0);
        json(&locate_into(&to, (text, &read), scenario, &watched.cancel, progress).map_err(raised)?)
    });
    watched.finish(result)
}
