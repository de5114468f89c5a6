//! The command: fuzzes each target, prints what became of it, and repeats single cases.

use clap::{Args, Parser, Subcommand};
use homebody_fuzz::case::{self, Done, End};
use homebody_fuzz::supervise::{Finding, LONGEST, MOST_BYTES, Plan, supervise};
use homebody_fuzz::table::Table;
use homebody_fuzz::target::{Files, Target};
use homebody_fuzz::targets::{self, TARGETS};
use homebody_fuzz::worker::{Share, work};
use indicatif::{ProgressBar, ProgressStyle};
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;
use std::{env, fs, io, thread};

/// Fuzzes all that reads files, logs, plans and messages of anybody's. Each case has a second and 256 MiB, may be accepted or
/// refused in words, and must neither panic nor hang. What fails is told by target, seed and number.
#[derive(Parser)]
#[command(name = "homebody-fuzz", args_conflicts_with_subcommands = true)]
#[command(after_help = "Examples:
  cargo run --release -p homebody-fuzz
  cargo run --release -p homebody-fuzz -- --target routine --seconds 600 --seed 7
  cargo run --release -p homebody-fuzz -- --target log --case 4711 --save case/

The exit code is 0 where nothing failed, and 1 where something did.")]
struct Arguments {
    #[command(flatten)]
    asked: Asked,
    #[command(subcommand)]
    own: Option<Own>,
}

#[derive(Args)]
struct Asked {
    /// Only this target; may be given several times
    #[arg(long, value_parser = target)]
    target: Vec<Target>,
    /// How many cases of each target, instead of its own number
    #[arg(long, value_name = "N")]
    cases: Option<u64>,
    /// Fuzz each target for so long, instead of for a number of cases
    #[arg(long, value_name = "S", conflicts_with = "cases")]
    seconds: Option<u64>,
    /// The seed of all cases
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    seed: u64,
    /// Repeat this case of one target, and say what becomes of it
    #[arg(long, value_name = "N", requires = "target", conflicts_with_all = ["cases", "seconds"])]
    case: Option<u64>,
    /// Write the files of the case into this folder
    #[arg(long, value_name = "FOLDER", requires = "case")]
    save: Option<PathBuf>,
    /// How many processes work side by side; as many as there are processors without it
    #[arg(long, value_name = "N")]
    workers: Option<NonZero<u64>>,
}

/// What processes of this program say to each other.
#[derive(Subcommand)]
enum Own {
    #[command(hide = true)]
    Work {
        #[arg(long, value_parser = target)]
        target: Target,
        #[arg(long)]
        seed: u64,
        #[arg(long)]
        first: u64,
        #[arg(long)]
        step: u64,
        #[arg(long)]
        end: u64,
    },
}

fn main() -> ExitCode {
    let Arguments { asked, own } = Arguments::parse();
    let done = || match own {
        Some(Own::Work { target, seed, first, step, end }) => {
            work(&target, Share { seed, first, step, end }).map(|()| true)
        }
        None => match asked.case {
            Some(number) => repeat(&asked, number),
            None => asked.all(),
        },
    };
    match temporary_files().and_then(|()| done()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Makes sure that temporary files can be made: cases are lived in a folder of them, and databases are made there.
fn temporary_files() -> io::Result<()> {
    tempfile::tempdir().map(|_| ()).map_err(|error| {
        let hint = "let TMPDIR name a folder that can be written";
        io::Error::other(format!("no folder for temporary files: {error}\n  hint: {hint}"))
    })
}

fn target(name: &str) -> Result<Target, String> {
    let known = || TARGETS.map(|target| target.name).join(", ");
    targets::named(name).ok_or_else(|| format!("there is no such target\n  hint: the targets are {}", known()))
}

impl Asked {
    /// Fuzzes all that is asked for; whether nothing failed.
    fn all(&self) -> io::Result<bool> {
        let targets = if self.target.is_empty() { TARGETS.to_vec() } else { self.target.clone() };
        let mut table = Table(Vec::new());
        for target in targets {
            let plan = self.plan(&target)?;
            let bar = bar(&target, &plan);
            let outcome = supervise(&target, &plan, &|| bar.inc(1));
            bar.finish_and_clear();
            let mut outcome = outcome?;
            // On a machine that others use, a case may have waited for them: it is measured again alone.
            outcome.findings =
                outcome.findings.into_iter().filter_map(|found| confirmed(&target, &plan, found)).collect();
            for Finding { number, what } in &outcome.findings {
                println!("{} --seed {} --case {number}: {what}", target.name, self.seed);
            }
            table.0.push((target, outcome));
        }
        print!("{table}");
        Ok(table.failures() == 0)
    }

    fn plan(&self, target: &Target) -> io::Result<Plan> {
        let workers = thread::available_parallelism().map_or(1, |count| count.get() as u64);
        Ok(Plan {
            program: env::current_exe()?,
            seed: self.seed,
            first: 0,
            cases: self.cases.unwrap_or(if self.seconds.is_some() { u64::MAX } else { target.cases }),
            until: self.seconds.map(Duration::from_secs),
            workers: self.workers.map_or(workers, NonZero::get),
            hangs_after: Duration::from_secs(10),
            is_measured: !cfg!(debug_assertions),
        })
    }
}

/// What failed once more, alone.
fn confirmed(target: &Target, plan: &Plan, found: Finding) -> Option<Finding> {
    if !found.what.ends_with(" MiB") {
        return Some(found);
    }
    let alone = Plan { first: found.number, cases: 1, workers: 1, until: None, ..plan.clone() };
    match supervise(target, &alone, &|| ()) {
        Ok(outcome) => outcome.findings.into_iter().next(),
        Err(_) => Some(found),
    }
}

fn bar(target: &Target, plan: &Plan) -> ProgressBar {
    let (bar, template) = match plan.until {
        Some(until) => {
            (ProgressBar::no_length(), format!("{{msg:10}} {{spinner}} {{elapsed}} of {until:?}  {{human_pos}} cases"))
        }
        None => {
            (ProgressBar::new(plan.cases), "{msg:10} {bar:40} {percent:>3} %  {human_pos} cases  {eta} left".to_owned())
        }
    };
    let style = ProgressStyle::with_template(&template).unwrap_or_else(|_| ProgressStyle::default_bar());
    bar.with_style(style).with_message(target.name)
}

/// Does one case in this process; whether it went well.
fn repeat(asked: &Asked, number: u64) -> io::Result<bool> {
    let mut is_good = true;
    for target in &asked.target {
        let files = target.case(&(target.corpus)(), asked.seed, number);
        if let Some(folder) = &asked.save {
            save(folder, &files)?;
        }
        case::keep_panics();
        // As a thread of the program, whose stack is smaller than the first one's.
        let target = *target;
        let measured = move || case::run(&target, &files);
        let Done { end, took, peak_bytes } =
            thread::spawn(measured).join().map_err(|_| io::Error::other("the case could not be done"))?;
        let (took_s, peak) = (took.as_secs_f64(), peak_bytes >> 20);
        println!("{} --seed {} --case {number}: {took_s:.2} s, {peak} MiB: {end:?}", target.name, asked.seed);
        let is_measured = !cfg!(debug_assertions);
        is_good &= !matches!(end, End::Failed(_)) && !(is_measured && (took > LONGEST || peak_bytes > MOST_BYTES));
    }
    Ok(is_good)
}

fn save(folder: &Path, files: &Files) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    for (name, bytes) in files {
        let path = folder.join(name);
        fs::write(&path, bytes)?;
        println!("{} is written", path.display());
    }
    Ok(())
}
