// The care view of weeks in which a depression grows: by keyboard through the calendar, a note that another browser sees, a sentence
// that leads to playback, and two spans; axe finds nothing in it.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { serve, until } from './served.mjs';

const RUN = 'tigerplace-depression-1';
const axe = readFileSync(new URL('../node_modules/axe-core/axe.min.js', import.meta.url), 'utf8');

let served;
before(async () => {
  served = await serve('tigerplace-depression');
  served.homebody('run', 'tigerplace-depression', '--for', '60d', '--quiet');
  await served.page.goto(`${served.address.split('#')[0]}#/care/${RUN}`);
});
after(() => served.close());

const calendar = (page) => page.getByRole('region', { name: 'Calendar' });
const opened = (page) => page.getByRole('region', { name: 'Selected day' });

test('a day is found by keyboard, and what is noted about its alert another browser sees', { timeout: 240_000 }, async () => {
  const { page } = served;
  const alert = calendar(page).getByRole('button', { name: /alert open/ }).last();
  await alert.waitFor();
  const day = /^\w+ (\d+ \w+ \d+)/.exec(await alert.getAttribute('title'))[1];
  await calendar(page).locator('td button[tabindex="0"]').focus();
  for (let step = 0; step < 70 && !(await opened(page).getByRole('heading').innerText()).endsWith(day); step++) await page.keyboard.press('ArrowLeft');
  const isFocused = await alert.evaluate((cell) => cell === document.activeElement);
  assert.ok(isFocused, 'the day that is open has the focus');
  await page.keyboard.press('Enter');
  await page.keyboard.press('Tab');
  await opened(page).getByRole('checkbox').first().check();
  await opened(page).getByRole('textbox', { name: /^Note on .*:/ }).first().fill('rang her son');
  await page.keyboard.press('Tab');
  const other = await served.context.newPage();
  const place = join(served.folder, 'runs', RUN, 'care-notes.json');
  await until(() => readIf(place).includes('rang her son'), 'the note is on disk');
  await other.goto(served.address);
  await other.goto(await page.evaluate(() => window.location.href));
  await opened(other).getByRole('checkbox').first().waitFor();
  await other.waitForFunction(() => [...document.querySelectorAll('.opened input')].some(({ value }) => value === 'rang her son'));
  assert.ok(await opened(other).getByRole('checkbox').first().isChecked());
  await other.close();
});

function readIf(place) {
  try {
    return readFileSync(place, 'utf8');
  } catch {
    return '';
  }
}

test('a sentence opens down to its days, and to the evening on which one began', { timeout: 240_000 }, async () => {
  const { page } = served;
  const changed = page.getByRole('region', { name: 'Changes' });
  await changed.locator('summary').first().click();
  const link = changed.getByRole('link', { name: /^Watch/ }).first();
  const moment = /@(\d+-\d+-\d+)T(\d+:\d+)/.exec(await link.getAttribute('href'));
  await link.click();
  const clock = new RegExp(`^${Number(moment[1].slice(8))} \\w+, ${moment[2]}`);
  const slider = page.getByLabel('Time of the day');
  await slider.waitFor();
  const shown = () => slider.getAttribute('aria-valuetext');
  await until(async () => clock.test((await shown()) ?? ''), async () => `${clock}, while the page shows ${await shown()}`);
  await page.goBack();
  await changed.waitFor();
});

test('two spans, and no violation in light or dark, nor on a telephone', { timeout: 240_000 }, async () => {
  const { page } = served;
  await page.goto(`${served.address.split('#')[0]}#/care/${RUN}`);
  const spans = page.getByRole('region', { name: 'Compare two periods' });
  await spans.getByRole('row', { name: /^Sleep/ }).waitFor();
  for (const [width, colorScheme] of [[1280, 'light'], [1024, 'dark'], [390, 'light']]) {
    await page.emulateMedia({ colorScheme });
    await page.setViewportSize({ width, height: 800 });
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
    assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 160)}`), [], `${width}, ${colorScheme}`);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
    assert.ok(wide <= 0, `${wide} pixels wider than ${width}`);
  }
});
