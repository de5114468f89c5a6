//! The messages about numbers, times and days.

use homebody_core::problem::Advice;

homebody_core::messages! {
    /// Problems with a number, a time or a day in a routine.
    pub enum TimeSentenceMessage in "routine" {
        /// Homebody computes with numbers up to a billion.
        NumberTooLarge {
            /// The words.
            text: String,
        } error "number-too-large" ("the number {text:?} is too large")
            hint ("write a smaller number");
        /// A range goes from a smaller number to a larger one, such as `2 to 3 times`.
        ReversedNumbers {
            /// The words.
            text: String,
        } error "reversed-numbers" ("the range {text:?} begins with the larger number")
            hint ("write the smaller number first");
        /// A range of times goes from an earlier time to a later one, such as `from 14:00 to 17:00`.
        ReversedTimes {
            /// The words.
            text: String,
        } error "reversed-times" ("the range {text:?} begins with the later time")
            hint ("write the earlier time first");
        /// A routine has days, and activities last for less than one. Only outings and visits may last longer.
        LongerThanADay {
            /// The words.
            text: String,
        } error "longer-than-a-day" ("{text:?} is more than a day")
            hint ("write at most 24 hours; only outings and visits can last longer");
        /// An activity without a duration would leave no trace in a run.
        NoDuration {
            /// The words.
            text: String,
        } error "no-duration" ("{text:?} is a duration of zero")
            hint ("write how long it lasts, such as \"for 20 minutes\"");
        /// The duration of an outing or a visit has a limit, which is our choice.
        LongerThanAYear {
            /// The words.
            text: String,
        } error "longer-than-a-year" ("{text:?} is more than a year")
            hint ("write until when, such as \"until day 100\"");
        /// A share is a part of all days or occasions.
        MoreThanAll {
            /// The words.
            text: String,
        } error "more-than-all" ("{text:?} is more than 100 %")
            hint ("write at most 100 %");
        /// A habit with a frequency of zero has no effect.
        Never {
            /// The words.
            text: String,
        } error "never" ("with {text:?}, this never happens")
            hint ("write \"does not\", or leave the sentence out");
        /// Days, weeks and months of a run count from 1, and go up to a hundred years.
        NoDay {
            /// The words.
            text: String,
        } error "no-day" ("there is no {text:?}")
            hint ("write a whole number from 1 to 36525, such as \"day 100\" or \"week 6\"");
        /// The day does not exist in this month, or the year is outside of the range.
        NoDate error "no-date" ("this date does not exist, or is not between 1900 and 2200")
            hint ("write year, month and day, such as 2009-05-01");
        /// Every other week is about one day of the week. With several days, each of them could be in another week.
        SeveralWeekdays {
            /// The words.
            text: String,
        } error "several-weekdays" ("{text:?} names several weekdays, which can fall in different weeks")
            hint ("write a sentence for each day: \"every other Saturday\", \"every third Monday\"");
        /// Homebody repeats habits by days. Within a day it counts how often they happen.
        EveryHours {
            /// The words.
            text: String,
            /// The same as times a day.
            times_a_day: f64,
        } error "every-hours" ("{text:?} is more often than once a day")
            hint ("write how many times, such as \"{times_a_day} times a day\"");
        /// A habit can return every 1 to 365 days.
        EveryDays {
            /// The words.
            text: String,
        } error "every-days" ("a habit cannot repeat every {text:?}")
            hint ("write a whole number of days from 1 to 365, such as \"every 3 days\"");
        /// A part of each day has a beginning, and the sentence leaves it open.
        PartOfEachDay {
            /// The words.
            text: String,
        } error "part-of-each-day" ("{text:?} gives a length, but no beginning")
            hint ("write both times, \"from 14:00 to 17:00\", or the days: \"every day\", \"most days\"");
        /// The first number of a share is more than 0 and not more than the second.
        NotAShare {
            /// The words.
            text: String,
        } error "not-a-share" ("{text:?} is not a share of days")
            hint ("write a share such as \"one day in three\"");
        /// A week has seven days.
        DaysAWeek {
            /// The words.
            text: String,
        } error "days-a-week" ("a week has 7 days, not {text:?}")
            hint ("write at most 7 days");
        /// The number of times in this period is more than its days. Several times a day are a number of times a day.
        OftenerThanDaily {
            /// The words.
            text: String,
        } error "oftener-than-daily" ("{text:?} in this period is more than once a day")
            hint ("write a number of times a day, such as \"2 times a day\"");
        /// "At first" begins a change of a frequency. The second part says the later frequency.
        AtFirst error "at-first" ("\"at first\" needs a second part with the later frequency")
            hint ("write \"rarely at first, often by day 160\"");
        /// A change of a frequency ends on a day.
        ByWhen error "by-when" ("the sentence does not say on which day the change of frequency ends")
            hint ("write \"rarely at first, often by day 160\"");
        /// A number of times is whole.
        Count {
            /// The words.
            text: String,
        } error "count" ("{text:?} is not a whole number from 1 to 100")
            hint ("write a whole number from 1 to 100, such as \"2 to 3 times\"");
        /// A day has two times for each number from 1 to 12, and nothing in the sentence decides between them.
        AmbiguousTime {
            /// The words.
            text: String,
            /// The hint.
            help: String,
        } error "ambiguous-time" ("the time {text:?} can be in the morning or in the afternoon")
            hint ("{help}");
        /// Times are hours and minutes, such as `06:45` or `6:45 pm`.
        NoTime {
            /// The words.
            text: String,
            /// The hint.
            help: Advice,
        } error "no-time" ("there is no time {text:?}")
            advice (Some(help.clone()));
        /// The time and the part of the day contradict each other.
        PartOfDay {
            /// The time.
            text: String,
            /// The part of the day.
            part: String,
            /// The words for it.
            part_text: String,
        } error "part-of-day" ("{text:?} is not in the {part}")
            hint ("correct the time, or leave out {part_text:?}");
        /// An activity and a phase have one end.
        TwoEnds {
            /// The words of one end.
            text: String,
            /// The words of the other end.
            other: String,
        } error "two-ends" ("{text:?} and {other:?} both say when this ends")
            hint ("leave one of them out");
        /// An activity and a phase begin before they end.
        EndBeforeBegin {
            /// The words of the end.
            text: String,
        } error "end-before-begin" ("{text:?} is not after the beginning")
            hint ("write an end after the beginning");
        /// A frequency changes within the phase that the sentence names.
        ChangeBeforeBegin {
            /// The words.
            text: String,
        } error "change-before-begin" ("{text:?} changes before the habit begins")
            hint ("write a later day after \"by\"");
        /// The sentence has a duration, and nothing says on which day it begins.
        NoBeginning {
            /// The hint.
            help: String,
        } error "no-beginning" ("the sentence does not say on which day this begins")
            hint ("{help}");
        /// With a time of day and a number of days, an outing or a visit can happen once and last all these days, or happen each day.
        StayOrEachDay {
            /// The verb of a stay.
            state: String,
            /// The words for the days.
            days: String,
        } error "stay-or-each-day" ("{days:?} can be the length of one absence or visit, or the days on which it happens")
            hint ("write \"{state} {days}\" without a time of day for one, or add a length such as \"for 1 hour\" for each day");
        /// A change that fades has an end at which the fading begins.
        NoEndToFade error "no-end-to-fade" ("the sentence does not say when the fading begins")
            hint ("write \"until day 100, fading over 2 weeks\"");
        /// The end of an activity is a time of day. Homebody cannot plan it by another activity.
        UntilActivity {
            /// The words.
            text: String,
            /// The activity.
            activity: String,
        } error "until-activity" ("{text:?} is not a time of day")
            hint ("write a time, such as \"until 22:00\", or a duration before the activity: \"for 2 hours before {activity}\"");
        /// "From" with a time of day begins a range.
        NoEnd {
            /// The words.
            text: String,
            /// The time.
            time: String,
        } error "no-end" ("the range {text:?} has no end")
            hint ("write \"at {time}\", or add an end: \"from {time} to ...\"");
        /// A month alone can be its first day, or the month in each year.
        WhichDay {
            /// The words.
            text: String,
        } error "which-day" ("the sentence does not say on which day of {text:?} this begins")
            hint ("write a date such as 2009-03-01, or \"from March to May\" for those months of all years");
        /// A change builds up over one length of time.
        OneLength error "one-length" ("a change needs one length of time, not a range")
            hint ("write one number, such as \"over 4 weeks\"");
        /// "For" begins a length of time with a unit.
        NotALength {
            /// The words.
            text: String,
        } error "not-a-length" ("{text:?} is not a length of time")
            hint ("write minutes, hours, days or weeks, such as \"for 20 minutes\"");
        /// A phase has whole days.
        WholeDays error "whole-days" ("a length in days must be one whole number of at least 1")
            hint ("write one whole number, such as \"for 10 days\"");
        /// A sentence can place an activity before or after another activity. These words name a time instead.
        OpenTime {
            /// The words.
            text: String,
            /// The hint.
            help: String,
        } error "open-time" ("{text:?} leaves the time open")
            hint ("{help}");
        /// A time that varies by more than half a day can be any time.
        SpreadOfTime error "spread-of-time" ("the time varies by more than 12 hours")
            hint ("write at most 12 hours");
        /// A duration that varies by its own length can be zero.
        SpreadOfDuration error "spread-of-duration" ("the duration varies by as much as its own length")
            hint ("write less than the duration itself");
        /// The time of most falls and the time of this fall contradict each other.
        TwoTimesOfFall {
            /// The words.
            text: String,
        } error "two-times-of-fall" ("the sentence gives the time of most falls, and {text:?} is a second time")
            hint ("leave one of the two times out");
        /// People are up to 130 years old.
        Age {
            /// The words.
            text: String,
        } error "age" ("{text:?} is not a possible age")
            hint ("write an age of at most 130 years, such as \"is 82\"");
        /// The walking speed of a person has a range.
        Pace {
            /// The words.
            text: String,
        } error "pace" ("a person cannot walk at {text:?}")
            hint ("write a speed from 0.2 to 1.6 m/s");
        /// A change has a limit, so that a run stays possible. The limit is our choice.
        TooGreat {
            /// The words.
            text: String,
            /// The limit.
            most: String,
        } error "too-great" ("{text:?} is more than {most}")
            hint ("write at most {most}");
        /// A decrease by more than all would be less than nothing.
        LessThanNothing {
            /// The words.
            text: String,
        } error "less-than-nothing" ("a decrease cannot be more than 100 %: {text:?}")
            hint ("write at most 100 %");
        /// Each sentence has one value of this kind.
        Twice {
            /// The words.
            text: String,
            /// The words before them.
            first: String,
            /// The meaning of both.
            meaning: String,
        } error "twice" ("{text:?} conflicts with {first:?}: {meaning}")
            hint ("leave one of them out, or make two sentences");
    }
}
