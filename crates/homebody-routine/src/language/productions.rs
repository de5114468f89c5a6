//! The productions: how the value of a phrase is made from those of its parts. The grammar names them.

pub mod arguments;
mod clauses;
mod days;
mod frequency;
mod measures;
mod numbers;
mod rules;
mod times;
mod verbs;

use arguments::Production;

pub use clauses::unsaid_chance;
pub use verbs::act_of;

pub fn named(name: &str) -> Option<Production> {
    let tables: [fn(&str) -> Option<Production>; 8] = [
        numbers::named,
        times::named,
        days::named,
        frequency::named,
        measures::named,
        verbs::named,
        clauses::named,
        rules::named,
    ];
    tables.iter().find_map(|table| table(name))
}
