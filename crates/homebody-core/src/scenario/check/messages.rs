//! Messages that the checks of several files share.

crate::messages! {
    /// Problems with names.
    pub enum NameMessage in "name" {
        /// A name of blanks is invisible in tables and pictures.
        Blank error "blank" ("a name must not be blank")
            hint ("write a name");
        /// Ends of lines, tabs and other control characters in a name would break tables and terminals.
        ControlCharacter { name: String } error "control-character" ("the name {name:?} contains a control character")
            hint ("remove it");
    }
}

crate::messages! {
    /// Problems with pairs of a least and a most value.
    pub enum RangeMessage in "range" {
        /// The key takes a list of two numbers, the smaller one first.
        Reversed { key: String, first: f64, second: f64 }
            error "reversed" ("the first value of {key:?}, {first}, is greater than the second, {second}")
            hint ("write [{second}, {first}]");
    }
}
