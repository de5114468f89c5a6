// Draws the picture of the README: a resident who is driven. `node e2e/picture.mjs FILE.png`

import { setTimeout as wait } from 'node:timers/promises';
import { serve } from './served.mjs';

const served = await serve('tigerplace');
const { page } = served;
await page.setViewportSize({ width: 1280, height: 800 });
await page.emulateMedia({ colorScheme: 'light' });
await page.getByLabel('Who walks').selectOption({ index: 1 });
await page.getByRole('button', { name: 'New run' }).click();
await page.getByRole('button', { name: 'Play', exact: true }).click();
await page.getByRole('application').focus();
for (const [code, seconds] of [['KeyD', 2.6], ['KeyS', 3.0], ['KeyD', 2.3], ['KeyW', 2.0], ['KeyD', 3.2], ['KeyS', 2.0]]) {
  await page.keyboard.down(code);
  await wait(seconds * 1000);
  if (code !== 'KeyS' || seconds !== 2.0) await page.keyboard.up(code);
}
await page.screenshot({ path: process.argv[2] });
await served.close();
