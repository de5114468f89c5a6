//! Which silhouettes are meant: of which cameras, and from when to when.

use crate::failure::Failure;
use homebody_core::scenario::nearest::nearest;
use homebody_core::sensors::camera::CameraFile;
use homebody_core::time::Micros;
use homebody_kit::LogWithSilhouettes;
use homebody_log::LogError;
use homebody_log::silhouettes::Kept;
use std::ops::Range;

/// What is asked for, by numbers.
pub struct Asked {
    /// The cameras, among all that have kept something, in the order in which they were asked for.
    pub cameras: Vec<usize>,
    /// The same as their home has them.
    pub files: Vec<CameraFile>,
    pub span: Range<Micros>,
}

impl Asked {
    /// Understands it, or says all that is wrong with it. `strip` is how long moments that are drawn take, if some are: without
    /// a word of the end these are all that is meant.
    pub fn of(
        kept: &LogWithSilhouettes,
        (names, from, to): (&[String], Option<&str>, Option<&str>),
        strip: Option<Micros>,
    ) -> Result<Asked, Failure> {
        let mut wrong = Vec::new();
        let mut cameras: Vec<usize> = Vec::new();
        let all = || kept.silhouettes.cameras.iter().map(|camera| camera.file.name.as_str());
        for name in names {
            match all().position(|known| known == name) {
                Some(camera) if !cameras.contains(&camera) => cameras.push(camera),
                Some(_) => {}
                None => {
                    let meant = nearest(name, all()).map_or(String::new(), |one| format!("did you mean {one:?}? "));
                    let all = all().collect::<Vec<_>>().join(", ");
                    wrong.push(format!("no camera is called {name:?}\n  hint: {meant}the cameras are {all}"));
                }
            }
        }
        if names.is_empty() {
            cameras = (0..kept.silhouettes.cameras.len()).collect();
        }
        let mut time = |text: Option<&str>| {
            let at = text.map(|text| kept.scenario.calendar.written(text).ok_or(text)).transpose();
            at.unwrap_or_else(|text| {
                let hint = "write 2025-06-03T03:12:05, or 03:12:05 for a time of the first 24 hours";
                wrong.push(format!("{text:?} is not a time\n  hint: {hint}"));
                None
            })
        };
        let (from, to) = (time(from), time(to));
        if let (Some(from), Some(to)) = (from, to)
            && from >= to
        {
            let hint = "--to must be later than --from";
            wrong.push(format!(
                "there is no time between {} and {}\n  hint: {hint}",
                clock(kept, from),
                clock(kept, to)
            ));
        }
        if !wrong.is_empty() {
            return Err(Failure::Usage(wrong.join("\n")));
        }
        let there = kept.silhouettes.span()?;
        let (first, last) = there.ok_or_else(|| {
            Failure::usage("no camera has seen a person\n  hint: an unfinished run may have pictures later")
        })?;
        let begin = from.unwrap_or(first);
        let end = to.or(strip.map(|long| begin + long + 1)).unwrap_or(last + 1);
        let files = cameras.iter().map(|&camera| kept.silhouettes.cameras[camera].file.clone()).collect();
        Ok(Asked { cameras, files, span: begin..end })
    }

    /// Hands over those that are meant, each with the number of its camera among those.
    pub fn for_each<E: From<LogError>>(
        &self,
        kept: &LogWithSilhouettes,
        mut each: impl FnMut(Kept, usize) -> Result<(), E>,
    ) -> Result<(), E> {
        kept.silhouettes.for_each_within(self.span.clone(), |kept| {
            let camera = self.cameras.iter().position(|&camera| camera == kept.camera);
            camera.map_or(Ok(()), |camera| each(kept, camera))
        })
    }

    /// Why nothing is there, and when there is something.
    pub fn nothing(&self, kept: &LogWithSilhouettes) -> Result<Failure, LogError> {
        let [begin, end] = [self.span.start, self.span.end].map(|at| clock(kept, at));
        let before = kept.silhouettes.last_before(self.span.start)?;
        let after = kept.silhouettes.next_from(self.span.end)?;
        let near = [("the last one before is at", before), ("the next one after is at", after)];
        let near = near.into_iter().filter_map(|(words, at)| Some(format!("{words} {}", clock(kept, at?))));
        let mut hints: Vec<String> = near.collect();
        if self.cameras.len() < kept.silhouettes.cameras.len() {
            hints.push("other cameras may have silhouettes in this time".into());
        }
        let names: Vec<&str> = self.files.iter().map(|file| file.name.as_str()).collect();
        let what = format!("{}: no silhouettes from {begin} to {end}", names.join(", "));
        Ok(Failure::usage(format!("{what}\n  hint: {}", hints.join("; "))))
    }
}

/// An instant on the clock on the wall, such as `2025-06-03 03:12:05.200`.
pub fn clock(kept: &LogWithSilhouettes, at: Micros) -> String {
    kept.scenario.calendar.local(at).strftime("%Y-%m-%d %H:%M:%S%.3f").to_string()
}
