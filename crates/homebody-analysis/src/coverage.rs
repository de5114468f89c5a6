//! Coverage: the share of the walkable floor that the sensors see, their overlaps, and the dead zones.
//!
//! It uses the same fields that make the data: `sees` has for each place the sensors that would notice a body that stands and moves there.
//!
//! We assume that a body can be wherever it fits, even where a piece of furniture locks it out.
//!
//! The floor is sampled at the middles of square cells; an area is the number of its cells times the cell's. A straight border can put at
//! most half of each cell it crosses on the wrong side, and that, summed over the border's cells, is the error given with each area: a
//! bound for straight borders, an estimate for others.
//!
//! Left out: the time that people spend at a place, and the chance that a sensor notices them.

pub mod cameras;
mod grid;
mod table;

use homebody_core::geometry::Point;
use homebody_core::home::field::Field;
use homebody_core::home::form::HomeFile;
use homebody_core::ids::SensorId;
use homebody_core::numbers::Numbers;
use homebody_core::plan::Plan;
use homebody_core::posture::Posture;
use homebody_core::resident::Build;
use homebody_core::sensor_set::SensorSet;
use homebody_core::sensors::Sensor;
use homebody_core::sensors::kinds::SensorFile;
use serde::Serialize;

pub use grid::{CellCorner, CoverageGrid, Region};

/// The side of a cell unless the caller wants another, in metres.
pub const STEP_M: f64 = 0.05;

/// Area below which a dead zone is not listed, though it counts in the shares; in square metres.
pub const LEAST_DEAD_ZONE_M2: f64 = 0.02;

/// The coverage of a home's walkable floor. Lengths are metres, areas square metres, shares 0 to 1.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Coverage {
    pub step_m: f64,
    /// The radius of the body that has to fit: its middle stays this far from walls and furniture.
    pub body_radius_m: f64,
    pub whole: SeenFloor,
    /// The rooms, in the order of the home's file.
    pub rooms: Vec<SeenFloor>,
    /// Walkable floor in doors, where their openings are in no room's outline.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub doorways: Option<SeenFloor>,
    pub sensors: Vec<SensorCoverage>,
    /// The pairs of sensors that share floor, the largest share first.
    pub overlaps: Vec<Overlap>,
    /// The floor that no sensor sees, the largest piece first.
    pub dead_zones: Vec<DeadZone>,
    #[serde(skip)]
    pub grid: CoverageGrid,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SeenFloor {
    pub name: String,
    pub floor_m2: f64,
    /// `floor_m2` is at most this far from the truth where the floor's borders are straight.
    pub floor_error_m2: f64,
    /// Shares of `floor_m2`; their sum is 1, or 0 without floor.
    pub seen_by: SeenBy,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct SeenBy {
    pub none: f64,
    pub one: f64,
    pub two: f64,
    pub three_or_more: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct SensorCoverage {
    pub name: String,
    /// The floor that it sees, in square metres.
    pub seen_m2: f64,
    /// The part of `seen_m2` that no other sensor sees.
    pub alone_m2: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Overlap {
    /// The names of the two, in the order of the home's file.
    pub sensors: [String; 2],
    pub shared_m2: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DeadZone {
    /// From 1, the largest first; pictures and tables have these numbers.
    pub number: usize,
    /// The room that holds most of it; `None` if no room holds any, as in a doorway.
    pub room: Option<String>,
    pub area_m2: f64,
    /// `area_m2` is about this far from the truth at most: a fan's border is many short straight ones.
    pub area_error_m2: f64,
    /// The point of the zone that is farthest from its border.
    pub middle: [f64; 2],
    /// The border, corners counter-clockwise.
    pub outline: Vec<[f64; 2]>,
    /// Pieces inside the outline that a sensor sees, or that are not walkable; corners clockwise.
    pub holes: Vec<Vec<[f64; 2]>>,
}

#[derive(Clone, Debug)]
pub struct SeenHome {
    /// The home with those of its sensors that look: the others have no field.
    pub home: HomeFile,
    pub coverage: Coverage,
    pub sensors: Vec<Sensor>,
    pub field: Field,
}

impl SeenHome {
    /// The wall sensors' beams on a standing body, to draw: the sensor's number among those that look, and both ends.
    pub fn beams(&self) -> Vec<(usize, Point, Point)> {
        let SeenHome { sensors, field, .. } = self;
        let walls = (0..sensors.len()).filter(|&sensor| sensors[sensor].is_on_wall());
        let beams = |sensor: usize| field.beams[field.range(sensor)].iter();
        walls.flat_map(|sensor| beams(sensor).map(move |beam| (sensor, beam.start, beam.end()))).collect()
    }
}

/// Computes the field of the sensors of a valid home for a standing body of this build, in cells of `step_m`.
pub fn of_home(home: &HomeFile, build: Build, step_m: f64) -> SeenHome {
    let mut home = home.clone();
    home.sensors.retain(SensorFile::senses_motion);
    let plan = Plan::new(&home);
    let sensors: Vec<Sensor> = home.sensors.iter().filter_map(|sensor| Sensor::new(sensor, &plan)).collect();
    let names: Vec<String> = sensors.iter().map(|sensor| sensor.name.clone()).collect();
    let field = Field::bake(&plan, &sensors, build.size(Posture::Standing, &Numbers::default()));
    let coverage = coverage(&plan, build.radius_m, &names, step_m, &|p| field.seen_at(p));
    SeenHome { home, coverage, sensors, field }
}

/// Samples the walkable floor in cells of `step_m` and counts which sensors see each.
///
/// `sees` answers for a body that stands and moves at a point: which of `sensors` would notice.
///
/// # Panics
///
/// If `sees` names a sensor that is not among `sensors`, or `step_m` is not a positive number.
pub fn coverage(
    plan: &Plan,
    body_radius_m: f64,
    sensors: &[String],
    step_m: f64,
    sees: &dyn Fn(Point) -> SensorSet,
) -> Coverage {
    let count = sensors.len();
    let grid = CoverageGrid::sample(plan.bounds(), step_m, |p| plan.is_walkable(p, body_radius_m).then(|| sees(p)));
    let room_of: Vec<Option<usize>> = (0..grid.cells.len()).map(|cell| plan.room_at(grid.middle(cell))).collect();
    let floor = |name: &str, belongs: &dyn Fn(usize) -> bool| floor(&grid, name, belongs);

    let whole = floor("all", &|_| true);
    let rooms = plan.rooms.iter().enumerate();
    let rooms = rooms.map(|(room, named)| floor(&named.name, &|cell| room_of[cell] == Some(room))).collect();
    let doorways = Some(floor("doorways", &|cell| room_of[cell].is_none())).filter(|floor| floor.floor_m2 > 0.0);
    let area = |counts: &dyn Fn(&SensorSet) -> bool| {
        grid.cells.iter().flatten().filter(|seen| counts(seen)).count() as f64 * step_m * step_m
    };
    let views = sensors.iter().enumerate().map(|(sensor, name)| SensorCoverage {
        name: name.clone(),
        seen_m2: area(&|seen| seen.contains(SensorId::new(sensor))),
        alone_m2: area(&|seen| seen.len() == 1 && seen.contains(SensorId::new(sensor))),
    });
    let mut shared = vec![0_usize; count * count];
    for seen in grid.cells.iter().flatten() {
        for a in seen.iter().map(SensorId::index) {
            seen.iter().map(SensorId::index).filter(|&b| b > a).for_each(|b| shared[a * count + b] += 1);
        }
    }
    let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b)));
    let mut overlaps: Vec<Overlap> = pairs
        .filter(|&(a, b)| shared[a * count + b] > 0)
        .map(|(a, b)| Overlap {
            sensors: [sensors[a].clone(), sensors[b].clone()],
            shared_m2: shared[a * count + b] as f64 * step_m * step_m,
        })
        .collect();
    overlaps.sort_by(|a, b| b.shared_m2.total_cmp(&a.shared_m2));
    Coverage {
        step_m,
        body_radius_m,
        whole,
        rooms,
        doorways,
        sensors: views.collect(),
        overlaps,
        dead_zones: dead_zones(&grid, plan, &room_of),
        grid,
    }
}

fn floor(grid: &CoverageGrid, name: &str, belongs: &dyn Fn(usize) -> bool) -> SeenFloor {
    let is_floor = |cell: usize| grid.cells[cell].is_some() && belongs(cell);
    let mut counts = [0_usize; 4];
    for cell in (0..grid.cells.len()).filter(|&cell| is_floor(cell)) {
        counts[grid.watchers(cell).unwrap_or(0).min(3)] += 1;
    }
    let cells: usize = counts.iter().sum();
    let share = |count: usize| if cells == 0 { 0.0 } else { count as f64 / cells as f64 };
    SeenFloor {
        name: name.to_owned(),
        floor_m2: cells as f64 * grid.step_m * grid.step_m,
        floor_error_m2: grid.area_error_m2(is_floor),
        seen_by: SeenBy {
            none: share(counts[0]),
            one: share(counts[1]),
            two: share(counts[2]),
            three_or_more: share(counts[3]),
        },
    }
}

fn dead_zones(grid: &CoverageGrid, plan: &Plan, room_of: &[Option<usize>]) -> Vec<DeadZone> {
    let mut regions = grid.regions(|cell| grid.watchers(cell) == Some(0));
    // By area; the regions come in the order of their first cells, which the stable sort keeps.
    regions.sort_by_key(|region| std::cmp::Reverse(region.cells.len()));
    let listed = regions.iter().filter(|region| grid.area_m2(region) >= LEAST_DEAD_ZONE_M2);
    let zones = listed.enumerate().map(|(index, region)| {
        let mut votes = vec![0_usize; plan.rooms.len()];
        for room in region.cells.iter().filter_map(|&cell| room_of[cell]) {
            votes[room] += 1;
        }
        let room = (0..votes.len()).filter(|&room| votes[room] > 0).max_by_key(|&room| votes[room]);
        let in_metres =
            |ring: &Vec<CellCorner>| grid::straightened(ring).iter().map(|&c| grid.corner(c).into()).collect();
        let mut rings = region.rings.iter().map(in_metres);
        DeadZone {
            number: index + 1,
            room: room.map(|room| plan.rooms[room].name.clone()),
            area_m2: grid.area_m2(region),
            area_error_m2: grid.region_error_m2(region),
            middle: grid.middle(grid.deepest(region)).into(),
            outline: rings.next().unwrap_or_default(),
            holes: rings.collect(),
        }
    });
    zones.collect()
}
