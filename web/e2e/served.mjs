// The real program with a scenario of its own, and a real browser that looks at it.

import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { cpSync, mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { chromium } from 'playwright-core';

const axe = readFileSync(new URL('../node_modules/axe-core/axe.min.js', import.meta.url), 'utf8');
const repository = resolve(import.meta.dirname, '../..');
const program = resolve(process.env.HOMEBODY ?? join(repository, 'target/debug/homebody'));
const browser = process.env.CHROMIUM ?? '/usr/bin/chromium';
const flags = ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'];

/** How long anything is waited for: far longer than it takes, for machines that are busy with other things. */
const PATIENCE_MS = 90_000;

/** Waits until something holds, and fails with what did not. */
export async function until(holds, what) {
  const begun = performance.now();
  while (!(await holds())) {
    if (performance.now() - begun > PATIENCE_MS) assert.fail(`waited in vain: ${typeof what === 'function' ? await what() : what}`);
    await new Promise((on) => setTimeout(on, 100));
  }
}

/** Starts a run and plays it. A press of Play may come before the page has the new run. */
export async function playNewRun(page) {
  await page.getByRole('button', { name: 'New run' }).first().click();
  const pause = page.getByRole('button', { name: 'Pause', exact: true });
  await until(async () => {
    if (await pause.isVisible()) return true;
    // The button may become Pause in the meantime.
    await page.getByRole('button', { name: 'Play', exact: true }).click({ timeout: 1_000 }).catch(() => {});
    return false;
  }, 'the new run does not play');
}

/**
 * Serves a copy of a scenario of the repository, and opens its page.
 * @param prepare changes the copy before it is served; `script` runs in each page before its own.
 */
export function serve(scenario, { prepare = () => {}, script } = {}) {
  return served([scenario], { script, words: [scenario], prepare: (folder) => prepare(join(folder, scenario)) });
}

/** Serves a folder with copies of scenarios of the repository, and opens its first page. */
export function serveLibrary(scenarios, { prepare, words = [] } = {}) {
  return served(scenarios, { prepare, words });
}

async function served(scenarios, { prepare = () => {}, script, words }) {
  const folder = mkdtempSync(join(tmpdir(), 'homebody-e2e-'));
  for (const scenario of scenarios) cpSync(join(repository, 'scenarios', scenario), join(folder, scenario), { recursive: true });
  prepare(folder);
  const profile = mkdtempSync(join(tmpdir(), 'homebody-chromium-'));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: browser, headless: true, args: flags, viewport: { width: 1280, height: 1600 }, acceptDownloads: true,
  });
  if (script) await context.addInitScript(script);
  let server;
  const start = (port) => {
    server = spawn(program, ['serve', ...words, '--no-open', ...(port === null ? [] : ['--port', port])], { cwd: folder, stdio: ['ignore', 'pipe', 'inherit'] });
    return new Promise((ready, failed) => {
      let said = '';
      server.stdout.on('data', (text) => {
        said += text;
        if (said.includes('\n')) ready(said.trim());
      });
      server.on('error', failed);
      server.on('exit', (code) => failed(new Error(`the server has ended with ${code}`)));
    });
  };
  const stop = () => new Promise((gone) => {
    if (server.exitCode !== null || server.signalCode !== null) return gone();
    server.on('exit', gone);
    server.kill('SIGINT');
  });
  const begun = performance.now();
  const address = await start('0');
  const wrong = [];
  const watch = (page) => {
    page.on('pageerror', (error) => wrong.push(String(error)));
    page.on('console', (message) => message.type() === 'error' && wrong.push(message.text()));
  };
  context.on('page', watch);
  context.setDefaultTimeout(PATIENCE_MS);
  const page = await context.newPage();
  await page.goto(address);
  return {
    folder, page, context, address, wrong,
    /** When the program was started, by this program's clock. */
    begun,
    /** The folders of runs. */
    runs: () => readdirSync(join(folder, 'runs')).sort(),
    /** What the program prints. */
    homebody: (...words) => execFileSync(program, words, { cwd: folder, encoding: 'utf8' }),
    /** The server is gone until the function that comes back is called, which returns the address of the next. */
    async gone() {
      await stop();
      return (port = new URL(address).port) => start(port);
    },
    async close() {
      await context.close();
      await stop();
      for (const path of [folder, profile]) rmSync(path, { recursive: true, force: true });
      if (wrong.length > 0) throw new Error(wrong.join('\n'));
    },
  };
}

/** Light and dark, on a screen and on a telephone: axe finds nothing, and nothing is wider than the window. Leaves pictures in a folder, if there is one. */
export async function looked(page, name, folder) {
  for (const colorScheme of ['light', 'dark']) {
    await page.emulateMedia({ colorScheme });
    for (const width of [1280, 390]) {
      await page.setViewportSize({ width, height: 800 });
      await page.waitForTimeout(500);
      if (folder) await page.screenshot({ path: join(folder, `${name}-${colorScheme}-${width}.png`) });
      await page.evaluate(axe);
      const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
      const found = violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 160)).join(' | ')}`);
      assert.deepEqual(found, [], `${name}, ${colorScheme}, ${width} wide`);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
      assert.ok(wide <= 0, `${wide} pixels wider than ${width}`);
    }
  }
  await page.setViewportSize({ width: 1280, height: 800 });
  await page.emulateMedia({ colorScheme: 'light' });
}
