import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Refused } from '../../server';
import type { LocatingView } from '../../wire';
import { Locating } from './locating.svelte';

const view = (part: Partial<LocatingView>): LocatingView => ({ log: 'week.csv', state: 'walking', share: 0, run: null, problem: null, ...part });

let answers: (LocatingView | null)[];
let sent: string[];
let done: string[];
let walking: Locating;
let refuses: string | null;

const server = {
  json: async <T>(): Promise<T> => (answers.length > 1 ? answers.shift() : answers[0]) as T,
  post: async <T>(path: string): Promise<T> => {
    if (refuses !== null) throw new Refused(409, refuses);
    sent.push(path);
    return null as T;
  },
  remove: async <T>(path: string): Promise<T> => {
    sent.push(`DELETE ${path}`);
    return null as T;
  },
};

const log = (text = 'time,sensor,value\n', name = 'week.csv') => new File([text], name);

beforeEach(() => {
  vi.useFakeTimers();
  [sent, done, refuses, answers] = [[], [], null, [null]];
  walking = new Locating(server, (run) => done.push(run));
});

afterEach(() => vi.useRealTimers());

test('a log is sent, its share shown, and its run opened once', async () => {
  answers = [view({ share: 0.2 }), view({ share: 0.7 }), view({ state: 'done', share: 1, run: 'week-walked-1/run' })];
  await walking.open(log(), 'older/one');
  expect(sent).toEqual(['/api/walk/week.csv/older%2Fone']);
  expect([walking.isRunning, walking.view!.share]).toEqual([true, 0.2]);
  await vi.advanceTimersByTimeAsync(400);
  expect(walking.view!.share).toBe(0.7);
  await vi.advanceTimersByTimeAsync(2000);
  expect([walking.isRunning, done]).toEqual([false, ['week-walked-1/run']]);
});

test('what another page has opened is seen, and what was over before is not opened again', async () => {
  answers = [view({ state: 'done', run: 'old/run' })];
  walking.watch();
  await vi.advanceTimersByTimeAsync(1000);
  expect(done).toEqual([]);
  answers = [view({ share: 0.5 }), view({ state: 'done', run: 'new/run' })];
  walking.watch();
  await vi.advanceTimersByTimeAsync(1000);
  expect(done).toEqual(['new/run']);
});

test('why a log cannot be opened is said', async () => {
  answers = [view({ state: 'failed', problem: 'none of the sensors is one of the home’s\n  hint: ids' })];
  await walking.open(log(), null);
  expect(walking.problem).toContain('Cannot open week.csv: none of the sensors');
  refuses = 'Homebody is still locating people in other.csv. Wait until it has finished, or stop it.';
  await walking.open(log(), null);
  expect([walking.problem, walking.isRunning]).toEqual([refuses, false]);
});

test('an empty log, and one that is too large, are not sent', async () => {
  await walking.open(log(''), null);
  expect(walking.problem).toBe('week.csv is empty.');
  const large = log();
  Object.defineProperty(large, 'size', { value: 65 << 20 });
  await walking.open(large, null);
  expect(walking.problem).toContain('larger than 64 MB');
  expect(sent).toEqual([]);
});

test('it is stopped by the server, and nobody asks any more who has left', async () => {
  answers = [view({})];
  await walking.open(log(), null);
  await walking.stop();
  expect(sent.at(-1)).toBe('DELETE /api/walk');
  walking.leave();
  answers = [view({ state: 'done', run: 'late/run' })];
  await vi.advanceTimersByTimeAsync(5000);
  expect(done).toEqual([]);
});
