// Cameras: what they see on plans, live, and of a fall that is played back.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { looked, serve } from './served.mjs';

let served;
before(async () => {
  served = await serve('postures');
  served.homebody('run', 'postures', '--for', '2m', '--quiet');
});
after(() => served.close());

/** How many pixels of a picture are a body's: white. */
const bodyPixels = (picture) => picture.locator('canvas').evaluate((canvas) => {
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  let count = 0;
  for (let at = 0; at < data.length; at += 4) if (data[at] === 255 && data[at + 1] === 255) count += 1;
  return count;
});

test('a fall is played back in silhouettes of all cameras with the voxel person', { timeout: 240_000 }, async () => {
  const { page, address } = served;
  await page.goto(`${address.split('#')[0]}#/playback/postures-1@2025-06-02T10:00:05`);
  const cameras = page.getByRole('region', { name: 'Cameras', exact: true });
  await cameras.getByText('No other picture of a person exists').waitFor();
  for (const name of ['south-west', 'south-east', 'north-east']) await cameras.getByRole('img', { name: `Silhouette of ${name}: person in view` }).waitFor();
  assert.ok(await bodyPixels(cameras.getByRole('img', { name: 'Silhouette of south-west' })) > 100);
  await cameras.getByRole('img', { name: /Voxel person/ }).waitFor();
  await cameras.getByText('upright', { exact: true }).waitFor();
  const top = async () => Number.parseFloat(await cameras.getByRole('definition').nth(1).innerText());
  assert.ok(await top() > 1.4, `${await top()} m high`);

  // The usual rules find the fall; its mark leads there.
  await cameras.getByRole('button', { name: 'Find falls seen by cameras' }).click();
  // The finder opens, and says apart what cameras see and what is true.
  await page.getByText(/Falls seen by cameras: [1-9]\d*, in the ground truth: \d+/).waitFor();
  const hit = page.getByRole('region', { name: 'Search results' }).getByRole('button', { name: /by cameras: very likely a fall/ }).first();
  await hit.waitFor();
  await hit.click();
  for (let turn = 0; turn < 3; turn += 1) {
    await page.getByRole('slider', { name: 'Time of the day' }).press('Shift+ArrowRight');
  }
  await cameras.getByText('on the ground', { exact: true }).waitFor();
  assert.ok(await top() < 0.7, `${await top()} m high`);
  assert.match(await page.locator('time, .clock').first().innerText(), /^10:01:(0[6-9]|1)/);
  await looked(page, 'playback of cameras', process.env.LOOKS);
});

test('at any speed it goes on, and before the run there is nothing to see', { timeout: 240_000 }, async () => {
  const { page, address } = served;
  await page.goto(`${address.split('#')[0]}#/playback/postures-1@2025-06-02T10:00:00`);
  const cameras = page.getByRole('region', { name: 'Cameras', exact: true });
  await cameras.getByRole('img', { name: /: person in view/ }).first().waitFor();
  await page.getByRole('button', { name: '10×: ' }).click();
  await page.getByRole('button', { name: 'Play', exact: true }).click();
  await cameras.getByText('in between', { exact: true }).waitFor();
  await cameras.getByText('on the ground', { exact: true }).waitFor();
  // What is closed is fetched no more, and opens by a key.
  await cameras.locator('summary').press('Enter');
  await cameras.getByRole('img').first().waitFor({ state: 'hidden' });
});

test('live pictures are those of now', { timeout: 240_000 }, async () => {
  const { page, address } = served;
  await page.goto(`${address.split('#')[0]}#/live`);
  const cameras = page.getByRole('region', { name: 'Cameras', exact: true });
  await page.getByRole('button', { name: 'Play', exact: true }).click();
  await cameras.getByRole('img', { name: 'Silhouette of south-west: person in view' }).waitFor();
  assert.ok(await bodyPixels(cameras.getByRole('img', { name: 'Silhouette of south-west' })) > 100);
  await looked(page, 'cameras live', process.env.LOOKS);
});
