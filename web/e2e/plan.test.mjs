// Somebody moves sensors about on the plan, sees what they see then, and saves: the file on disk has changed where it was
// meant to, and what is wrong is said as `homebody check` says it.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, beforeEach, test } from 'node:test';
import { serve, until } from './served.mjs';

const SCENARIO = 'older-adult';

let served;
before(async () => {
  served = await serve(SCENARIO);
  await served.page.setViewportSize({ width: 1280, height: 720 });
});
after(() => served.close());

const onDisk = () => readFileSync(join(served.folder, SCENARIO, 'home.json'), 'utf8');

/** Each test begins with what is on disk. */
beforeEach(async () => {
  const { page } = served;
  await page.getByRole('link', { name: 'Plan' }).click();
  await page.getByRole('application').waitFor();
  const undo = page.getByRole('button', { name: 'Undo' });
  while (!(await page.getByText('All changes saved.').isVisible()) && (await undo.isEnabled())) await undo.click();
  await page.getByText('All changes saved.').waitFor();
});

/** Selects something by its name in the list, and gives the plan the keys. */
async function select(name) {
  const { page } = served;
  await page.getByRole('tab', { name: 'List' }).click();
  await page.getByRole('textbox', { name: 'Find by name or kind' }).fill(name);
  await page.getByRole('tabpanel').getByRole('button', { name }).first().click();
  await page.getByRole('application').focus();
}

/** The share of all floor that no sensor sees, in percent. */
async function unseen() {
  await served.page.getByRole('tab', { name: 'Coverage' }).click();
  const cell = served.page.getByRole('row', { name: /^All / }).getByRole('cell').nth(1);
  return parseFloat(await cell.innerText());
}

/** The lines of each text that the other has not. */
function differing(before, after) {
  const [old, now] = [before.split('\n'), after.split('\n')];
  return [old.filter((line) => !now.includes(line)), now.filter((line) => !old.includes(line))];
}

async function drag(locator, dx, dy) {
  const { page } = served;
  const { x, y, width, height } = await locator.boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  for (let step = 1; step <= 10; step++) await page.mouse.move(x + width / 2 + (dx * step) / 10, y + height / 2 + (dy * step) / 10);
  await page.mouse.up();
}

test('a sensor is moved by keys and another by the mouse: less is unseen, and two lines are saved', { timeout: 240_000 }, async () => {
  const { page } = served;
  const begun = onDisk();
  const first = await unseen();
  assert.ok(first > 0);
  await select('hallway middle');
  for (let press = 0; press < 6; press++) await page.keyboard.press('ArrowLeft');
  await until(async () => (await unseen()) < first, 'the dead zone shrinks as the sensor is nudged');
  const second = await unseen();
  await drag(page.getByRole('img', { name: 'kitchen refrigerator, ceiling motion sensor' }).last(), 0, -40);
  await until(async () => (await unseen()) < second, 'the dead zone shrinks as the sensor is dragged');
  assert.equal(onDisk(), begun);
  await page.keyboard.press('Control+s');
  await page.getByText('All changes saved.').waitFor();
  const saved = onDisk();
  const [old, now] = differing(begun, saved);
  assert.deepEqual([old.length, now.length], [2, 2]);
  assert.match(now[0], /"hallway middle", "area": \[\[3\.9, 1\.7\], \[4\.8, 1\.7\]/);
  assert.match(now[1], /"kitchen refrigerator"/);
  // The command rounds to the nearest tenth, the page down.
  const [, none] = /\nall .*?([\d.]+)%/.exec(served.homebody('coverage', SCENARIO));
  const down = Number(none) - (await unseen());
  assert.ok(down > -0.01 && down < 0.11, `${none} % and ${down} less`);

  await page.getByRole('application').focus();
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  await page.getByText('home.json is not saved.').waitFor();
  await page.keyboard.press('Control+s');
  await page.getByText('All changes saved.').waitFor();
  assert.equal(onDisk(), begun);
});

/** What the command says is wrong with what is on disk. */
function checked() {
  try {
    return JSON.parse(served.homebody('check', SCENARIO, '--json'));
  } catch (error) {
    return JSON.parse(error.stdout);
  }
}

for (const [mistake, make] of [
  ['a sensor inside a wall', async (page) => {
    await select('bathroom area');
    for (let press = 0; press < 2; press++) await page.keyboard.press('ArrowRight');
  }],
  ['a door off its wall', async (page) => {
    await select('bedroom door');
    await page.getByRole('tab', { name: 'Element' }).click();
    await page.getByRole('spinbutton', { name: 'From: north' }).fill('3.1');
    await page.keyboard.press('Enter');
  }],
]) {
  test(`${mistake} is said as the command says it, and undo mends it`, { timeout: 240_000 }, async () => {
    const { page } = served;
    const begun = onDisk();
    assert.deepEqual(checked().problems, []);
    await make(page);
    await page.getByRole('tab', { name: /Problems \d/ }).click();
    await page.getByRole('button', { name: /^Show / }).first().waitFor();
    await page.keyboard.press('Control+s');
    await page.getByText('All changes saved.').waitFor();
    const problems = checked().problems;
    assert.ok(problems.length > 0);
    for (const { what, hint } of problems) {
      await page.getByText(what, { exact: true }).waitFor();
      if (hint) await page.getByText(hint, { exact: true }).first().waitFor();
    }
    await page.getByRole('button', { name: /^Show / }).first().click();
    await page.getByRole('application').focus();
    await page.keyboard.press('Control+z');
    await page.getByText('No problems.').waitFor();
    await page.keyboard.press('Control+s');
    await page.getByText('All changes saved.').waitFor();
    assert.equal(onDisk(), begun);
  });
}
