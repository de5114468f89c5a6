//! The server as its page uses it, and as clients without a token do.

mod draft_plan;
mod drafts;
mod free_text;
mod guard;
mod installing;
mod library;
mod limits;
mod locating;
mod naming;
mod served;
mod slow;
mod statements;
mod two_servers;
mod underlay;
mod watching;
mod written_back;
