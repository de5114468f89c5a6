// Ninety finished days are opened, and their nights played.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { setTimeout as wait } from 'node:timers/promises';
import { serve, until } from './served.mjs';

let served;
before(async () => {
  served = await serve('tigerplace');
  served.homebody('run', 'tigerplace', '--quiet');
});
after(() => served.close());

test('a finished run is opened, and a trip of the night played', { timeout: 240_000 }, async () => {
  const { page, address } = served;
  await page.goto(`${address.split('#')[0]}#/playback/tigerplace-1`);
  await page.getByText('Day 1 of 90').waitFor();
  const people = page.getByRole('row', { name: /margaret/ }).first();
  const next = page.getByRole('button', { name: 'Next activity' });
  let doing = '';
  for (let pressed = 0; pressed < 40 && !/bathroom|toilet/.test(doing); pressed += 1) {
    await next.click();
    await wait(80);
    doing = await people.innerText();
  }
  assert.match(doing, /bathroom|toilet/, 'no trip of a night');
  const clock = page.locator('time, .clock').first();
  const begun = await clock.innerText();
  assert.match(begun, /^0[0-6]:/, `${begun} is no night`);
  await page.getByRole('button', { name: '10×: ' }).click();
  await page.getByRole('button', { name: 'Play', exact: true }).click();
  await page.getByRole('row', { name: /margaret.*bathroom/ }).waitFor();
  await page.getByRole('row', { name: /(toilet|bathroom) motion.*ON|A[57].*ON/ }).first().waitFor();
  await page.getByRole('button', { name: 'Pause', exact: true }).click();
  assert.notEqual(await clock.innerText(), begun);
});

test('of two runs that differ by a condition it is shown what one has and the other lacks', { timeout: 240_000 }, async () => {
  const twins = await serve('tigerplace-depression');
  try {
    const { page, address } = twins;
    twins.homebody('run', 'tigerplace-depression', '--for', '38d', '--quiet');
    twins.homebody('run', 'tigerplace-depression', '--for', '38d', '--quiet', '--without', 'depression');
    // Up to the condition's beginning both have lived the same.
    await page.goto(`${address.split('#')[0]}#/playback/tigerplace-depression-1@2009-03-10T12:00:00`);
    await page.getByText('Day 9 of 38').waitFor();
    await page.getByLabel('Compare with').selectOption('tigerplace-depression-2');
    const differs = page.getByRole('region', { name: 'Differences on this day' });
    await differs.getByText('Every event has a match in the other run within a minute.').waitFor();
    await page.goto(`${address.split('#')[0]}#/playback/tigerplace-depression-1@2009-04-08T12:00:00`);
    await page.getByText('Day 38 of 38').waitFor();
    await differs.getByRole('rowheader', { name: 'bedroom motion' }).waitFor();
    await differs.getByRole('columnheader', { name: 'Room' }).waitFor();
    await page.getByLabel('Heat map').check();
    await page.getByText('Difference from the first run on this day').waitFor();
    const now = page.getByRole('region', { name: 'At this time' });
    assert.equal(await now.getByRole('rowheader', { name: /^margaret$/ }).count(), 2);
    await page.getByLabel('Table').check();
    await page.getByRole('region', { name: 'Rows by day' }).getByRole('row', { name: /8 Apr 2009.*[+−]\d+/ }).waitFor();
    // Of all days both runs are counts, and what one has more of than the other.
    const line = page.getByRole('group', { name: /^Timeline/ });
    await line.focus();
    await page.keyboard.press('a');
    await page.getByText('38 d shown').waitFor();
    await page.getByText('more above').waitFor();
    // Twins are told apart by what one was lived without, also in what is kept.
    assert.deepEqual(await page.locator('.clock .run').allInnerTexts(), ['first: tigerplace-depression-1', 'second: tigerplace-depression-2 without depression']);
    await page.getByText('Export', { exact: true }).click();
    const [lines] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: '(SVG)' }).click()]);
    assert.match(readFileSync(await lines.path(), 'utf8'), /2 March 2009.*above the line: tigerplace-depression-1<.*below the line: tigerplace-depression-2 without depression</s);
    const lanes = page.getByRole('region', { name: 'Lanes' }).locator('canvas');
    const box = await lanes.boundingBox();
    await page.mouse.move(box.x + box.width * 0.97, box.y + 7);
    await page.getByText(/about \d+ events here, in the second run \d+$/).waitFor();
    if (process.env.PICTURES) await page.screenshot({ path: `${process.env.PICTURES}/twins.png` });
    await page.getByText('Export', { exact: true }).click();
    const [file] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: '(CSV)' }).click()]);
    const rows = readFileSync(await file.path(), 'utf8').split('\n').map((row) => row.split(','));
    // Up to the condition's beginning both have lived the same; at the end the second has other counts.
    const counts = (what, name, from, to) => rows.filter((row) => row[2] === what && row[3] === name && row[0] >= from && row[0] < to).map((row) => `${row[0]} ${row[4]}`).join('\n');
    for (const [from, to, alike] of [['2009-03-02', '2009-03-07', true], ['2009-04-04', '2009-04-09', false]]) {
      const [own, other] = ['count', 'count beside'].map((what) => counts(what, 'bedroom motion', from, to));
      assert.ok(own !== '' && other !== '', `no counts from ${from} on`);
      assert.equal(own === other, alike, `from ${from} on`);
    }
  } finally {
    await twins.close();
  }
});

test('what is looked for over the whole run is listed, marked on the time line, and gone to by a key', { timeout: 240_000 }, async () => {
  const { page, address } = served;
  await page.goto(`${address.split('#')[0]}#/playback/tigerplace-1@2009-03-02T12:00:00`);
  await page.getByText('Day 1 of 90').waitFor();
  await page.getByText('Find in the whole run').click();
  await page.getByLabel('Room', { exact: true }).selectOption('bathroom');
  await page.getByRole('button', { name: 'Find', exact: true }).click();
  await page.getByText(/\d+ times/).waitFor();
  const hits = page.getByRole('region', { name: 'Search results' }).getByRole('button');
  assert.match(await hits.first().innerText(), /0[0-5]:\d\d:\d\d.*margaret/s);
  const clock = page.locator('time, .clock').first();
  const shows = (holds, what) => until(async () => holds(await clock.innerText()), async () => `${what}, while it shows ${await clock.innerText()}`);
  await page.locator('main, body').first().press('n');
  await shows((text) => /^0[0-5]:/.test(text), 'a time of the night');
  const first = await clock.innerText();
  await page.getByRole('row', { name: /margaret.*bathroom/ }).waitFor();
  await page.keyboard.press('n');
  await shows((text) => text !== first, 'another time');
  await page.keyboard.press('p');
  await shows((text) => text === first, 'the first time again');
  // What is chosen stays open.
  await page.getByLabel('Search for').selectOption('on');
  await page.getByLabel('Sensor', { exact: true }).selectOption('stove motion');
  await page.getByLabel('between').check();
  // No hours at all are told.
  await page.getByLabel('From hour').selectOption('0');
  await page.getByLabel('To hour').selectOption('0');
  await page.getByRole('button', { name: 'Find', exact: true }).click();
  await page.getByRole('alert').getByText('The two times of day must differ').waitFor();
});

test('the time line goes from the whole run to seconds, is sorted, and is kept as picture, lines and table', { timeout: 240_000 }, async () => {
  const { page, address } = served;
  await page.goto(`${address.split('#')[0]}#/playback/tigerplace-1@2009-03-10T12:00:00`);
  await page.getByText('Day 9 of 90').waitFor();
  const line = page.getByRole('group', { name: /^Timeline/ });
  await line.focus();
  await page.keyboard.press('a');
  await page.getByText('90 d shown').waitFor();
  await page.keyboard.press('0');
  await page.getByText('1 d shown').waitFor();
  const box = await line.boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + 60);
  for (let turn = 0; turn < 60; turn += 1) await page.mouse.wheel(0, -240);
  await page.getByText('1 s shown').waitFor();
  await page.keyboard.press('0');
  // Two hours are drawn out over the times.
  await page.mouse.move(box.x + box.width / 2, box.y + 8);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 80, box.y + 8, { steps: 4 });
  await page.mouse.up();
  await page.getByText(/^[12] h \d+ min shown$/).waitFor();
  await page.getByRole('combobox', { name: 'Order of lanes' }).selectOption('active');
  await page.keyboard.press('Escape');
  const kept = {};
  for (const form of ['PNG', 'SVG', 'CSV']) {
    await page.getByText('Export', { exact: true }).click();
    const [file] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: `(${form})` }).click()]);
    kept[form] = readFileSync(await file.path());
  }
  assert.equal(kept.PNG.subarray(1, 4).toString(), 'PNG');
  assert.match(kept.SVG.toString(), /^<svg [^>]*>.*margaret.*<\/svg>\s*$/s);
  const rows = kept.CSV.toString().trim().split('\n');
  assert.equal(rows[0], 'begin,end,what,name,said,run');
  assert.ok(rows.length > 20 && rows.some((row) => /,sensor,.* motion,ON,tigerplace-1$/.test(row)), rows.slice(0, 3).join('\n'));
  // A mark is there again when the page is.
  await line.focus();
  await page.keyboard.press('m');
  await page.reload();
  await page.getByText('Day 9 of 90').waitFor();
  assert.equal(await page.evaluate(() => JSON.parse(localStorage['homebody-marks/tigerplace-1']).length), 1);
});
