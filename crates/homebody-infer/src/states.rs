//! The states of a body: patches of floor, seats, beds, and being out.

use homebody_core::geometry::Point;
use homebody_core::plan::Plan;
use homebody_core::posture::Posture;
use homebody_walk::Mesh;
use homebody_walk::places::{HomePlace, HomePlaces};

#[derive(Clone, Debug, PartialEq)]
pub struct BodyState {
    pub kind: StateKind,
    /// In metres; `None` while out.
    pub at: Option<Point>,
    /// Index of the plan's room; `None` while out.
    pub room: Option<usize>,
    pub posture: Posture,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StateKind {
    Out,
    Walks,
    Stands,
    /// Active at a place.
    Busy,
    Still,
    /// Without movement for minutes.
    Motionless,
}

#[derive(Clone, Debug)]
pub struct States {
    /// By the number of the state; 0 is being out.
    pub all: Vec<BodyState>,
    rooms: usize,
    pub(crate) stations: Vec<StayPlace>,
    grid: PatchGrid,
}

#[derive(Clone, Debug)]
pub(crate) struct StayPlace {
    pub spot: HomePlace,
    pub busy: usize,
    pub motionless: usize,
    /// `None` where resting is impossible.
    pub still: Option<usize>,
}

#[derive(Clone, Debug)]
struct PatchGrid {
    corner: Point,
    columns: usize,
    /// Row by row, the nearest patch.
    patch: Vec<Option<u32>>,
    patches: usize,
}

/// Side of a cell of the floor in metres (our choice).
const CELL_M: f64 = 0.25;
/// Smallest side of a patch of floor in metres (our choice): a person crosses it in about a second.
const PATCH_M: f64 = 0.75;
/// Largest number of patches of a home, approximately (our choice): the cost of inference grows with it.
const MOST_PATCHES: f64 = 110.0;
/// Number of cells below which a patch joins its neighbours (our choice).
const LEAST_CELLS: usize = 3;
/// Distance below which places are one (our choice).
const SAME_M: f64 = 0.35;

impl States {
    pub(crate) fn new(plan: &Plan, places: &HomePlaces, mesh: &Mesh) -> States {
        let (grid, patches) = PatchGrid::new(plan, mesh);
        let mut all = vec![BodyState { kind: StateKind::Out, at: None, room: None, posture: Posture::Standing }];
        for kind in [StateKind::Walks, StateKind::Stands] {
            let of = |&at: &Point| BodyState { kind, at: Some(at), room: plan.room_at(at), posture: Posture::Standing };
            all.extend(patches.iter().map(of));
        }
        let mut stations: Vec<StayPlace> = Vec::new();
        for spot in places.all().iter().filter(|spot| spot.is_reachable && !spot.is_room) {
            let is_known =
                |other: &StayPlace| other.spot.at.distance(spot.at) < SAME_M && other.spot.posture == spot.posture;
            if stations.iter().any(is_known) {
                continue;
            }
            let state =
                |kind| BodyState { kind, at: Some(spot.at), room: plan.room_at(spot.at), posture: spot.posture };
            let busy = all.len();
            all.extend([StateKind::Busy, StateKind::Motionless].map(state));
            let still = (spot.posture != Posture::Standing).then_some(busy + 2);
            all.extend(still.map(|_| state(StateKind::Still)));
            stations.push(StayPlace { spot: spot.clone(), busy, motionless: busy + 1, still });
        }
        States { all, rooms: plan.rooms.len(), stations, grid }
    }

    pub(crate) fn empty() -> States {
        let grid = PatchGrid { corner: Point::ZERO, columns: 1, patch: vec![None], patches: 0 };
        let out = BodyState { kind: StateKind::Out, at: None, room: None, posture: Posture::Standing };
        States { all: vec![out], rooms: 0, stations: Vec::new(), grid }
    }

    /// 0 is out, 1 between rooms; rooms start at 2.
    pub(crate) fn place(&self, state: u32) -> usize {
        match self.all[state as usize] {
            BodyState { kind: StateKind::Out, .. } => 0,
            BodyState { room: None, .. } => 1,
            BodyState { room: Some(room), .. } => room + 2,
        }
    }

    pub(crate) fn places(&self) -> usize {
        self.rooms + 2
    }

    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// Always false: a body can be out.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    pub(crate) fn walking(&self, at: Point) -> usize {
        1 + self.grid.patch(at)
    }

    pub(crate) fn staying(&self, at: Point, posture: Posture, kind: StateKind) -> usize {
        let here = |station: &&StayPlace| station.spot.posture == posture && station.spot.at.distance(at) < SAME_M;
        match self.stations.iter().filter(here).min_by(|a, b| a.spot.at.distance(at).total_cmp(&b.spot.at.distance(at)))
        {
            Some(station) if kind == StateKind::Motionless => station.motionless,
            Some(station) if kind == StateKind::Still => station.still.unwrap_or(station.busy),
            Some(station) => station.busy,
            None => 1 + self.grid.patches + self.grid.patch(at),
        }
    }

    pub(crate) fn patches(&self) -> impl Iterator<Item = (usize, usize)> {
        let patches = self.grid.patches;
        (0..patches).map(move |patch| (1 + patch, 1 + patches + patch))
    }
}

impl PatchGrid {
    fn new(plan: &Plan, mesh: &Mesh) -> (PatchGrid, Vec<Point>) {
        let (corner, most) = plan.bounds();
        let columns = ((most.x - corner.x) / CELL_M).ceil() as usize + 1;
        let rows = ((most.y - corner.y) / CELL_M).ceil() as usize + 1;
        let middle =
            |cell: usize| corner + Point::new((cell % columns) as f64 + 0.5, (cell / columns) as f64 + 0.5) * CELL_M;
        let free: Vec<usize> = (0..columns * rows).filter(|&cell| mesh.is_free(middle(cell))).collect();
        let area_m2 = free.len() as f64 * CELL_M * CELL_M;
        let side_m = libm::sqrt(area_m2 / MOST_PATCHES).max(PATCH_M);
        // Cells of one room and one square form a patch; small remainders join the nearest.
        let mut squares: std::collections::BTreeMap<(usize, i64, i64), Vec<usize>> = std::collections::BTreeMap::new();
        for &cell in &free {
            let at = middle(cell);
            let room = plan.room_at(at).map_or(usize::MAX, |room| room);
            let square = ((at - corner) / side_m).floor();
            squares.entry((room, square.x as i64, square.y as i64)).or_default().push(cell);
        }
        let large: Vec<(Option<usize>, Vec<usize>)> = squares
            .into_iter()
            .filter(|(_, cells)| cells.len() >= LEAST_CELLS)
            .map(|((room, ..), cells)| ((room != usize::MAX).then_some(room), cells))
            .collect();
        let middles: Vec<Point> = large
            .iter()
            .map(|(_, cells)| {
                let sum = cells.iter().fold(Point::ZERO, |sum, &cell| sum + middle(cell));
                let mean = sum / cells.len() as f64;
                let nearest =
                    |a: &&usize, b: &&usize| middle(**a).distance(mean).total_cmp(&middle(**b).distance(mean));
                cells.iter().min_by(nearest).map_or(mean, |&cell| middle(cell))
            })
            .collect();
        let mut patch = vec![None; columns * rows];
        for (index, (_, cells)) in large.iter().enumerate() {
            cells.iter().for_each(|&cell| patch[cell] = Some(index as u32));
        }
        for (cell, patch) in patch.iter_mut().enumerate().filter(|(_, patch)| patch.is_none()) {
            // A cell within furniture or a door belongs to the nearest patch, of its own room if possible.
            let at = middle(cell);
            let room = plan.room_at(at);
            let far = |index: &usize| {
                let other = if large[*index].0 == room { 0.0 } else { 100.0 };
                middles[*index].distance(at) + other
            };
            *patch = (0..middles.len()).min_by(|a, b| far(a).total_cmp(&far(b))).map(|index| index as u32);
        }
        (PatchGrid { corner, columns, patch, patches: middles.len() }, middles)
    }

    fn patch(&self, at: Point) -> usize {
        let rows = self.patch.len() / self.columns;
        let cell = ((at - self.corner) / CELL_M).floor();
        let column = (cell.x.max(0.0) as usize).min(self.columns - 1);
        let row = (cell.y.max(0.0) as usize).min(rows - 1);
        self.patch[row * self.columns + column].map_or(0, |patch| patch as usize)
    }
}
