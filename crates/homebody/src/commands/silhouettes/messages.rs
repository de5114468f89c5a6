//! The messages of `homebody silhouettes`.

use std::path::PathBuf;

homebody_core::messages! {
    /// Problems with silhouettes and the files that they go to.
    pub enum SilhouettesMessage in "silhouettes" {
        /// The home of the run has no camera with this name.
        NoCamera { name: String, nearest: Option<String>, known: Vec<String> } error "no-camera"
            ("no camera is called {name:?}")
            advice ({
                let meant = nearest.as_ref().map_or_else(String::new, |nearest| format!("did you mean {nearest:?}? "));
                Some(format!("{meant}the cameras are {}", known.join(", ")))
            });
        /// The run has cameras, and no resident was in front of one yet.
        NoneYet error "none-yet" ("no camera has seen a person")
            hint ("an unfinished run may have silhouettes later: resume it, or name another run");
        /// The cameras have silhouettes, but none in this time.
        NoneInTime {
            cameras: Vec<String>, begin: String, end: String, before: Option<String>, after: Option<String>, has_others: bool,
        } error "none-in-time" ("{cameras}: no silhouettes from {begin} to {end}", cameras = cameras.join(", "))
            advice ({
                let before = before.as_ref().map(|at| format!("the last one before is at {at}"));
                let after = after.as_ref().map(|at| format!("the next one after is at {at}"));
                let others = has_others.then(|| "other cameras may have silhouettes in this time".to_owned());
                let hints: Vec<String> = [before, after, others].into_iter().flatten().collect();
                (!hints.is_empty()).then(|| hints.join("; "))
            });
        /// `--out` writes a film, a table or a folder of pictures. `--png` and `--svg` draw some moments side by side.
        NotAFilm { path: PathBuf, extension: String } error "not-a-film"
            ("--out cannot write a single picture such as {path}", path = path.display())
            hint (
                "pass --{extension} {path} to draw moments side by side, or --out {film} to write a film",
                path = path.display(),
                film = path.with_extension("apng").display()
            );
        /// The extension of the file names a form that Homebody does not write. It writes films as APNG, which browsers play.
        Form { path: PathBuf, extension: String } error "form"
            ("--out {path}: cannot write .{extension}", path = path.display())
            hint ("use .apng for a film, .csv or .jsonl for a table, or a name without an extension for a folder of pictures");
        /// Pictures go into a folder of their own, so that none of them replaces another file.
        NotEmpty { path: PathBuf } error "not-empty" ("{path} is not an empty folder", path = path.display())
            hint ("name a new or an empty folder");
        /// A film or a folder of very many pictures takes too much memory or time.
        TooMany {
            path: PathBuf,
            count: u64,
            /// `frames` or `pictures`.
            what: &'static str,
            most: u64,
        } error "too-many" ("{path} would have {count} {what}, and the limit is {most}", path = path.display())
            hint ("select fewer {what} with --from and --to, with --camera, or with --every 1s");
    }
}
