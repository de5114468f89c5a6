// A file is written here and by another program at once: neither loses what was written.

import assert from 'node:assert/strict';
import { readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { serve } from './served.mjs';

let served;
let editor;
before(async () => {
  served = await serve('tigerplace');
  const { page, address } = served;
  await page.goto(`${address.split('#')[0]}#/life`);
  editor = page.getByRole('textbox', { name: /^Routine of margaret/ });
  await page.getByText('Every sentence is understood.').waitFor();
});
after(() => served.close());

const path = () => join(served.folder, 'tigerplace/margaret.routine');
const onDisk = () => readFileSync(path(), 'utf8');
const shown = () => editor.evaluate((editor) => [...editor.querySelectorAll('.cm-line')].map((line) => line.textContent).join('\n'));

/** Writes a sentence at the end, in the page. */
async function write(sentence) {
  await editor.click();
  await served.page.keyboard.press('Control+End');
  await served.page.keyboard.type(`\n${sentence}`);
  await served.page.keyboard.press('Escape');
  await served.page.getByText('margaret.routine is not saved.').waitFor();
}

const question = () => served.page.getByRole('alert').filter({ hasText: /was (changed on|deleted from) disk/ });

test('what nobody here has changed is shown as it is on disk', { timeout: 240_000 }, async () => {
  writeFileSync(path(), `${onDisk()}\nOften she drinks.`);
  await served.page.waitForFunction(() => document.querySelector('main').innerText.includes('has a drink'));
  assert.match(await shown(), /Often she drinks\.$/);
});

test('what was changed here and there is asked about, and mine can be kept', { timeout: 240_000 }, async () => {
  const { page } = served;
  await write('Often she exercises.');
  const theirs = `${onDisk()}\nOften she has a snack.`;
  writeFileSync(path(), theirs);
  await question().waitFor();
  // Asked or not, saving does not replace what has not been decided on.
  await page.keyboard.press('Control+s');
  await page.getByText('margaret.routine is not saved.').waitFor();
  assert.equal(onDisk(), theirs);
  await question().getByRole('button', { name: 'Keep my version' }).click();
  await page.keyboard.press('Control+s');
  await page.getByText('All changes saved.').waitFor();
  assert.match(onDisk(), /Often she exercises\.$/);
  assert.doesNotMatch(onDisk(), /snack/);
});

test('theirs can be taken, and a file that has gone is made again', { timeout: 240_000 }, async () => {
  const { page } = served;
  await write('Often she naps.');
  const theirs = onDisk().replace('Often she exercises.', 'Often she relaxes.');
  writeFileSync(path(), theirs);
  await question().getByRole('button', { name: 'Use the version on disk' }).click();
  await page.getByText('All changes saved.').waitFor();
  assert.match(await shown(), /Often she relaxes\.$/);
  assert.equal(onDisk(), theirs);

  await write('Often she reads.');
  rmSync(path());
  await question().getByRole('button', { name: 'Keep my version' }).click();
  await page.keyboard.press('Control+s');
  await page.getByText('All changes saved.').waitFor();
  assert.equal(onDisk(), `${theirs}\nOften she reads.`);
});

test('what is not saved is not lost with a view, and a connection that is lost is told', { timeout: 240_000 }, async () => {
  const { page, context } = served;
  await write('Often she phones.');
  await page.evaluate(() => (window.location.hash = '#/live'));
  await page.getByRole('application').waitFor();
  await page.evaluate(() => (window.location.hash = '#/life'));
  await page.getByText('margaret.routine is not saved.').waitFor();
  await editor.getByText('Often she phones.').waitFor();
  assert.match(await shown(), /Often she phones\.$/);
  await context.setOffline(true);
  await page.keyboard.press('Control+s');
  await page.getByRole('alert').filter({ hasText: 'Not saved' }).waitFor();
  await context.setOffline(false);
  served.wrong.length = 0;
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  await page.getByText('All changes saved.').waitFor();
  assert.match(onDisk(), /Often she phones\.$/);
});
