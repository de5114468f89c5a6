//! A cache of routes, because residents repeat the same few.

use crate::mesh::Mesh;
use homebody_core::geometry::Point;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Number of ways that are remembered (our choice): a home of 60 places has 3,540, and a person walks few of them.
const MOST: usize = 4096;

/// A mesh with a cache, which does not change its results.
#[derive(Clone, Debug)]
pub struct Routes {
    mesh: Arc<Mesh>,
    known: BTreeMap<[u64; 4], Option<Arc<[Point]>>>,
    most: usize,
}

impl Routes {
    pub fn new(mesh: Arc<Mesh>) -> Routes {
        Routes { mesh, known: BTreeMap::new(), most: MOST }
    }

    /// Limits the cache: with thousands of bodies at once, memory matters more than time.
    pub fn at_most(self, most: usize) -> Routes {
        Routes { most, ..self }
    }

    pub fn mesh(&self) -> &Arc<Mesh> {
        &self.mesh
    }

    pub fn path(&mut self, from: Point, to: Point) -> Option<Arc<[Point]>> {
        let key = [from.x, from.y, to.x, to.y].map(f64::to_bits);
        if let Some(known) = self.known.get(&key) {
            return known.clone();
        }
        let path: Option<Arc<[Point]>> = self.mesh.path(from, to).map(Arc::from);
        if self.known.len() >= self.most {
            self.known.clear();
        }
        self.known.insert(key, path.clone());
        path
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::homes::tigerplace;

    #[test]
    fn remembered_routes_equal_found_ones() {
        let plan = tigerplace();
        let mesh = Arc::new(Mesh::new(&plan, 0.22));
        let mut routes = Routes::new(mesh.clone());
        let places: Vec<Point> = plan.places.iter().map(|(_, at)| *at).chain([Point::new(20.0, 0.0)]).collect();
        for round in 0..2 {
            let mut copy = routes.clone();
            for (&from, &to) in places.iter().flat_map(|from| places.iter().map(move |to| (from, to))) {
                let found = routes.path(from, to);
                assert_eq!(found.as_deref(), mesh.path(from, to).as_deref(), "round {round}");
                assert_eq!(found, copy.path(from, to));
            }
        }
        assert_eq!(routes.known.len(), places.len() * places.len());
    }

    #[test]
    fn remembered_routes_are_bounded() {
        let mut routes = Routes::new(Arc::new(Mesh::new(&tigerplace(), 0.22)));
        let from = Point::new(4.65, 1.6);
        for step in 0..MOST + 10 {
            let to = from + Point::new(0.0, 1e-5 * step as f64);
            assert!(routes.path(from, to).is_some());
        }
        assert!(routes.known.len() <= MOST);
        let mut few = Routes::new(routes.mesh().clone()).at_most(8);
        for step in 0..100 {
            let to = from + Point::new(0.0, 1e-3 * step as f64);
            assert_eq!(few.path(from, to), routes.path(from, to));
        }
        assert!(few.known.len() <= 8);
    }
}
