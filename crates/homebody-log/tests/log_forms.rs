//! The table of forms in `docs/reference/logs.md` agrees with that of the code.
//!
//! `HOMEBODY_REWRITE=1 cargo test -p homebody-log --test all log_forms::` writes it again. The forms themselves are tested in
//! `crates/homebody-log/tests/recorded.rs`.

use crate::generated::is_generated_between;
use homebody_log::registry::FORMS;

#[test]
fn the_page_of_forms_is_that_of_the_table() {
    let row = |name: &str, what: &str| format!("| `{name}` | {} |\n", what.replace('|', "\\|"));
    let rows: String = FORMS.iter().map(|form| row(form.name, form.what)).collect();
    let begin = "<!-- made from the table of forms -->";
    is_generated_between("docs/reference/logs.md", begin, &format!("| form | description |\n|---|---|\n{rows}"));
}
