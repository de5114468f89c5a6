//! `docs/reference/activities.md` agrees with the tables of activities and roles.
//!
//! `HOMEBODY_REWRITE=1 cargo test -p homebody-core --test all activities::` writes it anew.

use crate::generated::is_generated;
use homebody_core::activity::{ACTIVITIES, ActivityKind, KIND_WORDS, KnownActivity, TimeUse, turning};
use homebody_core::posture::Posture;
use homebody_core::role::{ROLES, Role, RoleRow};

const HEAD: &str = "\
# Activities and roles

This page lists the labels of activities in the truth, and the roles of the furniture that activities use.

It is made from the tables in `crates/homebody-core/src/activity.rs` and `crates/homebody-core/src/role.rs`.

## Activities

The column `name` of the truth's table `activity` has one of these labels, or a name that the scenario gives. Labels do not change,
because logs contain them.

- The *kind* sets the colour in pictures and on the page.
- The *use of time* is the category of the activity in the sum of a day's hours.
- The *usual length* is the median in minutes, for a routine that gives no length. An activity without one takes its length from
  something else, such as the next activity.

";

const OWN: &str = "
An activity that a routine or a path names, such as `knits`, has that name as its label. A use of a thing by a rule has a label such as
";

const KINDS: &str = "
A name outside the table, such as `Personal_Hygiene` in a real log, is of the first kind below with a matching word. A word matches if
a word of the name begins with it.

| kind | words |
|---|---|
";

const PIECES: &str = "
## Roles of furniture

An activity takes place at the piece of furniture, or the place, that has a certain role. The name of a piece gives it its roles: a
`couch` is a `sofa` and a `guest_seat`. To give a piece another role, set `role` in `home.json`. The piece then has that role only,
whatever its name:

```json
{ \"name\": \"table\", \"at\": [1, 2], \"size_m\": [2, 0.9], \"height_m\": 0.5, \"enterable\": true, \"role\": \"bed\" }
```

- A piece named after a resident, such as `Ruth's bed`, belongs to that resident alone, even if it has a `role`. All residents without
  a piece of their own share the others.
- Of several pieces, one with a `role` comes before one that has the role by its name. Among names, the order of the table holds.
- A piece that no resident can reach is not used.
- If no piece has the role, a piece with a role in the column *instead* is used.

| `role` | purpose | names that imply it | instead | posture in an enterable piece |
|---|---|---|---|---|
";

const TAIL: &str = "
A piece with a role that residents lie in has to be enterable. A dash stands for the posture that the piece's name implies. A resident
stands next to a piece that is not enterable.
";

/// In backquotes, with commas between.
fn list<T: AsRef<str>>(words: impl IntoIterator<Item = T>) -> String {
    words.into_iter().map(|word| format!("`{}`", word.as_ref())).collect::<Vec<_>>().join(", ")
}

/// The name of a role; for the way out, its best name.
fn called(role: Role) -> String {
    role.key().unwrap_or_else(|| role.row().names[0].to_owned())
}

fn activity(known: &KnownActivity) -> String {
    let KnownActivity { label, about, kind, time_use, usual, roles, .. } = known;
    let usual = usual.map_or(String::new(), |usual| usual.median_min.to_string());
    let roles = list(roles.iter().map(|&role| called(role)));
    format!("| `{label}` | {about} | {} | {} | {usual} | {roles} |\n", kind.in_words(), time_use.in_words())
}

fn role(row: &RoleRow) -> String {
    let key = row.role.key().map_or("none".to_owned(), |key| format!("`{key}`"));
    let instead = list(row.instead.iter().map(|&role| called(role)));
    let posture = row.posture.map_or("-".to_owned(), |posture| match posture {
        Posture::Standing => "standing".to_owned(),
        Posture::Sitting => "sitting".to_owned(),
        Posture::Lying => "lying".to_owned(),
        other => unreachable!("no furniture is for {}", other.name()),
    });
    format!("| {key} | {} | {} | {instead} | {posture} |\n", row.about, list(row.names))
}

/// The whole page.
fn document() -> String {
    let mut text = HEAD.to_owned();
    text += "| label | activity | kind | use of time | usual length | roles |\n|---|---|---|---|---|---|\n";
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

/// Roles without an activity: the way to a seat without another activity, and roles for pets and the page.
#[test]
fn every_role_is_used_by_an_activity_or_has_a_reason() {
    let used = |role: &Role| ACTIVITIES.iter().any(|known| known.roles.contains(role));
    let unused: Vec<Role> = ROLES.iter().map(|row| row.role).filter(|role| !used(role)).collect();
    // The sofa fills in for other seats, the television is turned on from one, books are taken from nowhere, pets sleep.
    assert_eq!(unused, [Role::Sofa, Role::Television, Role::Bookcase, Role::Basket]);
}
