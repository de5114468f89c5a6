//! The server as its page knows it, and as those who should not be heard do.

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
