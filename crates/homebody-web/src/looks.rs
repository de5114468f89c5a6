//! What the cameras of a run that is being lived see now. Pictures go by; nothing but the last of each camera is kept.

use crate::wire::LookView;
use homebody_core::event::Frame;
use homebody_core::home::resolved::ResolvedHome;
use homebody_core::ids::SensorId;
use homebody_core::sensor_set::SensorSet;
use homebody_core::time::{RunTime, Span};
use homebody_log::silhouettes::cameras;

/// The cameras of a home.
pub struct Looks(Vec<Look>);

struct Look {
    sensor: SensorId,
    period: Span,
    /// When it saw somebody last, and its silhouette, packed.
    last: Option<(RunTime, Vec<u8>)>,
}

impl Looks {
    pub fn of(home: &ResolvedHome) -> Looks {
        let look = |(sensor, camera): (SensorId, &homebody_core::sensors::camera::CameraFile)| Look {
            sensor,
            period: camera.period(),
            last: None,
        };
        Looks(cameras(home).map(look).collect())
    }

    /// Takes what the cameras have kept since the last time.
    pub fn take(&mut self, frames: &[Frame]) {
        for look in &mut self.0 {
            let last = frames.iter().rev().find(|frame| frame.sensor == look.sensor);
            if let Some(Frame { at, picture, .. }) = last {
                look.last = Some((*at, picture.packed.clone()));
            }
        }
    }

    /// What they see at an instant at which these sensors are awake. A picture is the latest until the next is due: of an empty
    /// room none is kept.
    pub fn at(&self, now: RunTime, awake: &SensorSet) -> Vec<LookView> {
        let look = |look: &Look| {
            let is_latest = |(at, _): &&(RunTime, Vec<u8>)| *at <= now && now - *at <= look.period;
            let awake = awake.contains(look.sensor);
            let packed = look.last.as_ref().filter(is_latest).filter(|_| awake).map(|(_, packed)| packed.clone());
            LookView { sensor: look.sensor.0, awake, packed: packed.unwrap_or_default() }
        };
        self.0.iter().map(look).collect()
    }
}
