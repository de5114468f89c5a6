//! The server as its page knows it, and as those who should not be heard do.

mod guard;
mod living;
mod served;
