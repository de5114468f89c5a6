// A folder of homes in a real browser: begun, opened, copied, renamed, deleted and put back; two homes at once; an address that
// outlives the server; and how it looks. With `PICTURES=FOLDER` it leaves pictures.

import assert from 'node:assert/strict';
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { looked, serveLibrary } from './served.mjs';

const pictures = process.env.PICTURES;
const LONG = 'a name that goes on and on '.repeat(4).trim().slice(0, 100);

let served;
before(async () => {
  served = await serveLibrary(['studio', 'tigerplace', 'older-adult'], { words: ['--address-file', 'address'] });
  if (pictures) mkdirSync(pictures, { recursive: true });
  await served.page.setViewportSize({ width: 1280, height: 800 });
});
after(() => served.close());

const at = (...parts) => join(served.folder, ...parts);
const card = (name) => served.page.getByRole('article', { name, exact: true });

test('homes are shown with their plans, and a run is lived in the one that is opened', { timeout: 240_000 }, async () => {
  const { page } = served;
  for (const name of ['studio', 'tigerplace', 'older-adult']) await card(name).locator('svg polygon').first().waitFor();
  await card('tigerplace').getByText('margaret').waitFor();
  await card('studio').getByRole('link', { name: 'studio' }).last().click();
  await page.getByRole('button', { name: 'Play', exact: true }).waitFor();
  assert.match(page.url(), /\/homes\/studio\/#\/live$/);
  const field = page.getByLabel('Date and time to go to');
  const start = await field.getAttribute('min');
  await field.fill(new Date(Date.parse(`${start}Z`) + 20 * 3_600_000).toISOString().slice(0, 19));
  await page.getByRole('button', { name: 'Go', exact: true }).click();
  await page.locator('table[aria-rowcount] tbody tr[aria-rowindex]').first().waitFor();
  await page.getByRole('link', { name: 'All homes' }).click();
  await card('studio').getByRole('list', { name: 'Runs' }).getByText('studio-1').waitFor();
  await card('studio').locator('rect').first().waitFor();
  assert.ok(existsSync(at('studio', 'runs', 'studio-1')));
});

test('a home is begun empty, and one from a template; names that are none are refused in words', { timeout: 240_000 }, async () => {
  const { page } = served;
  await page.getByRole('button', { name: 'New home' }).click();
  const dialog = page.getByRole('dialog', { name: 'New home' });
  await looked(page, 'new', pictures);
  await dialog.getByLabel('Name').fill(`${'n'.repeat(4000)}/`);
  await dialog.getByRole('button', { name: 'Create home' }).click();
  await dialog.getByText('it is longer than 100 characters').waitFor();
  await dialog.getByLabel('Name').fill(LONG);
  await dialog.getByRole('radio', { name: 'From a template' }).check();
  await dialog.getByLabel('Template', { exact: true }).selectOption('by-hand');
  await dialog.getByRole('button', { name: 'Create home' }).click();
  await page.getByRole('button', { name: 'Play', exact: true }).waitFor();
  await page.getByRole('link', { name: 'All homes' }).click();
  await page.getByRole('button', { name: 'New home' }).click();
  await dialog.getByLabel('Name').fill('nothing yet');
  await dialog.getByRole('button', { name: 'Create home' }).click();
  await page.getByRole('application').waitFor();
  assert.match(page.url(), /\/homes\/nothing%20yet\/#\/plan$/);
  await page.getByRole('link', { name: 'All homes' }).click();
  await card('nothing yet').getByRole('link', { name: 'Draw the plan' }).waitFor();
});

test('a home is begun from an image: it lies under the plan, is scaled by two points, and goes with the home', { timeout: 240_000 }, async () => {
  const { page } = served;
  await page.getByRole('button', { name: 'New home' }).click();
  const dialog = page.getByRole('dialog', { name: 'New home' });
  await dialog.getByRole('radio', { name: 'From an image' }).check();
  const file = (name, mimeType, text) => dialog.getByLabel('File', { exact: true }).setInputFiles({ name, mimeType, buffer: Buffer.from(text) });
  await file('notes.txt', 'text/plain', 'no picture');
  await dialog.getByRole('button', { name: 'Create home' }).click();
  await dialog.getByText('This file is not a PNG, JPEG or SVG image.').waitFor();
  await file('torn.png', 'image/png', 'no picture');
  await dialog.getByRole('button', { name: 'Create home' }).click();
  await dialog.getByText('The browser cannot read this image.').waitFor();
  assert.ok(!existsSync(at('notes')) && !existsSync(at('torn')));
  await file('Oak Street 5.svg', 'image/svg+xml', '<svg xmlns="http://www.w3.org/2000/svg" width="400" height="280"><rect x="20" y="20" width="360" height="240" fill="none" stroke="black"/></svg>');
  assert.equal(await dialog.getByLabel('Name').inputValue(), 'Oak Street 5');
  await dialog.getByRole('button', { name: 'Create home' }).click();
  const panel = page.getByRole('tabpanel', { name: 'Image' });
  await panel.getByText('Oak Street 5.svg').waitFor();
  await panel.getByText('Click two points with a known distance').waitFor();
  assert.equal(await panel.getByRole('button', { name: 'Set scale with two points' }).getAttribute('aria-pressed'), 'true');
  const width = () => panel.getByLabel('Width of the image').inputValue();
  const before = Number.parseFloat(await width());
  const plan = page.getByRole('application');
  const box = await plan.boundingBox();
  for (const share of [0.4, 0.6]) await page.mouse.click(box.x + share * box.width, box.y + 0.5 * box.height);
  const apart = Number.parseFloat((await panel.getByText(/^Now .* Real distance/).innerText()).match(/[\d.]+/)[0]);
  // Typed at once, as a wall's length.
  await page.keyboard.type('7');
  await page.keyboard.press('Enter');
  const after = Number.parseFloat(await width());
  assert.ok(Math.abs(after / before - 7 / apart) < 0.02, `${before} m became ${after} m by ${apart} m that are 7 m`);
  await page.getByRole('button', { name: 'Undo' }).click();
  assert.equal(Number.parseFloat(await width()), before);
  await page.getByRole('button', { name: 'Redo' }).click();
  // It is there another time, and under another name; the tool is held but the first time.
  await page.getByRole('link', { name: 'All homes' }).click();
  await page.getByRole('button', { name: 'Rename Oak Street 5' }).click();
  await page.getByLabel('New name').fill('oak');
  await page.getByRole('dialog').getByRole('button', { name: 'Rename' }).click();
  await card('oak').getByRole('link', { name: 'oak' }).last().click();
  await page.goto(new URL('/homes/oak/#/plan', page.url()).href);
  await page.getByRole('tab', { name: 'Image' }).click();
  await panel.getByText('Oak Street 5.svg').waitFor();
  assert.equal(Number.parseFloat(await width()), after);
  assert.equal(await panel.getByRole('button', { name: 'Set scale with two points' }).getAttribute('aria-pressed'), 'false');
  await looked(page, 'image', pictures);
  await page.getByRole('link', { name: 'All homes' }).click();
});

test('a home is copied, renamed, deleted, and put back by Undo', { timeout: 240_000 }, async () => {
  const { page } = served;
  await page.getByRole('button', { name: 'Duplicate tigerplace' }).click();
  await page.getByRole('dialog').getByRole('button', { name: 'Duplicate' }).click();
  await card('tigerplace 2').waitFor();
  await page.getByRole('button', { name: 'Rename tigerplace 2' }).click();
  await page.getByLabel('New name').fill('margaret’s');
  await page.getByRole('dialog').getByRole('button', { name: 'Rename' }).click();
  await card('margaret’s').waitFor();
  assert.equal(JSON.parse(readFileSync(at('margaret’s', 'scenario.json'), 'utf8')).name, 'margaret’s');
  await page.getByRole('button', { name: 'Delete margaret’s' }).click();
  await card('margaret’s').waitFor({ state: 'detached' });
  assert.ok(!existsSync(at('margaret’s')));
  await page.getByRole('button', { name: 'Undo' }).click();
  await card('margaret’s').waitFor();
  await page.getByRole('button', { name: 'Delete margaret’s' }).click();
  await page.getByText('Deleted homes (1)').click();
  await page.getByRole('button', { name: 'Restore' }).waitFor();
  await looked(page, 'library', pictures);
  await page.getByRole('button', { name: 'Restore' }).click();
  await card('margaret’s').waitFor();
});

test('two pages on one home: the second tab needs no token, and hears that the home was renamed', { timeout: 240_000 }, async () => {
  const { page, context } = served;
  const second = await context.newPage();
  await second.goto(new URL('/homes/older-adult/#/plan', page.url()).href);
  await second.getByRole('application').waitFor();
  await page.bringToFront();
  await page.getByRole('button', { name: 'Rename older-adult' }).click();
  await page.getByLabel('New name').fill('renamed');
  await page.getByRole('dialog').getByRole('button', { name: 'Rename' }).click();
  await card('renamed').waitFor();
  await second.getByText('this home was renamed or deleted').waitFor();
  served.wrong.length = 0;
  await second.getByRole('link', { name: 'All homes' }).last().click();
  await second.getByRole('article', { name: 'renamed' }).waitFor();
  await second.close();
});

test('the files of a home that is open are deleted on disk: what was drawn is written back', { timeout: 240_000 }, async () => {
  const { page } = served;
  await page.goto(new URL('/homes/studio/#/plan', page.url()).href);
  await page.getByRole('application').focus();
  await page.keyboard.press('Control+a');
  await page.keyboard.press('ArrowLeft');
  await page.getByText('home.json is not saved.').waitFor();
  rmSync(at('studio', 'home.json'));
  await page.getByText(/was deleted from disk/).waitFor();
  // What is asked leaves the tools beside it as they are.
  assert.ok((await page.getByRole('button', { name: 'Snap', exact: true }).boundingBox()).height < 50);
  await page.getByRole('button', { name: 'Keep my version' }).click();
  await page.keyboard.press('Control+s');
  await page.getByText('All changes saved.').waitFor();
  assert.ok(existsSync(at('studio', 'home.json')));
  served.wrong.length = 0;
});

test('the server is started again: the page goes on under the same address', { timeout: 240_000 }, async () => {
  const { page, address } = served;
  const start = await served.gone();
  // The port is kept as well.
  assert.equal(await start(null), address);
  await page.getByText('connected', { exact: true }).waitFor();
  await page.goto(new URL('/library/', page.url()).href);
  await card('tigerplace').waitFor();
  served.wrong.length = 0;
});

test('a folder that is full of other things is an empty library', { timeout: 240_000 }, async () => {
  const empty = await serveLibrary([], { prepare: (folder) => writeFileSync(join(folder, 'notes.txt'), 'mine') });
  await empty.page.getByText('There are no homes here yet').waitFor();
  await empty.close();
});
