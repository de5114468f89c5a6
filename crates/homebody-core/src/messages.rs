//! The messages of the program, each with a stable code: declared in one place per area by [`crate::messages!`], listed by `homebody explain`,
//! and written into one snapshot for readers.

use crate::geometry::Point;
use crate::problem::Advice;
pub use crate::problem::{Diagnose, Severity};
use crate::time::{RunTime, Span, UtcTime, WallTime};
pub use serde_json::Value;
use std::path::{Path, PathBuf};

/// One declared message, for lists of all messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CatalogueEntry {
    /// The stable code, such as `log::exists`.
    pub code: &'static str,
    /// The severity.
    pub severity: Severity,
    /// The text, with names in braces for the data.
    pub text: &'static str,
    /// The hint, with names in braces for the data.
    pub hint: Option<&'static str>,
    /// The long explanation, as it stands above the declaration.
    pub about: &'static str,
    /// The names of the data.
    pub data: &'static [&'static str],
}

/// All messages that an area declares.
pub trait Catalogue {
    /// The entries, in the order of the declaration.
    const ENTRIES: &'static [CatalogueEntry];
}

/// A value that a message carries for programs.
pub trait Datum {
    /// The value as JSON.
    fn datum(&self) -> Value;
}

macro_rules! data_as_json {
    ($($type:ty),*) => { $(impl Datum for $type {
        fn datum(&self) -> Value {
            Value::from(self.clone())
        }
    })* };
}

data_as_json!(String, bool, u8, u16, u32, u64, usize, i64, f64);

macro_rules! micros_as_json {
    ($($type:ty),*) => { $(impl Datum for $type {
        fn datum(&self) -> Value {
            Value::from(self.micros())
        }
    })* };
}

micros_as_json!(Span, RunTime, UtcTime, WallTime);

impl Datum for &str {
    fn datum(&self) -> Value {
        Value::from(*self)
    }
}

impl Datum for Point {
    fn datum(&self) -> Value {
        Value::from(vec![self.x, self.y])
    }
}

impl Datum for PathBuf {
    fn datum(&self) -> Value {
        self.as_path().datum()
    }
}

impl Datum for Path {
    fn datum(&self) -> Value {
        Value::from(self.display().to_string())
    }
}

impl Datum for jiff::civil::Date {
    fn datum(&self) -> Value {
        Value::from(self.to_string())
    }
}

impl Datum for std::io::Error {
    fn datum(&self) -> Value {
        Value::from(self.to_string())
    }
}

impl Datum for serde_json::Error {
    fn datum(&self) -> Value {
        Value::from(self.to_string())
    }
}

impl Datum for Advice {
    fn datum(&self) -> Value {
        Value::from(self.text.clone())
    }
}

impl<T: Datum> Datum for Vec<T> {
    fn datum(&self) -> Value {
        Value::Array(self.iter().map(Datum::datum).collect())
    }
}

impl<T: Datum + ?Sized> Datum for Box<T> {
    fn datum(&self) -> Value {
        self.as_ref().datum()
    }
}

impl Datum for dyn std::error::Error + Send + Sync {
    fn datum(&self) -> Value {
        Value::from(self.to_string())
    }
}

impl<T: Datum> Datum for Option<T> {
    fn datum(&self) -> Value {
        self.as_ref().map_or(Value::Null, Datum::datum)
    }
}

/// Declares the messages of an area as an enum: for each variant its data, severity, code, text and hint. The comment above a variant is
/// the explanation that `homebody explain` prints.
///
/// ```
/// homebody_core::messages! {
///     /// Problems with doors.
///     pub enum DoorMessage in "door" {
///         /// A door must be in a wall. Move it to one, or draw the wall first.
///         OffWall { door: String, distance_m: f64 }
///             error "off-wall" ("the door {door:?} is {distance_m:.2} m from the nearest wall")
///             hint ("move it into a wall");
///     }
/// }
/// use homebody_core::messages::{Catalogue, Diagnose};
///
/// let message = DoorMessage::OffWall { door: "front door".into(), distance_m: 0.4 };
/// assert_eq!(message.diagnostic().code, "door::off-wall");
/// assert_eq!(message.diagnostic().data["distance_m"], 0.4);
/// assert_eq!(message.to_string(), "the door \"front door\" is 0.40 m from the nearest wall\n  hint: move it into a wall");
/// assert_eq!(DoorMessage::ENTRIES[0].hint, Some("move it into a wall"));
/// ```
///
/// A hint that depends on the data is `advice (EXPRESSION)`, an `Option` of a text or of an [`Advice`](crate::problem::Advice), which has a
/// text and a fix. `fix (EXPRESSION)` after a hint is its fix, an `Option<Box<Fix>>`. The last clause is `cause (EXPRESSION)`, an `Option`
/// of the error that caused this one. A part `=> inner { Variant(Type); }` at the end holds errors of other areas unchanged.
#[macro_export]
macro_rules! messages {
    (
        $(#[$outer:meta])*
        $vis:vis enum $name:ident in $prefix:literal {
            $(
                $(#[doc = $doc:literal])*
                $variant:ident $(($only:ident: $only_type:ty))? $({ $($(#[doc = $field_doc:literal])* $field:ident: $type:ty),* $(,)? })?
                    $severity:ident $code:literal ($text:literal $($text_args:tt)*)
                    $(hint ($hint:literal $($hint_args:tt)*))?
                    $(advice ($advice:expr))?
                    $(fix ($fix:expr))?
                    $(cause ($cause:expr))?;
            )*
            $(=> inner { $($(#[doc = $inner_doc:literal])* $inner:ident($inner_type:ty);)* })?
        }
    ) => {
        $(#[$outer])*
        #[derive(Debug)]
        $vis enum $name {
            $(
                $(#[doc = $doc])*
                #[allow(missing_docs, reason = "the text of the message says what its data are")]
                $variant $(($only_type))? $({ $($(#[doc = $field_doc])* $field: $type),* })?,
            )*
            $($($(#[doc = $inner_doc])* $inner($inner_type),)*)?
        }

        impl $crate::messages::Catalogue for $name {
            const ENTRIES: &'static [$crate::messages::CatalogueEntry] = &[$(
                $crate::messages::CatalogueEntry {
                    code: concat!($prefix, "::", $code),
                    severity: $crate::messages!(@severity $severity),
                    text: $text,
                    hint: $crate::messages!(@hint $($hint)? $(advice $advice)?),
                    about: concat!($($doc, "\n"),*),
                    data: &[$(stringify!($only))? $($(stringify!($field)),*)?],
                },
            )*];
        }

        impl $crate::messages::Diagnose for $name {
            #[allow(unused_mut, unused_assignments, unused_variables)]
            fn diagnostic(&self) -> $crate::problem::Diagnostic {
                match self {
                    $(
                        Self::$variant $(($only))? $({ $($field),* })? => {
                            let mut advice: Option<$crate::problem::Advice> = None;
                            $(advice = Some($crate::problem::Advice::from(format!($hint $($hint_args)*)));)?
                            $(advice = $crate::problem::Advice::from_option($advice);)?
                            $(advice = advice.map(|advice| advice.with_fix($fix));)?
                            $crate::problem::Diagnostic::new(
                                concat!($prefix, "::", $code),
                                $crate::messages!(@severity $severity),
                                format!($text $($text_args)*),
                                advice,
                                vec![
                                    $((stringify!($only), $crate::messages::Datum::datum($only)))?
                                    $($((stringify!($field), $crate::messages::Datum::datum($field))),*)?
                                ],
                            )
                        }
                    )*
                    $($(Self::$inner(inner) => $crate::messages::Diagnose::diagnostic(inner),)*)?
                }
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                std::fmt::Display::fmt(&$crate::messages::Diagnose::diagnostic(self), f)
            }
        }

        impl std::error::Error for $name {
            #[allow(unused_variables)]
            fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
                match self {
                    $(
                        Self::$variant $(($only))? $({ $($field),* })? => {
                            $(return $cause;)?
                            #[allow(unreachable_code)]
                            None
                        }
                    )*
                    $($(Self::$inner(inner) => std::error::Error::source(inner),)*)?
                }
            }
        }

        impl $crate::messages::Datum for $name {
            fn datum(&self) -> $crate::messages::Value {
                $crate::messages::Value::from(self.to_string())
            }
        }

        impl From<$name> for $crate::problem::Diagnostic {
            fn from(message: $name) -> $crate::problem::Diagnostic {
                $crate::messages::Diagnose::diagnostic(&message)
            }
        }
    };
    (@severity error) => { $crate::messages::Severity::Error };
    (@severity warning) => { $crate::messages::Severity::Warning };
    (@hint) => { None };
    (@hint $hint:literal) => { Some($hint) };
    (@hint advice $advice:expr) => { Some("(depends on the case)") };
}
