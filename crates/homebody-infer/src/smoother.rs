//! Forward and backward smoothing of a log.
//!
//! The log is processed in blocks, so that memory stays constant; each block is smoothed together with the steps after it.

use crate::belief::Belief;
use crate::body_pair::BodyPair;
use crate::fault_interval::FaultInterval;
use crate::log_step::{LogSteps, MessageContent};
use crate::message::LogMessage;
use crate::senses::Senses;
use crate::states::BodyState;
use crate::visits::Visits;
use homebody_core::time::RunTime;

/// Number of steps that are smoothed together, and number of later steps that are used for them (our choice).
const BLOCK: usize = 4_096;
const AHEAD: usize = 768;

/// The places of people at an instant.
pub struct InstantEstimate<'a> {
    pub at: RunTime,
    /// The message at that instant; `None` inside of a long silence.
    pub said: Option<MessageContent>,
    pairs: Vec<(&'a Belief, [&'a Senses; 2])>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guess<'a> {
    pub state: &'a BodyState,
    /// Probability of its room.
    pub chance: f64,
    /// Rate of the instant's message in that state, per second; 0 without a message.
    pub says: f32,
}

/// Probabilities of places, which sum to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Chances {
    pub out: f32,
    /// In a doorway.
    pub between: f32,
    pub rooms: Vec<f32>,
}

/// Locates each body by messages in order of time, up to `end`, and reports each instant in turn. Messages and silences
/// within `faults` are ignored.
///
/// Each two bodies in a row are estimated jointly; of other pairs, only the expected messages count.
pub fn translate(
    bodies: &[Senses],
    faults: &[FaultInterval],
    messages: impl IntoIterator<Item = LogMessage>,
    end: RunTime,
    mut tell: impl FnMut(InstantEstimate),
) {
    let Some(first) = bodies.first() else { return };
    let empty_body = first.empty_body();
    let mut smoother = Smoother::new(bodies, &empty_body, LogSteps::new(&first.timing, faults));
    messages.into_iter().for_each(|message| {
        smoother.hear(&message, &mut tell);
    });
    smoother.end(end, &mut tell);
}

/// Locates each body as the log arrives, by messages up to each instant. Instants are in order of time; one without a
/// message adds a silence. Two bodies at home count as residents.
pub fn follow(
    bodies: &[Senses],
    instants: impl IntoIterator<Item = (RunTime, Option<LogMessage>)>,
    mut tell: impl FnMut(InstantEstimate),
) {
    let Some(first) = bodies.first() else { return };
    let empty_body = first.empty_body();
    let mut follower = Follower::new(bodies, &empty_body);
    for (at, message) in instants {
        match message {
            Some(message) => follower.hear(&message),
            None => follower.wait(at),
        }
        tell(follower.now());
    }
}

pub struct Follower<'a> {
    pairs: Vec<BodyPair<'a>>,
    steps: LogSteps<'a>,
    said: Option<MessageContent>,
}

impl<'a> Follower<'a> {
    /// `empty_body` is [`Senses::empty_body`] of the first body.
    ///
    /// # Panics
    ///
    /// Without a body.
    pub fn new(bodies: &'a [Senses], empty_body: &'a Senses) -> Follower<'a> {
        Follower { pairs: in_pairs(bodies, empty_body), steps: LogSteps::new(&bodies[0].timing, &[]), said: None }
    }

    /// A late message counts as if it came now.
    pub fn hear(&mut self, message: &LogMessage) {
        self.steps.hear(message);
        self.advance();
    }

    /// Advances without a message.
    pub fn wait(&mut self, until: RunTime) {
        self.steps.advance(until, None);
        self.advance();
    }

    fn advance(&mut self) {
        let steps = self.steps.len();
        (0..steps).for_each(|number| advance(&mut self.pairs, &self.steps, number));
        self.said = self.steps.get(steps - 1).said;
        for pair in &mut self.pairs {
            let last = pair.last().clone();
            pair.begin_after(steps, last);
        }
        self.steps.forget(steps);
    }

    pub fn now(&self) -> InstantEstimate<'_> {
        let pairs = self.pairs.iter().map(|pair| (pair.last(), pair.senses)).collect();
        InstantEstimate { at: self.steps.now(), said: self.said, pairs }
    }
}

fn in_pairs<'a>(bodies: &'a [Senses], empty_body: &'a Senses) -> Vec<BodyPair<'a>> {
    bodies.chunks(2).map(|pair| BodyPair::new([&pair[0], pair.get(1).unwrap_or(empty_body)])).collect()
}

/// Advances all pairs by a step; any of them may cause its message.
fn advance(pairs: &mut [BodyPair], steps: &LogSteps, number: usize) {
    pairs.iter_mut().for_each(|pair| pair.advance(steps, number));
    let Some(heard) = steps.get(number).said else { return };
    if let [pair] = pairs {
        return pair.hear(heard, 0.0);
    }
    let expected: Vec<f32> = pairs.iter().map(|pair| pair.expected(heard)).collect();
    let all: f32 = expected.iter().sum();
    pairs.iter_mut().zip(expected).for_each(|(pair, own)| pair.hear(heard, (all - own).max(0.0)));
}

pub(crate) struct Smoother<'a> {
    pairs: Vec<BodyPair<'a>>,
    visits: Option<Visits<'a>>,
    steps: LogSteps<'a>,
    /// Steps that the forward pass has processed.
    gone: usize,
}

impl<'a> Smoother<'a> {
    pub fn new(bodies: &'a [Senses], empty_body: &'a Senses, steps: LogSteps<'a>) -> Smoother<'a> {
        let (residents, visits) = match bodies {
            [alone, guest] if guest.visits && !alone.visits => (&bodies[..1], Some(Visits::new([alone, guest]))),
            all => (all, None),
        };
        Smoother { pairs: in_pairs(residents, empty_body), visits, steps, gone: 0 }
    }

    /// Returns true if `tell` received a full block.
    pub fn hear(&mut self, message: &LogMessage, tell: &mut impl FnMut(InstantEstimate)) -> bool {
        self.steps.hear(message);
        let mut has_reported = false;
        while self.steps.len() >= BLOCK + AHEAD {
            self.smooth(BLOCK, tell);
            has_reported = true;
        }
        has_reported
    }

    /// Reports the remaining steps, up to an instant.
    pub fn end(&mut self, end: RunTime, tell: &mut impl FnMut(InstantEstimate)) {
        self.steps.advance(end, None);
        self.smooth(usize::MAX, tell);
    }

    fn smooth(&mut self, most: usize, tell: &mut impl FnMut(InstantEstimate)) {
        let (steps, reported) = (&self.steps, most.min(self.steps.len()));
        for number in self.gone..steps.len() {
            advance(&mut self.pairs, steps, number);
        }
        self.gone = steps.len() - reported;
        if let (Some(visits), [alone, ..]) = (&mut self.visits, &self.pairs[..]) {
            visits.advance(alone, steps, reported);
        }
        let at_end = |pair: &BodyPair| reported.checked_sub(1).map(|last| pair.beliefs[last].clone());
        let before: Vec<Option<Belief>> = self.pairs.iter().map(at_end).collect();
        for pair in &mut self.pairs {
            pair.go_back(steps, (0, reported), pair.nothing_known(), |number, after| {
                self.visits.iter_mut().for_each(|visits| visits.go_back(steps, number, after));
            });
        }
        for number in 0..reported {
            let visit = self.visits.as_ref().and_then(|visits| visits.reported(number));
            let pairs = match visit {
                Some(visit) => vec![visit],
                None => self.pairs.iter().map(|pair| (&pair.beliefs[number], pair.senses)).collect(),
            };
            let step = steps.get(number);
            tell(InstantEstimate { at: step.end, said: step.said, pairs });
        }
        let all = self.pairs.iter_mut().zip(before);
        all.for_each(|(pair, before)| before.into_iter().for_each(|before| pair.begin_after(reported, before)));
        self.steps.forget(reported);
    }
}

impl<'a> InstantEstimate<'a> {
    /// Rate of ON by sensor, per second while it can send, over all bodies.
    pub(crate) fn expected(&self, sensors: usize) -> Vec<f32> {
        let mut expected = vec![0.0; sensors];
        for (belief, senses) in &self.pairs {
            for (body, senses) in senses.iter().enumerate().filter(|(_, senses)| senses.states().len() > 1) {
                let mut of_body = vec![0.0; sensors];
                for (chance, &state) in belief.marginal(body).into_iter().zip(&belief.states[body]) {
                    let rates = senses.on_rates(state);
                    of_body.iter_mut().zip(rates).for_each(|(sum, rate)| *sum += chance * rate);
                }
                expected.iter_mut().zip(of_body).for_each(|(sum, own)| *sum += own);
            }
        }
        expected
    }

    /// In the order of the bodies. Two equal bodies are interchangeable.
    pub fn guesses(&self) -> Vec<Guess<'a>> {
        let mut guesses = Vec::with_capacity(2 * self.pairs.len());
        self.report(|guess, _| guesses.push(guess));
        guesses
    }

    /// In the order of the guesses. Two equal bodies are interchangeable: the first is the one whose guess is first.
    pub fn chances(&self) -> Vec<Chances> {
        let mut all = Vec::with_capacity(2 * self.pairs.len());
        self.report(|_, chances| all.push(Chances::from_places(chances)));
        all
    }

    /// Passes the guess of each body with its probabilities of being out, between rooms, and in each room.
    pub fn report(&self, mut tell: impl FnMut(Guess<'a>, &[f32])) {
        for (belief, senses) in &self.pairs {
            if senses[1].states().len() == 1 {
                let (guess, chances) = single_guess(belief, senses[0], self.said);
                tell(guess, &chances);
                tell(Guess { state: &senses[1].states().all[0], chance: guess.chance, says: 0.0 }, &NOBODY);
                continue;
            }
            let together = JointPlaces::new(belief, senses);
            let ([first, second], [its, others]) = (together.guesses(self.said), together.chances());
            let turned = is_resident_second(senses, &first);
            let all = if turned { [(second, others), (first, its)] } else { [(first, its), (second, others)] };
            all.into_iter().for_each(|(guess, chances)| tell(guess, &chances));
        }
    }
}

const NOBODY: [f32; 2] = [1.0, 0.0];

impl Chances {
    /// By the numbers of `States::place`.
    fn from_places(places: &[f32]) -> Chances {
        Chances { out: places[0], between: places[1], rooms: places[2..].to_vec() }
    }
}

fn single_guess<'a>(belief: &Belief, senses: &'a Senses, said: Option<MessageContent>) -> (Guess<'a>, Vec<f32>) {
    let states = senses.states();
    let mut chances = vec![0.0f32; states.places()];
    for (&state, chance) in belief.states[0].iter().zip(&belief.chances) {
        chances[states.place(state)] += chance;
    }
    let best = (0..chances.len()).max_by(|&a, &b| chances[a].total_cmp(&chances[b])).unwrap_or(0);
    let is_there = |(state, _): &(&u32, &f32)| states.place(**state) == best;
    let all = belief.states[0].iter().zip(&belief.chances);
    let state = all.filter(is_there).max_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(&state, _)| state as usize);
    let says = said.map_or(0.0, |heard| senses.rate(heard.sensor, heard.said)[state]);
    (Guess { state: &states.all[state], chance: f64::from(chances[best]), says }, chances)
}

/// If a resident and a guest may be swapped, the one who is alone at home is the resident.
fn is_resident_second(senses: &[&Senses; 2], first: &Guess) -> bool {
    senses[1].visits && first.state.at.is_none()
}

struct JointPlaces<'b, 'a> {
    belief: &'b Belief,
    senses: &'b [&'a Senses; 2],
    /// By body and tracked state, its place.
    places: [Vec<usize>; 2],
    columns: usize,
    /// By pair of places, row by row: a row for each place of the first.
    chances: Vec<f32>,
    /// The most likely pair, in either order.
    best: usize,
}

impl<'b, 'a> JointPlaces<'b, 'a> {
    fn new(belief: &'b Belief, senses: &'b [&'a Senses; 2]) -> JointPlaces<'b, 'a> {
        let places = [0, 1].map(|body| {
            let states = belief.states[body].iter().map(|&state| senses[body].states().place(state));
            states.collect::<Vec<usize>>()
        });
        let columns = senses[0].states().places().max(senses[1].states().places());
        let mut chances = vec![0.0f32; columns * columns];
        for (row, &a) in belief.chances.chunks_exact(places[1].len().max(1)).zip(&places[0]) {
            for (chance, &b) in row.iter().zip(&places[1]) {
                chances[a * columns + b] += chance;
            }
        }
        let mut together = JointPlaces { belief, senses, places, columns, chances, best: 0 };
        let by_chance = |a: &usize, b: &usize| {
            let either = together.either(*a).total_cmp(&together.either(*b));
            either.then(together.chances[*a].total_cmp(&together.chances[*b]))
        };
        together.best = (0..together.chances.len()).max_by(by_chance).unwrap_or(0);
        together
    }

    /// The probability of a pair in either order.
    fn either(&self, pair: usize) -> f32 {
        let (a, b) = (pair / self.columns, pair % self.columns);
        self.chances[pair] + if a == b { 0.0 } else { self.chances[b * self.columns + a] }
    }

    fn guesses(&self, said: Option<MessageContent>) -> [Guess<'a>; 2] {
        let JointPlaces { belief, senses, places, columns, best, .. } = self;
        let width = places[1].len();
        let is_there = |pair: &usize| places[0][pair / width] * columns + places[1][pair % width] == *best;
        let by_chance = |a: &usize, b: &usize| belief.chances[*a].total_cmp(&belief.chances[*b]);
        let pair = (0..belief.chances.len()).filter(is_there).max_by(by_chance).unwrap_or(0);
        let chance = f64::from(self.either(*best));
        let guess = |body: usize, place: usize| {
            let state = belief.states[body][place] as usize;
            let says = said.map_or(0.0, |heard| senses[body].rate(heard.sensor, heard.said)[state]);
            Guess { state: &senses[body].states().all[state], chance, says }
        };
        [guess(0, pair / width), guess(1, pair % width)]
    }

    /// A pair that matches the best one only in reverse order counts reversed.
    fn chances(&self) -> [Vec<f32>; 2] {
        let (first, second) = (self.best / self.columns, self.best % self.columns);
        let mut of = [vec![0.0; self.columns], vec![0.0; self.columns]];
        for (pair, chance) in self.chances.iter().enumerate() {
            let (a, b) = (pair / self.columns, pair % self.columns);
            let is_turned = a != first && b != second && (a == second || b == first);
            let (a, b) = if is_turned { (b, a) } else { (a, b) };
            of[0][a] += chance;
            of[1][b] += chance;
        }
        of
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::senses::tests::{END, senses, walk};

    #[test]
    fn following_a_log_equals_its_forward_pass() {
        let bodies = [senses()];
        let empty_body = bodies[0].empty_body();
        let mut follower = Follower::new(&bodies, &empty_body);
        let (mut steps, mut pair) = (LogSteps::new(&bodies[0].timing, &[]), BodyPair::new([&bodies[0], &empty_body]));
        let mut gone = 0;
        for message in walk() {
            follower.hear(&message);
            steps.hear(&message);
            for number in gone..steps.len() {
                advance(std::slice::from_mut(&mut pair), &steps, number);
            }
            gone = steps.len();
            let now = follower.now();
            assert_eq!((now.at, now.pairs[0].0), (message.at, pair.last()));
        }
        // Control: later messages change the result of some instants.
        let (mut live, mut all) = (Vec::new(), Vec::new());
        let instants = walk().into_iter().map(|message| (message.at, Some(message)));
        follow(&bodies, instants, |instant| live.push((instant.at, instant.guesses()[0].chance)));
        translate(&bodies, &[], walk(), END, |instant| all.push((instant.at, instant.guesses()[0].chance)));
        assert!(live.iter().any(|one| !all.contains(one)));
    }
}
