// An installer's desk in a real browser: a device is picked and put up, the list leads to it, a sheet is made, places are
// suggested and put in place of those there, and two layouts are held against each other.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { looked, serve, until } from './served.mjs';

const SCENARIO = 'studio';

let served;
before(async () => {
  served = await serve(SCENARIO);
  const { page } = served;
  await page.setViewportSize({ width: 1280, height: 900 });
  await page.getByRole('link', { name: 'Plan' }).click();
  await page.getByRole('application').waitFor();
  await page.getByRole('tab', { name: 'Install' }).click();
});
after(() => served.close());

const home = () => JSON.parse(readFileSync(join(served.folder, SCENARIO, 'home.json'), 'utf8'));
const desk = () => served.page.getByRole('region', { name: /Install sheet/ });
const count = () => desk().locator('ol > li').count();

/** Saves what is drawn, and reads it from the disk. */
async function saved() {
  const { page } = served;
  await page.keyboard.press('Control+s');
  await page.getByText('All changes saved.').waitFor();
  return home();
}

test('a device of the catalogue is put up with its numbers, and the list leads to it', { timeout: 240_000 }, async () => {
  const { page } = served;
  const before = home().sensors.length;
  await until(async () => (await count()) === before, 'all sensors are listed');
  await page.getByRole('combobox', { name: 'Device', exact: true }).selectOption('fibaro');
  await page.getByText('Z-Wave, mounted 2.4 m high').waitFor();
  await page.getByRole('button', { name: 'Place one' }).click();
  const area = await page.getByRole('application').boundingBox();
  await page.mouse.click(area.x + area.width / 2, area.y + area.height / 2);
  await until(async () => (await count()) === before + 1, 'what was put up is listed');
  const entry = desk().locator('ol > li').last();
  assert.match(await entry.innerText(), /Fibaro FGMS-001, Z-Wave\n.*wall.*\n2\.40 m high, looks /s);
  const fresh = (await saved()).sensors.at(-1);
  assert.deepEqual([fresh.preset, fresh.height_m], ['fibaro', 2.4]);
  await page.keyboard.press('Escape');
  await entry.getByRole('button').click();
  await page.getByRole('tab', { name: 'Element' }).click();
  assert.equal(await page.getByRole('tabpanel').getByRole('heading', { level: 2 }).first().innerText(), fresh.name);
  await page.getByRole('tab', { name: 'Install' }).click();
});

test('a sheet to print and a table are saved', { timeout: 240_000 }, async () => {
  const { page } = served;
  const fetched = async (name) => {
    const coming = page.waitForEvent('download');
    await page.getByRole('button', { name }).click();
    const download = await coming;
    return [download.suggestedFilename(), readFileSync(await download.path())];
  };
  const [sheet, bytes] = await fetched('Export PDF');
  assert.ok(sheet.endsWith('-sheet.pdf') && bytes.subarray(0, 5).toString() === '%PDF-', sheet);
  const [table, text] = await fetched('CSV');
  assert.ok(table.endsWith('-parts.csv'));
  assert.equal(text.toString().trim().split('\n').length, home().sensors.length + 1);
});

test('the floor has the colours of the sheet that is printed', { timeout: 240_000 }, async () => {
  const paint = readFileSync(new URL('../../crates/homebody-picture/src/paint.rs', import.meta.url), 'utf8');
  const [, seen] = /pub const SEEN: \[&str; 3\] = \[(.*)\];/.exec(paint);
  const printed = [...seen.matchAll(/#(..)(..)(..)/g)].map(([, ...parts]) => `rgb(${parts.map((part) => parseInt(part, 16)).join(', ')})`);
  const legend = served.page.getByRole('list', { name: 'Colours of the floor' });
  for (const [index, count] of ['1', '2', '3+'].entries()) {
    const swatch = legend.getByRole('listitem').filter({ hasText: new RegExp(`^${count.replace('+', '\\+')}$`) }).locator('.swatch');
    assert.equal(await swatch.evaluate((one) => getComputedStyle(one).backgroundColor), printed[index], count);
  }
});

test('places are suggested, put in place of those there, and compared with them', { timeout: 240_000 }, async () => {
  const { page } = served;
  const before = home().sensors.map(({ name }) => name);
  const motion = home().sensors.filter(({ kind }) => kind === 'motion').map(({ name }) => name);
  assert.ok(motion.length > 1 && motion.length < before.length);
  await page.getByRole('spinbutton', { name: 'Sensors' }).fill('3');
  await page.getByRole('button', { name: 'Suggest sensors' }).click();
  const answer = page.getByRole('region', { name: 'Suggested sensors' });
  await answer.waitFor();
  assert.equal(await answer.locator('ol > li').count(), 3);
  assert.match(await answer.innerText(), new RegExp(`Replace: ${before.length - motion.length + 3} sensors in all\\. Removed: ${motion.join(', ')}\\. Kept: ${before.length - motion.length} sensors`));
  assert.equal(await page.getByRole('tabpanel').evaluate((panel) => panel.scrollWidth - panel.clientWidth), 0);
  await answer.getByRole('button', { name: `Replace the current ${motion.length} motion sensors` }).click();
  const now = before.length - motion.length + 3;
  await until(async () => (await count()) === now, 'the list has those that were suggested, and those of other kinds');

  await page.getByLabel('First layout').selectOption('Before the suggestion');
  await page.getByLabel('Second layout').selectOption('Current plan');
  await page.getByRole('button', { name: 'Compare' }).click();
  const both = page.getByRole('region', { name: 'Comparison of two layouts' });
  await both.waitFor();
  assert.equal(await both.getByRole('row', { name: /^Sensors/ }).innerText().then((text) => text.split(/\s+/).join(' ')), `Sensors ${before.length} ${now}`);
  const differences = await both.locator('ul > li').allInnerTexts();
  for (const name of motion) assert.ok(differences.some((line) => line.startsWith(`${name}: goes: `)), name);
  assert.equal(differences.filter((line) => line.includes(': comes: ')).length, 3);

  // One step, which is undone as one.
  await page.getByRole('button', { name: 'Undo', exact: true }).click();
  await until(async () => (await count()) === before.length, 'all sensors are back');
});

test('by what people would show it takes a while, says how far it is, and can be stopped', { timeout: 240_000 }, async () => {
  const { page } = served;
  await page.getByRole('checkbox', { name: 'Bathroom visits at night' }).check();
  await page.getByRole('button', { name: 'Suggest sensors' }).click();
  await page.getByRole('progressbar', { name: 'Progress of the suggestion' }).waitFor();
  // The first people are lived in a second, or in many where much else goes on; a quick machine may be ready before it is stopped.
  const ready = page.getByRole('region', { name: 'Suggested sensors' }).waitFor();
  const goesOn = page.waitForFunction(() => document.querySelector('progress[aria-label="Progress of the suggestion"]')?.value > 0);
  await Promise.any([ready, goesOn]);
  await Promise.any([ready, page.getByRole('button', { name: 'Stop', exact: true }).click()]);
  await page.getByRole('button', { name: 'Suggest sensors' }).and(page.locator(':enabled')).waitFor();
});

test('the desk is accessible, and as wide as its window', { timeout: 240_000 }, async () => {
  await looked(served.page, 'parts', process.env.PICTURES);
});
