//! Two bodies in one home, and what is thought of both together.
//!
//! What is said may come of either, so that what is thought of one depends on the other: the chances are of pairs of states.
//! Only the states that count are kept of each. One body alone has nobody beside it, who has one state and makes nothing speak.

use crate::learn::{SILENCE, Senses};
use crate::said::Said;
use crate::steps::{Heard, Steps, Unusual};

/// Whatever is said may have come of nothing, in whatever state (ours).
pub(crate) const OF_NOTHING: f32 = 3e-6;
/// A state counts no more once its chance is this small beside the best, of one body alone and of each of two (ours).
const HOPELESS_ALONE: f32 = 1e-5;
const HOPELESS: f32 = 1e-6;
/// An exponent that makes no difference (ours).
const NOTHING: f32 = 1e-3;
/// The state of being out.
pub(crate) const OUT: u32 = 0;
/// So many states count at once of somebody who may be visiting, of the one who lives there then, and of each of two who live
/// there (ours).
const OF_GUESTS: usize = 32;
const OF_HOSTS: usize = 120;
const OF_TWO: usize = 64;

/// What is thought of two bodies at one instant.
#[derive(Clone, Debug, Default)]
pub(crate) struct Belief {
    /// The states that count, of each.
    pub states: [Vec<u32>; 2],
    /// The chances of pairs of them, row by row: a row for each of the first.
    pub chances: Vec<f32>,
}

/// What is thought of two bodies over a stretch of a log.
pub(crate) struct Pair<'a> {
    pub senses: [&'a Senses; 2],
    pub before: Belief,
    /// After each step, by what was said so far; then, of those that are told, by all.
    pub beliefs: Vec<Belief>,
    /// By step: how often others than these two would have said what was said.
    others: Vec<f32>,
    /// The logarithm of how likely all was that was said so far, and left unsaid.
    pub evidence: f64,
    /// The same before the first step, and after each.
    pub evidence_before: f64,
    pub evidences: Vec<f64>,
}

impl<'a> Pair<'a> {
    pub fn new(senses: [&'a Senses; 2]) -> Pair<'a> {
        let begins = senses.map(Senses::begins);
        let states = [0, 1].map(|body| likely(&begins[body], (usize::MAX, HOPELESS)));
        let of = |body: usize, place: u32| begins[body][place as usize];
        let chances = states[0].iter().flat_map(|&a| states[1].iter().map(move |&b| of(0, a) * of(1, b))).collect();
        Pair::after_belief(senses, Belief { states, chances })
    }

    /// Two of whom this is thought at first.
    pub fn after_belief(senses: [&'a Senses; 2], before: Belief) -> Pair<'a> {
        Pair {
            senses,
            before,
            beliefs: Vec::new(),
            others: Vec::new(),
            evidence: 0.0,
            evidence_before: 0.0,
            evidences: Vec::new(),
        }
    }

    /// What was thought last.
    pub fn last(&self) -> &Belief {
        self.beliefs.last().unwrap_or(&self.before)
    }

    /// Goes on by a step, until just before what is said at its end.
    pub fn go_on(&mut self, steps: &Steps, number: usize) {
        let step = steps.get(number);
        let unusual = steps.unusual(number);
        let mut belief = self.last().clone();
        self.ends(&mut belief, unusual);
        if let Some(span) = step.span {
            belief = self.after(&belief, span, unusual, step.said);
        }
        self.ends(&mut belief, unusual);
        self.evidence += belief.normalise();
        self.beliefs.push(belief);
        self.others.push(0.0);
        self.evidences.push(self.evidence);
    }

    /// How often the two would say this now, in messages a second.
    pub fn expected(&self, heard: Heard) -> f32 {
        let belief = self.last();
        self.saying(heard, belief).zip(&belief.chances).map(|(rate, chance)| rate * chance).sum()
    }

    /// Takes what is said at the end of the step that came last; others would say it so often.
    pub fn hear(&mut self, heard: Heard, others: f32) {
        let mut belief = self.beliefs.pop().unwrap_or_default();
        self.weigh(heard, others, &mut belief);
        self.evidence += belief.normalise();
        self.beliefs.push(belief);
        if let (Some(last), Some(evidence)) = (self.others.last_mut(), self.evidences.last_mut()) {
            (*last, *evidence) = (others, self.evidence);
        }
    }

    /// By what is said, which others would say so often.
    fn weigh(&self, heard: Heard, others: f32, belief: &mut Belief) {
        let mut chances = std::mem::take(&mut belief.chances);
        let rates = self.saying(heard, belief);
        chances.iter_mut().zip(rates).for_each(|(chance, rate)| *chance *= rate + others + OF_NOTHING);
        belief.chances = chances;
    }

    /// How often something is said by two bodies in each pair of states.
    fn saying(&self, heard: Heard, belief: &Belief) -> impl Iterator<Item = f32> {
        let rates = self.rates(heard.sensor, heard.said, belief);
        // What feels a body says that it is over once neither is there.
        let least = heard.said == Said::Off && self.senses[0].timing[heard.sensor].feels;
        let [first, second] = rates;
        first.into_iter().flat_map(move |a| {
            let each = second.clone().into_iter();
            each.map(move |b| if least { a.min(b) } else { a + b })
        })
    }

    /// How often a sensor says something of each of the two alone, by the states that count.
    fn rates(&self, sensor: usize, said: Said, belief: &Belief) -> [Vec<f32>; 2] {
        [0, 1].map(|body| {
            let rate = self.senses[body].rate(sensor, said);
            belief.states[body].iter().map(|&state| rate[state as usize]).collect()
        })
    }

    /// Where they are after a span in which nothing is said; a state that what is said then would need is kept.
    fn after(&self, belief: &Belief, span: usize, unusual: &[Unusual], said: Option<Heard>) -> Belief {
        let turns = [0, 1].map(|body| Turns::new(self.senses[body], span, unusual));
        let mut alone: [Vec<f32>; 2] = Default::default();
        let states = [0, 1].map(|body| {
            let mut to = turns[body].forward(&belief.alone(body), &belief.states[body]);
            alone[body].clone_from(&to);
            let limits = self.limits(body);
            let keep = likely(&to, limits);
            let Some(heard) = said else { return keep };
            let rates = self.senses[body].rate(heard.sensor, heard.said);
            to.iter_mut().zip(rates).for_each(|(to, rate)| *to *= rate + OF_NOTHING);
            merged(&keep, &likely(&to, limits))
        });
        if let ([_], [_]) = (&belief.states[1][..], &states[1][..]) {
            // Who the other is with certainty says nothing of the first.
            let chances = states[0].iter().map(|&state| alone[0][state as usize]).collect();
            return Belief { states, chances };
        }
        let [first, second] = [0, 1].map(|body| turns[body].between(&belief.states[body], &states[body]));
        let half = product_of_transposed(&first, &belief.chances, [belief.states[0].len(), states[0].len()]);
        let chances = product(&half, &second, belief.states[1].len(), states[1].len());
        Belief { states, chances }
    }

    /// How many states of a body count at once, and from which chance on beside the best.
    fn limits(&self, body: usize) -> (usize, f32) {
        let (own, other) = (self.senses[body], self.senses[1 - body]);
        match (own.visits, other.visits) {
            _ if other.states().len() == 1 => (usize::MAX, HOPELESS_ALONE),
            (true, _) => (OF_GUESTS, HOPELESS),
            (false, true) => (OF_HOSTS, HOPELESS),
            (false, false) => (OF_TWO, HOPELESS),
        }
    }

    /// Half of what it says that what feels somebody does not end: for as long as either keeps it on, all is as it should be.
    fn ends(&self, belief: &mut Belief, unusual: &[Unusual]) {
        let feels = |one: &&Unusual| one.may_end_s > 0.0 && self.senses[0].timing[one.sensor].feels;
        for one in unusual.iter().filter(feels) {
            let [first, second] = self.rates(one.sensor, Said::Off, belief);
            let seconds = one.may_end_s / 2.0;
            for (row, a) in belief.chances.chunks_exact_mut(second.len().max(1)).zip(first) {
                for (chance, &b) in row.iter_mut().zip(&second) {
                    let exponent = a.min(b) * seconds;
                    if exponent > NOTHING {
                        *chance *= libm::expf(-exponent);
                    }
                }
            }
        }
    }

    /// Goes back through all steps, of which the first has this number, and makes of what was thought by what was said before
    /// what is thought by all. `after` is how likely all is that comes after the last; `look` gets the same for the end of each
    /// step with the step's number.
    pub fn go_back(&mut self, steps: &Steps, first: usize, mut after: Belief, mut look: impl FnMut(usize, &Belief)) {
        for place in (0..self.beliefs.len()).rev() {
            look(first + place, &after);
            let previous = place.checked_sub(1).map_or(&self.before, |previous| &self.beliefs[previous]);
            let back = self.back((steps, first + place), self.others[place], &after, previous);
            let belief = &mut self.beliefs[place];
            belief.chances.iter_mut().zip(&after.chances).for_each(|(chance, after)| *chance *= after);
            belief.normalise();
            after = back;
        }
    }

    /// What is known of all that comes after the last step by what is known of the first alone, once the second is out.
    pub fn with_second_out(&self, alone: &Belief) -> Belief {
        let [first, second] = &self.last().states;
        let of = |state: u32| alone.states[0].binary_search(&state).map_or(0.0, |place| alone.chances[place]);
        let chances = first.iter().flat_map(|&a| second.iter().map(move |&b| if b == OUT { of(a) } else { 0.0 }));
        let mut after = Belief { chances: chances.collect(), states: self.last().states.clone() };
        after.normalise();
        after
    }

    /// What is known of all that comes after the last step, if nothing is: all is as likely.
    pub fn nothing_known(&self) -> Belief {
        let mut after = self.last().clone();
        after.chances.fill(1.0);
        after
    }

    /// How likely all is that comes after a step's beginning, for who was in the states of `previous` then, where `after` is
    /// the same for its end, and others say what is said then so often.
    fn back(&self, (steps, number): (&Steps, usize), others: f32, after: &Belief, previous: &Belief) -> Belief {
        let (step, unusual) = (steps.get(number), steps.unusual(number));
        let mut after = after.clone();
        if let Some(heard) = step.said {
            self.weigh(heard, others, &mut after);
        }
        self.ends(&mut after, unusual);
        let before = match step.span {
            None => after,
            Some(span) => {
                let turns = [0, 1].map(|body| Turns::new(self.senses[body], span, unusual));
                if let ([_], [_]) = (&previous.states[1][..], &after.states[1][..]) {
                    let chances = turns[0].back(&after.chances, &after.states[0], &previous.states[0]);
                    return self.ended(Belief { states: previous.states.clone(), chances }, unusual);
                }
                let [first, second] =
                    [0, 1].map(|body| turns[body].between(&previous.states[body], &after.states[body]));
                let half = product_with_transposed(&after.chances, &second, after.states[1].len());
                let rows = after.states[0].len();
                let chances = product(&first, &half, rows, previous.states[1].len());
                Belief { states: previous.states.clone(), chances }
            }
        };
        self.ended(before, unusual)
    }

    /// The same before half of what did not end.
    fn ended(&self, mut before: Belief, unusual: &[Unusual]) -> Belief {
        self.ends(&mut before, unusual);
        before.normalise();
        before
    }

    /// Begins anew after so many steps, with what was thought then by what was said until then.
    pub fn begin_after(&mut self, steps: usize, before: Belief) {
        self.evidence_before = self.evidences[steps - 1];
        self.evidence = self.evidence_before;
        self.before = before;
        self.beliefs.clear();
        self.others.clear();
        self.evidences.clear();
    }
}

impl Belief {
    /// The chances of one body's states, whatever the other does: by state, of those that count.
    pub fn alone(&self, body: usize) -> Vec<f32> {
        let columns = self.states[1].len().max(1);
        match body {
            0 => self.chances.chunks_exact(columns).map(|row| row.iter().sum()).collect(),
            _ => {
                let mut sums = vec![0.0; self.states[1].len()];
                for row in self.chances.chunks_exact(columns) {
                    sums.iter_mut().zip(row).for_each(|(sum, chance)| *sum += chance);
                }
                sums
            }
        }
    }

    /// The chance that a body is out.
    pub fn out(&self, body: usize) -> f32 {
        let of = |(chance, state): (f32, &u32)| if *state == OUT { chance } else { 0.0 };
        self.alone(body).into_iter().zip(&self.states[body]).map(of).sum()
    }

    /// Makes the chances one together; the logarithm of what they were.
    fn normalise(&mut self) -> f64 {
        let sum: f32 = self.chances.iter().sum();
        if sum > 0.0 && sum.is_finite() {
            self.chances.iter_mut().for_each(|chance| *chance /= sum);
            return libm::log(f64::from(sum));
        }
        // Nothing fits: all is possible again.
        let even = 1.0 / self.chances.len().max(1) as f32;
        self.chances.fill(even);
        libm::log(f64::from(f32::MIN_POSITIVE))
    }
}

/// How one body gets from state to state in a span, in which some sensors are deaf.
struct Turns<'a> {
    senses: &'a Senses,
    span: usize,
    /// By state: by how much less is said there in the span than if all could be.
    unsaid: Vec<f32>,
    /// By state: what that makes of the chance of those who come or go within the span.
    passing: Vec<f32>,
}

impl<'a> Turns<'a> {
    fn new(senses: &'a Senses, span: usize, unusual: &[Unusual]) -> Turns<'a> {
        let size = senses.states().len();
        if unusual.is_empty() {
            return Turns { senses, span, unsaid: vec![0.0; size], passing: vec![1.0; size] };
        }
        let mut unsaid = vec![0.0f32; size];
        let mut add = |rates: &[f32], seconds: f32| {
            unsaid.iter_mut().zip(rates).for_each(|(unsaid, rate)| *unsaid += rate * seconds);
        };
        for one in unusual {
            add(senses.rate(one.sensor, Said::On), one.deaf_s * SILENCE as f32);
            if one.may_end_s > 0.0 && !senses.timing[one.sensor].feels {
                add(senses.rate(one.sensor, Said::Off), -one.may_end_s);
            }
        }
        // Who comes or goes at any time of the span is there for a part of it: the mean of the exponential over all parts.
        let part = |&unsaid: &f32| match unsaid.abs() < NOTHING {
            true => 1.0,
            false => unsaid / (1.0 - libm::expf(-unsaid)),
        };
        let passing = unsaid.iter().map(part).collect();
        Turns { senses, span, unsaid, passing }
    }

    /// The chance of staying in a state for the whole span, but for that which its matrix has.
    fn stays(&self, state: u32) -> f32 {
        let unsaid = self.unsaid[state as usize];
        if unsaid.abs() < NOTHING {
            return 0.0;
        }
        let (usual, passing) = (self.senses.flow.stays(self.span, state), self.passing[state as usize]);
        (libm::expf(usual + unsaid) - libm::expf(usual) * passing * passing).max(0.0)
    }

    /// Where a body is afterwards who was in one of several states, each with its chance.
    fn forward(&self, chances: &[f32], states: &[u32]) -> Vec<f32> {
        let chances_of: Vec<f32> =
            states.iter().zip(chances).map(|(&state, chance)| chance * self.passing[state as usize]).collect();
        let mut to = vec![0.0; self.passing.len()];
        self.senses.flow.forward(self.span, &chances_of, states, &mut to);
        to.iter_mut().zip(&self.passing).for_each(|(to, passing)| *to *= passing);
        for (&state, chance) in states.iter().zip(chances) {
            to[state as usize] += chance * self.stays(state);
        }
        to
    }

    /// How likely all is that comes after the span for who was in one of the states `from`, where `chances` is the same for each
    /// state `to` at its end.
    fn back(&self, chances: &[f32], to: &[u32], from: &[u32]) -> Vec<f32> {
        let mut all = vec![0.0; self.passing.len()];
        let mut stays = all.clone();
        for (&state, &chance) in to.iter().zip(chances) {
            all[state as usize] = chance * self.passing[state as usize];
            stays[state as usize] = chance * self.stays(state);
        }
        let of = |&state: &u32| {
            let passes = dot(self.senses.flow.row(self.span, state), &all) * self.passing[state as usize];
            passes + stays[state as usize]
        };
        from.iter().map(of).collect()
    }

    /// The chances of getting from some states to others: a row for each of the first.
    fn between(&self, from: &[u32], to: &[u32]) -> Vec<f32> {
        let mut turns = Vec::with_capacity(from.len() * to.len());
        for &state in from {
            let (row, passing) = (self.senses.flow.row(self.span, state), self.passing[state as usize]);
            turns.extend(to.iter().map(|&to| row[to as usize] * passing * self.passing[to as usize]));
            if let Ok(place) = to.binary_search(&state) {
                let here = turns.len() - to.len() + place;
                turns[here] += self.stays(state);
            }
        }
        turns
    }
}

/// The product of a matrix with `middle` columns and one with `columns`.
fn product(a: &[f32], b: &[f32], middle: usize, columns: usize) -> Vec<f32> {
    if columns == 1 {
        return a.chunks_exact(middle.max(1)).map(|row| dot(row, b)).collect();
    }
    let mut product = vec![0.0; a.len() / middle.max(1) * columns];
    for (to, row) in product.chunks_exact_mut(columns.max(1)).zip(a.chunks_exact(middle.max(1))) {
        for (factor, b) in row.iter().zip(b.chunks_exact(columns.max(1))) {
            to.iter_mut().zip(b).for_each(|(to, b)| *to += factor * b);
        }
    }
    product
}

/// The product of a matrix, turned over, of this many rows and columns, and another with as many rows.
fn product_of_transposed(a: &[f32], b: &[f32], [rows, columns]: [usize; 2]) -> Vec<f32> {
    let width = b.len() / rows.max(1);
    let mut product = vec![0.0; columns * width];
    for (a, b) in a.chunks_exact(columns.max(1)).zip(b.chunks_exact(width.max(1))) {
        for (to, factor) in product.chunks_exact_mut(width.max(1)).zip(a) {
            to.iter_mut().zip(b).for_each(|(to, b)| *to += factor * b);
        }
    }
    product
}

/// The product of a matrix and another turned over, both of this many columns.
fn product_with_transposed(a: &[f32], b: &[f32], columns: usize) -> Vec<f32> {
    let columns = columns.max(1);
    a.chunks_exact(columns).flat_map(|a| b.chunks_exact(columns).map(move |b| dot(a, b))).collect()
}

/// The sum of products, in parts so that the processor can do them at once.
fn dot(a: &[f32], b: &[f32]) -> f32 {
    const PARTS: usize = 8;
    let mut sums = [0.0; PARTS];
    let (a_parts, b_parts) = (a.chunks_exact(PARTS), b.chunks_exact(PARTS));
    let rest: f32 = a_parts.remainder().iter().zip(b_parts.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a_parts.zip(b_parts) {
        sums.iter_mut().zip(a.iter().zip(b)).for_each(|(sum, (a, b))| *sum += a * b);
    }
    rest + sums.iter().sum::<f32>()
}

/// All of two sorted lists of states.
fn merged(a: &[u32], b: &[u32]) -> Vec<u32> {
    let mut all = Vec::with_capacity(a.len() + b.len());
    let mut rest = b.iter().copied().peekable();
    for &state in a {
        while let Some(before) = rest.next_if(|&other| other < state) {
            all.push(before);
        }
        rest.next_if_eq(&state);
        all.push(state);
    }
    all.extend(rest);
    all
}

/// The states that count, of chances by state: from a part of the best on, and the best of too many.
fn likely(chances: &[f32], (most, part): (usize, f32)) -> Vec<u32> {
    let least = chances.iter().copied().fold(0.0, f32::max) * part;
    let all = 0..chances.len() as u32;
    let mut likely: Vec<u32> = all.clone().filter(|&state| chances[state as usize] > least).collect();
    if likely.is_empty() {
        // Nothing fits: all is possible again.
        likely.extend(all);
    }
    if likely.len() > most {
        likely.select_nth_unstable_by(most, |&a, &b| chances[b as usize].total_cmp(&chances[a as usize]));
        likely.truncate(most);
        likely.sort_unstable();
    }
    likely
}
