import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Latest } from './latest';

let asked: number[];
let answer: ((answer: string) => void)[];
let taken: string[];
let failed: string[];
let latest: Latest<number, string>;

beforeEach(() => {
  vi.useFakeTimers();
  [asked, answer, taken, failed] = [[], [], [], []];
  latest = new Latest(
    100,
    (number) => {
      asked.push(number);
      if (number < 0) return Promise.reject(new Error('too small'));
      return new Promise((done) => answer.push(done));
    },
    (text) => taken.push(text),
    (why) => failed.push(why),
  );
});

afterEach(() => vi.useRealTimers());

test('only the last of several changes is asked about', async () => {
  latest.want(1);
  await vi.advanceTimersByTimeAsync(60);
  latest.want(2);
  await vi.advanceTimersByTimeAsync(60);
  expect(asked).toEqual([]);
  await vi.advanceTimersByTimeAsync(60);
  expect(asked).toEqual([2]);
});

test('one question at a time, and the latest next', async () => {
  latest.want(1);
  await vi.advanceTimersByTimeAsync(100);
  for (const number of [2, 3]) {
    latest.want(number);
    await vi.advanceTimersByTimeAsync(200);
  }
  expect([asked, latest.wants]).toEqual([[1], true]);
  answer[0]!('one');
  await vi.advanceTimersByTimeAsync(0);
  expect([asked, taken, latest.wants]).toEqual([[1, 3], ['one'], false]);
});

test('without a pause the first is asked at once', async () => {
  const asked: number[] = [];
  const eager = new Latest<number, void>(0, async (number) => void asked.push(number), () => {}, () => {});
  for (const number of [1, 2, 3]) eager.want(number);
  expect(asked).toEqual([1]);
  await vi.advanceTimersByTimeAsync(0);
  expect(asked).toEqual([1, 3]);
});

test('what fails is told, and the next is asked', async () => {
  latest.want(-1);
  await vi.advanceTimersByTimeAsync(100);
  expect(failed).toEqual(['too small']);
  latest.want(1);
  await vi.advanceTimersByTimeAsync(100);
  expect(asked).toEqual([-1, 1]);
});

test('after the end nothing is taken', async () => {
  latest.want(1);
  await vi.advanceTimersByTimeAsync(100);
  latest.close();
  answer[0]!('one');
  await vi.advanceTimersByTimeAsync(200);
  expect(taken).toEqual([]);
});
