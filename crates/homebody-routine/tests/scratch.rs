#![allow(clippy::disallowed_methods)]
mod home;
use home::{home, short};
use homebody_core::problem::Problem;
use homebody_routine::language::{Known, routine};
use homebody_routine::routine::{Activity, Routine};
fn known() -> Known {
    Known { usual: Activity::OWN_WAYS.to_vec(), ..home() }
}
fn read(text: &str) -> (Routine, Vec<Problem>) {
    routine("margaret.routine", text, &known())
}
#[test]
fn scratch() {
    let Ok(path) = std::env::var("SCRATCH") else { return };
    let text = std::fs::read_to_string(path).unwrap();
    for (i, line) in text.lines().enumerate() {
        let (found, problems) = read(line);
        let remarks: Vec<_> = found.remarks.iter().map(|r| r.text.clone()).collect();
        if problems.is_empty() {
            println!("{} {line}\n     = {} {remarks:?}", i + 1, short(&found));
        } else {
            println!("{} {line}", i + 1);
            for p in &problems {
                println!("     ! {} | {:?}", p.what, p.hint);
            }
        }
    }
}
#[test]
fn kept() {
    let Ok(path) = std::env::var("KEPT") else { return };
    let text = std::fs::read_to_string(&path).unwrap();
    let (mut yes, mut remarks, mut hinted, mut bare) = (0, 0, 0, 0);
    let mut out = String::new();
    for line in text.lines() {
        let v: serde_json::Value = serde_json::from_str(line).unwrap();
        let said = v["text"].as_str().unwrap();
        let (found, problems) = read(said);
        let r: Vec<_> = found.remarks.iter().map(|r| r.text.clone()).collect();
        if problems.is_empty() {
            yes += 1;
            if short(&found) == "remark" {
                remarks += 1;
            }
        } else if problems.iter().all(|p| p.hint.is_some()) {
            hinted += 1
        } else {
            bare += 1
        }
        out += &serde_json::json!({"id": v["id"], "text": said, "meaning": v["meaning"], "understood": if problems.is_empty() { short(&found) } else { String::new() }, "remarks": r,
          "problems": problems.iter().map(|p| format!("{} | {:?}", p.what, p.hint)).collect::<Vec<_>>() }).to_string();
        out.push('\n');
    }
    std::fs::write(format!("{path}.out"), out).unwrap();
    println!("accepted {yes} (remarks alone {remarks}), refused with hint {hinted}, without {bare}");
}
