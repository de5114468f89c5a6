//! The server as its page uses it, and as clients without a token do.

mod desk;
mod desk_plan;
mod guard;
mod installing;
mod library;
mod limits;
mod living;
mod naming;
mod served;
mod slow;
mod two_servers;
mod underlay;
mod walking;
mod written_back;
