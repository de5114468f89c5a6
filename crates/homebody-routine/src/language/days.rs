//! On which days: weekdays, months, dates, and all but these.

use super::adverbs::{Adverbs, put};
use super::calendar;
use super::day_kind::days_of_kind;
use super::frequency::Often;
use super::reader::SentenceReader;
use super::times;
use crate::routine::DaySelection;

impl Adverbs {
    /// "on Tuesday and Friday", "at weekends", "in winter", "from May to September", "except on Sunday".
    pub(super) fn days(&mut self, reader: &mut SentenceReader) -> Option<()> {
        let from = reader.at;
        if self.excepted(reader).is_some() {
            return Some(());
        }
        if reader.eat("from|between") {
            if let Some(months) = calendar::month_range(reader) {
                let span = reader.span(from);
                put(reader, &mut self.months, months, span, "both say in which months");
                return Some(());
            }
        } else if reader.ahead(|reader| {
            reader.eat("on|at");
            calendar::day_of_month(reader).is_some() || {
                reader.eat("the");
                calendar::days_of_year(reader).is_some()
            }
        }) {
            return self.days_of_month(reader);
        } else if reader.eat("in|during") {
            let months = calendar::months(reader)?;
            let span = reader.span(from);
            put(reader, &mut self.months, months, span, "both say in which months");
            return Some(());
        } else {
            reader.eat("on|at|of");
            if let Some(kind) = days_of_kind(reader) {
                let span = reader.span(from);
                put(reader, &mut self.kind, kind, span, "both say on which days");
                return Some(());
            }
            reader.eat("the|a");
        }
        let weekdays = calendar::weekdays(reader)?;
        let part = reader.eat_any(&times::PARTS);
        let span = reader.span(from);
        let often = Often { chance: None, weekdays: Some(weekdays), part, every: None, times: None };
        self.put_often(reader, often, span);
        Some(())
    }

    pub fn says_when(&self) -> bool {
        self.weekdays.is_some()
            || self.when.is_some()
            || self.part.is_some()
            || self.every.is_some()
            || self.kind.is_some()
            || self.chance.is_some()
    }

    /// "except on Sunday", "but not in winter", and of every day, "but Thursday".
    pub fn excepted(&mut self, reader: &mut SentenceReader) -> Option<()> {
        reader.attempt(|reader| {
            let from = reader.at;
            let after_days =
                from > 0 && ["day", "days", "evening", "morning"].contains(&reader.words[from - 1].text.as_str());
            let excepts = reader.eat("except|excluding|bar")
                || reader.eat("apart|aside from")
                || reader.eat("other than")
                || reader.eat("but not|never")
                || reader.eat("not") && self.weekdays.is_some()
                || after_days && reader.eat("but");
            excepts.then_some(())?;
            reader.eat("for");
            if reader.eat("in|during") {
                let excepted = calendar::months(reader)?;
                let span = reader.span(from);
                match &mut self.months {
                    Some(months) if months.value & !excepted != 0 => months.value &= !excepted,
                    months => {
                        put(reader, months, DaySelection::ALL.months & !excepted, span, "both say in which months")
                    }
                }
                return Some(());
            }
            reader.eat("on|at");
            reader.eat("the|a");
            let excepted = calendar::weekdays(reader)?;
            let span = reader.span(from);
            match &mut self.weekdays {
                // "On weekdays but not on Friday": of these days, the others.
                Some(days) if days.value & !excepted != 0 => days.value &= !excepted,
                days => put(reader, days, DaySelection::ALL.weekdays & !excepted, span, "both say on which days"),
            }
            Some(())
        })
    }

    /// "on 25 December", "on the first Monday of the month".
    fn days_of_month(&mut self, reader: &mut SentenceReader) -> Option<()> {
        let from = reader.at;
        reader.eat("on|at");
        let kind = "both say on which days";
        if let Some((weekdays, days, months)) = calendar::day_of_month(reader) {
            let span = reader.span(from);
            put(reader, &mut self.of_month, days, span, kind);
            if let Some(weekdays) = weekdays {
                put(reader, &mut self.weekdays, weekdays, span, kind);
            }
            if months != DaySelection::ALL.months {
                put(reader, &mut self.months, months, span, "both say in which months");
            }
            return Some(());
        }
        reader.eat("the");
        let (months, days) = calendar::days_of_year(reader)?;
        let span = reader.span(from);
        put(reader, &mut self.of_month, days, span, kind);
        put(reader, &mut self.months, months, span, "both say in which months");
        Some(())
    }
}
