//! A wall-mounted passive infrared sensor.
//!
//! The device watches warm bodies move through a lens that spreads its view over a fan, 145 degrees
//! wide and 50 degrees high at TigerPlace, finer in the middle than at the edges (Godsey & Skubic 2009,
//! section III.D).
//!
//! We assume that every moving body is warm and large enough; that the lens stands two centimetres off
//! the wall; and that the fan is made of upright blades, each at one bearing, as high as the field is.
//! Bearings are spread as sign(u) |u|^1.5 over u in -1..1: of 32 over 145 degrees the middle two are 0.8 degrees
//! apart, the outermost two 6.9 (the exponent is ours; the paper's figure 3 only says that the middle is dense and the
//! edge sparse). The rows of the level `zones` are spread evenly.
//!
//! From a lens at height h, a body of height t at range r shows itself between the depressions
//! atan((h - t) / r) and atan(h / r). It is in a blade where that span meets the blade's own, so each
//! blade is a straight span of the floor plan, one per height of body. Walls, closed doors and furniture
//! as high as the lens end it; lower furniture casts a shadow behind it on bodies lower than itself.
//!
//! Left out: temperature and its contrast, the lens' gain by angle, mirrors and glass; a blade's
//! steep lower limit behind low furniture.

use crate::geometry::{self, Point, point};
use crate::scenario::home::{Level as LevelFile, MotionFile};
use crate::time::{Micros, micros};

/// How far the lens stands off the wall, in metres.
pub const LENS_OFF_WALL_M: f64 = 0.02;

/// A wall sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    pub lens: Point,
    pub height_m: f64,
    pub reach_m: f64,
    pub blades: Vec<Blade>,
    pub level: Level,
}

/// One bearing of the fan, before anything in the home limits it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blade {
    pub direction: Point,
    /// Tangents of the least and the greatest depression, positive below the horizon.
    pub least_depression: f64,
    pub greatest_depression: f64,
    /// At the `zones` level, whether the zone is the positive one of its pair.
    pub positive: bool,
}

/// What the sensor takes for movement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Level {
    Paper,
    /// A movement is seen up to `reach_per_m` metres away for each metre that it spans in a second.
    Sensitivity {
        reach_per_m: f64,
    },
    /// `pulses` of alternating sign within `window` make a detection.
    Zones {
        pulses: u32,
        window: Micros,
        pitch_rad: f64,
    },
}

impl Motion {
    pub fn new(file: &MotionFile) -> Motion {
        let lens = point(file.at) + geometry::direction(file.facing_deg) * LENS_OFF_WALL_M;
        let [width, height] = file.field_deg;
        let bottom = file.tilt_deg + height / 2.0;
        let blade = |bearing: f64, top: f64, bottom: f64, positive| Blade {
            direction: geometry::direction(file.facing_deg + bearing),
            least_depression: tangent(top),
            greatest_depression: tangent(bottom),
            positive,
        };
        let (blades, level) = match &file.level {
            LevelFile::Zones(zones) => {
                let row_height = height / 3.0;
                let rows = zones.rows.iter().enumerate();
                let blades = rows.flat_map(|(row, &count)| {
                    let top = file.tilt_deg - height / 2.0 + row as f64 * row_height;
                    spread(count, 1.0).map(move |(index, u)| {
                        blade(u * width / 2.0, top, top + row_height, (index + row as u32).is_multiple_of(2))
                    })
                });
                let level = Level::Zones {
                    pulses: zones.pulses,
                    window: micros(zones.window_s),
                    pitch_rad: width.to_radians() / f64::from(zones.rows[0].saturating_sub(1).max(1)),
                };
                (blades.collect(), level)
            }
            level => {
                let top = file.tilt_deg - height / 2.0;
                let blades = spread(file.beams, 1.5).map(|(_, u)| blade(u * width / 2.0, top, bottom, true));
                let level = match level {
                    LevelFile::Sensitivity(file) => {
                        Level::Sensitivity { reach_per_m: 1.0 / libm::tan(file.threshold_deg.to_radians()) }
                    }
                    _ => Level::Paper,
                };
                (blades.collect(), level)
            }
        };
        Motion { lens, height_m: file.height_m, reach_m: file.reach_m, blades, level }
    }

    /// The ranges at which a blade meets a body of this height where nothing stands in between:
    /// least and most, in metres; nothing if it never does.
    pub fn ranges(&self, blade: &Blade, body_m: f64) -> Option<(f64, f64)> {
        let (mut near, mut far) = (0.0_f64, self.reach_m);
        let above = self.height_m - body_m;
        if blade.greatest_depression > 0.0 {
            near = near.max(above / blade.greatest_depression);
        } else if above > 0.0 {
            return None;
        } else if blade.greatest_depression < 0.0 {
            far = far.min(above / blade.greatest_depression);
        }
        if blade.least_depression > 0.0 {
            far = far.min(self.height_m / blade.least_depression);
        }
        (near < far).then_some((near, far))
    }

    /// The ranges at which furniture hides a body of this height: it stands on the blade from
    /// `enter` to `leave` and is lower than the lens. A body is not hidden by what it lies on.
    pub fn shadow(
        &self,
        furniture_m: f64,
        enterable: bool,
        (enter, leave): (f64, f64),
        body_m: f64,
    ) -> Option<(f64, f64)> {
        if body_m >= furniture_m {
            return None;
        }
        let start = if enterable { leave } else { enter };
        Some((start, leave * (self.height_m - body_m) / (self.height_m - furniture_m)))
    }
}

/// `count` numbers over -1..1, dense in the middle for an exponent above 1.
fn spread(count: u32, exponent: f64) -> impl Iterator<Item = (u32, f64)> {
    (0..count).map(move |index| {
        let u = if count == 1 { 0.0 } else { 2.0 * f64::from(index) / f64::from(count - 1) - 1.0 };
        (index, u.signum() * libm::pow(u.abs(), exponent))
    })
}

/// The tangent of an angle in degrees; infinite straight down or steeper, minus infinity straight up.
fn tangent(angle_deg: f64) -> f64 {
    if angle_deg >= 90.0 {
        f64::INFINITY
    } else if angle_deg <= -90.0 {
        f64::NEG_INFINITY
    } else {
        libm::tan(angle_deg.to_radians())
    }
}
