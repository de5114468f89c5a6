//! The local web app: a server that lives runs, and the page that looks at them.
pub mod wire;
