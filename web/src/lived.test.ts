import { expect, test } from 'vitest';
import { activityKind } from './charts/kinds-of-activities';
import { KEPT_US, RunHistory } from './run-history';
import { firing, frame } from './testing/frames';
import { madeUpHome } from './testing/home';
import type { BodyView } from './wire';

const body = (activity: string, room: number | null): BodyView => ({ at: [0, 0], heading_deg: 0, posture: 'standing', room, activity });

function lived(): RunHistory {
  const made = new RunHistory();
  made.clear({ home: madeUpHome(3), residents: [{ name: 'Agnes', radius_m: 0.2 }] });
  return made;
}

test('firings and what people did are kept as they come', () => {
  const all = lived();
  all.take(frame({ now_us: 10, firings: [firing(0, 9, 1)], bodies: [body('cooking', 1)] }));
  all.take(frame({ now_us: 20, bodies: [body('cooking', 1)] }));
  all.take(frame({ now_us: 30, firings: [firing(1, 25, 1)], bodies: [body('eating', 1)] }));
  all.take(frame({ now_us: 40, bodies: [null] }));
  expect([all.fired[1], all.said[1]]).toEqual([[9, 25], ['ON', 'ON']]);
  expect(all.names).toEqual(['cooking', 'eating', 'away']);
  expect(all.activities[0]!.map(([begin, , what]) => [begin, what])).toEqual([[10, 0], [30, 1], [40, 2]]);
  expect(all.rooms[0]).toEqual([[10, 39, 1]]);
});

test('who is out of the home is so for as long as they are; what visitors do elsewhere is not told', () => {
  const all = new RunHistory();
  all.clear({ home: madeUpHome(3), residents: ['Agnes', "Agnes's nurse"].map((name) => ({ name, radius_m: 0.2 })) });
  for (const now_us of [0, 10, 20]) all.take(frame({ now_us, bodies: [null, null] }));
  all.take(frame({ now_us: 30, bodies: [body('coming_home', 1), body('visiting', 1)] }));
  all.take(frame({ now_us: 40, bodies: [body('visit', 1), null] }));
  expect(all.activities.map((spans) => spans.map(([begin, end, what]) => [begin, end, all.names[what]]))).toEqual([
    [[0, 30, 'away'], [30, 40, 'coming_home'], [40, 40, 'visit']],
    [[30, 39, 'visiting']],
  ]);
  expect([all.doing(0, null), all.doing(1, null), all.doing(1, { ...body('', 1), activity: null })]).toEqual(['away', '', '']);
  expect(activityKind(all.doing(0, null)).id).toBe('out');
});

test('what was taken back is forgotten, and told again is there once', () => {
  const all = lived();
  all.take(frame({ now_us: 10, firings: [firing(0, 9, 1)], bodies: [body('cooking', 1)] }));
  all.take(frame({ now_us: 30, firings: [firing(1, 25, 1)], bodies: [body('eating', 2)] }));
  all.take(frame({ now_us: 12, firings: [firing(0, 9, 1)], bodies: [body('cooking', 1)] }));
  expect(all.fired[1]).toEqual([9]);
  expect(all.activities[0]!.at(-1)![2]).toBe(0);
  expect(all.activities[0]!.every(([, end]) => end <= 12)).toBe(true);
});

test('what was done while the run jumped is not known', () => {
  const all = lived();
  const [minute, hour] = [60e6, 3_600e6];
  for (const now_us of [0, minute, hour, hour + minute]) all.take(frame({ now_us, bodies: [body(now_us < hour ? 'sleeping' : 'cooking', 1)] }));
  expect(all.activities[0]).toEqual([[0, minute, 0], [hour, hour + minute, 1]]);
  expect(all.rooms[0]).toEqual([[0, minute, 1], [hour, hour + minute, 1]]);
});

test('what is too old is forgotten', () => {
  const all = lived();
  all.take(frame({ now_us: 10, firings: [firing(0, 9, 1)], bodies: [body('cooking', 1)] }));
  all.take(frame({ now_us: 20, bodies: [body('', null)] }));
  all.take(frame({ now_us: KEPT_US + 100, firings: [firing(1, KEPT_US + 50, 1)], bodies: [body('', null)] }));
  expect([all.fired[1], all.activities[0], all.from_us]).toEqual([[KEPT_US + 50], [], 100]);
});

test('what was told of but not shown is known to be missing, sensor by sensor, and when', () => {
  const all = lived();
  const hour = 3_600e6;
  all.take(frame({ now_us: 0 }));
  all.take(frame({ now_us: 19 * hour, told: 12, counts: [2, 10, 0], firings: [firing(10, 15 * hour, 1), firing(11, 18 * hour, 1)] }));
  expect(all.missed).toEqual([[{ from_us: 0, to_us: 15 * hour, missing: 2 }], [{ from_us: 0, to_us: 15 * hour, missing: 8 }], []]);
  expect(all.unseen).toEqual([{ from_us: 0, to_us: 19 * hour, missing: 0 }]);
  // The page sees everything from here on.
  all.take(frame({ now_us: 19 * hour + 60e6, told: 13, counts: [3, 10, 0], firings: [firing(12, 19 * hour + 1, 0)] }));
  expect([all.missed[0]!.length, all.missed[1]!.length, all.unseen.length]).toEqual([1, 1, 1]);
  // Back to a part that was not seen, and on from there.
  all.take(frame({ now_us: 10 * hour, told: 6, counts: [1, 5, 0], firings: [firing(5, 9 * hour, 1)] }));
  expect(all.missed).toEqual([[{ from_us: 0, to_us: 9 * hour, missing: 1 }], [{ from_us: 0, to_us: 9 * hour, missing: 4 }], []]);
  expect([all.fired[1], all.unseen]).toEqual([[9 * hour], [{ from_us: 0, to_us: 10 * hour, missing: 0 }]]);
  all.take(frame({ now_us: 0, told: 0, counts: [0, 0, 0] }));
  expect([all.missed, all.unseen]).toEqual([[[], [], []], []]);
});

test('what was gone over while the run went back and on again is not known', () => {
  const all = lived();
  const hour = 3_600e6;
  all.take(frame({ now_us: 0, bodies: [body('sleeping', 1)] }));
  all.take(frame({ now_us: 60e6, told: 1, counts: [1, 0, 0], firings: [firing(0, 50e6)], bodies: [body('sleeping', 1)] }));
  // The run restarted, and the next report comes from a later time than before.
  all.take(frame({ now_us: 3 * hour, told: 1, counts: [1, 0, 0], firings: [firing(0, 2 * hour)], bodies: [body('cooking', 1)] }));
  expect(all.unseen).toEqual([{ from_us: 60e6, to_us: 3 * hour, missing: 0 }]);
  expect(all.activities[0]).toEqual([[0, 60e6, 0], [3 * hour, 3 * hour, 1]]);
});

test('who comes late has not seen what was before, and of very many firings those that are let go are known to be missing', () => {
  const all = lived();
  all.take(frame({ now_us: 7_200e6, told: 70, counts: [70, 0, 0], firings: [firing(69, 7_100e6)] }));
  expect(all.missed[0]).toEqual([{ from_us: 0, to_us: 7_100e6, missing: 69 }]);
  const many = Array.from({ length: 10_004 }, (_, seq) => firing(70 + seq, 7_200e6 + seq));
  for (let from = 0; from < many.length; from += 500) {
    const [now_us, some] = [7_200e6 + from + 500, many.slice(from, from + 500)];
    all.take(frame({ now_us, told: 70 + from + some.length, counts: [70 + from + some.length, 0, 0], firings: some }));
  }
  expect(all.fired[0]!.length).toBe(10_000);
  expect(all.missed[0]!.reduce((sum, { missing }) => sum + missing, 0)).toBe(74);
});
