// Measures the page of the real program in Chromium, and prints a figure a line: `HOMEBODY=PROGRAM node e2e/measure.mjs`. What
// counts is a program that was built for release, on a machine that does nothing else.

import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { setTimeout as wait } from 'node:timers/promises';
import { gzipSync } from 'node:zlib';
import { serve } from './served.mjs';

const part = (sorted, share) => sorted[Math.min(sorted.length - 1, Math.floor(sorted.length * share))];

function say(what, times, unit = 'ms') {
  const sorted = [...times].sort((a, b) => a - b);
  const figure = (share) => part(sorted, share).toFixed(1);
  console.log(`${what}: p50 ${figure(0.5)} p95 ${figure(0.95)} most ${figure(1)} ${unit}, of ${sorted.length}`);
}

/** In each page: how long its scripts take for a frame, how far frames are apart, and when which picture was drawn. */
function watch() {
  const watched = { scripts: [], gaps: [], pictures: [], first: null, keys: [], heats: [] };
  window.watched = watched;
  let drawn = 0;
  // What is drawn is told by the numbers that it is drawn with.
  for (const name of ['moveTo', 'lineTo', 'arc', 'translate', 'rotate', 'ellipse', 'setTransform', 'fillRect', 'fillText']) {
    const draw = CanvasRenderingContext2D.prototype[name];
    CanvasRenderingContext2D.prototype[name] = function (...numbers) {
      for (const number of numbers) drawn = (drawn * 31 + (typeof number === 'number' ? number * 1000 : String(number).length)) % 1e9;
      return draw.apply(this, numbers);
    };
  }
  const request = window.requestAnimationFrame.bind(window);
  const put = CanvasRenderingContext2D.prototype.putImageData;
  CanvasRenderingContext2D.prototype.putImageData = function (...image) {
    request(() => watched.heats.push(performance.now()));
    return put.apply(this, image);
  };
  let last = 0;
  let [spent, frame] = [0, 0];
  window.requestAnimationFrame = (callback) =>
    request((now) => {
      if (now !== frame) {
        if (frame > 0) {
          watched.scripts.push(spent);
          watched.gaps.push(now - frame);
        }
        [spent, frame] = [0, now];
      }
      const begun = performance.now();
      drawn = 0;
      callback(now);
      const ended = performance.now();
      spent += ended - begun;
      if (drawn !== 0 && drawn !== last) {
        watched.pictures.push(ended);
        watched.first ??= performance.timeOrigin + ended;
      }
      if (drawn !== 0) last = drawn;
    });
  addEventListener('keydown', () => watched.keys.push(performance.now()), true);
}

const script = `(${watch})()`;

// The first picture.
const firsts = [];
for (let round = 0; round < 5; round += 1) {
  const served = await serve('tigerplace', { script });
  await served.page.waitForFunction(() => window.watched.first !== null);
  firsts.push((await served.page.evaluate(() => window.watched.first)) - performance.timeOrigin - served.begun);
  if (round === 0) {
    const address = new URL(served.address).origin;
    const index = await (await fetch(address)).text();
    const weigh = async (path) => gzipSync(Buffer.from(await (await fetch(new URL(path, address))).arrayBuffer())).length;
    const seen = new Set(['/']);
    // Whatever a file of the page names belongs to the page.
    const follow = async (text, base) => {
      for (const [, name] of text.matchAll(/["'`(](\.?\/?[\w./-]+\.(?:js|css|svg|woff2))["'`)]/g)) {
        const path = new URL(name.startsWith('assets/') ? `/${name}` : name, new URL(base, address)).pathname;
        if (seen.has(path)) continue;
        const answer = await fetch(new URL(path, address));
        if (!answer.ok) continue;
        seen.add(path);
        if (path.endsWith('.js')) await follow(await answer.text(), path);
      }
    };
    await follow(index, '/');
    const weights = await Promise.all([...seen].map(weigh));
    console.log(`page: ${(weights.reduce((a, b) => a + b, 0) / 1000).toFixed(0)} kB compressed, in ${seen.size} files`);
  }
  await served.close();
}
say('first picture after the program is started', firsts);

/** Ten residents, or as many, and a hundred sensors. */
function crowd(folder, people = 10) {
  const read = (name) => JSON.parse(readFileSync(join(folder, name), 'utf8'));
  const write = (name, value) => writeFileSync(join(folder, name), JSON.stringify(value, null, 2));
  const [scenario, home, margaret] = ['scenario.json', 'home.json', 'margaret.json'].map(read);
  scenario.residents = [];
  for (let number = 0; number < people; number += 1) {
    write(`resident${number}.json`, { ...margaret, name: `resident ${number}` });
    scenario.residents.push(`resident${number}.json`);
  }
  writeFileSync(join(folder, 'margaret.routine'), readFileSync(join(folder, 'margaret.routine'), 'utf8').replace('Margaret is', 'She is'));
  const walls = home.sensors.filter(({ kind }) => kind === 'motion');
  for (let number = 0; home.sensors.length < 100; number += 1) {
    home.sensors.push({ ...walls[number % walls.length], name: `sensor ${number}` });
  }
  delete scenario.logger;
  write('scenario.json', scenario);
  write('home.json', home);
}

const crowded = await serve('tigerplace', { script, prepare: (folder) => crowd(folder) });
await crowded.page.setViewportSize({ width: 1280, height: 720 });
await crowded.page.getByRole('button', { name: 'Play', exact: true }).click();
for (const speed of ['1×', '1,000×']) {
  await crowded.page.getByRole('button', { name: new RegExp(`^${speed}:`) }).click();
  await wait(2000);
  await crowded.page.evaluate(() => Object.assign(window.watched, { scripts: [], gaps: [] }));
  await wait(15_000);
  const { scripts, gaps } = await crowded.page.evaluate(() => window.watched);
  say(`script of a frame, 10 residents and 100 sensors at ${speed}`, scripts);
  say(`frame to frame, the same`, gaps);
}
await crowded.close();

// From a key to the picture that it changes: somebody stands in a home in which nothing else moves.
const quiet = await serve('by-hand', { script });
await quiet.page.setViewportSize({ width: 1280, height: 720 });
await quiet.page.getByLabel('Who walks').selectOption({ index: 1 });
await quiet.page.getByRole('button', { name: 'New run' }).click();
await quiet.page.getByRole('button', { name: 'Play', exact: true }).click();
await quiet.page.getByRole('application').focus();
const latencies = [];
for (let press = 0; press < 60; press += 1) {
  // Long enough for sensors to have fired and faded.
  await wait(1500);
  await quiet.page.evaluate(() => Object.assign(window.watched, { keys: [], pictures: [] }));
  const code = press % 2 === 0 ? 'KeyD' : 'KeyA';
  await quiet.page.keyboard.down(code);
  await wait(200);
  await quiet.page.keyboard.up(code);
  const { keys, pictures } = await quiet.page.evaluate(() => window.watched);
  const picture = pictures.find((at) => at >= keys[0]);
  if (picture !== undefined) latencies.push(picture - keys[0]);
}
say('key to picture', latencies);
await quiet.close();

// From a move of a sensor to the heat map of what is seen then.
const plan = await serve('tigerplace', { script });
await plan.page.setViewportSize({ width: 1280, height: 720 });
await plan.page.goto(`${plan.address.split('#')[0]}#/plan`);
await plan.page.getByRole('tab', { name: 'List' }).click();
await plan.page.getByRole('textbox', { name: 'Find by name or kind' }).fill('kitchen motion');
await plan.page.getByRole('tabpanel').getByRole('button', { name: 'kitchen motion' }).first().click();
await plan.page.getByRole('application').focus();
const heats = [];
for (let press = 0; press < 60; press += 1) {
  await wait(400);
  await plan.page.evaluate(() => Object.assign(window.watched, { keys: [], heats: [] }));
  await plan.page.keyboard.press(press % 2 === 0 ? 'ArrowRight' : 'ArrowLeft');
  await wait(400);
  const { keys, heats: [drawn] } = await plan.page.evaluate(() => window.watched);
  if (drawn !== undefined) heats.push(drawn - keys[0]);
}
say('from a key that moves a sensor to the heat map drawn anew', heats);
await plan.close();

// A year that was lived: opened, and looked into at days that were not looked at before.
const year = await serve('tigerplace', { script });
await year.page.setViewportSize({ width: 1280, height: 720 });
year.homebody('run', 'tigerplace', '--for', '365d', '--quiet');
const origin = new URL(year.address).origin;
/** How long it takes until something is there after a view is opened, in seconds. */
async function opens(view, there) {
  const asked = performance.now();
  await year.page.goto(`${origin}/#/${view}/tigerplace-1`);
  await there.waitFor();
  return ((performance.now() - asked) / 1000).toFixed(2);
}
const daily = year.page.getByRole('heading', { name: 'Day by day' });
console.log(`care of a year opens in ${await opens('care', daily)} s`);
console.log(`a year's log is opened in ${await opens('playback', year.page.getByText('Day 1 of 365'))} s`);
console.log(`care of a year opens again in ${await opens('care', daily)} s`);
await opens('playback', year.page.getByText('Day 1 of 365'));
const scrubs = [];
for (let round = 0; round < 60; round += 1) {
  await wait(300);
  const took = await year.page.evaluate(async (share) => {
    const slider = document.querySelector('input[aria-label="Time in the run"]');
    performance.clearResourceTimings();
    window.watched.pictures = [];
    slider.value = String(Math.floor(Number(slider.max) * share));
    const begun = performance.now();
    slider.dispatchEvent(new Event('input', { bubbles: true }));
    await new Promise((done) => setTimeout(done, 600));
    const fetched = performance.getEntriesByType('resource').filter(({ name }) => /\/days\/\d+$/.test(name));
    const there = Math.max(begun, Math.min(...fetched.map(({ responseEnd }) => responseEnd), Infinity));
    const picture = window.watched.pictures.find((at) => at >= (Number.isFinite(there) ? there : begun));
    return picture === undefined ? null : picture - begun;
  }, (round * 0.6180339887) % 1);
  if (took !== null) scrubs.push(took);
}
say('scrubbed to a day that was not looked at', scrubs);

// Searches over the year, from the page and back, each of them several times.
const FINDS = {
  'in the bathroom between 0 and 6': { what: 'room', name: 'bathroom', between_min: [0, 360], least_s: 0 },
  'stove motion on for 30 minutes': { what: 'on', name: 'stove motion', between_min: null, least_s: 1800 },
  'no movement for 3 hours by day': { what: 'still', name: null, between_min: [480, 1200], least_s: 10_800 },
  'falls': { what: 'fall', name: null, between_min: null, least_s: 0 },
  'lost messages': { what: 'lost', name: null, between_min: null, least_s: 0 },
};
for (const [words, query] of Object.entries(FINDS)) {
  const took = await year.page.evaluate(async (query) => {
    const times = [];
    for (let round = 0; round < 12; round += 1) {
      const begun = performance.now();
      const answer = await fetch('/api/runs/tigerplace-1/find', {
        method: 'POST', headers: { 'content-type': 'application/json', 'x-homebody-token': sessionStorage['homebody-token'] }, body: JSON.stringify(query),
      });
      await answer.json();
      if (!answer.ok) throw new Error(String(answer.status));
      times.push(performance.now() - begun);
    }
    return times;
  }, query);
  say(`found in a year: ${words}`, took);
}

// The time line of a year, zoomed by the wheel from all of it to an hour and back.
const line = year.page.getByRole('group', { name: /^Timeline/ });
await line.focus();
await year.page.keyboard.press('a');
await year.page.getByText('365 d shown').waitFor();
await wait(2000);
await zoomed(year.page, `zooming the lanes of a year`);
await year.close();

/** Frame to frame while the wheel zooms in and out. */
async function zoomed(page, what) {
  const box = await page.getByRole('group', { name: /^Timeline/ }).boundingBox();
  await page.mouse.move(box.x + box.width * 0.6, box.y + 70);
  await page.evaluate(() => Object.assign(window.watched, { scripts: [], gaps: [] }));
  for (let turn = 0; turn < 160; turn += 1) {
    await page.mouse.wheel(0, turn % 40 < 20 ? -120 : 120);
    await wait(16);
  }
  const { scripts, gaps } = await page.evaluate(() => window.watched);
  say(`script of a frame, ${what}`, scripts);
  say(`frame to frame, ${what}`, gaps);
}

// A hundred sensors, over a year.
const wide = await serve('tigerplace', { script, prepare: (folder) => crowd(folder, 1) });
await wide.page.setViewportSize({ width: 1280, height: 900 });
wide.homebody('run', 'tigerplace', '--for', '365d', '--quiet');
await wide.page.goto(`${new URL(wide.address).origin}/#/playback/tigerplace-1`);
await wide.page.getByText(/^Day 1 of/).waitFor({ timeout: 300_000 });
await wide.page.getByRole('group', { name: /^Timeline/ }).focus();
await wide.page.keyboard.press('a');
await wait(8000);
await zoomed(wide.page, 'the same of 100 sensors');
await wide.close();
