// Made from crates/homebody-core/src/sensors/kinds.rs and the rows that it lists; form.rs says what each means.

export const SENSOR_KINDS = {
  motion: { label: "motion, on a wall", mount: "wall", bearers: [], unit: null, values: ["ON"], shape: "arrow", colour: "blue", casas: "M" },
  ceiling_motion: { label: "motion, from the ceiling", mount: "ceiling", bearers: [], unit: null, values: ["ON"], shape: "ring", colour: "sky", casas: "M" },
  contact: { label: "contact", mount: "thing", bearers: ["door", "furniture"], unit: null, values: ["OPEN", "CLOSE"], shape: "gap", colour: "orange", casas: "D" },
  bed: { label: "bed", mount: "thing", bearers: ["enterable"], unit: null, values: ["IN", "OUT", "RESTLESS_1", "RESTLESS_2", "RESTLESS_3", "RESTLESS_4", "PULSE_LOW", "PULSE_NORMAL", "PULSE_HIGH", "RESPIRATION_LOW", "RESPIRATION_NORMAL", "RESPIRATION_HIGH"], shape: "pill", colour: "purple", casas: "I" },
  stove_temperature: { label: "stove temperature", mount: "thing", bearers: ["furniture"], unit: "°C", values: ["ON", "OFF"], shape: "flame", colour: "vermillion", casas: "T" },
  pressure: { label: "pressure", mount: "thing", bearers: ["enterable"], unit: null, values: ["ON", "OFF"], shape: "hexagon", colour: "green", casas: "I" },
  power: { label: "power", mount: "thing", bearers: ["furniture", "lamp"], unit: "W", values: ["ON", "OFF"], shape: "bolt", colour: "yellow", casas: "P" },
  flow: { label: "flow", mount: "thing", bearers: ["furniture"], unit: null, values: ["ON", "OFF"], shape: "drop", colour: "sky", casas: "I" },
  light: { label: "light", mount: "room", bearers: [], unit: "lx", values: [], shape: "star", colour: "yellow", casas: "LS" },
  temperature: { label: "temperature", mount: "room", bearers: [], unit: "°C", values: [], shape: "cross", colour: "vermillion", casas: "T" },
  camera: { label: "camera, silhouettes only", mount: "free", bearers: [], unit: null, values: ["WOKE", "SEEN", "SLEPT"], shape: "eye", colour: "purple", casas: "C" },
} as const;
