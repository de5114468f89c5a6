use homebody_experiment::claims::*;
use std::sync::Mutex;
fn main() {
    let text = std::fs::read_to_string(std::env::args().nth(1).unwrap()).unwrap();
    let only = std::env::args().nth(2);
    let cases: Vec<Case> = Case::read(&text)
        .unwrap()
        .into_iter()
        .filter(|c| only.as_ref().is_none_or(|o| o.split(',').any(|o| c.line.to_string() == o || c.form.contains(o))))
        .collect();
    let next = Mutex::new(0);
    let rows = Mutex::new(Vec::new());
    std::thread::scope(|s| {
        for _ in 0..2 {
            s.spawn(|| {
                loop {
                    let i = {
                        let mut n = next.lock().unwrap();
                        *n += 1;
                        *n - 1
                    };
                    let Some(case) = cases.get(i) else { break };
                    let t = std::time::Instant::now();
                    let r = case.live(60, 11);
                    if t.elapsed().as_secs() > 8 {
                        eprintln!("{} took {:?}", case.line, t.elapsed());
                    }
                    rows.lock().unwrap().push((i, r));
                }
            });
        }
    });
    let mut rows = rows.into_inner().unwrap();
    rows.sort_by_key(|(i, _)| *i);
    println!("{}", Experiment::of(rows.into_iter().flat_map(|(_, r)| r).collect(), 60, 11));
}
