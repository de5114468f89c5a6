//! Enums whose variants each have a word.

/// Declares an enum with a word for each variant, a list of all variants, and a function that gives the word.
macro_rules! worded {
    (
        $(#[$meta:meta])*
        pub enum $name:ident {
            $($(#[$doc:meta])* $variant:ident = $text:literal,)*
        }
        $(#[$all_doc:meta])*
        ALL
        $(#[$word_doc:meta])*
        fn $word:ident
    ) => {
        $(#[$meta])*
        pub enum $name {
            $($(#[$doc])* $variant,)*
        }

        impl $name {
            $(#[$all_doc])*
            pub const ALL: [$name; [$($name::$variant),*].len()] = [$($name::$variant),*];

            $(#[$word_doc])*
            pub fn $word(self) -> &'static str {
                match self {
                    $($name::$variant => $text,)*
                }
            }
        }
    };
}

pub(crate) use worded;
