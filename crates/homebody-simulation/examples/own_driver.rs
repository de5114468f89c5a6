//! Moves a resident with a custom driver: she paces up and down the living room all day, and rests in between.

use homebody_core::drivers::{Driver, Next, Surroundings};
use homebody_core::geometry::{Point, point};
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::time::SECOND;
use homebody_simulation::SimulationError;

#[derive(Clone, Debug)]
struct Pacing {
    ends: [Point; 2],
    at: usize,
    is_tired: bool,
}

impl Driver for Pacing {
    fn next(&mut self, around: &Surroundings) -> Next {
        let now = around.now();
        self.is_tired = !self.is_tired;
        let from = self.ends[self.at];
        let (doing, lasts) = if self.is_tired {
            (MotionState::Rest { at: from }, 60 * SECOND)
        } else {
            self.at = 1 - self.at;
            (MotionState::Stride { from, to: self.ends[self.at] }, 5 * SECOND)
        };
        Next::Segment(MotionSegment { begin: now, end: now + lasts, doing, posture: Posture::Standing })
    }

    fn copy(&self) -> Box<dyn Driver> {
        Box::new(self.clone())
    }
}

/// The number of firings of each sensor in such a day, by name.
pub fn firings() -> Result<Vec<(String, usize)>, SimulationError> {
    let scenario = homebody_simulation::template("tigerplace")?;
    let ends = [point([5.0, 3.6]), point([8.4, 3.6])];
    let pacing = move |_: &_, _| Pacing { ends, at: 0, is_tired: false };
    let mut run = scenario.run().days(1).driver("margaret", pacing).start()?;
    let mut firings: Vec<(String, usize)> = run.sensors().map(|name| (name.to_owned(), 0)).collect();
    while let Some(batch) = run.next_batch()? {
        batch.firings.iter().for_each(|firing| firings[firing.sensor.index()].1 += 1);
    }
    Ok(firings)
}

pub fn main() -> Result<(), SimulationError> {
    let firings = firings()?;
    firings.iter().filter(|(_, count)| *count > 0).for_each(|(name, count)| println!("{count:>6}  {name}"));
    println!("{}", firings.iter().map(|(_, count)| count).sum::<usize>());
    Ok(())
}
