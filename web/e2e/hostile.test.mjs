// Names that try to break out of where they are shown: in every view, nothing of them is run, and nothing is broken by them.

import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { setTimeout as wait } from 'node:timers/promises';
import { serve } from './served.mjs';

const EVIL = [
  '<script>window.broken=1</script>',
  '<img src=x onerror="window.broken=1">',
  '"><svg onload=window.broken=1>',
  "'-window.broken-'",
  '{@html "<b>broken</b>"}',
  'javascript:window.broken=1',
  '</style></title></textarea>',
  '👩‍👩‍👧‍👦🛁',
  '\u202egnihton غرفة النوم',
  'very '.repeat(19),
  '__proto__',
  'constructor',
];

let served;
before(async () => {
  served = await serve('tigerplace', {
    prepare(folder) {
      const change = (name, alter) => {
        const path = join(folder, name);
        const value = JSON.parse(readFileSync(path, 'utf8'));
        alter(value);
        writeFileSync(path, JSON.stringify(value, null, 2));
      };
      const names = new Map();
      change('home.json', (home) => {
        home.name = EVIL[0];
        home.sensors.slice(0, EVIL.length).forEach((sensor, index) => {
          names.set(sensor.name, EVIL[index]);
          sensor.name = EVIL[index];
        });
        home.furniture.find(({ name }) => name === 'bookcase').name = EVIL[1];
        home.places.find(({ name }) => name === 'coats').name = EVIL[2];
      });
      change('logger.json', (logger) => {
        logger.ids = Object.fromEntries(Object.entries(logger.ids).filter(([name]) => !names.has(name)));
        logger.ids[EVIL[0]] = '<b>broken</b>';
      });
      change('scenario.json', (scenario) => {
        scenario.name = EVIL[1];
        scenario.about = EVIL[0];
      });
    },
  });
});
after(() => served.close());

test('whatever things are called, the page shows it as text', { timeout: 240_000 }, async () => {
  const { page, address } = served;
  const origin = address.split('#')[0];
  const refused = [];
  page.on('console', (message) => /Content Security Policy/.test(message.text()) && refused.push(message.text()));
  await page.getByRole('button', { name: 'Play', exact: true }).click();
  await page.getByRole('button', { name: '1,000×: ' }).click();
  await wait(2500);
  await page.getByRole('button', { name: 'Stop' }).click();
  await page.getByText(/Stored .* rows in/).first().waitFor();
  assert.ok((await page.getByRole('banner').innerText()).includes(EVIL[1]), 'the name is shown as it is');
  const [run] = served.runs();
  for (const view of ['live', 'plan', 'life', 'log', 'playback', `care/${encodeURIComponent(run)}`, `playback/${encodeURIComponent(run)}`]) {
    await page.goto(`${origin}#/${view}`);
    await wait(1000);
    assert.equal(await page.evaluate(() => window.broken), undefined, view);
    assert.equal(await page.locator('main').count(), 1, view);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
    assert.ok(wide <= 0, `${view} is ${wide} pixels wider than its window`);
    assert.equal(await page.locator('img[src="x"], svg[onload], b:text("broken")').count(), 0, view);
  }
  assert.deepEqual(refused, []);
});
