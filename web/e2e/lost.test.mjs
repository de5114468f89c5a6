// A line that is cut, and a server that is started again: the page says so, goes on by itself where it can, and loses nothing.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { setTimeout as wait } from 'node:timers/promises';
import { serve } from './served.mjs';

let served;
before(async () => (served = await serve('studio')));
after(() => served.close());

const lost = (page) => page.getByText('connection lost, reconnecting');
const connected = (page) => page.getByText('connected', { exact: true });

test('a line that is cut is told, and found again while the run goes on', { timeout: 240_000 }, async () => {
  const { context, address } = served;
  const page = await context.newPage();
  let [line, isCut] = [null, false];
  await page.routeWebSocket(/api\/live/, (wire) => {
    if (isCut) wire.close();
    else {
      line = wire;
      wire.connectToServer();
    }
  });
  await page.goto(address);
  await connected(page).waitFor();
  await page.getByRole('button', { name: '100×: ' }).click();
  await page.getByRole('button', { name: 'Play', exact: true }).click();
  const now = () => page.getByRole('slider', { name: 'Time in the run' }).evaluate((slider) => Number(slider.value));
  await page.getByRole('button', { name: 'Pause', exact: true }).waitFor();
  isCut = true;
  await line.close();
  await lost(page).waitFor();
  await page.getByRole('button', { name: 'Pause', exact: true }).click();
  await page.getByText('Not connected to the server. Nothing was changed.').waitFor();
  // Text is a little behind the drawing.
  await wait(500);
  const before = await now();
  await wait(500);
  assert.equal(await now(), before, 'what is not known is not shown');
  isCut = false;
  await connected(page).waitFor();
  await page.waitForFunction((before) => Number(document.querySelector('[aria-label="Time in the run"]').value) > before + 100e6, before);
  await page.getByRole('button', { name: 'Pause', exact: true }).click();
  await page.getByRole('button', { name: 'Play', exact: true }).waitFor();
  await page.close();
});

test('what was written outlives a server that is started again', { timeout: 240_000 }, async () => {
  const { page, address } = served;
  await page.goto(`${address.split('#')[0]}#/life`);
  const editor = page.getByRole('textbox', { name: /^Routine of walter/ });
  await page.getByText('Every sentence is understood.').waitFor();
  await editor.click();
  await page.keyboard.press('Control+End');
  await page.keyboard.type('\nHe reads at about 20:00 for 1 hour.');
  await page.getByText('walter.routine is not saved.').waitFor();
  const again = await served.gone();
  await lost(page).waitFor();
  const next = await again();
  // Each start has a token of its own.
  await page.getByLabel('Address or access token').waitFor();
  await page.getByLabel('Address or access token').fill(next);
  await page.getByRole('button', { name: 'Connect' }).click();
  await connected(page).waitFor();
  await page.getByText('walter.routine is not saved.').waitFor();
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  await page.getByText('All changes saved.').waitFor();
  assert.match(readFileSync(join(served.folder, 'studio/walter.routine'), 'utf8'), /He reads at about 20:00 for 1 hour\.$/);
  // The browser says itself that nobody answered, and that the first token is not that of the second.
  const expected = /ERR_CONNECTION_REFUSED|WebSocket connection|401 \(Unauthorized\)/;
  assert.deepEqual(served.wrong.splice(0).filter((text) => !expected.test(text)), []);
});
