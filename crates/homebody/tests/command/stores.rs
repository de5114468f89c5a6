//! The command and all kinds of destinations, with servers: they return the rows that they got, and their problems are reported.
//!
//! Servers are begun by the tests. Tests of servers that are not installed say so and pass, unless `HOMEBODY_SERVERS=required` is set.

mod digests;
mod doctor;
mod examples;
mod labels;
mod own_names;
mod replaced;
