// Draws the pictures of the README, each a moment of use: `node e2e/picture.mjs FOLDER` draws live.png, where a resident is
// driven, plan.png, where a sensor is dragged, life.png, where a condition is left out, and care.png, weeks after one began. More
// words name those that are wanted: `node e2e/picture.mjs FOLDER care`.

import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { setTimeout as wait } from 'node:timers/promises';
import { serve } from './served.mjs';

const folder = process.argv[2];
if (!folder) throw new Error('Say into which folder the pictures go.');
mkdirSync(folder, { recursive: true });

/** Opens a view of a scenario as the pictures have it, and takes one once all is as `act` makes it. */
async function picture(name, scenario, act) {
  if (process.argv.length > 3 && !process.argv.slice(3).includes(name)) return;
  const served = await serve(scenario);
  const { page, address } = served;
  await page.setViewportSize({ width: 1280, height: 800 });
  await page.emulateMedia({ colorScheme: 'light' });
  await page.goto(`${address.split('#')[0]}#/${name}`);
  await act(page, served);
  await page.screenshot({ path: join(folder, `${name}.png`) });
  await served.close();
}

async function walk(page, code, seconds) {
  await page.keyboard.down(code);
  await wait(seconds * 1000);
  await page.keyboard.up(code);
}

/** Through a door; who stands beside it goes a little aside and tries again. */
async function into(page, room, code, aside) {
  const there = page.getByRole('region', { name: 'People' }).getByRole('cell', { name: room, exact: true });
  for (let tries = 0; tries < 8; tries++) {
    await walk(page, code, 2);
    if (await there.isVisible()) return;
    await walk(page, aside, 0.2);
  }
  throw new Error(`The ${room} has not been reached.`);
}

await picture('live', 'tigerplace', async (page) => {
  await page.getByLabel('Keyboard controls').selectOption({ index: 1 });
  await page.getByRole('button', { name: 'New run' }).click();
  await page.getByRole('button', { name: 'Play', exact: true }).click();
  await page.getByRole('application').focus();
  await walk(page, 'KeyD', 2.6);
  await into(page, 'hall', 'KeyS', 'KeyA');
  await walk(page, 'KeyS', 1);
  await walk(page, 'KeyD', 2.3);
  await into(page, 'living room', 'KeyW', 'KeyA');
  await walk(page, 'KeyD', 2.8);
  await into(page, 'kitchen', 'KeyS', 'KeyA');
  await page.keyboard.down('KeyS');
  await wait(600);
});

// A sensor of the hall is dragged, and what no sensor sees changes with it.
await picture('plan', 'older-adult', async (page) => {
  await page.getByRole('tab', { name: 'Coverage' }).click();
  await page.getByRole('row', { name: /^All / }).waitFor();
  const sensor = await page.getByRole('img', { name: /^hallway middle/ }).last().boundingBox();
  const [x, y] = [sensor.x + sensor.width / 2, sensor.y + sensor.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 44, y + 6, { steps: 12 });
  await wait(1500);
});

// Two weeks in which the depression is at its strongest, beside the same weeks without it, and the sentence that says so.
await picture('life', 'tigerplace-depression', async (page) => {
  await page.getByRole('button', { name: 'Show its days' }).click();
  await page.getByLabel('Number of days').selectOption('14 days');
  await page.getByLabel('depression', { exact: true }).check();
  await page.getByRole('heading', { name: 'Without depression' }).waitFor({ timeout: 60_000 });
  await page.getByText('simulating').waitFor({ state: 'hidden', timeout: 60_000 });
  await page.getByRole('textbox', { name: /^Routine of margaret/ }).click();
  await page.keyboard.press('Control+End');
  await page.keyboard.press('ArrowUp');
  await wait(1000);
});

// How somebody is whose depression has grown for some weeks.
await picture('care', 'tigerplace-depression', async (page, served) => {
  served.homebody('run', 'tigerplace-depression', '--for', '70d', '--quiet');
  await page.setViewportSize({ width: 1280, height: 1465 });
  await page.reload();
  await page.getByRole('heading', { name: 'Day by day' }).waitFor();
  await page.getByRole('region', { name: 'Changes' }).locator('.signs summary').first().click();
  await wait(500);
});
