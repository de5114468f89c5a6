// A life is written: a mistake is underlined, mended and saved, and what is left out of the days is seen.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { looked, serve, until } from './served.mjs';

const SCENARIO = 'tigerplace-depression';

let served;
let editor;
before(async () => {
  served = await serve(SCENARIO);
  const { page, address } = served;
  await page.goto(`${address.split('#')[0]}#/life`);
  editor = page.getByRole('textbox', { name: /^Routine of margaret/ });
  await page.getByText('Every sentence is understood.').waitFor();
});
after(() => served.close());

const onDisk = () => readFileSync(join(served.folder, SCENARIO, 'margaret.routine'), 'utf8');
const list = () => served.page.getByRole('listbox', { name: /^Days/ });
const days = () => list().getByRole('option').allTextContents();
const drawn = () => served.page.locator('canvas').first().evaluate((canvas) => canvas.toDataURL());

/** What the program says of the scenario, where it is wrong. */
function check() {
  try {
    return served.homebody('check', SCENARIO);
  } catch (error) {
    return `${error.stdout}${error.stderr}`;
  }
}

test('a mistake is underlined, in the words of the program, and mended by completion', { timeout: 240_000 }, async () => {
  const { page } = served;
  const problems = page.getByRole('region', { name: 'Problems' });
  const before = onDisk();
  await editor.click();
  await page.keyboard.press('Control+End');
  await page.keyboard.type('\nShe wtches television at about 20:00 for 1 hour.');
  await page.keyboard.press('Escape');
  await problems.getByText('1 problem').waitFor();
  const underlined = page.locator('.cm-lintRange-error');
  await underlined.first().waitFor();
  assert.deepEqual(await underlined.allInnerTexts(), ['wtches television']);
  assert.equal(onDisk(), before, 'nothing is written before it is saved');
  await page.keyboard.press('Control+s');
  await page.getByText('All changes saved.').waitFor();
  const said = check();
  const [what, hint] = await problems.locator('.words').first().evaluate((words) => [words.firstChild.textContent, words.lastElementChild.textContent]);
  assert.ok(what.length > 10 && hint.length > 10, 'a problem has words');
  assert.ok(said.includes(what), `${what} is not in ${said}`);
  assert.ok(said.includes(hint), `${hint} is not in ${said}`);

  // The list leads to the words that are underlined, and completion offers what could stand there instead.
  await problems.getByRole('button').first().click();
  await page.keyboard.press('Control+Space');
  await complete(page, /^watches television/);
  await page.getByText('Every sentence is understood.').waitFor();
  await page.getByText('margaret.routine is not saved.').waitFor();
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  await page.getByText('All changes saved.').waitFor();
  assert.equal(onDisk(), `${before}\nShe watches television at about 20:00 for 1 hour.`);
  assert.doesNotMatch(check(), /not|problem/i);
});

/** Takes a completion by keys. The list takes none for a moment after it has opened, and opens anew while more of the words come. */
async function complete(page, name) {
  const option = page.getByRole('option', { name });
  await option.waitFor();
  while ((await option.getAttribute('aria-selected')) !== 'true') {
    await page.waitForTimeout(100);
    await page.keyboard.press('ArrowDown');
  }
  await page.keyboard.press('Enter');
}

test('what is begun is completed while it is written', { timeout: 240_000 }, async () => {
  const { page } = served;
  await editor.click();
  await page.keyboard.press('Control+End');
  await page.keyboard.type('\nOften she reads in the liv');
  await complete(page, /^living room *room/);
  await page.keyboard.type(' in the aft');
  await complete(page, /^in the afternoon/);
  await page.keyboard.type('.');
  await page.getByRole('region', { name: 'Interpretation' }).getByText('reads (living room)').waitFor();
  assert.match(await editor.innerText(), /Often she reads in the living room in the afternoon\.$/);
  await page.getByText('Every sentence is understood.').waitFor();
});

/** Goes to a control by Tab, as a person without a mouse does. */
async function tabTo(page, control) {
  for (let step = 0; step < 80; step++) {
    if (await control.evaluate((one) => one.getRootNode().activeElement === one)) return;
    await page.keyboard.press('Tab');
  }
  assert.fail('Tab does not lead to the control');
}

test('a visit is added and a habit edited by the form, with keys alone', { timeout: 240_000 }, async () => {
  const { page } = served;
  const before = await editor.innerText();
  const dialog = page.getByRole('dialog');
  const sentence = dialog.getByRole('region', { name: 'Sentence' });
  const field = (name) => dialog.getByRole('textbox', { name }).or(dialog.getByRole('combobox', { name })).first();
  /** Writes into a field in place of its text. */
  const fill = async (control, text) => {
    await tabTo(page, control);
    await page.keyboard.press('Control+a');
    await page.keyboard.type(text);
  };
  await editor.focus();
  await page.keyboard.press('Control+End');
  await page.getByRole('button', { name: 'Add a statement' }).focus();
  await page.keyboard.press('Enter');
  await dialog.waitFor();
  assert.equal(await field('Kind').evaluate((one) => document.activeElement === one), true, 'the focus is in the form');
  await page.keyboard.type('Visit');
  await fill(field('Visitor'), 'neighbour');
  await tabTo(page, dialog.getByRole('checkbox', { name: 'Sunday' }));
  await page.keyboard.press('Space');
  await fill(field('Time of day: at'), '15:00');
  await fill(field('Length, min'), '90');
  // A number becomes a value when the user leaves its field.
  await page.keyboard.press('Tab');
  await sentence.getByText('On Sunday, her neighbour visits at 15:00 for 90 minutes.').waitFor();
  // Explanations of fields move nothing, so that a click after a field meets its button.
  const insert = dialog.getByRole('button', { name: 'Insert' });
  const heights = [];
  for (const name of ['Visitor', 'Activity', 'Length, min']) {
    await field(name).focus();
    heights.push((await insert.boundingBox()).y);
  }
  assert.equal(new Set(heights).size, 1, `the button moves: ${heights}`);
  await looked(page, 'statement-form', process.env.PICTURES);
  await page.setViewportSize({ width: 1280, height: 1600 });
  await tabTo(page, dialog.getByRole('button', { name: 'Insert' }));
  await page.keyboard.press('Enter');
  await dialog.waitFor({ state: 'hidden' });
  const added = `${before}\nOn Sunday, her neighbour visits at 15:00 for 90 minutes.`;
  await until(async () => (await editor.innerText()) === added, async () => `the visit is not in ${await editor.innerText()}`);
  assert.equal(await editor.evaluate((one) => one.getRootNode().activeElement === one), true, 'the focus is in the text again');
  await page.getByText('Every sentence is understood.').waitFor();

  // The cursor is in the new sentence; the habit is above it.
  const here = page.getByRole('region', { name: 'Interpretation of the line' });
  await until(async () => {
    await page.keyboard.press('ArrowUp');
    return (await here.innerText()).includes('reads in the living room');
  }, 'the cursor does not come to the habit');
  const edit = page.getByRole('button', { name: 'Edit as a form' });
  await edit.focus();
  await page.keyboard.press('Enter');
  await dialog.waitFor();
  await fill(field('Place'), 'bedroom');
  await sentence.getByText('she reads in the bedroom').waitFor();
  await page.keyboard.press('Escape');
  await dialog.waitFor({ state: 'hidden' });
  assert.equal(await edit.evaluate((one) => document.activeElement === one), true, 'the focus is back at the button');
  assert.equal(await editor.innerText(), added, 'what is cancelled changes nothing');
  await page.keyboard.press('Enter');
  await dialog.waitFor();
  await fill(field('Place'), 'bedroom');
  await sentence.getByText('she reads in the bedroom').waitFor();
  // Enter in a field is the button of the form.
  await page.keyboard.press('Enter');
  await dialog.waitFor({ state: 'hidden' });
  await until(async () => (await editor.innerText()).includes('she reads in the bedroom'), 'the habit is edited');
  assert.equal((await editor.innerText()).split('\n').length, added.split('\n').length);
  await page.keyboard.press('Control+z');
  await until(async () => (await editor.innerText()) === added, 'one undo takes the edit back');
  await page.keyboard.press('Control+z');
  await until(async () => (await editor.innerText()) === before, 'one more takes the visit back');
});

test('the days are drawn, and are others without the condition', { timeout: 240_000 }, async () => {
  const { page } = served;
  await page.getByRole('button', { name: 'Show its days' }).click();
  await page.getByText('3 – 30 May 2009').waitFor();
  await page.getByText('simulating').waitFor({ state: 'hidden' });
  const [before, picture] = [await days(), await drawn()];
  assert.equal(before.length, 28);
  await page.getByLabel('depression', { exact: true }).check();
  await page.getByLabel('Side by side').uncheck();
  await page.getByRole('heading', { name: 'Without depression' }).waitFor();
  const motion = (all) => all.reduce((sum, day) => sum + Number(/(\d+) firings/.exec(day)[1]), 0);
  assert.ok(motion(await days()) > motion(before) * 1.1, 'who is not depressed moves more');
  assert.notEqual(await drawn(), picture);
  await list().focus();
  await page.keyboard.press('Enter');
  await page.getByRole('heading', { name: 'Sun, 3 May 2009' }).waitFor();
});

test('all of it is lived as it was drawn, and can be played back', { timeout: 300_000 }, async () => {
  const { page } = served;
  await page.getByRole('button', { name: 'Run all days' }).click();
  await page.getByRole('progressbar').waitFor();
  const link = page.getByRole('link', { name: /^Play back/ });
  await link.waitFor({ timeout: 240_000 });
  await link.click();
  await page.getByText('Day 1 of 120').waitFor();
  const [run] = served.runs().slice(-1);
  assert.match(readFileSync(join(served.folder, 'runs', run, 'recording.json'), 'utf8'), /depression/);
});
