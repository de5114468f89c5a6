// Ninety finished days are opened, and their nights played.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { setTimeout as wait } from 'node:timers/promises';
import { serve } from './served.mjs';

let served;
before(async () => {
  served = await serve('tigerplace');
  served.homebody('run', 'tigerplace', '--quiet');
});
after(() => served.close());

test('a finished run is opened, and a trip of the night played', { timeout: 120_000 }, async () => {
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
  await page.getByRole('row', { name: /margaret.*bathroom/ }).waitFor({ timeout: 20_000 });
  await page.getByRole('row', { name: /(toilet|bathroom) motion.*ON|A[57].*ON/ }).first().waitFor({ timeout: 20_000 });
  await page.getByRole('button', { name: 'Pause', exact: true }).click();
  assert.notEqual(await clock.innerText(), begun);
});

test('of two runs that differ by a condition it is shown what one has and the other lacks', { timeout: 180_000 }, async () => {
  const twins = await serve('tigerplace-depression');
  try {
    const { page, address } = twins;
    twins.homebody('run', 'tigerplace-depression', '--for', '38d', '--quiet');
    twins.homebody('run', 'tigerplace-depression', '--for', '38d', '--quiet', '--without', 'depression');
    // Up to the condition's beginning both have lived the same.
    await page.goto(`${address.split('#')[0]}#/playback/tigerplace-depression-1@2009-03-10T12:00:00`);
    await page.getByText('Day 9 of 38').waitFor();
    await page.getByLabel('Beside it').selectOption('tigerplace-depression-2');
    const differs = page.getByRole('region', { name: 'What differs on this day' });
    await differs.getByText('Every firing of one is one of the other within a minute.').waitFor();
    await page.goto(`${address.split('#')[0]}#/playback/tigerplace-depression-1@2009-04-08T12:00:00`);
    await page.getByText('Day 38 of 38').waitFor();
    await differs.getByRole('rowheader', { name: 'bedroom motion' }).waitFor();
    await differs.getByRole('columnheader', { name: 'Room' }).waitFor();
    await page.getByLabel('Time spent, as heat').check();
    await page.getByText('More and less time that day than in the first run').waitFor();
    const now = page.getByRole('region', { name: 'At this time' });
    assert.equal(await now.getByRole('rowheader', { name: /^margaret$/ }).count(), 2);
    await page.getByLabel('as a table').check();
    await page.getByRole('region', { name: 'Rows by day' }).getByRole('row', { name: /8 Apr 2009.*[+−]\d+/ }).waitFor();
  } finally {
    await twins.close();
  }
});
