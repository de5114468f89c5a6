//! The picture below the plan, from the scenario's folder.

use super::served::Served;
use serde_json::{Value, json};
use std::fs;

#[test]
fn serves_the_image_below_the_plan() {
    let served = Served::scenario("studio");
    assert_eq!(served.api("/api/underlay").body, b"null");
    assert_eq!(served.api("/api/underlay/picture").code, 404);
    let lies = json!({ "picture": "plan.png", "at": [5.0, 2.5], "width_m": 10.0, "turn_deg": 90.0 });
    fs::write(served.file("studio", "underlay.json"), lies.to_string()).unwrap();
    assert_eq!(served.api("/api/underlay/picture").code, 404);
    fs::write(served.file("studio", "plan.png"), b"a picture").unwrap();
    assert_eq!(serde_json::from_slice::<Value>(&served.api("/api/underlay").body).unwrap(), lies);
    assert_eq!(served.api("/api/underlay/picture").body, b"a picture");
    // Only images in the folder are served.
    for name in ["scenario.json", "../secret.png", "/etc/hostname.png"] {
        fs::write(served.folder.path().join("secret.png"), b"secret").unwrap();
        fs::write(served.file("studio", "underlay.json"), lies.to_string().replace("plan.png", name)).unwrap();
        assert_eq!(served.api("/api/underlay/picture").code, 404, "{name}");
    }
}
