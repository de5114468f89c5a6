//! The floor plan: a home with its furniture and sensors.

use homebody_core::home::form::HomeFile;
use homebody_core::plan::Plan;
use homebody_core::problem::counted;

use super::layers;
use super::legend::Legend;
use super::paint::SENSOR;
use super::sheet::Sheet;

pub fn floor_plan(home: &HomeFile) -> String {
    let plan = Plan::new(home);
    let rooms = counted(home.rooms.len(), "room", "rooms");
    let sensors = counted(home.sensors.len(), "sensor", "sensors");
    let room_names: Vec<&str> = home.rooms.iter().map(|room| room.name.as_str()).collect();
    let sensor_names: Vec<&str> = home.sensors.iter().map(|sensor| sensor.name()).collect();
    let description = format!("Rooms: {}. Sensors: {}.", room_names.join(", "), sensor_names.join(", "));

    let subtitle = format!("Floor plan: {rooms}, {sensors}");
    let mut sheet = Sheet::new(&home.name, &subtitle, &description, plan.bounds());
    layers::frames(&mut sheet, home);
    layers::floors(&mut sheet, &plan);
    layers::furniture(&mut sheet, home, &layers::FURNITURE, &layers::ENTERABLE);
    layers::ceiling_areas(&mut sheet, home, SENSOR);
    layers::mats(&mut sheet, home);
    layers::walls(&mut sheet, home, &plan);
    sheet.dimensions(layers::ways_in_on_west(home, &plan));
    layers::doors(&mut sheet, home, &plan);
    layers::sensors(&mut sheet, home, &plan);
    layers::names(&mut sheet, home, &plan, layers::FURNITURE_NAME);
    sheet.labels.draw(&mut sheet.svg);

    let mut legend = Legend::new();
    legend.heading(&mut sheet.svg, "Legend");
    layers::explain(&mut sheet, &mut legend, home);
    legend.note(&mut sheet.svg, "Dimensions are taken over the outer walls.");
    sheet.finish(legend.end())
}
