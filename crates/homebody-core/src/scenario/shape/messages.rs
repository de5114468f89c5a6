//! Messages for files that do not have the form that their schema asks for.

use crate::nearest::quoted;
use crate::problem::Advice;

crate::messages! {
    /// Differences between a file and its JSON Schema.
    pub enum SchemaMessage in "schema" {
        /// Homebody computes with numbers up to about 1.8e308. A larger number in a file is a mistake.
        NumberTooLarge { subject: String } error "number-too-large" ("{subject} is too large a number")
            hint ("write a smaller number");
        /// The value counts something, so it has no fraction.
        NotWhole {
            subject: String,
            /// The number, as the file has it.
            written: String,
        } error "not-whole" ("{subject} must be a whole number, but is {written}")
            hint ("remove the fraction");
        /// Each number of a scenario has a smallest and a largest value. `homebody schema` prints them, and editors show them.
        OutOfRange {
            subject: String,
            bounds: String,
            /// The number, as the file has it.
            written: String,
        } error "out-of-range" ("{subject} must be {bounds}, but is {written}");
        /// The key takes some names only, and this is not one of them. Upper and lower case count.
        UnknownName {
            subject: String,
            /// The name, as the file has it.
            name: String,
            nearest: Option<String>,
            known: Vec<String>,
        } error "unknown-name" ("{subject} cannot be {name:?}")
            advice (Some(choice(nearest, known)));
        /// The key needs a text of at least one character.
        EmptyText { subject: String } error "empty-text" ("{subject} must not be empty")
            hint ("write a text");
        /// Texts have a largest length, so that tables and pictures have room for them.
        LongText { subject: String, most_characters: u64 }
            error "long-text" ("{subject} must have at most {most_characters} characters")
            hint ("shorten it");
        /// The list is too short or too long. A number that is written with a comma counts as two items: write `0.5`, not `0,5`.
        WrongCount {
            subject: String,
            /// The number of items that it needs, in words.
            wanted: String,
            /// The number of items that it has.
            count: u64,
            /// The correction, or the meaning of the key.
            help: Option<String>,
        } error "wrong-count" ("{subject} must have {wanted}, but has {count}")
            advice (help.clone());
        /// The object has more entries than Homebody reads.
        TooManyKeys { subject: String, most: u64, count: usize }
            error "too-many-keys" ("{subject} must have at most {most} keys, but has {count}")
            hint ("remove some of them");
        /// JSON readers disagree on the meaning of an object that has the same key twice, so Homebody refuses it.
        DuplicateKey { key: String, first_line: usize } error "duplicate-key" ("{key:?} is given twice")
            hint ("remove one of them; the first is on line {first_line}");
        /// The object does not have such a key. Homebody refuses unknown keys, because a misspelt key would otherwise have no effect.
        UnknownKey {
            key: String,
            /// The kind of object, with its article.
            object: String,
            nearest: Option<String>,
            known: Vec<String>,
        } error "unknown-key" ("{key:?} is not a key of {object}")
            advice (Some(match nearest {
                Some(near) => Advice::meant(near),
                None => format!("its keys are {}", quoted(known)).into(),
            }));
        /// The object cannot be used without this key.
        MissingKey {
            key: String,
            /// The kind of object, with its article.
            object: String,
            /// The meaning of the key, from the schema.
            meaning: Option<String>,
            /// The values that the key can have, where it is one of several names.
            known: Vec<String>,
        } error "missing-key" ("{object} needs the key {key:?}")
            advice (if known.is_empty() { meaning.clone().map(Advice::from) } else { Some(choice(&None, known)) });
        /// This choice has values of its own, so its name alone says too little. Write an object with the name as its key:
        ///
        /// ```json
        /// { "level": { "zones": {} } }
        /// ```
        NameAlone { name: String }
            error "name-alone" ("the name {name:?} alone is not enough: it needs values of its own")
            hint ("write an object with the key {name:?}, and the values in it: {{ {name:?}: {{ .. }} }}");
        /// The object is a choice between several kinds. Its only key names the kind.
        KeyCount {
            /// The kind of object, with its article.
            object: String,
            /// The number of keys that it has.
            count: usize,
            known: Vec<String>,
        } error "one-key" ("{object} must have exactly one key, but has {count}")
            advice (Some(choice(&None, known)));
        /// The name is not one of the known kinds.
        UnknownKind { name: String, object: String, nearest: Option<String>, known: Vec<String> }
            error "unknown-kind" ("{name:?} is not a kind of {object}")
            advice (Some(choice(nearest, known)));
        /// The value has another JSON type than the key takes: a text in quotes, a number, `true` or `false`, a list or an object.
        WrongType {
            subject: String,
            wanted: String,
            found: String,
            /// The correction, or the meaning of the key.
            help: Option<String>,
        } error "wrong-type" ("{subject} must be {wanted}, but is {found}")
            advice (help.clone());
        /// Homebody stops after very many problems in a file. Most of them often have the same cause.
        TooMany { most: usize }
            error "too-many-problems" ("the file has more than {most} problems, and these are the first")
            hint ("solve these, and check again");
        /// The file has the form that its schema asks for, and its values do not fit together.
        Invalid { why: String } error "invalid" ("cannot read the file: {why}");
    }
}

/// The hint for a value that is one of several names.
pub(super) fn choice(nearest: &Option<String>, known: &[String]) -> Advice {
    match nearest {
        Some(near) => Advice::meant(near),
        None => format!("choose one of {}", quoted(known)).into(),
    }
}
