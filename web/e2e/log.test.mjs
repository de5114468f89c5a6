// A logger's file is written in the page, and the database of the next run is as it says.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { playNewRun, serve } from './served.mjs';

let served;
before(async () => (served = await serve('tigerplace')));
after(() => served.close());

const logger = () => readFileSync(join(served.folder, 'tigerplace/logger.json'), 'utf8');
const rows = (place = 1) => served.page.getByRole('region', { name: `Rows of destination ${place}` });

/** The rows of a run's log, as the program reads them from its database: sensor and message. */
function stored(run) {
  served.homebody('convert', join('runs', run), '--to', `csv:${run}.csv`);
  const [head, ...lines] = readFileSync(join(served.folder, `${run}.csv`), 'utf8').trim().split('\n');
  const at = ['sensor', 'value'].map((name) => head.split(',').indexOf(name));
  return lines.map((line) => at.map((column) => line.split(',')[column]));
}

async function goTo(view) {
  await served.page.getByRole('link', { name: view, exact: true }).click();
}

test('table, columns, ids, messages and time are changed, and the first rows show it', { timeout: 240_000 }, async () => {
  const { page } = served;
  await goTo('Log');
  await rows().getByRole('columnheader', { name: 'event_code' }).waitFor();
  const before = logger();
  await page.getByRole('textbox', { name: 'Table' }).fill('reading');
  await page.getByRole('textbox', { name: 'Time', exact: true }).fill('read_at');
  await page.getByRole('textbox', { name: 'Sensor', exact: true }).fill('unit');
  await page.getByLabel('Id of bedroom motion').fill('Z9');
  await page.getByRole('radio', { name: /^ON, then OFF/ }).check();
  await page.getByLabel('Hold time in seconds').fill('7.5');
  await page.getByRole('combobox', { name: 'Time', exact: true }).selectOption({ label: 'Local time with UTC offset' });
  await rows().getByRole('columnheader', { name: 'read_at' }).waitFor();
  await rows().getByRole('cell', { name: 'Z9' }).first().waitFor();
  await rows().getByRole('cell', { name: 'OFF' }).first().waitFor();
  await rows().getByRole('cell', { name: /^2009-03-02T00:.*-06:00$/ }).first().waitFor();
  await page.getByText('table reading').waitFor();
  assert.equal(logger(), before, 'nothing is written before it is saved');
  await page.keyboard.press('Control+s');
  await page.getByText('All changes saved.').waitFor();
  const expected = before
    .replace('"event"', '"reading"').replace('"ts_local"', '"read_at"').replace('"sensor_id"', '"unit"').replace('"A1"', '"Z9"')
    .replace('"fire_only"', '{ "on_off": { "hold_s": 7.5 } }').replace('"time": "local"', '"time": "local_offset"');
  assert.equal(logger(), expected, 'only what was changed is another');
});

test('what is wrong stands beside its field, and a place outside the run is told', { timeout: 240_000 }, async () => {
  const { page } = served;
  const table = page.getByRole('textbox', { name: 'Table' });
  await table.fill('My Table');
  await page.getByText('cannot be the name of a table or a column').first().waitFor();
  assert.equal(await table.getAttribute('aria-invalid'), 'true');
  await page.getByRole('button', { name: 'Undo' }).click();
  assert.equal(await table.inputValue(), 'reading');
  await page.getByRole('button', { name: 'Test' }).click();
  await page.getByText('Homebody can write there').waitFor();
  await page.getByLabel('Address of destination 1').fill('/nowhere/at/all/log.db');
  await page.getByRole('button', { name: 'Test' }).click();
  await page.getByText("is not a file name inside the run's folder").first().waitFor();
  while (await page.getByRole('button', { name: 'Undo' }).isEnabled()) await page.getByRole('button', { name: 'Undo' }).click();
  while (await page.getByRole('button', { name: 'Redo' }).isEnabled()) await page.getByRole('button', { name: 'Redo' }).click();
  await page.getByLabel('Address of destination 1').fill('log.db');
  await page.getByText('All changes saved.').waitFor();
});

test('the next run is stored so, and is seen to grow', { timeout: 240_000 }, async () => {
  const { page } = served;
  await goTo('Live');
  await playNewRun(page);
  await page.locator('summary', { hasText: 'tigerplace-1' }).waitFor();
  await page.getByRole('button', { name: '100×: ' }).click();
  await goTo('Log');
  const map = page.getByRole('application', { name: 'Motion density' });
  await map.focus();
  await page.keyboard.press('ArrowDown');
  const hour = page.getByText(/^Mon, 2 March 2009, 00 to 01 h: [\d,]+ firings?$/);
  await hour.waitFor();
  const first = await hour.innerText();
  await page.waitForFunction((first) => document.querySelector('.foot .said').innerText !== first, first);
  await page.getByRole('checkbox', { name: 'Table' }).last().check();
  await page.getByRole('row', { name: /^bedroom motion [1-9]/ }).waitFor();
  await goTo('Live');
  await page.getByRole('button', { name: 'Stop' }).click();
  await page.getByText(/Stored .* rows in/).first().waitFor();
  const rows = stored('tigerplace-1');
  assert.ok(rows.length > 10, `${rows.length} rows`);
  assert.ok(rows.some(([sensor, message]) => sensor === 'Z9' && message === 'OFF'), 'no row of Z9 that says OFF');
  assert.ok(rows.every(([sensor]) => sensor !== 'A1' && sensor !== 'bedroom motion'), 'a row with the old id');
  // SQLite keeps texts as they are, and the statement that made a table as it was said.
  const bytes = readFileSync(join(served.folder, 'runs/tigerplace-1/log.db'), 'latin1');
  assert.match(bytes, /2009-03-02T00:\d\d:\d\d\.\d{6}-06:00/);
  const table = /CREATE TABLE[^"(]*"reading" \(([^(]*)/.exec(bytes)?.[1];
  assert.ok(table, 'there is no table "reading"');
  for (const column of ['run_id', 'seq', 'read_at', 'unit', 'event_code']) assert.ok(table.includes(column), `${column} is not in ${table}`);
});

test('the log is downloaded from the Log view as it is stored', { timeout: 240_000 }, async () => {
  const { page } = served;
  await goTo('Log');
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Export log' }).click()]);
  assert.deepEqual(readFileSync(await download.path()), readFileSync(join(served.folder, 'runs/tigerplace-1/log.db')));
});
