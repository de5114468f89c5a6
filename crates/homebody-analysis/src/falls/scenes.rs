//! All cameras of a home: those of one room see one person together.
//!
//! We assume that pictures come in order of time.
//!
//! Where two cameras agree on a person, the voxel person counts; otherwise the first camera that sees a person.

use super::rules::{FallRules, FallState, Memberships};
use super::voxels::VoxelSpace;
use super::watch::{Fall, FallWatch};
use super::{BodyShape, ShapeAt, single};
use homebody_core::body::figure::Point3;
use homebody_core::body::ground::Ground;
use homebody_core::camera::lens::Lens;
use homebody_core::camera::outlook::Outlook;
use homebody_core::camera::silhouette::Silhouette;
use homebody_core::plan::Plan;
use homebody_core::time::RunTime;
use std::sync::Arc;

#[derive(Clone, Debug)]
pub struct CameraPicture {
    pub at: RunTime,
    pub camera: usize,
    pub silhouette: Silhouette,
}

/// Pixels below which a part of a silhouette is noise (our choice).
const SPECK_PX: usize = 6;

impl CameraPicture {
    fn without_specks(&self) -> CameraPicture {
        CameraPicture { at: self.at, camera: self.camera, silhouette: self.silhouette.without_specks(SPECK_PX) }
    }
}

/// A person in a room, by the pictures of an instant.
#[derive(Clone, Debug)]
pub struct SeenPerson {
    pub shape: BodyShape,
    pub memberships: Memberships,
    /// The middles of the cubes that two cameras or more agree on; empty if one camera alone sees the person.
    pub cubes: Vec<Point3>,
}

#[derive(Clone)]
pub struct Scenes<'r> {
    rules: &'r FallRules,
    scenes: Vec<RoomScene<'r>>,
    at: RunTime,
    /// The number of instants on which two cameras or more agreed.
    pub voxel_persons: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CameraSighting {
    pub at: RunTime,
    pub state: FallState,
}

#[derive(Clone)]
struct RoomScene<'r> {
    /// Their numbers among all cameras.
    cameras: Vec<usize>,
    lenses: Vec<Lens>,
    /// Shared by all copies.
    space: Arc<VoxelSpace>,
    ground: Arc<Ground>,
    watch: FallWatch<'r>,
    /// Pictures of the present instant, by camera of the scene.
    now: Vec<Option<CameraPicture>>,
    seen_at: RunTime,
}

impl<'r> Scenes<'r> {
    pub fn new(plan: &Plan, lenses: &[Lens], rules: &'r FallRules) -> Scenes<'r> {
        let room = |lens: &Lens| plan.room_at(lens.at.truncate());
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for camera in 0..lenses.len() {
            match groups.iter_mut().find(|group| room(&lenses[group[0]]) == room(&lenses[camera])) {
                Some(group) => group.push(camera),
                None => groups.push(vec![camera]),
            }
        }
        let ground = Arc::new(Outlook::new(plan).ground);
        let scene = |cameras: Vec<usize>| {
            let lenses: Vec<Lens> = cameras.iter().map(|&camera| lenses[camera]).collect();
            let space = Arc::new(VoxelSpace::new(plan, &lenses));
            RoomScene {
                ground: ground.clone(),
                now: vec![None; cameras.len()],
                cameras,
                lenses,
                space,
                watch: FallWatch::new(rules),
                seen_at: RunTime::MIN,
            }
        };
        Scenes { rules, scenes: groups.into_iter().map(scene).collect(), at: RunTime::MIN, voxel_persons: 0 }
    }

    /// Takes the next picture; returns the falls in those of the instant before it.
    pub fn next(&mut self, seen: CameraPicture) -> Vec<Fall> {
        let seen = seen.without_specks();
        let found = if seen.at == self.at { Vec::new() } else { self.look() };
        self.at = seen.at;
        for scene in &mut self.scenes {
            if let Some(index) = scene.cameras.iter().position(|&camera| camera == seen.camera) {
                scene.now[index] = Some(seen);
                break;
            }
        }
        found
    }

    /// The last sight of a person by the cameras of any room, and their state.
    pub fn last_sighting(&self) -> Option<CameraSighting> {
        let scene = self.scenes.iter().max_by_key(|scene| scene.seen_at)?;
        Some(CameraSighting { at: scene.seen_at, state: scene.watch.state()? })
    }

    /// The people in the rooms by the pictures of one instant alone, without those before.
    pub fn persons(&self, seen: &[CameraPicture]) -> Vec<SeenPerson> {
        let seen: Vec<CameraPicture> = seen.iter().map(CameraPicture::without_specks).collect();
        let person = |scene: &RoomScene| {
            let of_camera = |camera: &usize| seen.iter().find(|seen| seen.camera == *camera);
            let now: Vec<Option<&CameraPicture>> = scene.cameras.iter().map(of_camera).collect();
            let (shape, cubes) = scene.shape(&now)?;
            Some(SeenPerson { shape, memberships: self.rules.memberships(&shape), cubes })
        };
        self.scenes.iter().filter_map(person).collect()
    }

    pub fn look(&mut self) -> Vec<Fall> {
        let persons = &mut self.voxel_persons;
        self.scenes.iter_mut().filter_map(|scene| scene.look(persons)).collect()
    }
}

impl RoomScene<'_> {
    /// Looks at the pictures of an instant, and forgets them.
    fn look(&mut self, persons: &mut u64) -> Option<Fall> {
        let at = self.now.iter().flatten().next()?.at;
        let now: Vec<Option<&CameraPicture>> = self.now.iter().map(Option::as_ref).collect();
        let found = self.shape(&now);
        self.now.iter_mut().for_each(|seen| *seen = None);
        let (shape, cubes) = found?;
        self.seen_at = at;
        *persons += u64::from(!cubes.is_empty());
        self.watch.next(&ShapeAt { at, shape })
    }

    fn shape(&self, now: &[Option<&CameraPicture>]) -> Option<(BodyShape, Vec<Point3>)> {
        let pictures: Vec<_> = now.iter().map(|seen| seen.map(|seen| &seen.silhouette)).collect();
        if let Some(person) = self.space.person(&pictures) {
            return Some(person);
        }
        let (index, seen) = now.iter().enumerate().find_map(|(index, seen)| Some((index, (*seen)?)))?;
        Some((single::shape(&self.lenses[index], &seen.silhouette, &self.ground)?, Vec::new()))
    }
}
