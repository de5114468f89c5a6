// Every view in light and dark, on a small screen and on a tablet: axe finds nothing, and nothing is wider than the window. With
// `PICTURES=FOLDER` it also leaves a picture of each.

import assert from 'node:assert/strict';
import { mkdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { setTimeout as wait } from 'node:timers/promises';
import { serve } from './served.mjs';

const axe = readFileSync(new URL('../node_modules/axe-core/axe.min.js', import.meta.url), 'utf8');
const VIEWS = { live: 'live', plan: 'plan', life: 'life', log: 'log', runs: 'playback', playback: 'playback/tigerplace-depression-1', found: 'playback/tigerplace-depression-1@2009-03-04T03:00:00', twins: 'playback/tigerplace-depression-1@2009-03-03T12:00:00', care: 'care/tigerplace-depression-1' };
const SIZES = [[1280, 720], [1024, 768]];
const folder = process.env.PICTURES;

let served;
before(async () => {
  served = await serve('tigerplace-depression');
  for (const seed of ['1', '2']) served.homebody('run', 'tigerplace-depression', '--for', '5d', '--quiet', '--seed', seed);
  if (folder) mkdirSync(folder, { recursive: true });
  const { page } = served;
  // Three days and a morning of it have been lived, on however fast a machine.
  const field = page.getByLabel('Date and time to go to');
  const start = await field.getAttribute('min');
  const morning = `${new Date(Date.parse(`${start.slice(0, 10)}T00:00:00Z`) + 3 * 86_400_000).toISOString().slice(0, 10)}T10:00:00`;
  await field.fill(morning);
  await page.getByRole('button', { name: 'Go', exact: true }).click();
  await page.locator('table[aria-rowcount] tbody tr[aria-rowindex]').first().waitFor();
  await page.getByRole('button', { name: 'Play', exact: true }).click();
});
after(() => served.close());

/** What is done in a view before it is looked at. */
const DONE = {
  async found(page) {
    await page.getByText('Find in the whole run').click();
    await page.getByRole('button', { name: 'Find', exact: true }).click();
    await page.getByRole('region', { name: 'Search results' }).waitFor();
    await page.getByLabel('Rooms').check();
    await page.getByText('Export', { exact: true }).click();
  },
  async twins(page) {
    await page.getByLabel('Compare with').selectOption('tigerplace-depression-2');
    await page.getByRole('region', { name: 'Differences on this day' }).getByRole('columnheader', { name: 'Only first' }).waitFor();
    await page.getByLabel('Heat map').check();
  },
};

for (const theme of ['light', 'dark']) {
  for (const [name, view] of Object.entries(VIEWS)) {
    test(`${name}, ${theme}`, { timeout: 240_000 }, async () => {
      const { page, address } = served;
      await page.emulateMedia({ colorScheme: theme });
      // What was chosen before is not.
      await page.goto('about:blank');
      await page.goto(`${address.split('#')[0]}#/${view}`);
      await DONE[name]?.(page);
      for (const [width, height] of SIZES) {
        await page.setViewportSize({ width, height });
        // The first size draws the view, the others only move it.
        await wait(width === SIZES[0][0] ? 1000 : 500);
        if (folder) await page.screenshot({ path: join(folder, `${name}-${theme}-${width}.png`) });
        await page.evaluate(axe);
        const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
        const wrong = violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 160)).join(' | ')}`);
        assert.deepEqual(wrong, [], `${width} wide`);
        const wide = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
        assert.ok(wide <= 0, `${wide} pixels wider than ${width}`);
      }
    });
  }
}
