//! When, how long, how often: the parts of a sentence that may stand before or after the rest, in any order.

use super::activities;
use super::amounts::{self, Amount, AmountUnit, amount};
use super::calendar;
use super::frequency::{self, Often};
use super::messages::TimeSentenceMessage;
use super::reader::{SentenceReader, is_beginning};
use super::times;
use super::words::{TextSpan, Token};
use crate::routine::{Activity, DayKind, HabitChance, HabitTime, PartOfDay, PhaseDay};
use homebody_core::fuzzy::Fuzzy;

#[derive(Clone, Debug, PartialEq)]
pub struct Slot<T> {
    pub value: T,
    pub span: TextSpan,
    pub own: bool,
}

/// A time of day may be off by this at most: beyond it, any time would do.
const HALF_A_DAY_S: f64 = 12.0 * 3600.0;

const FIRST: &str = "am pm when as last a about after afterwards all almost always an and approximately around at before beginning \
    between by daily during each every fade fades fading few for frequently from give half hardly immediately in \
    just lasting of many midday midnight most mostly nearly noon normally now occasionally often on once one over \
    plus rarely right roughly seldom several shortly since some sometimes soon starting straight then thrice till \
    twice until usually weekday weekdays weekend weekends with within exactly except the two throughout three four five \
    six seven eight nine ten eleven twelve thirteen fourteen fifteen sixteen seventeen eighteen nineteen quarter \
    while twenty thirty forty fifty sixty ninety seventy eighty but excluding bar apart aside other not of";

fn is_first(word: &str) -> bool {
    FIRST.split(' ').any(|first| first == word)
}

fn may_begin(reader: &SentenceReader) -> bool {
    match reader.token(0) {
        Some(Token::Number(_) | Token::Clock(..)) => true,
        Some(Token::Word) => is_first(reader.peek(0)) || calendar::is_weekday(reader.peek(0)),
        _ => false,
    }
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Adverbs {
    pub chance: Option<Slot<HabitChance>>,
    pub weekdays: Option<Slot<u8>>,
    pub months: Option<Slot<u16>>,
    pub every: Option<Slot<u32>>,
    pub of_month: Option<Slot<(u8, u8)>>,
    pub kind: Option<Slot<DayKind>>,
    pub part: Option<Slot<PartOfDay>>,
    pub when: Option<Slot<HabitTime>>,
    pub lasts: Option<Slot<Fuzzy>>,
    pub until_time: Option<Slot<Fuzzy>>,
    pub times: Option<Slot<(u32, u32)>>,
    pub from: Option<Slot<PhaseDay>>,
    pub until: Option<Slot<PhaseDay>>,
    pub for_days: Option<Slot<f64>>,
    pub over: Option<Slot<f64>>,
    pub fading: Option<Slot<f64>>,
    pub last: LastAdverb,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum LastAdverb {
    #[default]
    Nothing,
    When,
    Lasts,
    Until,
}

pub fn put<T>(reader: &mut SentenceReader, slot: &mut Option<Slot<T>>, value: T, span: TextSpan, kind: &str) {
    if let Some(first) = slot {
        let (text, first) = (reader.said(span), reader.said(first.span));
        reader.fault(span, TimeSentenceMessage::Twice { text, first, meaning: kind.to_owned() });
    } else {
        *slot = Some(Slot { value, span, own: true });
    }
}

/// "after two weeks".
fn after_days(reader: &mut SentenceReader) -> Option<PhaseDay> {
    let days = calendar::days(reader).filter(|days| !days.is_range())?;
    days.as_count().map(|(days, _)| PhaseDay::Day(days as i32))
}

/// "until she goes to bed": what is planned has to have an hour.
fn until_event(reader: &mut SentenceReader, from: usize) -> Option<()> {
    let at = reader.at;
    activities::event(reader)?;
    let (span, activity) = (reader.span(from), reader.said(reader.span(at)));
    reader.fault(span, TimeSentenceMessage::UntilActivity { text: reader.said(span), activity });
    Some(())
}

/// "from 20:00", where no time of day follows.
fn no_end(reader: &mut SentenceReader, from: usize) -> Option<()> {
    let (time, faults) = (reader.at, reader.faults.count());
    times::time(reader, true)?;
    if reader.faults.count() > faults {
        return Some(());
    }
    let (span, time) = (reader.span(from), reader.said(reader.span(time)));
    let until = reader.at;
    if reader.eat("until|till") && until_event(reader, until).is_some() {
        return Some(());
    }
    reader.at = until;
    reader.fault(span, TimeSentenceMessage::NoEnd { text: reader.said(span), time });
    Some(())
}

/// "when she gets up", "once she has eaten lunch": after what has an end, at the beginning of all else.
fn when_doing(reader: &mut SentenceReader) -> Option<HabitTime> {
    if !(reader.eat("when|once") || reader.eat("as soon as")) || !["she", "he", "they"].contains(&reader.peek(0)) {
        return None;
    }
    reader.at += 1;
    let is_over = reader.eat("has|have");
    let event = activities::activity(reader)?;
    if !reader.is_over()
        && reader.token(0) == Some(Token::Word)
        && !["then", "and", "she", "he", "they"].contains(&reader.peek(0))
    {
        return None;
    }
    Some(match event {
        Activity::GoToBed => HabitTime::Before(event, None),
        Activity::GetUp | Activity::ComeHome => HabitTime::After(event, None),
        _ if is_over => HabitTime::After(event, None),
        _ => HabitTime::With(event),
    })
}

const ABOUT_WORDS: [&str; 4] = ["about", "around", "roughly", "approximately"];

/// "around four", where nothing follows that four could be of.
fn is_hour_by_itself(reader: &mut SentenceReader) -> bool {
    ABOUT_WORDS.contains(&reader.peek(0))
        && reader.ahead(|reader| {
            times::time(reader, true).is_some()
                && (reader.token(0).is_none_or(|token| token == Token::Comma) || is_beginning(reader.peek(0)))
        })
}

/// Time before the given hour within which a person who gets up by then does so (our choice).
const BY_S: f64 = 1_800.0;

impl Adverbs {
    pub fn next(&mut self, reader: &mut SentenceReader) -> bool {
        if !may_begin(reader) {
            return false;
        }
        let start = reader.at;
        let read: [fn(&mut Adverbs, &mut SentenceReader) -> Option<()>; 11] = [
            Adverbs::give_or_take,
            Adverbs::often,
            Adverbs::days,
            Adverbs::parts,
            Adverbs::clock,
            Adverbs::phase,
            Adverbs::gradually,
            Adverbs::duration,
            Adverbs::then,
            Adverbs::order,
            Adverbs::counts,
        ];
        read.iter().any(|read| {
            let faults = reader.faults.count();
            let found = read(self, reader).is_some();
            if !found {
                reader.faults.forget_since(faults);
                reader.at = start;
            } else {
                // How exactly that is, said behind it.
                let last = |reader: &mut SentenceReader| (reader.eat("about") && reader.is_over()).then_some(());
                let _ = reader.eat("or so")
                    || reader.eat("thereabouts|sharp|prompt|promptly")
                    || reader.attempt(last).is_some();
            }
            found
        })
    }

    pub fn is_part(word: &str) -> bool {
        times::PARTS.iter().any(|(names, _)| names.split('|').any(|name| name == word))
    }

    pub fn all(&mut self, reader: &mut SentenceReader) {
        reader.skip_commas();
        while self.next(reader) {
            reader.skip_commas();
        }
    }

    fn often(&mut self, reader: &mut SentenceReader) -> Option<()> {
        let from = reader.at;
        // "she rarely reads at first, often by day 160"
        if let Some(chance) = self.chance.as_mut().filter(|chance| chance.own && chance.value.becomes.is_none())
            && reader.eat("at first")
        {
            chance.value = frequency::becoming(reader, chance.value);
            return Some(());
        }
        let often = frequency::at_first(reader).or_else(|| frequency::often(reader));
        let Some(often) = often else {
            if !reader.eat("at first") {
                return None;
            }
            reader.fault(reader.span(from), TimeSentenceMessage::AtFirst);
            return Some(());
        };
        let span = reader.span(from);
        self.put_often(reader, often, span);
        Some(())
    }

    pub(super) fn put_often(&mut self, reader: &mut SentenceReader, often: Often, span: TextSpan) {
        if let Some(chance) = often.chance {
            put(reader, &mut self.chance, chance, span, "both say how often");
        }
        if let Some(weekdays) = often.weekdays {
            put(reader, &mut self.weekdays, weekdays, span, "both say on which days");
        }
        if let Some(part) = often.part {
            put(reader, &mut self.part, part, span, "both say at which time of the day");
        }
        if let Some(every) = often.every {
            put(reader, &mut self.every, every, span, "both say on which days");
        }
        if let Some(times) = often.times {
            put(reader, &mut self.times, times, span, "both say how many times");
        }
    }

    /// "in the morning", "at night", "during the day".
    fn parts(&mut self, reader: &mut SentenceReader) -> Option<()> {
        let from = reader.at;
        let after_day = from > 0 && calendar::is_weekday(&reader.words[from - 1].text);
        let half = [("am", PartOfDay::Morning), ("pm", PartOfDay::Afternoon)];
        let half = if after_day { reader.eat_any(&half) } else { None };
        let part = if let Some(half) = half {
            half
        } else if reader.eat("in|during") {
            reader.eat("the");
            reader.eat_any(&times::PARTS)?
        } else if reader.eat("by") && !matches!(reader.token(1), Some(Token::Number(_))) {
            reader.eat_any(&[("day", PartOfDay::Day), ("night", PartOfDay::Night)])?
        } else if reader.eat("at|around") {
            reader.eat_any(&[times::PARTS[1], times::PARTS[2], times::PARTS[5]])?
        } else {
            return None;
        };
        let span = reader.span(from);
        put(reader, &mut self.part, part, span, "both say at which time of the day");
        Some(())
    }

    /// "at about 06:45", "around 8 pm", "between 14:00 and 16:00", "from 10:00 to 12:00", "until 12:00".
    fn clock(&mut self, reader: &mut SentenceReader) -> Option<()> {
        let from = reader.at;
        let kind = "both say at which time";
        if reader.eat("between") {
            let (first, last) = times::time_range(reader, "and")?;
            let span = reader.span(from);
            put(reader, &mut self.when, HabitTime::At(Fuzzy::between(first.at, last.at)), span, kind);
            self.last = LastAdverb::Nothing;
            return Some(());
        }
        if reader.eat("from") {
            let Some((first, last)) = times::time_range(reader, "to|until|till") else {
                return no_end(reader, from);
            };
            let span = reader.span(from);
            put(reader, &mut self.when, HabitTime::At(first.fuzzy()), span, kind);
            put(reader, &mut self.until_time, last.fuzzy(), span, "both say until when");
            self.last = LastAdverb::Nothing;
            return Some(());
        }
        if reader.eat("until|till") {
            let Some(time) = times::time(reader, true) else { return until_event(reader, from) };
            let span = reader.span(from);
            put(reader, &mut self.until_time, time.fuzzy(), span, "both say until when");
            self.last = LastAdverb::Until;
            return Some(());
        }
        let is_up = |reader: &SentenceReader| {
            reader.at > 0 && ["up", "asleep", "bed"].contains(&reader.words[reader.at - 1].text.as_str())
        };
        if is_up(reader) && reader.eat("before") || reader.eat("by") {
            let time = times::time(reader, true)?;
            let span = reader.span(from);
            put(reader, &mut self.when, HabitTime::At(Fuzzy::between(time.at - BY_S, time.at)), span, kind);
            self.last = LastAdverb::Nothing;
            return Some(());
        }
        let at = reader.eat("at");
        let is_bare = at || is_hour_by_itself(reader);
        let time = times::time(reader, is_bare)?;
        let span = reader.span(from);
        put(reader, &mut self.when, HabitTime::At(time.fuzzy()), span, kind);
        self.last = LastAdverb::When;
        // "2 pm to 4 pm"
        let until = reader.at;
        let end = reader.attempt(|reader| if reader.eat("to|until|till") { times::time(reader, true) } else { None });
        if let Some(end) = end {
            let span = reader.span(until);
            put(reader, &mut self.until_time, end.fuzzy(), span, "both say until when");
            self.last = LastAdverb::Nothing;
        }
        Some(())
    }

    /// "from week 6", "from day 100 to day 120", "until 2009-05-01", "in week 6", "on 2009-05-01".
    fn phase(&mut self, reader: &mut SentenceReader) -> Option<()> {
        let start = reader.at;
        if reader.eat("until|till|before") {
            let is_end = reader.eat("the end of");
            let (moment, length) = calendar::moment(reader)?;
            let moment = if is_end { calendar::end_of(moment, length) } else { moment };
            let span = reader.span(start);
            put(reader, &mut self.until, moment, span, "both say until when");
            return Some(());
        }
        if reader.eat("after") {
            let moment = reader.attempt(calendar::moment).map(|(moment, length)| calendar::end_of(moment, length));
            let moment = moment.or_else(|| after_days(reader))?;
            let span = reader.span(start);
            put(reader, &mut self.from, moment, span, "both say from when");
            return Some(());
        }
        if reader.eat("in|on|during|throughout") || reader.peek(1) == "the" && reader.eat("for") {
            let (moment, length) = calendar::moment(reader)?;
            let span = reader.span(start);
            put(reader, &mut self.from, moment, span, "both say from when");
            put(reader, &mut self.until, calendar::end_of(moment, length), span, "both say until when");
            return Some(());
        }
        if !(reader.eat("from") || reader.eat("since") || reader.eat("starting|beginning on|in|from|with")) {
            return None;
        }
        let month = reader.at;
        if calendar::months(reader).is_some() {
            let span = reader.span(month);
            reader.fault(span, TimeSentenceMessage::WhichDay { text: reader.said(span) });
            return Some(());
        }
        let (moment, _) = calendar::moment(reader)?;
        reader.eat("on|onward|onwards");
        let span = reader.span(start);
        put(reader, &mut self.from, moment, span, "both say from when");
        let from = reader.at;
        if reader.eat("to|through")
            && let Some((moment, length)) = calendar::moment(reader)
        {
            let span = reader.span(from);
            put(reader, &mut self.until, calendar::end_of(moment, length), span, "both say until when");
        } else {
            reader.at = from;
        }
        Some(())
    }

    /// "over 4 weeks", "fading over 2 weeks".
    fn gradually(&mut self, reader: &mut SentenceReader) -> Option<()> {
        let start = reader.at;
        reader.eat("and");
        let fading = reader.eat("fading|fades|fade");
        if fading {
            reader.eat("out|away");
        }
        if !reader.eat("over|within") {
            return None;
        }
        reader.skip_determiners();
        let days = calendar::days(reader)?;
        let span = reader.span(start);
        if days.is_range() {
            reader.fault(span, TimeSentenceMessage::OneLength);
        }
        let slot = if fading { &mut self.fading } else { &mut self.over };
        put(reader, slot, days.from, span, "both say over which time");
        Some(())
    }

    /// "for about 2 hours", or "for 10 days", which is until when.
    fn duration(&mut self, reader: &mut SentenceReader) -> Option<()> {
        let start = reader.at;
        let of_each = reader.attempt(|reader| {
            reader.eat("of").then_some(())?;
            reader.ahead(|reader| amount(reader).is_some_and(|amount| amount.unit == AmountUnit::Second)).then_some(())
        });
        if of_each.is_none() && !reader.eat("for|lasting") {
            return None;
        }
        let Some(amount) = amount(reader) else {
            // "is up twice for the toilet"
            let for_toilet = |reader: &mut SentenceReader| {
                reader.skip_determiners();
                reader.eat("toilet|bathroom|loo|commode|wee")
            };
            if reader.ahead(for_toilet) {
                return None;
            }
            let from = reader.at;
            while !reader.is_over() && reader.token(0) != Some(Token::Comma) && reader.at < from + 3 {
                reader.at += 1;
            }
            let span = if from == reader.at { reader.span(start) } else { reader.span(from) };
            reader.fault(span, TimeSentenceMessage::NotALength { text: reader.said(span) });
            return Some(());
        };
        match amount.unit {
            AmountUnit::Second => {
                let lasts = amounts::length(reader, &amount);
                reader.eat("each");
                let span = reader.span(start);
                put(reader, &mut self.lasts, lasts, span, "both say how long");
                self.last = LastAdverb::Lasts;
            }
            AmountUnit::Day if !amount.is_range() && amount.from >= 1.0 && amount.from.fract() == 0.0 => {
                let span = reader.span(start);
                put(reader, &mut self.for_days, amount.from, span, "both say for how long");
            }
            AmountUnit::Day => {
                reader.fault(amount.span, TimeSentenceMessage::WholeDays);
            }
            _ => {
                reader.fault(amount.span, TimeSentenceMessage::NotALength { text: reader.said(amount.span) });
            }
        }
        Some(())
    }

    /// "after breakfast", "30 minutes before bed", "with lunch".
    fn order(&mut self, reader: &mut SentenceReader) -> Option<()> {
        let start = reader.at;
        if let Some(when) = reader.attempt(when_doing) {
            let span = reader.span(start);
            put(reader, &mut self.when, when, span, "both say at which time");
            self.last = LastAdverb::Nothing;
            return Some(());
        }
        let gap = reader.attempt(|reader| amount(reader).filter(|amount| amount.unit == AmountUnit::Second));
        if gap.is_none() {
            reader.eat("right|shortly|soon|immediately|just|straight");
        }
        let after = reader.eat_any(&[("after", 0), ("before", 1), ("with|during|while", 2), ("over|at", 3)])?;
        let at = reader.at;
        let other = activities::event(reader).filter(|event| after < 3 || matches!(event, Activity::Eat(_)));
        if other.is_none() && after == 3 {
            return None;
        }
        let Some(other) = other else {
            reader.at = at;
            let is_time = times::time(reader, true).is_some();
            if !is_time {
                reader.skip_determiners();
                reader.at += 1;
            }
            let text = reader.said(reader.span(start));
            let help = match after {
                2 => "write \"with breakfast\", or leave it out",
                _ => "write \"after breakfast\", \"before she goes to bed\", or \"between 20:00 and 22:00\"",
            };
            let help = help.to_owned();
            let message = match is_time {
                true => TimeSentenceMessage::OpenTime { text, help },
                false => TimeSentenceMessage::UnknownEvent { text, help },
            };
            reader.fault(reader.span(start), message);
            reader.at = reader.words.len();
            return Some(());
        };
        let gap = gap.map(|gap| amounts::duration(reader, &gap));
        let span = reader.span(start);
        let when = match after {
            0 => HabitTime::After(other, gap),
            1 => HabitTime::Before(other, gap),
            _ if gap.is_some() => return None,
            _ => HabitTime::With(other),
        };
        put(reader, &mut self.when, when, span, "both say at which time");
        self.last = LastAdverb::Nothing;
        Some(())
    }

    /// "once or twice", "3 times a week", "8 times a day".
    fn counts(&mut self, reader: &mut SentenceReader) -> Option<()> {
        let start = reader.at;
        let amount = amount(reader).filter(|amount| amount.unit == AmountUnit::Times)?;
        if ["as", "more", "less", "longer", "later", "earlier"].contains(&reader.peek(0)) {
            return None;
        }
        let often = frequency::times_in(reader, &amount);
        let often = often.unwrap_or_else(|| {
            let times = Some(frequency::count(reader, &amount));
            Often { chance: None, weekdays: None, part: None, every: None, times }
        });
        let span = reader.span(start);
        self.put_often(reader, often, span);
        Some(())
    }

    fn give_or_take(&mut self, reader: &mut SentenceReader) -> Option<()> {
        let start = reader.at;
        if !(reader.eat("give or take") || reader.eat("plus or minus")) {
            return None;
        }
        let spread: Amount = amount(reader).filter(|amount| amount.unit == AmountUnit::Second)?;
        let span = reader.span(start);
        let around = |fuzzy: &Fuzzy| Fuzzy::around((fuzzy.from + fuzzy.to) / 2.0, spread.to);
        let (lasts, until) = (self.lasts.as_mut(), self.until_time.as_mut());
        match (self.last, self.when.as_mut().map(|slot| &mut slot.value), lasts, until) {
            (LastAdverb::When | LastAdverb::Until, ..) if spread.to > HALF_A_DAY_S => {
                reader.fault(span, TimeSentenceMessage::SpreadOfTime);
            }
            (LastAdverb::When, Some(HabitTime::At(at)), _, _) => *at = around(at),
            (LastAdverb::Until, _, _, Some(until)) => until.value = around(&until.value),
            (LastAdverb::Lasts, _, Some(lasts), _) if spread.to < lasts.value.from => {
                lasts.value = around(&lasts.value)
            }
            (LastAdverb::Lasts, _, Some(_), _) => {
                reader.fault(span, TimeSentenceMessage::SpreadOfDuration);
            }
            _ => {
                reader.fault(span, TimeSentenceMessage::NothingVaries { text: reader.said(span) });
            }
        }
        self.last = LastAdverb::Nothing;
        Some(())
    }

    /// "then", "after that".
    fn then(&mut self, reader: &mut SentenceReader) -> Option<()> {
        let start = reader.at;
        if !(reader.eat("then|afterwards") || reader.eat("after that|this")) {
            return None;
        }
        let span = reader.span(start);
        put(reader, &mut self.when, HabitTime::Then, span, "both say at which time");
        Some(())
    }
}
