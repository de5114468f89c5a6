import { beforeEach, expect, test } from 'vitest';
import { Firings, LANE_US } from './firings';
import { firing, frame } from './testing/frames';

let firings: Firings;

beforeEach(() => {
  firings = new Firings();
  firings.clear(3);
});

const seqs = () => firings.rows.map((row) => ('firing' in row ? row.firing.seq : `${row.missing} missing`));

test('firings are kept in order, and counted by the server', () => {
  firings.take(frame({ now_us: 5_000_000, told: 2, firings: [firing(0, 1_000_000, 2), firing(1, 4_000_000, 2)] }));
  firings.take(frame({ now_us: 6_000_000, told: 3, counts: [1, 0, 2], firings: [firing(2, 6_000_000, 0)] }));
  expect(seqs()).toEqual([0, 1, 2]);
  expect(firings.counts).toEqual([1, 0, 2]);
});

test('what was told of but not sent is counted', () => {
  firings.take(frame({ told: 1, firings: [firing(0, 0)] }));
  firings.take(frame({ now_us: 9, told: 101, firings: [firing(99, 8), firing(100, 9)] }));
  expect(seqs()).toEqual([0, '98 missing', 99, 100]);
});

test('who comes late is told how many there were before', () => {
  firings.take(frame({ now_us: 50, told: 70, firings: [] }));
  expect(seqs()).toEqual(['70 missing']);
});

test('five hundred are kept, the newest', () => {
  for (let seq = 0; seq < 1200; seq++) firings.take(frame({ now_us: seq, told: seq + 1, firings: [firing(seq, seq)] }));
  expect(firings.rows).toHaveLength(500);
  expect([seqs()[0], seqs().at(-1), firings.added]).toEqual([700, 1199, 1200]);
});

test('lanes hold ten minutes', () => {
  firings.take(frame({ now_us: 10, told: 1, firings: [firing(0, 10, 1)] }));
  firings.take(frame({ now_us: LANE_US, told: 2, firings: [firing(1, LANE_US, 1)] }));
  expect(firings.lanes[1]).toEqual([10, LANE_US]);
  firings.take(frame({ now_us: LANE_US + 11, told: 2, firings: [] }));
  expect(firings.lanes[1]).toEqual([LANE_US]);
});

test('a run that is taken back forgets what is not yet so, and keeps nothing twice', () => {
  firings.take(frame({ now_us: 90, told: 3, firings: [firing(0, 10), firing(1, 50), firing(2, 90)] }));
  firings.take(frame({ now_us: 60, told: 2, firings: [] }));
  expect(seqs()).toEqual([0, 1]);
  expect(firings.lanes[0]).toEqual([10, 50]);
  firings.take(frame({ now_us: 95, told: 3, firings: [firing(2, 90)] }));
  expect(seqs()).toEqual([0, 1, 2]);
  firings.take(frame({ now_us: 55, told: 2, firings: [firing(0, 10), firing(1, 50)] }));
  expect(seqs()).toEqual([0, 1]);
});
