// A log of a home is opened in Playback: it is walked back, played with its doubt, and told of. With `PICTURES=FOLDER` it leaves a
// picture of each sight.

import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { setTimeout as wait } from 'node:timers/promises';
import { serve, until } from './served.mjs';

const axe = readFileSync(new URL('../node_modules/axe-core/axe.min.js', import.meta.url), 'utf8');
const pictures = process.env.PICTURES;

let served;
let log;
before(async () => {
  served = await serve('tigerplace');
  served.homebody('run', 'tigerplace', '--for', '3d', '--quiet');
  log = join(served.folder, 'real.txt');
  served.homebody('convert', 'runs/tigerplace-1', '--to', 'casas:real.txt');
  if (pictures) mkdirSync(pictures, { recursive: true });
});
after(() => served.close());

async function picture(name) {
  if (!pictures) return;
  await wait(700);
  await served.page.screenshot({ path: join(pictures, `${name}.png`) });
}

/** Axe finds nothing, and nothing is wider than the window. */
async function isSound(what) {
  const { page } = served;
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
  assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 160)).join(' | ')}`), [], what);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
  assert.ok(wide <= 0, `${what}: ${wide} pixels too wide`);
}

/** Where she most likely is, by the table. */
const likeliest = () => served.page.getByRole('row', { name: /margaret/ }).getByRole('cell').first().innerText();

async function open(file) {
  const { page, address } = served;
  if (!page.url().includes('#/playback')) await page.goto(`${address.split('#')[0]}#/playback`);
  await page.getByRole('button', { name: 'Open a log' }).waitFor();
  await page.getByLabel('A log', { exact: true }).setInputFiles(file);
  await page.getByRole('button', { name: 'Locate people' }).click();
}

test('a log is opened, and she walks in it where she was, with doubt', { timeout: 240_000 }, async () => {
  const { page } = served;
  await open(log);
  await page.getByText('real.txt, people located').first().waitFor({ state: 'attached' });
  await page.getByText('Certainty:').waitFor();
  await page.getByText('Day 1 of 3').waitFor();

  // The truth of the run that the log is of, which the page was not given.
  const truth = served.homebody('day', 'runs/tigerplace-1', '2009-03-03', '--json');
  const { residents } = JSON.parse(truth);
  const rooms = residents[0].rooms.map(({ begin_s, end_s, what }) => [begin_s, end_s, what]);
  const slider = page.getByLabel('Time of the day');
  await page.getByRole('button', { name: 'Next day' }).click();
  const [begin, end] = [Number(await slider.getAttribute('min')), Number(await slider.getAttribute('max'))];
  let [right, asked] = [0, 0];
  for (let at = begin + 450e6; at < end; at += 1_800e6) {
    await slider.fill(String(at));
    const clock = (await page.locator('.clock strong').first().innerText()).slice(0, 8);
    const where = roomAt(rooms, clock);
    if (where === null) continue;
    await wait(60);
    asked += 1;
    if ((await likeliest()).startsWith(where)) right += 1;
  }
  assert.ok(asked > 24, `${asked} times are known`);
  assert.ok(right >= 0.85 * asked, `she was where she was told ${right} of ${asked} times`);
});

function roomAt(rooms, clock) {
  const [hours, minutes, seconds] = clock.split(':').map(Number);
  const at = hours * 3600 + minutes * 60 + seconds;
  return rooms.find(([begin, end]) => begin <= at && at < end)?.[2] ?? null;
}

test('it plays, is gone through from room to room, and the real log’s rows stand beside', { timeout: 240_000 }, async () => {
  const { page } = served;
  const clock = page.locator('.clock strong').first();
  await page.getByRole('button', { name: 'Next room' }).click();
  const before = await clock.innerText();
  await page.getByRole('button', { name: '10×: ' }).click();
  await page.getByRole('button', { name: 'Play', exact: true }).click();
  await until(async () => (await clock.innerText()) !== before, 'another time');
  await page.getByRole('button', { name: 'Pause', exact: true }).click();
  await page.getByRole('row', { name: /motion.*ON/ }).first().waitFor();
  await page.getByText('Show located people').click();
  assert.equal(await page.getByText('Certainty:').count(), 0);
  await page.getByText('Show located people').click();
});

for (const [scheme, width, height] of [['light', 1280, 800], ['dark', 1280, 800], ['light', 390, 844], ['dark', 390, 844]]) {
  test(`it is sound in ${scheme}, ${width} wide`, { timeout: 240_000 }, async () => {
    const { page } = served;
    await page.emulateMedia({ colorScheme: scheme });
    await page.setViewportSize({ width, height });
    // Soon after she has got up nobody can be sure.
    for (let pressed = 0; pressed < 3; pressed += 1) await page.getByRole('button', { name: 'Next room' }).click();
    await page.evaluate(() => window.scrollTo(0, 0));
    await isSound(`${scheme} ${width}`);
    await picture(`walk-${scheme}-${width}`);
    for (const name of ['Log summary', 'Realism check']) {
      await page.getByRole('button', { name }).click();
      await page.getByRole('region', { name }).waitFor();
      const dialog = page.getByRole('dialog');
      assert.ok((await dialog.locator('.page svg').count()) > 0, 'no picture');
      await isSound(`${name}, ${scheme} ${width}`);
      await picture(`${name.split(' ')[0].toLowerCase()}-${scheme}-${width}`);
      await page.keyboard.press('Escape');
    }
  });
}

test('what cannot be opened is said, and a file may be let fall on the page', { timeout: 240_000 }, async () => {
  const { page } = served;
  await page.setViewportSize({ width: 1280, height: 1600 });
  const [strange, empty] = ['strange.txt', 'empty.txt'].map((name) => join(served.folder, name));
  writeFileSync(strange, readFileSync(log, 'utf8').replace(/\b([A-Z]\d+)\b/g, 'X$1'));
  writeFileSync(empty, '');
  await open(strange);
  await page.getByText(/No sensor of the log is a sensor of the home\. The log has/).waitFor();
  await picture('refused');
  await open(empty);
  await page.getByText('empty.txt is empty.').waitFor();

  const transfer = await page.evaluateHandle(() => {
    const data = new DataTransfer();
    data.items.add(new File(['2009-03-02 10:00:00 A1 ON\n'], 'fallen.txt'));
    return data;
  });
  await page.dispatchEvent('.playback', 'drop', { dataTransfer: transfer });
  const dialog = page.getByRole('dialog');
  await dialog.getByText('fallen.txt').waitFor();
  await dialog.getByLabel('Floor plan').selectOption({ label: 'tigerplace-1 · tigerplace' });
  await picture('asked');
  await dialog.getByRole('button', { name: 'Locate people' }).click();
  await page.getByText('fallen.txt, people located').first().waitFor({ state: 'attached' });
});
