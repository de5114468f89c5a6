//! The steps of scripts.

use homebody_core::geometry::Point;
use homebody_core::posture::Posture;
use homebody_core::time::Span;
use homebody_walk::WanderStyle;
use homebody_walk::manner::Manner;
use homebody_walk::places::HomePlace;

/// Names are resolved when the script calls the word.
#[derive(Clone, Debug)]
pub enum ScriptStep {
    Go(HomePlace),
    /// Without a route, the body stays.
    GoTo(Point),
    Stand,
    Straight {
        degrees: f64,
        metres: f64,
    },
    Wander {
        kind: WanderStyle,
        left: Span,
    },
    /// Stays with movements; without a manner, those of the posture.
    Wait {
        left: Span,
        manner: Option<Manner>,
        stirs: bool,
    },
    /// Stays without movements.
    Rest {
        left: Span,
    },
    /// Turns on or opens, or turns off or closes.
    Use {
        thing: u32,
        on: bool,
    },
    Activity(Option<String>),
    LeaveHome,
    /// The rest of that, behind the door.
    Outside,
    ComeHome,
    /// Drops all waiting steps.
    Instead,
    All(Vec<ScriptStep>),
}

impl ScriptStep {
    /// Begins with a pause.
    pub fn wait(left: Span, manner: Option<Manner>) -> ScriptStep {
        ScriptStep::Wait { left, manner, stirs: false }
    }

    /// In any place of the body.
    pub fn is_instant(&self) -> bool {
        match self {
            ScriptStep::Use { .. } | ScriptStep::Activity(_) => true,
            ScriptStep::All(steps) => steps.iter().all(ScriptStep::is_instant),
            _ => false,
        }
    }

    pub fn drops_the_rest(&self) -> bool {
        match self {
            ScriptStep::Instead => true,
            ScriptStep::All(steps) => steps.iter().any(ScriptStep::drops_the_rest),
            _ => false,
        }
    }

    pub fn usual_manner(posture: Posture) -> Manner {
        match posture {
            Posture::Standing | Posture::Bending | Posture::Kneeling => Manner::BUSY,
            Posture::Sitting => Manner::READING,
            Posture::Lying => Manner::AWAKE_IN_BED,
            Posture::Down => Manner::FALLEN,
        }
    }
}
