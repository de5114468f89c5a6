import { flushSync, mount, unmount } from 'svelte';
import { afterEach, beforeEach, expect, test } from 'vitest';
import type { Live } from '../../live.svelte';
import { Server } from '../../server';
import type { CareView, StoredView } from '../../wire';
import CarePage from './Care.svelte';

const EVIL = '<img src=x onerror="globalThis.broken=1">';

const care = (name: string): CareView => ({
  name,
  person: 'Ada',
  day: '2009-03-30',
  remarks: ['No sensor is at an entrance, so nothing is known of outings'],
  today: [
    { measure: 'sleep', words: 'Slept 4.0 hours, less than usual (7.0 hours)', is_more: false },
    { measure: 'meals', words: `Meals in the kitchen: 3 times, as usual ${EVIL}`, is_more: null },
  ],
  sentences: [
    { words: 'On most nights of the last two weeks, Ada slept less than before.', numbers: 'truth 0.90', measure: 'sleep', is_change: true, days: ['2009-03-29'] },
    { words: 'Every day of the last two weeks, Ada was out for 2 hours at most.', numbers: 'truth 1.00', measure: 'time_out', is_change: false, days: [] },
  ],
  alerts: [{ day: '2009-03-29', rule: 'sleep', words: 'Sleep: 4.0 h, less than the usual 7.0', days: ['2009-03-28', '2009-03-29'] }],
  charts: [{ measure: 'sleep', title: 'Sleep', unit: 'hours', is_guess: false, days: ['28', '29', '30'].map((day) => ({ day: `2009-03-${day}`, value: 4, usual: [6.5, 7.5] })) }],
});

const stored = (name: string): StoredView => ({ name, walked_back: null, scenario: name, start: '2009-03-02 00:00:00', days: 30, has_truth: false, problem: null });

let view: Record<string, unknown>;
let answers: Record<string, unknown>;

async function begin(hash = '#/care') {
  window.location.hash = hash;
  const fetch = (path: string) => Promise.resolve(path in answers ? Response.json(answers[path]) : new Response('There is no such run.', { status: 404 }));
  const server = new Server('token', () => {}, fetch);
  view = mount(CarePage, { target: document.body, props: { live: { server } as Live } });
  for (let turn = 0; turn < 10; turn++) {
    await new Promise((done) => setTimeout(done, 0));
    flushSync();
  }
}

beforeEach(() => {
  window.localStorage.clear();
  answers = { '/api/runs': [stored('a'), stored('b')], '/api/runs/a/care': care('a'), '/api/runs/b/care': care('b') };
});
afterEach(() => unmount(view));

test('the day, what has changed and what is worth a look are told in words', async () => {
  await begin();
  const text = document.body.textContent!;
  for (const told of ['How 2009-03-30 was', 'Slept 4.0 hours, less than usual', 'Ada slept less than before', '1 of 1 not seen to', 'nothing is known of outings']) {
    expect(text).toContain(told);
  }
  expect(document.querySelector('img')).toBeNull();
  expect(document.querySelectorAll('.today .odd').length).toBe(1);
});

test('an alert is seen to with a note, and shows its days', async () => {
  await begin('#/care/b');
  expect(document.querySelector<HTMLSelectElement>('#care-run')!.value).toBe('b');
  const [seen, note] = document.querySelectorAll<HTMLInputElement>('li input');
  seen!.click();
  note!.value = 'a cold';
  note!.dispatchEvent(new Event('change', { bubbles: true }));
  flushSync();
  expect(document.body.textContent).toContain('0 of 1 not seen to');
  expect(window.localStorage.getItem('homebody-care')).toContain('a cold');
  [...document.querySelectorAll('li button')].forEach((button) => (button as HTMLButtonElement).click());
  flushSync();
  expect(document.querySelectorAll('svg .marked').length).toBe(2);
});

test('what goes wrong is said', async () => {
  answers = { '/api/runs': [] };
  await begin();
  expect(document.body.textContent).toContain('No run is stored yet');
  await unmount(view);
  answers = { '/api/runs': [stored('a')] };
  await begin();
  expect(document.querySelector('[role=alert]')!.textContent).toContain('There is no such run.');
});
