// The care view of weeks in which a depression grows: its headline, a day by keyboard, a note that another browser sees, a sign that
// leads to playback, and two periods; axe finds nothing in it.

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
  served.homebody('run', 'tigerplace-depression', '--for', '90d', '--quiet');
  await served.page.goto(`${served.address.split('#')[0]}#/care/${RUN}`);
});
after(() => served.close());

const calendar = (page) => page.getByRole('region', { name: 'Calendar' });
const opened = (page) => page.getByRole('region', { name: 'Selected day' });

test('the first sentence says that something has changed, and since when', { timeout: 240_000 }, async () => {
  const state = served.page.getByRole('region', { name: 'State' });
  await state.getByText(/^(Changed|Look today)$/).waitFor();
  await state.getByText(/^Since about \d+ \w+: /).waitFor();
  await state.getByText(/Compared with .* \(28 complete days\)/).waitFor();
});

test('a day is found by keyboard, and what is noted about its episode another browser sees', { timeout: 240_000 }, async () => {
  const { page } = served;
  const found = calendar(page).getByRole('button', { name: /a change was found/ }).last();
  await found.waitFor();
  const day = /^\w+ (\d+ \w+ \d+)/.exec(await found.getAttribute('title'))[1];
  await calendar(page).locator('td button[tabindex="0"]').focus();
  for (let step = 0; step < 90 && !(await opened(page).getByRole('heading', { level: 2 }).innerText()).endsWith(day); step++) await page.keyboard.press('ArrowLeft');
  const isFocused = await found.evaluate((cell) => cell === document.activeElement);
  assert.ok(isFocused, 'the day that is open has the focus');
  await page.keyboard.press('Enter');
  await page.keyboard.press('Tab');
  await page.keyboard.press('Enter');
  const heading = await page.evaluate(() => document.activeElement.textContent);
  assert.match(heading, /^Since about|^From about/, 'the day leads to its episode');
  const episode = page.getByRole('region', { name: 'Changes' }).locator('.episode', { hasText: heading });
  await episode.getByRole('checkbox', { name: /^Dealt with/ }).check();
  await episode.getByRole('textbox', { name: /^Your name/ }).fill('Eve');
  await page.keyboard.press('Tab');
  await episode.getByRole('textbox', { name: /^Note on/ }).fill('rang her son');
  await page.keyboard.press('Tab');
  const other = await served.context.newPage();
  const place = join(served.folder, 'runs', RUN, 'care-notes.json');
  await until(() => readIf(place).includes('rang her son'), 'the note is on disk');
  await other.goto(served.address);
  await other.goto(await page.evaluate(() => window.location.href));
  await other.getByText(/^Dealt with by Eve on .*: rang her son$/).waitFor();
  await other.close();
});

function readIf(place) {
  try {
    return readFileSync(place, 'utf8');
  } catch {
    return '';
  }
}

test('a sign opens to its days, and to the evening on which one began', { timeout: 240_000 }, async () => {
  const { page } = served;
  const changed = page.getByRole('region', { name: 'Changes' });
  const folded = changed.locator('details.episode > summary').first();
  if (await folded.isVisible()) await folded.click();
  await changed.locator('.signs summary').first().click();
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
  await spans.getByRole('row', { name: /^Getting up/ }).waitFor();
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
