// Somebody drives a resident through the apartment, and finds in the database what the page has shown.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { setTimeout as wait } from 'node:timers/promises';
import { playNewRun, serve } from './served.mjs';

let served;
before(async () => (served = await serve('tigerplace')));
after(() => served.close());

/** Holds a key for so many seconds. */
async function hold(page, code, seconds) {
  await page.keyboard.down(code);
  await wait(seconds * 1000);
  await page.keyboard.up(code);
  await wait(150);
}

/** The table's rows: time, the sensor as the log calls it, message. */
const shown = (page) =>
  page.locator('table[aria-rowcount] tbody tr[aria-rowindex]').evaluateAll((rows) =>
    rows.map((row) => [...row.querySelectorAll('td')].map((cell) => cell.innerText.trim().split('\n').at(-1))));

/** The rows of a run's log, in the order in which they were stored: sensor and message. */
function stored(run) {
  served.homebody('convert', join('runs', run), '--to', `csv:${run}.csv`);
  const [head, ...lines] = readFileSync(join(served.folder, `${run}.csv`), 'utf8').trim().split('\n');
  const columns = head.split(',');
  const at = ['sensor', 'value'].map((name) => columns.findIndex((column) => column.startsWith(name)));
  return lines.map((line) => at.map((column) => line.split(',')[column]));
}

test('the keys drive her to the kitchen, and what sensors said is in SQLite', { timeout: 240_000 }, async () => {
  const { page } = served;
  await page.getByLabel('Keyboard controls').selectOption({ label: 'margaret' });
  await playNewRun(page);
  await page.getByRole('application').focus();
  // From beside the bed through the hall and the living room.
  const way = [['KeyD', 2.6], ['KeyS', 3.0], ['ArrowRight', 2.3], ['KeyW', 2.0], ['KeyD', 3.2], ['ArrowDown', 2.3]];
  for (const [code, seconds] of way) await hold(page, code, seconds);
  await page.getByRole('cell', { name: 'kitchen', exact: true }).waitFor();
  await wait(2500);
  await page.getByRole('button', { name: 'Stop' }).click();
  await page.getByText(/Stored .* rows in/).first().waitFor();
  const rows = (await shown(page)).reverse();
  assert.ok(rows.length > 5, `${rows.length} rows are shown`);
  assert.deepEqual(served.runs(), ['tigerplace-1']);
  const log = stored('tigerplace-1');
  assert.deepEqual(rows.map(([, sensor, message]) => [sensor, message]), log);
  // Kitchen motion is B5 in this network.
  assert.ok(log.some(([sensor]) => sensor === 'B5' || sensor === 'kitchen motion'), JSON.stringify(log));
});

test('the recording is lived again, to the same firings', { timeout: 240_000 }, async () => {
  const { page } = served;
  const before = await shown(page);
  await page.getByRole('button', { name: 'Replay' }).click();
  await page.getByRole('button', { name: 'As fast as possible' }).click();
  await page.getByText('The replay matches the recording').first().waitFor();
  await page.locator(`tr[aria-rowindex="${before.length + 1}"]`).waitFor();
  assert.deepEqual(await shown(page), before);
  assert.match(served.homebody('replay', 'runs/tigerplace-1/recording.json', '--out', 'csv:again.csv'), /identical to the recording/);
});

test('the log is downloaded as it is stored', { timeout: 240_000 }, async () => {
  const { page } = served;
  await page.getByText(/^Recording: |^Stored: |tigerplace-1/).first().click();
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Export log' }).click()]);
  const bytes = readFileSync(await download.path());
  assert.deepEqual(bytes, readFileSync(join(served.folder, 'runs/tigerplace-1/log.db')));
});

test('a page that is loaded anew, and a second one, see the same run', { timeout: 240_000 }, async () => {
  const { page, context, address } = served;
  await page.reload();
  await page.getByRole('application').waitFor();
  const other = await context.newPage();
  await other.goto(address);
  await other.getByRole('application').waitFor();
  await playNewRun(page);
  await page.getByRole('button', { name: '100×: ' }).click();
  await other.getByRole('button', { name: 'Pause', exact: true }).waitFor();
  await other.getByRole('button', { name: 'Pause', exact: true }).click();
  await page.getByRole('button', { name: 'Play', exact: true }).waitFor();
  await other.close();
});
