// Holds what a broker keeps of a home against Zigbee2MQTT's own types and converters.
//
//     node check.mjs NODE_MODULES kept.jsonl BASE
//
// Each line of the file is an object with `topic` and `payload`. README.md says how to get all of it.

import { readFileSync, writeFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

const [modules, file, base] = process.argv.slice(2);
const require = createRequire(join(modules, "check.cjs"));
const typescript = require("typescript");
const exposes = require("zigbee-herdsman-converters/lib/exposes");

const kept = new Map();
for (const line of readFileSync(file, "utf8").split("\n").filter(Boolean)) {
  const { topic, payload } = JSON.parse(line);
  kept.set(topic, payload);
}
const said = (topic) => JSON.parse(kept.get(`${base}/${topic}`));
const wrong = [];
let checked = 0;

// What the types want and no simulated device has: pictures, firmware and the radio's own.
const LEFT_OUT = ["icon", "software_build_id", "date_code"];

// The coordinator has no definition, which documents show as null and types as absent.
const devices = said("bridge/devices").map(({ definition, ...device }) => (definition ? { ...device, definition } : device));
const wanted = `Omit<Api["bridge/devices"][number], "definition" | "interview_state" | ${LEFT_OUT.map((key) => `"${key}"`).join(" | ")}>`;
// What it can tell is held against the converters below: as types these have methods, which no message has.
const definition = `Omit<NonNullable<Api["bridge/devices"][number]["definition"]>, "icon" | "exposes">`;
const sensors = devices.filter((device) => device.type !== "Coordinator");
const program = [
  `import type { Zigbee2MQTTAPI as Api } from "zigbee2mqtt";`,
  // An enum of texts, whose texts no literal is.
  `type Interview = \`\${NonNullable<Api["bridge/devices"][number]["interview_state"]>}\`;`,
  `type Device = ${wanted} & { interview_state: Interview; definition: ${definition} & { exposes: unknown[] } };`,
  `const state: Api["bridge/state"] = ${kept.get(`${base}/bridge/state`)};`,
  `const groups: Api["bridge/groups"] = ${kept.get(`${base}/bridge/groups`)};`,
  ...sensors.map((device, index) => `const device${index}: Device = ${JSON.stringify(device)};`),
  ...sensors.map(
    ({ friendly_name }, index) => `const is${index}: { state: "online" | "offline" } = ${kept.get(`${base}/${friendly_name}/availability`)};`,
  ),
];
const source = join(modules, "..", "homebody-check.ts");
writeFileSync(source, program.join("\n"));
const options = {
  noEmit: true, strict: true, skipLibCheck: true, types: [],
  module: typescript.ModuleKind.NodeNext, moduleResolution: typescript.ModuleResolutionKind.NodeNext,
};
const diagnostics = typescript.getPreEmitDiagnostics(typescript.createProgram([source], options));
for (const { messageText, file: place, start } of diagnostics) {
  const line = place ? place.getLineAndCharacterOfPosition(start).line : -1;
  wrong.push(`${(program[line] ?? "").slice(0, 60)}: ${typescript.flattenDiagnosticMessageText(messageText, " ")}`);
}
rmSync(source);
checked += program.length - 4;

// A property that the converters know is theirs in kind, unit and words.
function published({ name, type, unit, value_on, value_off, values }) {
  const preset = exposes.presets[name];
  const known = typeof preset === "function" && preset.length === 0 ? preset() : undefined;
  if (known && known.type === type) return known;
  switch (type) {
    case "binary": return new exposes.Binary(name, exposes.access.STATE, value_on, value_off);
    case "numeric": return unit ? new exposes.Numeric(name, exposes.access.STATE).withUnit(unit) : new exposes.Numeric(name, exposes.access.STATE);
    case "enum": return new exposes.Enum(name, exposes.access.STATE, values);
    case "text": return new exposes.Text(name, exposes.access.STATE);
    default: return {};
  }
}
for (const { friendly_name, definition } of sensors) {
  const last = kept.has(`${base}/${friendly_name}`) ? said(friendly_name) : {};
  for (const expose of definition.exposes) {
    const known = JSON.parse(JSON.stringify(published(expose)));
    for (const [key, value] of Object.entries(expose)) {
      if (JSON.stringify(known[key]) !== JSON.stringify(value)) {
        wrong.push(`${friendly_name}: ${expose.name} has ${key} ${JSON.stringify(value)}, the converters ${JSON.stringify(known[key])}`);
      }
    }
    const told = last[expose.property];
    if (told !== undefined && told !== null) {
      const fits = { binary: () => told === expose.value_on || told === expose.value_off, numeric: () => typeof told === "number",
        enum: () => expose.values.includes(told), text: () => typeof told === "string" };
      if (!fits[expose.type]()) wrong.push(`${friendly_name}: ${expose.name} says ${JSON.stringify(told)}`);
    }
    checked += 1;
  }
}
console.log(`${checked} things agree with Zigbee2MQTT but for ${wrong.length}`);
console.log(wrong.join("\n"));
process.exit(wrong.length || !sensors.length ? 1 : 0);
