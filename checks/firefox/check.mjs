// Looks at every view of the page with Firefox.
//
//     node check.mjs NODE_MODULES HOMEBODY
//
// README.md says how to get both.

import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { setTimeout as wait } from "node:timers/promises";

const [modules, program] = process.argv.slice(2).map((path) => resolve(path));
const require = createRequire(join(modules, "check.cjs"));
const { launch } = require("puppeteer-core");
const axe = readFileSync(join(modules, "axe-core/axe.min.js"), "utf8");
const pictures = process.env.PICTURES;
const SCENARIO = "tigerplace-depression";
const VIEWS = { live: "live", plan: "plan", life: "life", log: "log", playback: `playback/${SCENARIO}-1`, care: `care/${SCENARIO}-1` };

const folder = mkdtempSync(join(tmpdir(), "homebody-firefox-"));
cpSync(resolve(import.meta.dirname, "../../scenarios", SCENARIO), join(folder, SCENARIO), { recursive: true });
execFileSync(program, ["run", SCENARIO, "--for", "5d", "--quiet"], { cwd: folder });
if (pictures) mkdirSync(pictures, { recursive: true });

const server = spawn(program, ["serve", SCENARIO, "--no-open", "--port", "0"], { cwd: folder, stdio: ["ignore", "pipe", "inherit"] });
const address = await new Promise((ready) => server.stdout.once("data", (text) => ready(String(text).trim())));
const browser = await launch({ browser: "firefox", executablePath: process.env.FIREFOX ?? "/usr/bin/firefox-esr", headless: true });
const page = await browser.newPage();
const wrong = [];
page.on("pageerror", (error) => wrong.push(String(error)));
page.on("console", (message) => message.type() === "error" && wrong.push(message.text()));

/** What is looked at, in one size: no faults by axe, nothing wider than the window. */
async function looked(name, theme, width) {
  await page.setViewport({ width, height: 800 });
  await wait(1500);
  if (pictures) await page.screenshot({ path: join(pictures, `${name}-${theme}-${width}.png`) });
  await page.evaluate(axe);
  const found = await page.evaluate(async () => {
    const { violations } = await window.axe.run(document, { resultTypes: ["violations"] });
    return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 160)).join(" | ")}`);
  });
  assert.deepEqual(found, [], `${name}, ${theme}, ${width} wide`);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
  assert.ok(wide <= 0, `${name}, ${theme}: ${wide} pixels wider than ${width}`);
}

const until = (what, holds) => page.waitForFunction(holds, { timeout: 30_000 }).catch((error) => assert.fail(`${what}: ${error.message}`));

try {
  await page.goto(address);
  await until("the page opens", () => document.querySelector("canvas") !== null);
  let count = 0;
  for (const theme of ["light", "dark"]) {
    await page.evaluate((chosen) => localStorage.setItem("homebody-theme", chosen), theme);
    for (const [name, view] of Object.entries(VIEWS)) {
      await page.goto("about:blank");
      await page.goto(`${address.split("#")[0]}#/${view}`);
      await until(name, () => document.querySelector("main, nav") !== null);
      const dark = await page.evaluate(() => getComputedStyle(document.documentElement).colorScheme);
      assert.equal(dark, theme, `${name} is ${theme}`);
      for (const width of [1280, 1024]) {
        await looked(name, theme, width);
        count += 1;
      }
    }
  }

  // A life is played, and its clock goes on.
  await page.goto("about:blank");
  await page.goto(`${address.split("#")[0]}#/live`);
  const button = (name) => page.locator(`::-p-aria([name="${name}"][role="button"])`);
  await button("Play").click();
  await until("firings come", () => document.querySelectorAll("table[aria-rowcount] tbody tr[aria-rowindex]").length > 0);

  // A stored day is scrubbed by the keys.
  await page.goto("about:blank");
  await page.goto(`${address.split("#")[0]}#/playback/${SCENARIO}-1`);
  const range = await page.waitForSelector('[aria-label="Time of the day"]');
  const told = () => range.evaluate((input) => input.getAttribute("aria-valuetext"));
  const at = await told();
  await range.focus();
  for (let key = 0; key < 5; key++) await page.keyboard.press("ArrowRight");
  await wait(500);
  assert.notEqual(await told(), at, "the day is scrubbed");

  assert.deepEqual(wrong, [], "errors in the console");
  console.log(`${await browser.version()}: ${count} looks, a life played, a day scrubbed; nothing wrong`);
} finally {
  await browser.close();
  server.kill("SIGINT");
  rmSync(folder, { recursive: true, force: true });
}
