//! `docs/reference/activities.md` is what the tables of activities and roles say.
//!
//! `HOMEBODY_REWRITE=1 cargo test -p homebody-core --test activities` writes it anew.

#![allow(clippy::disallowed_methods, reason = "a test may read and write files; the core may not")]

#[path = "../../../tests/generated.rs"]
mod generated;

use generated::is_generated;
use homebody_core::activity::{ACTIVITIES, ActivityKind, KIND_WORDS, KnownActivity, TimeUse, turning};
use homebody_core::role::{ROLES, Role, RoleRow};
use homebody_core::scenario::path::Posture;

const HEAD: &str = "\
# Activities and roles

What the truth calls activities, and which furniture they use. This page is made from the tables in
`crates/homebody-core/src/activity.rs` and `crates/homebody-core/src/role.rs`.

## Activities

The column `name` of the truth's activities has one of these labels, or a name of the scenario's own. A label stays what it is: logs
have it. Its kind gives it its colour in pictures and on the page; the use of time is how hours of a day are added up. The usual
length is the median, in minutes, where a routine says nothing; what has none lasts as long as something else does.

";

const OWN: &str = "
What a routine or a path names itself, such as `knits`, is told by that name. Turning something on or off because of a rule is
";

const KINDS: &str = "
A name that is not in the table, such as `Personal_Hygiene` of a real log, is of the first kind that has a word with which one of the
name's words begins:

| kind | words |
|---|---|
";

const PIECES: &str = "
## Roles of furniture

An activity is done at the piece of furniture, or place, that fills a role. Which roles a piece fills, its name says: a `couch` is a
`sofa` and a `guest_seat`. Where it does not, or not the right one, `home.json` says the `role`; the piece then fills that one and
no other, whatever its name is:

```json
{ \"name\": \"table\", \"at\": [1, 2], \"size_m\": [2, 0.9], \"height_m\": 0.5, \"enterable\": true, \"role\": \"bed\" }
```

What is called after a resident, such as `Ruth's bed`, is theirs and nobody else's, also where it says its role. What is nobody's is
used by all who have none of their own. Of several, what says the role comes before what is only called so, and of names the first
in the table comes first. What nobody can get to is passed over. Where nothing fills a role, what fills one of those under
*instead* will do.

| `role` | what it is for | names that imply it | instead | in it, if it is enterable, one |
|---|---|---|---|---|
";

const TAIL: &str = "
A piece with a role in which one lies has to be enterable. A dash: as its name says. Who uses what is not enterable stands beside it.
";

/// In backquotes, with commas between.
fn list<T: AsRef<str>>(words: impl IntoIterator<Item = T>) -> String {
    words.into_iter().map(|word| format!("`{}`", word.as_ref())).collect::<Vec<_>>().join(", ")
}

/// What a role is called; the way out by its best name.
fn called(role: Role) -> String {
    role.key().unwrap_or_else(|| role.row().names[0].to_owned())
}

fn activity(known: &KnownActivity) -> String {
    let KnownActivity { label, about, kind, time_use, usual, roles } = known;
    let usual = usual.map_or(String::new(), |usual| usual.median_min.to_string());
    let roles = list(roles.iter().map(|&role| called(role)));
    format!("| `{label}` | {about} | {} | {} | {usual} | {roles} |\n", kind.in_words(), time_use.in_words())
}

fn role(row: &RoleRow) -> String {
    let key = row.role.key().map_or("none".to_owned(), |key| format!("`{key}`"));
    let instead = list(row.instead.iter().map(|&role| called(role)));
    let posture = row.posture.map_or("-".to_owned(), |posture| match posture {
        Posture::Standing => "stands".to_owned(),
        Posture::Sitting => "sits".to_owned(),
        Posture::Lying => "lies".to_owned(),
        other => unreachable!("no furniture is for {}", other.name()),
    });
    format!("| {key} | {} | {} | {instead} | {posture} |\n", row.about, list(row.names))
}

/// The whole page.
fn document() -> String {
    let mut text = HEAD.to_owned();
    text += "| label | what is done | kind | use of time | usual length | roles |\n|---|---|---|---|---|---|\n";
    text.extend(ACTIVITIES.iter().map(activity));
    text += OWN;
    text += &format!("`{}` or `{}`, with the name of the thing.\n", turning("stove", true), turning("stove", false));
    text += &format!(
        "\nThe kinds are: {}.\n\nThe uses of time are: {}.\n",
        ActivityKind::ALL.map(ActivityKind::in_words).join("; "),
        TimeUse::ALL.map(TimeUse::in_words).join("; ")
    );
    text += KINDS;
    text.extend(KIND_WORDS.iter().map(|(kind, words)| format!("| {} | {} |\n", kind.in_words(), list(*words))));
    text += PIECES;
    text.extend(ROLES.iter().map(role));
    text + TAIL
}

#[test]
fn the_document_is_what_the_tables_say() {
    is_generated("docs/reference/activities.md", &document());
}

/// What no activity goes to: the way to a seat on which nothing else is done, and what only pets and the page need.
#[test]
fn every_role_is_used_by_an_activity_or_has_a_reason() {
    let used = |role: &Role| ACTIVITIES.iter().any(|known| known.roles.contains(role));
    let unused: Vec<Role> = ROLES.iter().map(|row| row.role).filter(|role| !used(role)).collect();
    // The sofa fills in for other seats, the television is turned on from one, books are taken from nowhere, pets sleep.
    assert_eq!(unused, [Role::Sofa, Role::Television, Role::Bookcase, Role::Basket]);
}
