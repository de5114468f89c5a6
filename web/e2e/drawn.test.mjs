// A home is drawn from nothing to a lived day, in a real browser, by so few actions. An action is a click, a key, a choice, or a text
// that is typed with the key that ends it. With `PICTURES=FOLDER` it leaves a film strip of it.

import assert from 'node:assert/strict';
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { looked, serveLibrary } from './served.mjs';

const MOST_ACTIONS = 60;
const pictures = process.env.PICTURES;

let served;
before(async () => {
  served = await serveLibrary([]);
  if (pictures) mkdirSync(pictures, { recursive: true });
  await served.page.setViewportSize({ width: 1280, height: 800 });
});
after(() => served.close());

let actions = 0;
async function act(done) {
  actions += 1;
  await done();
}

/** Where a place of the plan is on the screen, by how the plan lies there now. */
async function spot([east, north]) {
  const { page } = served;
  const area = await page.getByRole('application').boundingBox();
  const transform = await page.locator('[role="application"] svg > g').first().getAttribute('transform');
  const [x, y, scale] = /translate\((\S+) (\S+)\) scale\((\S+)/.exec(transform).slice(1).map(Number);
  return [area.x + x + east * scale, area.y + y - north * scale];
}

const press = (name) => act(() => served.page.getByRole('button', { name, exact: true }).click());
const click = (at) => act(async () => served.page.mouse.click(...(await spot(at))));
const type = (length, way) => act(async () => {
  await served.page.keyboard.type(length);
  await served.page.keyboard.press(way);
});
const call = (name) => act(async () => {
  const field = served.page.getByRole('textbox', { name: 'Name', exact: true });
  await field.fill(name);
  await field.press('Enter');
});

let frames = 0;
/** A picture of 640 pixels, made smaller in a page of its own. */
async function picture() {
  if (!pictures) return;
  const { page, context } = served;
  await page.waitForTimeout(700);
  const whole = (await page.screenshot()).toString('base64');
  const small = await context.newPage();
  const url = await small.evaluate(async (whole) => {
    const bytes = Uint8Array.from(atob(whole), (c) => c.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes]), { resizeWidth: 640, resizeHeight: 400, resizeQuality: 'high' });
    const canvas = new OffscreenCanvas(640, 400);
    canvas.getContext('2d').drawImage(image, 0, 0);
    const blob = await canvas.convertToBlob({ type: 'image/png' });
    return [...new Uint8Array(await blob.arrayBuffer())];
  }, whole);
  await small.close();
  writeFileSync(join(pictures, `drawn-${++frames}.png`), Buffer.from(url));
  await page.bringToFront();
}

test('a home is drawn from nothing to a lived day', { timeout: 240_000 }, async () => {
  const { page } = served;
  await press('New home');
  await press('Create home');
  await page.getByRole('application').waitFor();

  // Walls by typed lengths.
  await press('Wall');
  await click([0.5, 0.5]);
  await type('9', 'ArrowRight');
  await type('6', 'ArrowUp');
  await picture();
  await type('9', 'ArrowLeft');
  await type('6', 'ArrowDown');
  await click([6, 0.5]);
  await type('6', 'ArrowUp');
  await click([6, 3]);
  await type('3.5', 'ArrowRight');
  for (const [name, at] of [['living room', [3, 3]], ['bedroom', [8, 5]], ['bathroom', [8, 2]]]) {
    await press('Fill');
    await click(at);
    await call(name);
  }
  for (const at of [[3.5, 0.5], [6, 4.2], [6, 1.6]]) {
    await press('Door');
    await click(at);
  }
  await picture();

  const [place, size] = [await spot([1, 1]), await page.getByRole('application').boundingBox()];
  await press('Furniture');
  assert.deepEqual([await spot([1, 1]), await page.getByRole('application').boundingBox()], [place, size], 'the plan stays where it is');
  const FURNITURE = [
    ['bed', [9.1, 5.6]], ['armchair', [0.9, 1.8]], ['toilet', [9, 0.9]], ['washbasin', [7.4, 0.8]],
    ['stove', [1.2, 6.2]], ['fridge', [2.2, 6.2]], ['sink', [3.2, 6.2]], ['table', [3.4, 3.4]], ['chair', [3.4, 2.7]],
  ];
  for (const [name, at] of FURNITURE) {
    await act(() => page.getByRole('group', { name: 'Furniture' }).getByRole('button', { name: new RegExp(`^${name} ?\\d`) }).click());
    await click(at);
    if (name === 'toilet') await picture();
  }
  await press('Sensor');
  for (const at of [[0.8, 4.2], [6.3, 6.2], [9.2, 2.7]]) {
    await act(() => page.getByRole('group', { name: 'Sensors' }).getByRole('button', { name: 'motion, on a wall', exact: true }).click());
    await click(at);
  }
  await picture();
  await looked(page, 'drawing', process.env.LOOKS);

  await act(() => page.keyboard.press('Control+s'));
  await page.getByText('All changes saved.').waitFor();
  assert.deepEqual(JSON.parse(served.homebody('check', 'home', '--json')).problems, []);
  await act(() => page.getByRole('link', { name: 'Live' }).click());
  await act(() => page.getByRole('button', { name: /New run/ }).click());
  const field = page.getByLabel('Date and time to go to');
  await field.waitFor();
  const start = await field.getAttribute('min');
  await act(() => field.fill(new Date(Date.parse(`${start}Z`) + 24 * 3_600_000).toISOString().slice(0, 19)));
  await press('Go');
  await page.getByText('day 2 of 7').waitFor();
  await page.getByRole('button', { name: 'Play', exact: true }).waitFor();
  await picture();
  console.log(`${actions} actions`);
  assert.ok(actions < MOST_ACTIONS, `${actions} actions`);

  // What was lived is a day: she was in bed, at the table and in the bathroom.
  await page.getByRole('button', { name: 'Stop', exact: true }).click();
  await page.getByRole('link', { name: 'All homes' }).click();
  await page.getByRole('article', { name: 'home' }).getByText('home-1').waitFor();
  await picture();
  const found = (...words) => JSON.parse(served.homebody('find', 'home/runs/home-1', ...words, '--json')).found;
  for (const room of ['living room', 'bedroom', 'bathroom']) assert.ok(found('room', room).length > 0, `somebody was in the ${room}`);
});
