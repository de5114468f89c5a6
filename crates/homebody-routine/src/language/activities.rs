//! What can be done, in all the ways of saying it that are understood.

use super::reader::{Reader, is_beginning, is_determiner};
use super::words::Token;
use crate::routine::{Activity, Meal};
use std::sync::LazyLock;

/// Ways of saying an activity, the usual one first.
///
/// `~` marks a verb, which may stand in any form; `[x]` may be missing; `a|b` is either; up to three other words may
/// stand before `*x`; `SELF` is herself, himself or themselves; `WHOM` is somebody, `HOST` somebody elsewhere; words such as "the" and "her" may stand anywhere.
static PHRASES: [(Activity, &[&str]); 32] = [
    (Activity::GetUp, &["~get up", "~wake [up]", "~rise", "~get out of bed"]),
    (Activity::UseBathroom, &["~go to bathroom|toilet|loo|restroom", "~use|visit bathroom|toilet|loo|restroom"]),
    (Activity::Shower, &["~take shower|bath", "~have shower|bath", "~shower", "~bathe"]),
    (
        Activity::Wash,
        &[
            "~wash [SELF]",
            "~wash face|hands|hair [and] [face|hands|hair]",
            "~brush|clean teeth",
            "~freshen up",
            "~have wash",
        ],
    ),
    (Activity::Dress, &["~get dressed", "~dress [SELF]", "~put clothes on", "~put on clothes"]),
    (
        Activity::TakeMedicine,
        &["~take *medicine|medicines|medication|medications|pills|pill|tablets|tablet", "~have medicine|medication"],
    ),
    (
        Activity::Prepare(Meal::Breakfast),
        &["~prepare|make|cook|fix breakfast", "~prepare|make|cook|fix *for breakfast"],
    ),
    (Activity::Prepare(Meal::Lunch), &["~prepare|make|cook|fix lunch", "~prepare|make|cook|fix *for lunch"]),
    (
        Activity::Prepare(Meal::Dinner),
        &["~prepare|make|cook|fix dinner|supper", "~prepare|make|cook|fix *for dinner|supper"],
    ),
    (Activity::Eat(Meal::Breakfast), &["~eat|have breakfast", "~eat|have *for breakfast"]),
    (Activity::Eat(Meal::Lunch), &["~eat|have lunch", "~eat|have *for lunch"]),
    (Activity::Eat(Meal::Dinner), &["~eat|have dinner|supper", "~eat|have *for dinner|supper"]),
    (Activity::WashUp, &["~wash up", "~do|wash|clean dishes", "~do washing up"]),
    (
        Activity::WatchTelevision,
        &[
            "~watch television|tv|telly",
            "~watch *news|film|movie|programme|programmes|program|programs|show|shows|series [on] [television|tv|telly]",
        ],
    ),
    (Activity::Read, &["~read [newspaper|newspapers|paper|book|books|magazine|magazines|bible|letters|novel]"]),
    (
        Activity::Phone,
        &[
            "~talk|speak|chat on phone|telephone [with|to] [WHOM]",
            "~phone|telephone|ring|call [WHOM]",
            "~phone|telephone|ring|call WHOM on phone|telephone",
            "~make phone|telephone call",
            "~talk|speak|chat to|with WHOM on phone|telephone",
        ],
    ),
    (Activity::Nap, &["~nap", "~take|have nap|siesta", "~doze [off]"]),
    (Activity::Laundry, &["~do laundry|washing", "~wash clothes|laundry"]),
    (
        Activity::Housework,
        &[
            "~do housework|cleaning|chores|vacuuming|dusting|hoovering",
            "~clean|tidy [up] [apartment|house|home|flat]",
            "~vacuum|hoover|dust|sweep [floor]",
        ],
    ),
    (
        Activity::Leave,
        &[
            "~leave apartment|flat|home|house|building",
            "~go out [shopping|walking]",
            "~go out for walk|meal|lunch|dinner|drive",
            "~go shopping|outside|swimming|walking",
            "~go for *walk|stroll|drive|ride",
            "~go to shops|shop|store|supermarket|market|church|doctor|park|library|club|work|town",
            "~take|have *walk",
            "~visit HOST",
            "~stay with|at HOST",
            "~go to|into hospital",
        ],
    ),
    (Activity::ComeHome, &["~come home|back [home]", "~return [home]", "~get home|back"]),
    (Activity::GoToBed, &["~go to bed|sleep", "~get into bed", "~turn in", "~retire"]),
    (
        Activity::Drink,
        &[
            "~have|take drink",
            "~have|drink|make [cup|glass|mug] [of] tea|coffee|water|juice|milk|cocoa|wine|beer",
            "~drink [something]",
        ],
    ),
    (Activity::Snack, &["~have|eat snack|fruit|biscuit|cake", "~snack", "~eat something"]),
    (Activity::Exercise, &["~exercise", "~do exercises|exercise|gymnastics|yoga"]),
    (Activity::UseComputer, &["~use computer|laptop|internet", "~sit|work at|on computer|laptop"]),
    (Activity::Relax, &["~relax", "~rest", "~sit [down] [quietly|still]", "~do nothing"]),
    (
        Activity::Wander,
        &["~wander|roam [around|about] [apartment|house|flat|home]", "~walk around|about [apartment|house|flat|home]"],
    ),
    (
        Activity::Pace,
        &["~pace [up|to|back] [and] [down|fro|forth]", "~walk up and down", "~walk to and fro", "~walk back and forth"],
    ),
    (Activity::Lap, &["~walk in circles", "~walk|do laps", "~circle", "~walk round and round"]),
    (Activity::LieAwake, &["~lie awake [in] [bed]"]),
    (Activity::Fall, &["~fall [down|over]", "~have fall"]),
];

/// What may be meant by a noun alone, after "after", "before" or "with".
const EVENTS: [(&str, Activity); 17] = [
    ("breakfast", Activity::Eat(Meal::Breakfast)),
    ("lunch", Activity::Eat(Meal::Lunch)),
    ("dinner|supper", Activity::Eat(Meal::Dinner)),
    ("bed|bedtime", Activity::GoToBed),
    ("shower|bath", Activity::Shower),
    ("nap|siesta", Activity::Nap),
    ("medicine|medication|pills|tablets", Activity::TakeMedicine),
    ("laundry", Activity::Laundry),
    ("housework|cleaning", Activity::Housework),
    ("dishes", Activity::WashUp),
    ("washing up", Activity::WashUp),
    ("walk|outing|shopping", Activity::Leave),
    ("television|tv", Activity::WatchTelevision),
    ("exercises", Activity::Exercise),
    ("visit", Activity::Visit),
    ("coffee|tea", Activity::Drink),
    ("snack", Activity::Snack),
];

/// Meals by name.
pub const MEALS: [(&str, Meal); 3] =
    [("breakfast", Meal::Breakfast), ("lunch", Meal::Lunch), ("dinner|supper", Meal::Dinner)];

/// An activity, if one comes next: the longest that fits.
pub fn activity(reader: &mut Reader) -> Option<Activity> {
    let all = PHRASES.iter().flat_map(|(activity, ways)| ways.iter().map(move |way| (activity, way)));
    let fits = all.filter_map(|(activity, way)| fits(reader, way).map(|end| (end, activity)));
    let (end, activity) = fits.max_by_key(|(end, _)| *end)?;
    let activity = activity.clone();
    reader.at = end;
    Some(activity)
}

/// What something comes before or after: a noun, or a sentence in small.
pub fn event(reader: &mut Reader) -> Option<Activity> {
    reader.attempt(|reader| {
        let back = reader.at;
        reader.skip_determiners();
        if let Some((_, event)) = EVENTS.iter().find(|(noun, _)| reader.eat(noun)) {
            return Some(event.clone());
        }
        reader.at = back;
        if reader.eat("she|he|they|it") || reader.eat("the person|resident") || reader.person() == Some(false) {
            reader.eat("has|have");
        }
        activity(reader)
    })
}

/// Where a way of saying something ends if it comes next.
fn fits(reader: &Reader, way: &str) -> Option<usize> {
    let mut at = 0;
    for wanted in way.split(' ') {
        let optional = wanted.starts_with('[');
        let wanted = wanted.trim_matches(['[', ']']);
        let mut ahead = at;
        while ahead > 0 && is_determiner(reader.peek(ahead)) {
            ahead += 1;
        }
        let wanted = match wanted.strip_prefix('*') {
            Some(noun) => {
                ahead += adjectives(reader, ahead, noun);
                noun
            }
            None => wanted,
        };
        let word = reader.peek(ahead);
        let found = match wanted {
            "SELF" => ["herself", "himself", "themselves", "themself", "itself"].contains(&word),
            // Somebody has to be named with a word such as "her" or "a" before it.
            "WHOM" => ahead > at && !word.is_empty(),
            "HOST" => ahead > at && !word.is_empty() && !is_here(reader, word),
            _ => match wanted.strip_prefix('~') {
                Some(verbs) => verbs.split('|').any(|verb| is_form(verb, word)),
                None => wanted.split('|').any(|wanted| wanted == word),
            },
        };
        match (found, optional) {
            (true, _) => at = ahead + 1,
            (false, true) => {}
            (false, false) => return None,
        }
    }
    Some(reader.at + at)
}

/// Whether something at home begins with this word.
fn is_here(reader: &Reader, word: &str) -> bool {
    reader.names.has_first(word) || ["bathroom", "toilet", "loo", "restroom"].contains(&word)
}

/// How many words stand before one of these nouns: none if it does not come soon.
fn adjectives(reader: &Reader, from: usize, nouns: &str) -> usize {
    const MOST: usize = 3;
    let is_noun = |ahead: usize| nouns.split('|').any(|noun| noun == reader.peek(from + ahead));
    let is_word = |ahead: usize| {
        let word = reader.peek(from + ahead);
        reader.token(from + ahead) == Some(Token::Word) && !is_determiner(word) && !is_beginning(word)
    };
    (0..=MOST).take_while(|ahead| (0..*ahead).all(is_word)).find(|ahead| is_noun(*ahead)).unwrap_or(0)
}

/// Whether a word is a form of this verb: "get", "gets", "getting".
pub fn is_form(verb: &str, word: &str) -> bool {
    // All forms of a verb here begin with the same letter, which spares making them.
    let may_be = word.as_bytes().first() == verb.as_bytes().first();
    may_be && (word == verb || word == third_person(verb) || word == gerund(verb) || word == participle(verb))
}

/// "watches" of "watch".
pub fn third_person(verb: &str) -> String {
    let consonant_y = verb.strip_suffix('y').filter(|stem| !stem.ends_with(['a', 'e', 'o', 'u']));
    match verb {
        "have" => "has".into(),
        _ if consonant_y.is_some() => format!("{}ies", consonant_y.unwrap_or_default()),
        _ if ["s", "sh", "ch", "x", "o"].iter().any(|end| verb.ends_with(end)) => format!("{verb}es"),
        _ => format!("{verb}s"),
    }
}

/// "goes to the bathroom" of "go to the bathroom".
pub fn in_third_person(doing: &str) -> String {
    match doing.split_once(' ') {
        Some((verb, rest)) => format!("{} {rest}", third_person(verb)),
        None => third_person(doing),
    }
}

fn gerund(verb: &str) -> String {
    match verb {
        "get" | "nap" | "sit" | "chat" | "put" => format!("{verb}{}ing", &verb[verb.len() - 1..]),
        "lie" => "lying".into(),
        _ => match verb.strip_suffix('e') {
            Some(stem) if !stem.ends_with(['e', 'i', 'o']) => format!("{stem}ing"),
            _ => format!("{verb}ing"),
        },
    }
}

/// What stands after "has": "got", "eaten".
fn participle(verb: &str) -> String {
    let irregular = [
        ("get", "got"),
        ("wake", "woken"),
        ("rise", "risen"),
        ("take", "taken"),
        ("have", "had"),
        ("make", "made"),
        ("eat", "eaten"),
        ("do", "done"),
        ("go", "gone"),
        ("leave", "left"),
        ("come", "come"),
        ("drink", "drunk"),
        ("read", "read"),
        ("sit", "sat"),
        ("fall", "fallen"),
        ("put", "put"),
    ];
    let found = irregular.iter().find(|(base, _)| *base == verb).map(|(_, form)| (*form).to_owned());
    found.unwrap_or_else(|| if verb.ends_with('e') { format!("{verb}d") } else { format!("{verb}ed") })
}

/// The usual way of saying an activity: "watches television".
pub fn phrase(activity: &Activity) -> String {
    match activity {
        Activity::Other(words) => words.clone(),
        Activity::Visit => "visits".into(),
        Activity::UseBathroom => "goes to the bathroom".into(),
        Activity::Leave => "leaves the apartment".into(),
        Activity::TakeMedicine => "takes medicine".into(),
        Activity::Shower => "takes a shower".into(),
        Activity::Phone => "talks on the phone".into(),
        Activity::Drink => "has a drink".into(),
        Activity::Snack => "has a snack".into(),
        known => PHRASES
            .iter()
            .find(|(activity, _)| activity == known)
            .map_or_else(String::new, |(_, ways)| spoken(ways.first().copied().unwrap_or_default())),
    }
}

/// The usual way of saying each activity that has one.
pub fn usual_phrases() -> impl Iterator<Item = String> {
    PHRASES.iter().map(|(activity, _)| phrase(activity))
}

/// All phrases that are understood, each with its verb in the third person, for hints.
pub fn all_phrases() -> &'static [String] {
    static ALL: LazyLock<Vec<String>> = LazyLock::new(spell_out);
    &ALL
}

fn spell_out() -> Vec<String> {
    let mut all = Vec::new();
    let ways = PHRASES.iter().flat_map(|(_, ways)| ways.iter());
    // What is eaten "for breakfast" only its eater can name.
    for way in ways.filter(|way| !way.contains("*for")) {
        let mut said = vec![String::new()];
        for wanted in way.split(' ').filter(|wanted| !wanted.starts_with('[') && !["WHOM", "HOST"].contains(wanted)) {
            let wanted = wanted.trim_start_matches('*');
            let forms: Vec<String> = match wanted.strip_prefix('~') {
                Some(verbs) => verbs.split('|').map(third_person).collect(),
                None => wanted.split('|').map(str::to_owned).collect(),
            };
            let longer =
                |said: &String| forms.iter().map(|form| format!("{said} {form}").trim().to_owned()).collect::<Vec<_>>();
            said = said.iter().flat_map(longer).collect();
        }
        all.extend(said);
    }
    all
}

fn spoken(way: &str) -> String {
    let words = way.split(' ').filter(|word| !word.starts_with('[')).map(|word| {
        let first = word.trim_start_matches('*').split('|').next().unwrap_or_default();
        first.strip_prefix('~').map_or(first.to_owned(), third_person)
    });
    words.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verbs_are_known_in_their_forms() {
        for (verb, forms) in [
            ("get", "gets getting got"),
            ("watch", "watches watching watched"),
            ("tidy", "tidies tidying"),
            ("take", "takes taking taken"),
            ("go", "goes going gone"),
            ("lie", "lies lying"),
        ] {
            assert!(forms.split(' ').all(|form| is_form(verb, form)), "{verb}");
        }
        assert!(!is_form("wash", "was"));
    }

    #[test]
    fn what_can_be_said_is_in_the_table_of_activities_and_all_else_there_has_a_reason() {
        use homebody_core::activity::{ACTIVITIES, LEAVING_HOME, RESTING, ROAMING, SLEEPING, VISITING};
        let said = PHRASES.iter().map(|(activity, _)| activity).chain([&Activity::Visit]);
        let mut labels: Vec<&str> = said.map(Activity::label).collect();
        // The night, parts of outings and visits, and pets.
        labels.extend([SLEEPING, LEAVING_HOME, VISITING, RESTING, ROAMING]);
        labels.sort();
        let mut known: Vec<&str> = ACTIVITIES.iter().map(|known| known.label).collect();
        known.sort();
        assert_eq!(labels, known);
        for (activity, _) in &PHRASES {
            assert!(homebody_core::activity::known(activity.label()).unwrap().usual.is_some(), "{activity:?}");
        }
    }

    #[test]
    fn phrases_are_spoken_in_the_third_person() {
        assert_eq!(phrase(&Activity::WatchTelevision), "watches television");
        assert_eq!(phrase(&Activity::Eat(Meal::Dinner)), "eats dinner");
        assert!(all_phrases().contains(&"takes bath".to_owned()));
    }
}
