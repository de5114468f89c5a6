//! The circumstances of what is done: what for, with whom, how, and why. Some of them say what is done, most change nothing and are
//! told as remarks.

use super::activities;
use super::adverbs::{Adverbs, Slot};
use super::amounts::{AmountUnit, amount};
use super::calendar::is_weekday;
use super::clause::{Clause, PLACES};
use super::help;
use super::predicate::{Predicate, named};
use super::reader::{SentenceReader, begins_adverb, denies, is_determiner};
use super::remarks::is_lived;
use super::subjects::SentenceSubject;
use super::unknown_word;
use super::words::Token;
use crate::routine::{Activity, HabitTime, PartOfDay};

/// "gets up to use the toilet", "goes to the kitchen to make tea": what for is what is done.
pub fn says_purpose(reader: &mut SentenceReader, clause: &mut Clause) -> bool {
    let from = reader.at;
    let found = reader.attempt(|reader| {
        if matches!(&clause.predicate, Predicate::Own(words) if unknown_word::is_way(words)) && clause.place.is_some() {
            let kind =
                [("something to eat", true), ("a snack", true), ("something to drink", false), ("a drink", false)];
            let found = reader.attempt(|reader| if reader.eat("for") { reader.eat_any(&kind) } else { None });
            if let Some(is_snack) = found {
                return Some(Predicate::Does(if is_snack { Activity::Snack } else { Activity::Drink }));
            }
        }
        let for_toilet = reader.attempt(|reader| {
            reader.eat("for").then_some(())?;
            reader.skip_determiners();
            reader.eat("toilet|bathroom|loo|commode|wee").then_some(())
        });
        if for_toilet.is_some() {
            let is_up = matches!(clause.predicate, Predicate::Does(Activity::GetUp | Activity::LieAwake));
            return is_up.then_some(Predicate::Does(Activity::UseBathroom));
        }
        if !reader.eat("in order to") && !reader.eat("to") {
            return None;
        }
        if clause.predicate == Predicate::Visits {
            return help::doing(reader);
        }
        let purpose = activities::activity(reader)?;
        let goes =
            matches!(&clause.predicate, Predicate::Own(words) if unknown_word::is_way(words) || words == "stands");
        match &clause.predicate {
            Predicate::Does(Activity::GetUp | Activity::Relax | Activity::LieAwake) => Some(Predicate::Does(purpose)),
            Predicate::Own(_) if goes && clause.place.is_some() => Some(Predicate::Does(purpose)),
            Predicate::Does(Activity::Leave) => Some(Predicate::Does(Activity::Leave)),
            _ => None,
        }
    });
    let Some(found) = found else { return false };
    let is_new = matches!(&found, Predicate::Does(activity) if Predicate::Does(activity.clone()) != clause.predicate);
    if clause.predicate == Predicate::Does(Activity::GetUp) && is_new {
        clause.adverbs.all(reader);
        if clause.adverbs.when.is_none() && clause.adverbs.part.is_none() {
            clause.adverbs.part = Some(Slot { value: PartOfDay::Night, span: reader.span(from), own: true });
        }
    }
    clause.predicate = found;
    true
}

/// "visits 30 minutes": for so long.
pub fn says_length(reader: &mut SentenceReader, clause: &mut Clause) -> bool {
    if clause.adverbs.lasts.is_some() || !matches!(clause.predicate, Predicate::Does(_) | Predicate::Visits) {
        return false;
    }
    let from = reader.at;
    let length = reader.attempt(|reader| {
        let length = amount(reader).filter(|amount| amount.unit == AmountUnit::Second)?;
        let turns =
            ["later", "earlier", "longer", "shorter", "more", "less", "before", "after"].contains(&reader.peek(0));
        (!turns).then_some(length)
    });
    let Some(length) = length else { return false };
    clause.adverbs.lasts = Some(Slot { value: length.as_duration(), span: reader.span(from), own: true });
    true
}

/// "plays bingo at the community centre": what is done out of the home is being out.
pub fn says_outside(reader: &mut SentenceReader, clause: &mut Clause) -> bool {
    // "Spends Sunday at her son's": the day would be lost.
    let says_when = |words: &str| words.split(' ').any(|word| is_weekday(word) || Adverbs::is_part(word));
    match &clause.predicate {
        Predicate::Does(_) if clause.place.is_none() => {}
        Predicate::Own(words) if clause.place.is_none() && !says_when(words) => {}
        _ => return false,
    }
    let found = reader.attempt(|reader| {
        if !reader.eat("at|in") {
            return None;
        }
        reader.skip_determiners();
        if reader.ahead(|reader| reader.name(&PLACES).is_some()) {
            return None;
        }
        let lexicon = reader.names.lexicon.clone();
        let length = (0..3).find_map(|before| {
            let length = lexicon.list("OUTSIDE", |ahead| reader.peek(before + ahead))?;
            Some(before + length)
        });
        reader.at += length?;
        (reader.is_over()
            || reader.token(0) != Some(Token::Word)
            || begins_adverb(reader)
            || reader.ahead(|reader| Adverbs::default().next(reader))
            || is_weekday(reader.peek(0)))
        .then_some(())
    });
    if found.is_some() {
        clause.predicate = Predicate::Does(Activity::Leave);
    }
    found.is_some()
}

/// "with her daughter", of who is out: who else is there no sensor of the home sees. "With help from a carer": who comes.
pub fn says_company(reader: &mut SentenceReader, clause: &mut Clause) -> bool {
    let Predicate::Does(activity) = clause.predicate.clone() else { return false };
    let from = reader.at;
    let is_passive = ["is", "are"].iter().any(|is| reader.said(clause.predicate_span).to_lowercase().starts_with(is));
    let by = is_passive && reader.eat("by|from");
    if !by && !reader.eat("with") {
        return false;
    }
    let helped = by || reader.eat("the help|assistance of|from") || reader.eat("help|assistance from");
    let starts = reader.at;
    let with_determiner = is_determiner(reader.peek(0));
    reader.skip_determiners();
    let start = reader.at;
    let Some(who) = named(reader) else {
        reader.at = from;
        return false;
    };
    let lexicon = reader.names.lexicon.clone();
    let is_people = (start..reader.at).any(|at| {
        let word = |ahead: usize| reader.words.get(at + ahead).map_or("", |word| word.text.as_str());
        ["PEOPLE", "RELATIVES", "PET"].iter().any(|list| lexicon.list(list, word).is_some())
    });
    let is_who = is_people || helped && with_determiner;
    if helped && is_who {
        clause.predicate = Predicate::HelpedBy(who, activity);
        return true;
    }
    if is_who && starts > from && activity == Activity::Leave {
        return true;
    }
    let spouse = ["husband", "wife", "partner", "cat", "dog"].contains(&who.as_str());
    if is_who && spouse {
        clause.beside.push(reader.span(from));
        return true;
    }
    let comes = is_people
        && !spouse
        && (clause.adverbs.says_when()
            || reader.ahead(|reader| {
                let mut more = Adverbs::default();
                more.all(reader);
                more.says_when()
            }));
    if comes {
        clause.predicate = Predicate::HelpedBy(who, activity);
        return true;
    }
    reader.at = from;
    false
}

/// "because she is tired", "due to her knees", "(with a carer)": why, and what stands between brackets, is a remark.
pub fn says_beside(reader: &mut SentenceReader, clause: &mut Clause) -> bool {
    if matches!(clause.predicate, Predicate::Not(_)) && reader.peek(0) == "unless" {
        return false;
    }
    let from = reader.at;
    if reader.peek(0) == "(" {
        let Some(length) = (1..reader.words.len() - from).find(|&ahead| reader.peek(ahead) == ")") else {
            return false;
        };
        let is_plain = reader.ahead(|reader| {
            reader.at += 1;
            while reader.at < from + length {
                if is_lived(reader) || matches!(reader.token(0), Some(Token::Number(_))) || denies(reader.peek(0)) {
                    return false;
                }
                reader.at += 1;
            }
            true
        });
        if is_plain && length > 1 {
            reader.at = from + 1;
            clause.beside.push(reader.words[from + 1].span.to(reader.words[from + length - 1].span));
            reader.at = from + length + 1;
        }
        return is_plain;
    }
    reader.skip_commas();
    let start = reader.at;
    let is_why = reader.eat("because|owing|due")
        || reader.eat("so that|as")
        || reader.eat("on account of")
        || reader.eat("for fear of")
        || reader.eat("rather than")
        || reader.eat("instead of")
        || reader.eat("since her|his|the|a|an|being|having|moving|coming")
        || reader.eat("since she|he|they")
        || reader.eat("as|since she|he is|has|gets|finds|feels|cannot|likes");
    if !is_why || reader.is_over() {
        reader.at = from;
        return false;
    }
    while !(reader.is_over()
        || [";", "(", ")"].contains(&reader.peek(0))
        || reader.at > start + 2 && begins_again(reader))
    {
        reader.at += 1;
    }
    clause.beside.push(reader.span(start));
    true
}

fn begins_again(reader: &mut SentenceReader) -> bool {
    reader.ahead(|reader| {
        let comma = reader.token(0) == Some(Token::Comma);
        reader.skip_commas();
        (reader.eat("and|but|so|then") || comma) && {
            reader.eat("she|he|they");
            Adverbs::default().all(reader);
            activities::activity(reader).is_some()
        }
    })
}

/// "sits in the armchair watching television": that is what is done. "Wanders looking for her husband": a remark.
pub fn says_doing(reader: &mut SentenceReader, clause: &mut Clause) -> bool {
    let is_doing = matches!(clause.predicate, Predicate::Does(_)) && reader.peek(0).ends_with("ing");
    if !is_doing {
        return false;
    }
    let from = reader.at;
    if let Some(activity) = reader.attempt(activities::activity) {
        let sits = matches!(clause.predicate, Predicate::Does(Activity::Relax));
        if sits {
            clause.predicate = Predicate::Does(activity);
            return true;
        }
        reader.at = from;
        return false;
    }
    const IN_MIND: &str =
        "looking|searching|calling|asking|worrying|thinking|crying|talking|shouting|muttering|feeling|holding|hoping";
    if !reader.eat(IN_MIND) {
        return false;
    }
    reader.attempt(|reader| {
        reader.eat("for|about|to|out").then_some(())?;
        let start = reader.at;
        reader.skip_determiners();
        let named = reader.at > start || reader.eat("herself|himself|something|somebody|someone|help");
        reader.at += usize::from(
            named && reader.at > start && is_determiner(reader.peek(0))
                || is_determiner(&reader.words[reader.at - 1].text),
        );
        named.then_some(())
    });
    clause.beside.push(reader.span(from));
    true
}

/// "walks to the shop for the newspaper": what for does not matter to who is out.
pub fn says_errand(reader: &mut SentenceReader, clause: &mut Clause) -> bool {
    clause.predicate == Predicate::Does(Activity::Leave)
        && reader
            .attempt(|reader| {
                reader.eat("for").then_some(())?;
                let is_named = is_determiner(reader.peek(0));
                reader.skip_determiners();
                let named = is_named
                    || reader.eat("lunch|dinner|coffee|tea|breakfast|supper|shopping|groceries|bread|milk|company");
                let is_time = reader.ahead(|reader| number_or_unit(reader));
                if !named || is_time {
                    return None;
                }
                if is_named {
                    reader.at += 1;
                }
                Some(())
            })
            .is_some()
}

fn number_or_unit(reader: &mut SentenceReader) -> bool {
    super::amounts::is_unit(reader)
        || super::amounts::number(reader).is_some()
        || ["half", "few", "couple", "while", "quarter"].contains(&reader.peek(0))
}

/// "visits every Sunday for lunch".
pub fn says_meal(reader: &mut SentenceReader, clause: &mut Clause) -> bool {
    if clause.predicate != Predicate::Visits {
        return false;
    }
    let found = reader.attempt(|reader| if reader.eat("for") { help::meal_shared(reader) } else { None });
    let is_some = found.is_some();
    clause.predicate = found.unwrap_or(Predicate::Visits);
    is_some
}

/// "visits on Sunday and stays until 16:00".
pub fn stays_on(reader: &mut SentenceReader, clause: &mut Clause) -> bool {
    matches!(clause.predicate, Predicate::Visits | Predicate::Helps(..))
        && reader
            .attempt(|reader| {
                reader.eat("and");
                (reader.eat("stays|stay|staying|remains") && ["until", "till", "for"].contains(&reader.peek(0)))
                    .then_some(())
            })
            .is_some()
}

/// "goes to bed late, at about 1 am": the time says it.
pub fn says_late(reader: &mut SentenceReader, clause: &mut Clause) -> bool {
    // "After she reads" is at no time of its own, early or late.
    let is_time = |when: &Slot<HabitTime>| matches!(when.value, HabitTime::At(_) | HabitTime::Within(_));
    let has_time = |adverbs: &Adverbs| adverbs.when.as_ref().is_some_and(is_time) || adverbs.until_time.is_some();
    reader
        .attempt(|reader| {
            reader.eat("quite|very|rather|fairly");
            if !reader.eat("late|early") {
                return None;
            }
            let mut more = Adverbs::default();
            let comes = reader.ahead(|reader| {
                more.all(reader);
                has_time(&more)
            });
            (comes || has_time(&clause.adverbs)).then_some(())
        })
        .is_some()
}

/// "drinks eight cups of tea a day": so many times.
pub fn counts_cups(reader: &mut SentenceReader, clause: &mut Clause) -> bool {
    if !matches!(clause.predicate, Predicate::Does(Activity::Drink)) || clause.adverbs.times.is_some() {
        return false;
    }
    let from = reader.at;
    let times = reader.attempt(|reader| {
        let times = amount(reader).filter(|amount| amount.unit == AmountUnit::None)?.as_count()?;
        reader.eat("cups|glasses|mugs|pots|beakers|drinks").then_some(())?;
        if reader.eat("of") {
            reader.at += 1;
            let _ = reader.eat("and|or coffee|tea|water|juice|squash");
        }
        (reader.eat("a|per|each|every day") || reader.eat("daily")).then_some(times)
    });
    let Some(times) = times else { return false };
    clause.adverbs.times = Some(Slot { value: times, span: reader.span(from), own: true });
    true
}

/// "On her own" is how everything is done where nobody is named, so it changes nothing but what is denied.
///
/// How it is done, "quietly", "with her frame", is not lived either.
pub fn says_alone(reader: &mut SentenceReader, clause: &mut Clause) -> bool {
    let is_done =
        matches!(clause.predicate, Predicate::Does(_) | Predicate::Own(_)) && clause.subject == SentenceSubject::Person;
    is_done
        && (reader.eat("on her|his|their own")
            || reader.eat("by herself|himself|themselves")
            || reader.eat(
                "together|alone|independently|unaided|quietly|happily|safely|contentedly|herself|himself|too|indoors",
            )
            || reader.eat("straight|right away")
            || reader.attempt(with_aid).is_some()
            || clause.predicate != Predicate::Does(Activity::Leave) && reader.eat("at home")
            || reader.eat("for herself|himself|both")
            || reader.eat("without help|assistance"))
}

/// "with a stick", "using her frame".
fn with_aid(reader: &mut SentenceReader) -> Option<()> {
    reader.eat("with|using").then_some(())?;
    reader.eat("the help|aid of");
    reader.skip_determiners();
    let lexicon = reader.names.lexicon.clone();
    (0..=2).find_map(|_| {
        let length = lexicon.list("AIDS", |ahead| reader.peek(ahead));
        reader.at += length.unwrap_or(1);
        length.map(|_| ())
    })
}
