//! The progress of long work: a bar on a terminal, elsewhere one line a minute on standard error.

use crate::print::tell;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle, TermLike};
use std::io::{self, IsTerminal, stderr};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Time before the first line without a terminal: shorter work needs none.
const FIRST_LINE: Duration = Duration::from_secs(10);

const NEXT_LINE: Duration = Duration::from_secs(60);

/// Time between two drawings of the bar, even without progress.
const TICK: Duration = Duration::from_millis(500);

/// A share of the work in percent.
pub const SHARE: &str = "{bar:40} {percent:>3} %  {eta} left";

/// A bar for work of a length; its template names the unit. The template of work without a length has a spinner.
pub fn bar(length: impl Into<Option<u64>>, template: &str) -> ProgressBar {
    let target = match stderr().is_terminal() {
        true => ProgressDrawTarget::stderr(),
        false => ProgressDrawTarget::term_like(Box::new(Lines::new(FIRST_LINE, NEXT_LINE, tell))),
    };
    let is_terminal = stderr().is_terminal();
    let template = if is_terminal { template.to_owned() } else { without_bar(template) };
    let bar = ProgressBar::with_draw_target(length.into(), target).with_style(style(&template));
    // Without a thread the bar moves only with the work.
    if thread::Builder::new().spawn(|| ()).is_ok() {
        bar.enable_steady_tick(TICK);
    }
    bar
}

/// A bar that moves only with the work, and is hidden without a terminal and with `--quiet`.
pub fn on_terminal(is_quiet: bool, length: Option<u64>, template: &str) -> ProgressBar {
    let target = if is_quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    ProgressBar::with_draw_target(length, target).with_style(style(template))
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

/// Shows a bar during work, and clears it afterwards.
pub fn show<T>(length: impl Into<Option<u64>>, template: &str, work: impl FnOnce(&ProgressBar) -> T) -> T {
    let bar = bar(length, template);
    let result = work(&bar);
    bar.finish_and_clear();
    result
}

/// Shows a bar during work that reports its completed share, from 0 to 1.
pub fn show_share<T>(work: impl FnOnce(&(dyn Fn(f64) + Sync)) -> T) -> T {
    show(1000, SHARE, |bar| work(&|share| bar.set_position((share * 1000.0) as u64)))
}

pub fn bar_unless(is_quiet: bool, length: impl Into<Option<u64>>, template: &str) -> ProgressBar {
    if is_quiet { ProgressBar::hidden() } else { bar(length, template) }
}

/// A spinner for work without a length; it ends when it is dropped.
pub struct Working(ProgressBar);

impl Working {
    /// `what` is a phrase such as `reading runs/flat-1`.
    pub fn on(what: impl Into<String>) -> Working {
        let bar = bar(None, "{spinner} {msg}  {elapsed}");
        bar.set_message(what.into());
        Working(bar)
    }
}

impl Drop for Working {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// The template without a bar and a spinner, for lines.
fn without_bar(template: &str) -> String {
    ["{bar:40} ", "{spinner} "].iter().fold(template.to_owned(), |text, part| text.replace(part, ""))
}

struct Lines<T> {
    first: Duration,
    next: Duration,
    state: Mutex<LineState>,
    print: T,
}

struct LineState {
    begun: Instant,
    printed: Option<Instant>,
    drawn: String,
}

impl<T> Lines<T> {
    fn new(first: Duration, next: Duration, print: T) -> Lines<T> {
        let state = LineState { begun: Instant::now(), printed: None, drawn: String::new() };
        Lines { first, next, state: Mutex::new(state), print }
    }

    fn state(&self) -> std::sync::MutexGuard<'_, LineState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<T> std::fmt::Debug for Lines<T> {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("Lines")
    }
}

impl<T: Fn(String) + Send + Sync> TermLike for Lines<T> {
    fn width(&self) -> u16 {
        200
    }

    fn move_cursor_up(&self, _: usize) -> io::Result<()> {
        Ok(())
    }

    fn move_cursor_down(&self, _: usize) -> io::Result<()> {
        Ok(())
    }

    fn move_cursor_right(&self, _: usize) -> io::Result<()> {
        Ok(())
    }

    fn move_cursor_left(&self, _: usize) -> io::Result<()> {
        Ok(())
    }

    fn write_line(&self, text: &str) -> io::Result<()> {
        self.write_str(text)
    }

    fn write_str(&self, text: &str) -> io::Result<()> {
        self.state().drawn.push_str(text);
        Ok(())
    }

    fn clear_line(&self) -> io::Result<()> {
        self.state().drawn.clear();
        Ok(())
    }

    fn flush(&self) -> io::Result<()> {
        let mut state = self.state();
        let drawn = std::mem::take(&mut state.drawn);
        let is_due = match state.printed {
            None => state.begun.elapsed() >= self.first,
            Some(printed) => printed.elapsed() >= self.next,
        };
        if is_due && !drawn.trim().is_empty() {
            state.printed = Some(Instant::now());
            drop(state);
            (self.print)(drawn.trim().to_owned());
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    fn drawn(first: Duration, next: Duration) -> Vec<String> {
        let printed = Arc::new(Mutex::new(Vec::new()));
        let kept = printed.clone();
        let lines = Lines::new(first, next, move |line| kept.lock().unwrap().push(line));
        for share in ["10 %", "20 %", "30 %"] {
            lines.write_line(share).unwrap();
            lines.flush().unwrap();
        }
        let printed = printed.lock().unwrap();
        printed.clone()
    }

    #[test]
    fn lines_come_late_and_seldom() {
        let hour = Duration::from_secs(3600);
        assert!(drawn(hour, hour).is_empty(), "short work prints nothing");
        assert_eq!(drawn(Duration::ZERO, hour), ["10 %"]);
        assert_eq!(drawn(Duration::ZERO, Duration::ZERO), ["10 %", "20 %", "30 %"]);
    }

    #[test]
    fn lines_have_no_bar() {
        assert_eq!(without_bar(SHARE), "{percent:>3} %  {eta} left");
    }
}
