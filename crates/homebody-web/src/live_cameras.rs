//! The present view of the cameras of a run. Only the last silhouette of each is stored.

use crate::wire::CameraStateView;
use homebody_core::event::Frame;
use homebody_core::home::resolved::ResolvedHome;
use homebody_core::ids::SensorId;
use homebody_core::sensor_set::SensorSet;
use homebody_core::time::{RunTime, Span};
use homebody_log::silhouettes::cameras;

pub struct LiveCameras(Vec<LiveCamera>);

struct LiveCamera {
    sensor: SensorId,
    period: Span,
    /// The time of its last silhouette with a body, and that silhouette, packed.
    last: Option<(RunTime, Vec<u8>)>,
}

impl LiveCameras {
    pub fn from_home(home: &ResolvedHome) -> LiveCameras {
        let camera = |(sensor, file): (SensorId, &homebody_core::sensors::camera::CameraFile)| LiveCamera {
            sensor,
            period: file.period(),
            last: None,
        };
        LiveCameras(cameras(home).map(camera).collect())
    }

    pub fn take(&mut self, frames: &[Frame]) {
        for camera in &mut self.0 {
            let last = frames.iter().rev().find(|frame| frame.sensor == camera.sensor);
            if let Some(Frame { at, picture, .. }) = last {
                camera.last = Some((*at, picture.packed.clone()));
            }
        }
    }

    /// The views at an instant, with the sensors that are awake. A silhouette counts until the next is due, because cameras store none of
    /// an empty room.
    pub fn at(&self, now: RunTime, awake: &SensorSet) -> Vec<CameraStateView> {
        let camera = |camera: &LiveCamera| {
            let is_latest = |(at, _): &&(RunTime, Vec<u8>)| *at <= now && now - *at <= camera.period;
            let awake = awake.contains(camera.sensor);
            let packed = camera.last.as_ref().filter(is_latest).filter(|_| awake).map(|(_, packed)| packed.clone());
            CameraStateView { sensor: camera.sensor.0, awake, packed: packed.unwrap_or_default() }
        };
        self.0.iter().map(camera).collect()
    }
}
