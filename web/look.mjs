// Looks at the page in Chromium, playing with its made-up home: `npm run look -- FOLDER` takes pictures, has axe-core check
// both themes, measures frames, and fails where something is wrong. The page is served as the program serves it, with its
// Content-Security-Policy, so that what that forbids is seen here.

import { mkdirSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join, normalize } from 'node:path';
import { chromium } from 'playwright-core';
import { build } from 'vite';

const POLICY =
  "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; font-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
const TYPES = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript', '.css': 'text/css', '.svg': 'image/svg+xml' };
const BROWSER = process.env.CHROMIUM ?? '/usr/bin/chromium';

const folder = process.argv[2];
/** Only the pictures whose name begins so. */
const only = process.argv[3] ?? '';
if (!folder) throw new Error('Say into which folder the pictures go.');
mkdirSync(folder, { recursive: true });

const temporary = ['page', 'fake', 'chromium'].map((name) => mkdtempSync(join(tmpdir(), `homebody-${name}-`)));
const [page_, fake_, profile] = temporary;
const wrong = [];

/** A server of one built page; nothing answers under /api, as where the program has just ended. */
async function serve(mode, dist) {
  await build({ mode, build: { outDir: dist, emptyOutDir: true }, logLevel: 'warn' });
  const server = createServer((request, response) => {
    const path = normalize(new URL(request.url, 'http://page').pathname);
    try {
      const file = join(dist, path === '/' ? 'index.html' : path);
      const body = readFileSync(file);
      response.writeHead(200, { 'content-type': TYPES[extname(file)] ?? 'application/octet-stream', 'content-security-policy': POLICY });
      response.end(body);
    } catch {
      response.writeHead(404).end();
    }
  }).listen(0, '127.0.0.1');
  await new Promise((listening) => server.once('listening', listening));
  return { server, address: `http://127.0.0.1:${server.address().port}` };
}

const real = await serve('production', page_);
const fake = await serve('fake', fake_);

const flags = ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'];
const context = await chromium.launchPersistentContext(profile, { executablePath: BROWSER, headless: true, args: flags });
const axe = readFileSync(new URL('node_modules/axe-core/axe.min.js', import.meta.url), 'utf8');

async function open(query, { scheme, width, height, wait = 3500, hash = '#/live', address = fake.address }) {
  const page = await context.newPage();
  page.on('console', (message) => {
    if (message.type() === 'error' || message.text().includes('Content Security Policy')) {
      // Without a server the line cannot be opened, and the browser says so itself.
      if (!message.text().includes('WebSocket')) wrong.push(`${query}: ${message.text()}`);
    }
  });
  page.on('pageerror', (error) => wrong.push(`${query}: ${error}`));
  await page.setViewportSize({ width, height });
  await page.emulateMedia({ colorScheme: scheme });
  await page.goto(`${address}/${query}${hash}`);
  await page.waitForTimeout(wait);
  return page;
}

async function check(page, name) {
  await page.screenshot({ path: join(folder, `${name}.png`) });
  // The policy forbids scripts from elsewhere, and evaluating one through the debugger is not held to it.
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
  for (const { id, help, nodes } of violations) wrong.push(`${name}: ${id}: ${help}: ${nodes.map(({ html, any }) => `${html.slice(0, 120)} ${any[0]?.message ?? ''}`).join(' | ')}`);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
  if (wide > 0) wrong.push(`${name}: the page is ${wide} pixels wider than its window`);
  console.log(`${name}: ${violations.length} violations`);
}

const SIZES = { '1280x720': { width: 1280, height: 720 }, '1024x768': { width: 1024, height: 768 } };
for (const scheme of ['light', 'dark']) {
  for (const [name, size] of Object.entries(SIZES)) {
    for (const [what, query] of Object.entries({ live: '', keys: '?driven=0&hour=21', fast: '?speed=1000&hour=10', many: '?residents=10&sensors=100', hostile: '?hostile=1&driven=0' })) {
      if (!`${what}-${scheme}-${name}`.startsWith(only)) continue;
      const page = await open(query, { scheme, ...size });
      await check(page, `${what}-${scheme}-${name}`);
      await page.close();
    }
  }
}

const phone = await open('?driven=0', { scheme: 'light', width: 420, height: 900 });
await check(phone, 'phone');
await phone.close();
for (const view of ['plan', 'life', 'playback', 'care']) {
  for (const [what, query] of Object.entries({ '': '', '-hostile': '?hostile=1' })) {
    const page = await open(query, { scheme: 'dark', width: 1280, height: 720, hash: `#/${view}`, wait: 1800 });
    await check(page, `${view}${what}`);
    await page.close();
  }
}

for (const state of ['calm', 'few', 'new', 'over', 'no_home']) {
  for (const [scheme, width] of [['light', 1440], ['dark', 390]]) {
    const page = await open(`?care=${state}`, { scheme, width, height: 900, hash: '#/care', wait: 1200 });
    await check(page, `care-${state}-${scheme}`);
    await page.close();
  }
}

for (const scheme of ['light', 'dark']) {
  for (const [what, query] of Object.entries({ log: '?hour=300', 'log-hostile': '?hostile=1&sensors=60' })) {
    if (!`${what}-${scheme}`.startsWith(only)) continue;
    const page = await open(query, { scheme, width: 1024, height: 768, hash: '#/log' });
    await check(page, `${what}-${scheme}`);
    for (const box of await page.getByRole('checkbox', { name: 'Table' }).all()) await box.check();
    await page.getByText('File text').click();
    await check(page, `${what}-tables-${scheme}`);
    await page.close();
  }
}

function expect(holds, what) {
  if (!holds) wrong.push(what);
  console.log(`${holds ? 'holds' : 'FAILS'}: ${what}`);
}

// What only a browser can tell: where the focus goes, what is done while a key is held, what names may do.
for (const scheme of ['light', 'dark']) {
  const page = await open('?hostile=1&driven=0&residents=1', { scheme, width: 1280, height: 720, wait: 800 });
  await page.locator('summary[aria-label="Layers"]').click();
  await page.getByLabel('Table').check();
  await check(page, `opened-${scheme}`);
  const far = () => page.locator('.far').first().innerText().catch(() => 'none');
  const before = await far();
  await page.getByRole('application').focus();
  await page.keyboard.down('KeyD');
  await page.waitForTimeout(1200);
  await page.keyboard.up('KeyD');
  await page.waitForTimeout(300);
  expect((await far()) !== before, 'a key that is held walks');
  await page.keyboard.press('Tab');
  expect(await page.evaluate(() => document.activeElement.getAttribute('role') !== 'application'), 'Tab leaves the plan');
  await page.getByRole('button', { name: '10×: ' }).click();
  await page.keyboard.press('Space');
  await page.waitForTimeout(300);
  expect(await page.getByRole('button', { name: 'Play', exact: true }).isVisible(), 'Space pauses after a button was clicked');
  await page.getByRole('button', { name: 'Stop' }).click();
  await page.waitForTimeout(300);
  expect(await page.getByRole('button', { name: 'Replay' }).isEnabled(), 'a run that was stopped can be lived again');
  expect((await page.title()).includes('broken') === false, 'no name is run');
  await check(page, `stopped-${scheme}`);
  await page.close();
}

for (const scheme of ['light', 'dark']) {
  const page = await open('', { scheme, width: 1024, height: 768, wait: 400, address: real.address });
  await check(page, `token-${scheme}`);
  await page.getByLabel('Token').fill('no token');
  await page.getByRole('button', { name: 'Connect' }).click();
  expect(await page.getByRole('alert').innerText().then((text) => text.startsWith('This is not an access token')), 'what is no token is said to be none');
  await page.goto(`${real.address}/#token=${'ab'.repeat(32)}`);
  await page.reload();
  await page.waitForTimeout(900);
  expect(page.url().endsWith('/#/live'), 'the token is gone from the address bar');
  expect(await page.getByText('connection lost, reconnecting').isVisible(), 'a lost connection is seen');
  await check(page, `lost-${scheme}`);
  await page.close();
}

// What a frame takes, and how often one comes, with ten people and a hundred sensors.
const share = (all, part) => [...all].sort((a, b) => a - b)[Math.floor(all.length * part)].toFixed(1);
for (const speed of ['1', 'fastest']) {
  const page = await open(`?residents=10&sensors=100&speed=${speed}`, { scheme: 'light', width: 1280, height: 720 });
  const times = await page.evaluate(
    () =>
      new Promise((done) => {
        const [gaps, work] = [[], []];
        let last = performance.now();
        const request = window.requestAnimationFrame.bind(window);
        window.requestAnimationFrame = (call) =>
          request((now) => {
            const begin = performance.now();
            call(now);
            work.push(performance.now() - begin);
          });
        request(function tick(now) {
          gaps.push(now - last);
          last = now;
          if (gaps.length < 600) request(tick);
          else done({ gaps: gaps.slice(10), work });
        });
      }),
  );
  console.log(`speed ${speed}, drawing a frame: p50 ${share(times.work, 0.5)} ms, p95 ${share(times.work, 0.95)} ms, ${times.work.length} frames`);
  console.log(`speed ${speed}, from frame to frame: p50 ${share(times.gaps, 0.5)} ms, p95 ${share(times.gaps, 0.95)} ms`);
  await page.close();
}

await context.close();
for (const { server } of [real, fake]) server.close();
for (const path of temporary) rmSync(path, { recursive: true, force: true });
for (const line of new Set(wrong)) console.error(line);
process.exitCode = wrong.length > 0 ? 1 : 0;
