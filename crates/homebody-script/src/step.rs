//! What a script says is to be done.

use homebody_core::geometry::Point;
use homebody_core::scenario::path::Posture;
use homebody_core::time::Micros;
use homebody_walk::Wandering;
use homebody_walk::manner::Manner;
use homebody_walk::places::Spot;

/// One step. Names are resolved as it is said.
#[derive(Clone, Debug)]
pub enum Step {
    /// To a place, and to be there so.
    Go(Spot),
    /// To a point that anybody may have computed: where no way leads there, one stays.
    GoTo(Point),
    /// Up, and out of the seat.
    Stand,
    /// Straight ahead.
    Straight { degrees: f64, metres: f64 },
    /// Without a goal.
    Wander { kind: Wandering, left: Micros },
    /// Staying, with movements; those of the posture where no manner was said.
    Wait { left: Micros, manner: Option<Manner>, stirs: bool },
    /// Staying without a movement.
    Rest { left: Micros },
    /// A thing is turned on or opened, or off or closed.
    Use { thing: u32, on: bool },
    /// What follows is called so.
    Activity(Option<String>),
    /// Out of the home by its front door.
    LeaveHome,
    /// What is left of that behind the door.
    Outside,
    /// In by the front door.
    ComeHome,
    /// What was to be done is dropped.
    Instead,
    /// Several, one after the other.
    All(Vec<Step>),
}

impl Step {
    /// Waiting from an instant on at which one does not move.
    pub fn wait(left: Micros, manner: Option<Manner>) -> Step {
        Step::Wait { left, manner, stirs: false }
    }

    /// Whether it takes no time wherever the body is.
    pub fn is_instant(&self) -> bool {
        match self {
            Step::Use { .. } | Step::Activity(_) => true,
            Step::All(steps) => steps.iter().all(Step::is_instant),
            _ => false,
        }
    }

    /// Whether what was still to be done is dropped for it.
    pub fn drops_the_rest(&self) -> bool {
        match self {
            Step::Instead => true,
            Step::All(steps) => steps.iter().any(Step::drops_the_rest),
            _ => false,
        }
    }

    /// How one stirs where nothing is said of it.
    pub fn usual_manner(posture: Posture) -> Manner {
        match posture {
            Posture::Standing | Posture::Bending | Posture::Kneeling => Manner::BUSY,
            Posture::Sitting => Manner::READING,
            Posture::Lying => Manner::AWAKE_IN_BED,
            Posture::Down => Manner::FALLEN,
        }
    }
}
