// Names that are longer than their places, up to 4 kB: nothing gets wider for them, and the whole is read by hovering and by keys.

import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { serve } from './served.mjs';

const words = (count, what) => Array.from({ length: count }, (_, index) => `${what}${index}`).join(' ');
/** Longer than a home may have: the page opens on it all the same, and says so. */
const HUGE = words(640, 'very').slice(0, 4096).trim();
const LONG = words(16, 'long').slice(0, 100).trim();

let served;
before(async () => {
  served = await serve('studio', {
    prepare(folder) {
      const path = join(folder, 'home.json');
      const home = JSON.parse(readFileSync(path, 'utf8'));
      home.sensors[0].name = HUGE;
      home.sensors[1].name = LONG;
      writeFileSync(path, JSON.stringify(home, null, 2));
    },
  });
  const { page, address } = served;
  await page.setViewportSize({ width: 1280, height: 800 });
  await page.goto('about:blank');
  await page.goto(`${address.split('#')[0]}#/plan`);
  await page.getByRole('application').waitFor();
  await page.getByRole('tab', { name: 'List' }).click();
});
after(() => served.close());

const whole = () => served.page.getByRole('tooltip');
const entry = (name) => served.page.getByRole('tabpanel').getByRole('button', { name: name.slice(0, 40) }).first();

test('what is cut is read by keys', { timeout: 240_000 }, async () => {
  const { page } = served;
  for (const name of [LONG, HUGE]) {
    await page.getByRole('textbox', { name: 'Find by name or kind' }).fill(name.slice(0, 12));
    await entry(name).waitFor();
    await page.keyboard.press('Tab');
    for (let presses = 0; presses < 12 && !(await entry(name).evaluate((one) => one === document.activeElement)); presses++) await page.keyboard.press('Tab');
    await whole().waitFor();
    assert.equal(await whole().innerText(), name);
    const { x, y, width, height } = await whole().boundingBox();
    assert.ok(x >= 0 && y >= 0 && x + width <= 1280 && y + height <= 800, 'it is within the window');
    await page.keyboard.press('Escape');
    assert.equal(await whole().count(), 0);
  }
});

test('what no hint of a browser has room for is read by hovering', { timeout: 240_000 }, async () => {
  const { page } = served;
  await page.mouse.move(5, 5);
  const { x, y, width, height } = await entry(HUGE).locator('.name').boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await whole().waitFor();
  assert.equal(await whole().innerText(), HUGE);
  await page.getByRole('textbox', { name: 'Find by name or kind' }).fill('');
  await page.mouse.move(5, 5);
  await whole().waitFor({ state: 'detached' });
});

test('nothing is wider than its window for a long name, whatever the view', { timeout: 240_000 }, async () => {
  const { page, address } = served;
  for (const view of ['live', 'plan', 'life', 'log', 'playback']) {
    await page.goto(`${address.split('#')[0]}#/${view}`);
    for (const width of [390, 768, 1280, 1920]) {
      await page.setViewportSize({ width, height: 800 });
      await page.waitForTimeout(400);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
      assert.ok(wide <= 0, `${view}: ${wide} pixels wider than ${width}`);
    }
  }
});
