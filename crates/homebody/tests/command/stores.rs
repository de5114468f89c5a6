//! The command and the places of all kinds, servers too: what goes there comes back, and what is wrong with one is told.
//!
//! Servers are begun by the tests. Where they are not installed the tests say so and pass, unless `HOMEBODY_SERVERS=required` is set.

mod digests;
mod doctor;
mod examples;
mod labels;
mod own_names;
mod replaced;
