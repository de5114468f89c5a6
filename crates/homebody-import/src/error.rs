//! Errors of importing a file.

homebody_core::messages! {
    /// Errors of importing a plan.
    #[derive(Clone, PartialEq, Eq)]
    pub enum ImportError in "import" {
        /// Sweet Home 3D saves a plan as a zip archive whose name ends in `.sh3d`.
        NoArchive error "not-an-archive" ("this is not a Sweet Home 3D file: it is not a zip archive")
            hint ("name the .sh3d file that Sweet Home 3D has saved");
        /// Homebody imports plans of Sweet Home 3D. For other forms there are other ways into a home.
        OtherForm { form: &'static str, hint: &'static str } error "other-form" ("this is not a Sweet Home 3D file: it is {form}") hint ("{hint}");
        /// The archive has no plan in it.
        NoHomeXml error "no-home-xml" ("this is not a Sweet Home 3D file: it has no Home.xml")
            hint ("name the .sh3d file that Sweet Home 3D has saved");
        /// Sweet Home 3D before version 5.3 saved plans as Java objects, which only Sweet Home 3D reads.
        OnlyJava error "old-version" ("an old version of Sweet Home 3D saved this file, with the plan as Java objects instead of a Home.xml")
            hint ("open it in Sweet Home 3D 5.3 or later (www.sweethome3d.com), choose File > Save as, and name the new file");
        /// A plan of one home is smaller. Large models of furniture make files large.
        TooLarge { unit: &'static str, found: u64, most: u64, hint: &'static str } error "too-large" ("the file is too large: it has {found} {unit}, and Homebody reads at most {most}") hint ("{hint}");
        /// The file was not copied completely, or was changed.
        Damaged(reason: String) error "damaged" ("cannot unpack the Home.xml of the file: {reason}")
            hint ("open it in Sweet Home 3D and save it again");
        /// The text of the plan is not well-formed XML.
        Disorder(reason: String) error "not-xml" ("the Home.xml of the file is not valid XML: {reason}")
            hint ("open it in Sweet Home 3D and save it again");
        /// Sweet Home 3D writes its plans in UTF-8.
        NotUtf8 error "not-utf-8" ("the Home.xml of the file is not text in UTF-8")
            hint ("open it in Sweet Home 3D and save it again");
        /// Homebody limits the number of elements and attributes, as a plan of one home has far fewer.
        ManyParts error "many-parts" ("the Home.xml of the file has more elements and attributes than the plan of one home")
            hint ("open it in Sweet Home 3D and save it again");
        /// A document type can make a small text very large. Sweet Home 3D writes none.
        DocumentType error "document-type" ("the Home.xml of the file declares a document type, which plans never do")
            hint ("open it in Sweet Home 3D and save it again");
        /// Homebody limits the number of attributes of an element.
        ManyAttributes error "many-attributes" ("a tag of Home.xml has more attributes than any tag of a plan")
            hint ("open it in Sweet Home 3D and save it again");
        /// Sweet Home 3D writes its plans without namespaces.
        Namespace error "namespace" ("the Home.xml of the file declares a namespace, which plans never do")
            hint ("open it in Sweet Home 3D and save it again");
        /// Homebody limits how deep elements are nested.
        Nested { most: usize } error "nested" ("the elements of Home.xml are nested more than {most} levels deep")
            hint ("open it in Sweet Home 3D and save it again");
        /// A level is one floor of a plan, named as in Sweet Home 3D or by its number from the lowest.
        NoSuchLevel { wanted: String, known: String } error "no-such-level" ("the plan has no level {wanted:?}") hint ("it has {known}");
        /// Homebody limits what a home can have, so that a simulation stays fast.
        TooMany { what: &'static str, count: usize, most: usize, hint: &'static str } error "too-many" ("the plan has {count} {what}, but a home can have at most {most}") hint ("{hint}");
        /// Residents move through rooms. Without drawn rooms, Homebody takes the areas that walls enclose.
        NoRooms error "no-rooms" ("the plan has no rooms, and no walls that enclose one")
            hint ("draw rooms in Sweet Home 3D: a double click inside walls makes one");
        /// The imported home must pass the same check as a home that is written by hand.
        Unsound(reason: String) error "unsound" ("the plan does not give a valid home: {reason}")
            hint ("correct the plan in Sweet Home 3D and save it again");
    }
}
