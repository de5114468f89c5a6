//! The selection of silhouettes by camera and time.

use super::messages::SilhouettesMessage;
use crate::commands::messages::MomentMessage;
use crate::failure::Failure;
use homebody_core::nearest::nearest;
use homebody_core::problem::Diagnostic;
use homebody_core::sensors::camera::CameraFile;
use homebody_core::time::{Interval, RunTime, Span};
use homebody_log::LogError;
use homebody_log::silhouettes::KeptSilhouettes;
use homebody_query::RunSilhouettes;

pub struct SilhouetteSelection {
    /// Indices of the cameras among all cameras with silhouettes, in the order of the arguments.
    pub cameras: Vec<usize>,
    /// The same cameras in the file of the home.
    pub files: Vec<CameraFile>,
    pub span: Interval<RunTime>,
}

impl SilhouetteSelection {
    /// Parses the arguments, or returns all their problems. `strip` is the duration of a strip of moments, if there is one: it is the
    /// selected time if no end is given.
    pub fn parse(
        kept: &RunSilhouettes,
        (names, from, to): (&[String], Option<&str>, Option<&str>),
        strip: Option<Span>,
    ) -> Result<SilhouetteSelection, Failure> {
        let mut wrong: Vec<Diagnostic> = Vec::new();
        let mut cameras: Vec<usize> = Vec::new();
        let all = || kept.silhouettes.cameras.iter().map(|camera| camera.file.name.as_str());
        for name in names {
            match all().position(|known| known == name) {
                Some(camera) if !cameras.contains(&camera) => cameras.push(camera),
                Some(_) => {}
                None => {
                    let nearest = nearest(name, all()).map(str::to_owned);
                    let known = all().map(str::to_owned).collect();
                    wrong.push(SilhouettesMessage::NoCamera { name: name.clone(), nearest, known }.into());
                }
            }
        }
        if names.is_empty() {
            cameras = (0..kept.silhouettes.cameras.len()).collect();
        }
        let mut time = |text: Option<&str>| {
            let at = text.map(|text| kept.scenario.calendar.written(text).ok_or(text)).transpose();
            at.unwrap_or_else(|text| {
                wrong.push(MomentMessage::NotATime { text: text.to_owned() }.into());
                None
            })
        };
        let (from, to) = (time(from), time(to));
        if let (Some(from), Some(to)) = (from, to)
            && from >= to
        {
            let [from, to] = [from, to].map(|at| clock(kept, at));
            wrong.push(MomentMessage::NoSpan { from, to }.into());
        }
        if !wrong.is_empty() {
            return Err(Failure::all(wrong));
        }
        let there = kept.silhouettes.span()?;
        let there = there.ok_or_else(|| Failure::asked(SilhouettesMessage::NoneYet))?;
        let begin = from.unwrap_or(there.begin);
        let last = strip.map_or(there.end, |long| begin + long);
        let end = to.unwrap_or(last + Span::MICROSECOND);
        let files = cameras.iter().map(|&camera| kept.silhouettes.cameras[camera].file.clone()).collect();
        Ok(SilhouetteSelection { cameras, files, span: Interval::new(begin, end) })
    }

    /// Passes on the selected silhouettes, each with the index of its camera in the selection.
    pub fn for_each<E: From<LogError>>(
        &self,
        kept: &RunSilhouettes,
        mut each: impl FnMut(KeptSilhouettes, usize) -> Result<(), E>,
    ) -> Result<(), E> {
        kept.silhouettes.for_each_within(self.span, |kept| {
            let camera = self.cameras.iter().position(|&camera| camera == kept.camera);
            camera.map_or(Ok(()), |camera| each(kept, camera))
        })
    }

    /// The failure of a selection without silhouettes, with the nearest ones before and after.
    pub fn nothing(&self, kept: &RunSilhouettes) -> Result<Failure, LogError> {
        let [begin, end] = [self.span.begin, self.span.end].map(|at| clock(kept, at));
        let before = kept.silhouettes.last_before(self.span.begin)?;
        let after = kept.silhouettes.next_from(self.span.end)?;
        let [before, after] = [before, after].map(|at| at.map(|at| clock(kept, at)));
        Ok(Failure::asked(SilhouettesMessage::NoneInTime {
            cameras: self.files.iter().map(|file| file.name.clone()).collect(),
            begin,
            end,
            before,
            after,
            has_others: self.cameras.len() < kept.silhouettes.cameras.len(),
        }))
    }
}

/// An instant in local time, such as `2025-06-03 03:12:05.200`.
pub fn clock(kept: &RunSilhouettes, at: RunTime) -> String {
    kept.scenario.calendar.local(at).strftime("%Y-%m-%d %H:%M:%S%.3f").to_string()
}
