//! Messages for text that is not valid JSON.

use jsonc_parser::ParseStringErrorKind;
use jsonc_parser::errors::ParseErrorKind;

crate::messages! {
    /// Problems with the syntax of a JSON file.
    pub enum JsonMessage in "json" {
        /// A file of a scenario contains one JSON object. An empty file contains none.
        Empty error "empty" ("the file is empty")
            hint ("write a JSON object, or name another file");
        /// A file of a scenario has a largest number of keys, items, objects and lists together, so that it fits into memory.
        TooManyValues { most: usize } error "too-many-values" ("the file has more than {most} values")
            hint ("remove values that the scenario does not need");
        /// A text begins and ends with a double quote, both on one line. A quote inside a text has a backslash before it:
        ///
        /// ```json
        /// { "about": "the \"blue\" room" }
        /// ```
        UnclosedText error "unclosed-text" ("this text has no closing quote")
            hint ("end it with a double quote on the same line");
        /// JSON allows tabs, ends of lines and other control characters in a text only as escapes, such as `\t` and `\u001b`.
        ControlCharacter error "control-character" ("a text contains a control character")
            hint ("write \\t for a tab, and \\u with four hexadecimal digits for any other control character");
        /// Names and descriptions are short. A text of this length is probably a different file, or a quote is missing.
        LongText { most_bytes: usize } error "long-text" ("this text is longer than {most_bytes} bytes")
            hint ("shorten it");
        /// Lists and objects lie in each other to a largest depth, which every valid scenario keeps.
        DeepNesting { most: usize } error "deep-nesting" ("lists and objects are nested more than {most} levels deep")
            hint ("check that the brackets and braces before this place are closed");
        /// The parser found a mistake that has no message of its own. An editor that knows JSON shows more.
        Invalid { why: String } error "invalid" ("this is not valid JSON: {why}");
        /// JSON separates values with commas, so `2,5` is two values. A number has a point:
        ///
        /// ```json
        /// { "days": 2.5 }
        /// ```
        DecimalComma error "decimal-comma" ("a number follows this comma, where a key in quotes is expected")
            hint ("write a number with a point: 0.5, not 0,5");
        /// JSON has no words for numbers that are infinite or undefined.
        NotANumber error "not-a-number" ("JSON has no NaN and no Infinity")
            hint ("write a number");
        /// JSON does not allow zeros at the start of a number.
        LeadingZero error "leading-zero" ("a number cannot begin with 0")
            hint ("remove the 0");
        /// JSON has no comments. `scenario.json` and `home.json` have the key `about` for remarks.
        Comment error "comment" ("JSON has no comments")
            hint ("remove the comment, or write its text as the value of \"about\"");
        /// Items of a list and entries of an object are separated by commas.
        MissingComma error "missing-comma" ("a comma is missing here")
            hint ("separate values with a comma");
        /// JSON does not allow a comma after the last item of a list or the last entry of an object.
        TrailingComma error "trailing-comma" ("nothing follows this comma")
            hint ("remove it");
        /// Two commas follow each other, or a comma stands where a value is expected.
        ExtraComma error "extra-comma" ("no value comes before this comma")
            hint ("remove it, or write the value");
        /// An entry of an object is a key, a colon and a value: `"days": 2`.
        MissingColon error "missing-colon" ("a key needs a colon and a value after it")
            hint ("write \"key\": value");
        /// A key and its colon have no value after them.
        MissingValue error "missing-value" ("a value is missing here")
            hint ("write a number, a text in quotes, a list or an object");
        /// Each key of an object is in double quotes: `"days": 2`, not `days: 2`.
        UnquotedKey error "unquoted-key" ("a key must be in double quotes")
            hint ("write \"key\": value");
        /// JSON has texts in double quotes only.
        SingleQuotes error "single-quotes" ("a text must be in double quotes")
            hint ("write double quotes instead of single quotes");
        /// JSON has decimal numbers only.
        Hexadecimal error "hexadecimal" ("a number must be decimal")
            hint ("write the number in decimal, such as 16 for 0x10");
        /// JSON does not allow a plus sign before a number.
        PlusSign error "plus-sign" ("a number cannot begin with +")
            hint ("remove the +");
        /// JSON requires a digit before and after the point of a number.
        BarePoint error "bare-point" ("a number needs a digit on both sides of its point")
            hint ("write a digit before and after the point, as in 0.5 and 5.0");
        /// A number ends in a sign, a point or an exponent without digits.
        IncompleteNumber error "incomplete-number" ("this number is incomplete")
            hint ("add the missing digits");
        /// The file ends before the object is complete. The place is where the object begins.
        UnclosedObject error "unclosed-object" ("this object has no closing brace")
            hint ("add the missing brace");
        /// The file ends before the list is complete. The place is where the list begins.
        UnclosedList error "unclosed-list" ("this list has no closing bracket")
            hint ("add the missing bracket");
        /// The brace has no opening brace. Often a brace before it is one too many.
        ExtraBrace error "extra-brace" ("this closing brace has no opening brace")
            hint ("remove it");
        /// The bracket has no opening bracket. Often a bracket before it is one too many.
        ExtraBracket error "extra-bracket" ("this closing bracket has no opening bracket")
            hint ("remove it");
        /// A file contains one value. More text follows after its end, often because a brace before it closes too much.
        TextAfterEnd error "text-after-end" ("text follows the end of the JSON value")
            hint ("remove the text, or a closing brace or bracket before it that is one too many");
        /// Only `true`, `false` and `null` are words of JSON. All other texts are in quotes.
        UnquotedText error "unquoted-text" ("this word is not a JSON value")
            hint ("put it in quotes");
        /// A colon stands between a key and its value.
        ExtraColon error "extra-colon" ("no key comes before this colon")
            hint ("write \"key\": value");
        /// Each entry of an object begins with a key in quotes.
        MissingKey error "missing-key" ("a key in quotes is missing here")
            hint ("write \"key\": value");
        /// JSON knows the escapes `\"`, `\\`, `\/`, `\b`, `\f`, `\n`, `\r`, `\t` and `\u` with four hexadecimal digits.
        InvalidEscape error "invalid-escape" ("the backslash in this text does not begin a valid escape")
            hint ("write \\\\ for a backslash");
    }
}

/// The message for a syntax error; `before` and `rest` are the text on its two sides.
pub(super) fn syntax(kind: &ParseErrorKind, before: &str, rest: &str) -> JsonMessage {
    use JsonMessage as Message;
    use ParseErrorKind as Kind;
    let is_number = |word: &str| ["NaN", "Infinity"].iter().any(|name| word.trim_start_matches('-').starts_with(name));
    let is_decimal_comma = || {
        let digits_before = before.strip_suffix(',').is_some_and(|text| text.ends_with(|c: char| c.is_ascii_digit()));
        digits_before && rest.starts_with(|c: char| c.is_ascii_digit())
    };
    match kind {
        Kind::ExpectedStringObjectProperty if is_decimal_comma() => Message::DecimalComma,
        _ if is_number(rest) => Message::NotANumber,
        Kind::ExpectedComma if before.ends_with('0') && rest.starts_with(|c: char| c.is_ascii_digit()) => {
            Message::LeadingZero
        }
        Kind::CommentsNotAllowed => Message::Comment,
        Kind::ExpectedComma => Message::MissingComma,
        Kind::TrailingCommasNotAllowed => Message::TrailingComma,
        Kind::UnexpectedComma => Message::ExtraComma,
        Kind::ExpectedColonAfterObjectKey => Message::MissingColon,
        Kind::ExpectedObjectValue => Message::MissingValue,
        Kind::ExpectedStringObjectProperty => Message::UnquotedKey,
        Kind::SingleQuotedStringsNotAllowed => Message::SingleQuotes,
        Kind::HexadecimalNumbersNotAllowed => Message::Hexadecimal,
        Kind::UnaryPlusNumbersNotAllowed => Message::PlusSign,
        Kind::BareDecimalPointNumbersNotAllowed => Message::BarePoint,
        Kind::ExpectedDigit
        | Kind::ExpectedDigitFollowingNegativeSign
        | Kind::ExpectedPlusMinusOrDigitInNumberLiteral => Message::IncompleteNumber,
        Kind::UnterminatedObject => Message::UnclosedObject,
        Kind::UnterminatedArray => Message::UnclosedList,
        Kind::UnexpectedCloseBrace => Message::ExtraBrace,
        Kind::UnexpectedCloseBracket => Message::ExtraBracket,
        Kind::MultipleRootJsonValues => Message::TextAfterEnd,
        Kind::UnexpectedWord => Message::UnquotedText,
        Kind::UnexpectedColon => Message::ExtraColon,
        Kind::UnexpectedTokenInObject => Message::MissingKey,
        Kind::String(ParseStringErrorKind::UnterminatedStringLiteral) => Message::UnclosedText,
        Kind::String(_) => Message::InvalidEscape,
        kind => Message::Invalid { why: kind.to_string() },
    }
}
