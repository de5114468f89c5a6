import { flushSync, mount, unmount } from 'svelte';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import type { Live } from '../../live.svelte';
import { Server } from '../../server';
import { fakeRuns, storedRun, walkedRun } from '../../testing/stored';
import { button, EVIL, expectText, write } from '../../testing/page';
import type { PlaybackView, StoredView } from '../../wire';
import PlaybackPage from './Playback.svelte';

const DAY = 86_400_000_000;

let view: Record<string, unknown>;

async function settle(): Promise<void> {
  await vi.advanceTimersByTimeAsync(50);
  flushSync();
}

async function begin(names = ['cottage-2', 'cottage-1'], make: (name: string) => PlaybackView = storedRun, listed: Record<string, Partial<StoredView>> = {}, ongoing: string | null = null): Promise<void> {
  const server = new Server('token', () => {}, fakeRuns(names, make, listed));
  view = mount(PlaybackPage, { target: document.body, props: { live: { server, ongoing } as Live } });
  for (let turn = 0; turn < 10; turn++) await settle();
}

function press(key: string, target: Element, shiftKey = false): void {
  target.dispatchEvent(new KeyboardEvent('keydown', { key, code: key === ' ' ? 'Space' : key, shiftKey, bubbles: true, cancelable: true }));
  flushSync();
}

const slider = (name: string) => document.querySelector<HTMLInputElement>(`input[aria-label="${name}"]`)!;
const said = () => slider('Time of the day').getAttribute('aria-valuetext');

function choose(id: string, value: string): void {
  const select = document.querySelector<HTMLSelectElement>(id)!;
  write(select, value, 'change');
  window.dispatchEvent(new Event('hashchange'));
}

beforeEach(() => {
  vi.useFakeTimers();
  window.location.hash = '#/playback';
});

afterEach(async () => {
  window.history.replaceState(null, '', '#/playback');
  await unmount(view);
  vi.useRealTimers();
});

test('of who is out of the home it is said that they are away', async () => {
  window.location.hash = '#/playback/cottage@2009-03-02T23:30:00';
  const spans: PlaybackView['spans'] = [[[0, (23 * DAY) / 24, 0], [(23 * DAY) / 24, DAY, 1]], []];
  await begin(['cottage'], (name) => storedRun(name, 1, { activities: ['cooking', 'away'], spans }));
  const rows = [...document.querySelectorAll('.people tbody tr')].map((row) => [...row.querySelectorAll('td')].map((cell) => cell.textContent!.trim()));
  expect(rows).toEqual([['out', '', 'away'], ['out', '', '']]);
});

test('zooming and looking elsewhere leave the clock and the address as they are', async () => {
  window.location.hash = '#/playback/cottage@2009-03-04T08:00:00';
  await begin(['cottage'], (name) => storedRun(name, 30));
  const [time, address] = [said(), window.location.hash];
  const line = document.querySelector('.line[aria-label^="Timeline"]')!;
  press('a', line);
  for (let turn = 0; turn < 8; turn++) press('+', line);
  for (let turn = 0; turn < 20; turn++) press('ArrowRight', line);
  for (let turn = 0; turn < 4; turn++) await settle();
  expect([said(), window.location.hash]).toEqual([time, address]);
  expect(document.querySelector('.tools .title')!.textContent).not.toBe('Day 3 of 30');
  // The way back, and the target of a jump becomes visible.
  button('◂ 4 March, 08:00:00').click();
  for (let turn = 0; turn < 4; turn++) await settle();
  expect(button('◂')).toBeUndefined();
  for (let turn = 0; turn < 20; turn++) press('ArrowRight', line);
  expect(button('◂')).toBeTruthy();
  press('ArrowRight', slider('Time of the day'));
  for (let turn = 0; turn < 4; turn++) await settle();
  expect([said(), button('◂')]).toEqual(['4 March, 08:01:00', undefined]);
});

test('the latest run is opened, and another can be chosen', async () => {
  await begin();
  expect(document.querySelector<HTMLSelectElement>('#first-run')!.value).toBe('cottage-2');
  choose('#first-run', 'cottage-1');
  for (let turn = 0; turn < 5; turn++) await settle();
  expect(window.location.hash).toBe('#/playback/cottage-1');
  expect(document.querySelector<HTMLSelectElement>('#first-run')!.value).toBe('cottage-1');
  expect(document.querySelector('a[href^="#/care"]')!.getAttribute('href')).toBe('#/care/cottage-1');
});

test('sliders go by minute, second, hour and day, and say where', async () => {
  await begin();
  const day = slider('Time of the day');
  expect(said()).toBe('2 March, 00:00:00');
  press('ArrowRight', day);
  press('ArrowRight', day, true);
  expect(said()).toBe('2 March, 00:01:01');
  press('PageUp', day);
  expect(said()).toBe('3 March, 00:01:01');
  press('ArrowRight', slider('Time in the run'));
  expect(slider('Time in the run').getAttribute('aria-valuetext')).toBe('3 March, 01:01:01, day 2 of 3');
  press('End', day);
  expect(said()).toBe('3 March, 23:59:59');
  press('Home', day);
  expect(said()).toBe('3 March, 00:00:00');
  press('End', slider('Time in the run'));
  expect(Number(slider('Time in the run').value)).toBe(3 * DAY);
  expect(button('Again')).toBeDefined();
});

test('an address that the page has not followed yet is left alone', async () => {
  await begin();
  press('ArrowRight', slider('Time of the day'));
  await vi.advanceTimersByTimeAsync(400);
  expect(window.location.hash).toMatch(/^#\/playback\/cottage-2@\d+-03-02T00:01:00$/);
  press('ArrowRight', slider('Time of the day'));
  // After a step back, the address changes before the page gets the event.
  window.history.replaceState(null, '', '#/care/cottage-2');
  await vi.advanceTimersByTimeAsync(400);
  expect(window.location.hash).toBe('#/care/cottage-2');
  press('ArrowRight', slider('Time of the day'));
  window.history.replaceState(null, '', '#/playback/cottage-2@2009-03-03T12:00:00');
  await vi.advanceTimersByTimeAsync(400);
  expect(window.location.hash).toBe('#/playback/cottage-2@2009-03-03T12:00:00');
});

test('Space plays and pauses', async () => {
  await begin();
  press(' ', document.body);
  expect(button('Pause')).toBeDefined();
  press(' ', document.body);
  expect(button('Pause')).toBeUndefined();
});

test('who is where is told in words, and not with the truth hidden', async () => {
  await begin();
  button('Next activity').click();
  for (let turn = 0; turn < 5; turn++) await settle();
  const now = () => document.querySelector('[aria-label="At this time"]')!.textContent!;
  expect(now()).toContain('Agnes');
  expect(now()).toContain('cooking');
  [...document.querySelectorAll('label')].find((label) => label.textContent!.includes('Show ground truth'))!.querySelector('input')!.click();
  flushSync();
  expect(now()).not.toContain('Agnes');
});

test('a run that is being lived is said to be, wherever its length would be', async () => {
  const make = (name: string) => storedRun(name, 3, { remarks: ['The run has no rows yet.'] });
  const titles = () => [...document.querySelectorAll('#first-run option')].map((option) => option.textContent);
  const text = () => document.body.textContent!.replace(/\s+/g, ' ');
  await begin(undefined, make, {}, 'cottage-2');
  expect(titles()).toEqual(['cottage-2 · 2009-03-02, running', 'cottage-1 · 2009-03-02, 3 days']);
  expect(text()).toContain('This run is still running; you see the days stored so far. Stop it in Live to play back all of it.');
  expect(text()).not.toContain('no rows yet');
  expect(text()).not.toContain('of 3');
  expect(slider('Time in the run').getAttribute('aria-valuetext')).toBe('2 March, 00:00:00, day 1');
  // The other is complete.
  choose('#first-run', 'cottage-1');
  for (let turn = 0; turn < 5; turn++) await settle();
  expect(text()).toContain('no rows yet');
  expect(text()).toContain('Day 1 of 3');
  expect(text()).not.toContain('still running');
});

test('a run that has a name has it beside what it leads to', async () => {
  await begin(undefined, undefined, { 'cottage-2': { about: { title: 'out and back', note: '' } } });
  const summary = () => document.querySelector('.keep summary')!.textContent;
  expect(summary()).toBe('out and back · name, note and details');
  choose('#first-run', 'cottage-1');
  for (let turn = 0; turn < 5; turn++) await settle();
  expect(summary()).toBe('Name, note and details');
});

test('a run without truth says so and has no activities to go to', async () => {
  await begin(['alone'], (name) => storedRun(name, 2, { has_truth: false, spans: [] }));
  expect(button('Next activity')).toBeUndefined();
  expect(document.body.textContent).toContain('(none stored)');
});

test('a second run is shown beside the first', async () => {
  await begin();
  choose('#second-run', 'cottage-1');
  for (let turn = 0; turn < 5; turn++) await settle();
  expect(document.querySelectorAll('.plans [role="application"]')).toHaveLength(2);
});

test('of two runs each is named wherever it is shown, with what it was lived without', async () => {
  await begin(['cottage-2', 'cottage-1'], storedRun, { 'cottage-1': { without: ['low_mood'] } });
  choose('#second-run', 'cottage-1');
  for (let turn = 0; turn < 5; turn++) await settle();
  const said = (selector: string) => [...document.querySelectorAll(selector)].map((one) => one.textContent!.replace(/\s+/g, ' ').trim());
  const both = ['cottage-2', 'cottage-1 without low mood'];
  expect(said('.clock .run')).toEqual([`first: ${both[0]}`, `second: ${both[1]}`]);
  expect(said('.which')).toEqual([`First: ${both[0]}`, `Second: ${both[1]}`]);
  expect(said('.key')[0]).toContain(`above the line: ${both[0]}, below it: ${both[1]}`);
  expect(said('section p')).toContain(`First: ${both[0]}; second: ${both[1]}`);
  button('Find').click();
  await settle();
  expect(said('.find [role="status"]')[0]).toContain(`in the first run, ${both[0]}`);
});

test('the address keeps the time, and a page that is loaded anew is there again', async () => {
  await begin();
  press('PageUp', slider('Time of the day'));
  press('ArrowRight', slider('Time of the day'));
  for (let turn = 0; turn < 3; turn++) await settle();
  await vi.advanceTimersByTimeAsync(400);
  expect(window.location.hash).toBe('#/playback/cottage-2@2009-03-03T00:01:00');
  await unmount(view);
  await begin();
  expect(said()).toBe('3 March, 00:01:00');
});

test('a run that is not there is told', async () => {
  window.location.hash = `#/playback/${encodeURIComponent('../etc')}`;
  await begin();
  expect([...document.querySelectorAll('[role="alert"]')].map((alert) => alert.textContent).join('')).toBe('There is no run ../etc.');
});

test('where no run is stored it is said how to have one, and nothing is to be chosen', async () => {
  await begin([]);
  const waiting = document.querySelector('.waiting')!;
  expect(waiting.textContent).toContain('No runs yet.');
  const chosen = vi.fn();
  document.querySelector<HTMLInputElement>('input[type="file"]')!.click = chosen;
  waiting.querySelector('button')!.click();
  expect(chosen).toHaveBeenCalledOnce();
  expect([...document.querySelectorAll('.waiting a')].map((link) => link.getAttribute('href'))).toEqual(['#/live', '#/life']);
  expect(document.querySelector('#first-run')).toBeNull();
  expect(button('Open a log')).toBeDefined();
});

test('hostile names are text', async () => {
  await begin([EVIL, `${EVIL} two`], (name) =>
    storedRun(name, 2, { scenario: EVIL, residents: [{ name: EVIL, radius_m: 0.2 }, { name: `${EVIL}${'x'.repeat(4000)}`, radius_m: 0.2 }], activities: [EVIL, EVIL], values: [EVIL, EVIL], remarks: [EVIL] }),
  );
  press('End', slider('Time of the day'));
  await settle();
  expectText(EVIL);
});

test('a log that was walked back says where everybody may be, how likely that is, and what its colours mean', async () => {
  await begin(['week'], (name) => walkedRun(name));
  const now = () => document.querySelector('[aria-label="At this time"]')!.textContent!;
  const { home } = walkedRun('week');
  expect(now()).toContain(`${home.rooms[4]!.name} 100 %`);
  button('Next room').click();
  for (let turn = 0; turn < 5; turn++) await settle();
  expect(said()).toBe('2 March, 07:00:00');
  press('ArrowLeft', slider('Time of the day'));
  await settle();
  expect(now()).toContain(`${home.rooms[4]!.name} 60 %`);
  expect(now()).toContain(`${home.rooms[2]!.name} 30 %, out 10 %`);
  expect(document.body.textContent).toContain('Certainty:');
  expect(document.body.textContent).not.toContain('Show ground truth');
  [...document.querySelectorAll('label')].find((label) => label.textContent!.includes('Show located people'))!.querySelector('input')!.click();
  await settle();
  expect(now()).not.toContain('60 %');
  expect(document.body.textContent).not.toContain('Certainty:');
  expect(document.querySelector('#first-run option')!.textContent).toContain('week.csv, people located');
});

test('what a log holds, and how real it is, is shown from the commands’ pages, without what could run', async () => {
  await begin(['week', 'other'], (name) => (name === 'week' ? walkedRun(name) : storedRun(name)));
  const page = () => document.querySelector('.page')?.shadowRoot?.querySelector('body');
  button('Log summary').click();
  for (let turn = 0; turn < 3; turn++) await settle();
  expect(page()!.textContent).toContain('look of week');
  button('Realism check').click();
  for (let turn = 0; turn < 3; turn++) await settle();
  // By default, next to the simulated path.
  expect(page()!.textContent).toContain('realism/week of week');
  choose('#beside-log', 'other');
  for (let turn = 0; turn < 3; turn++) await settle();
  expect(page()!.textContent).toContain('realism/other of week');
  expect(page()!.querySelector('script, style')).toBeNull();
  expect((globalThis as { broken?: number }).broken).toBeUndefined();
});
