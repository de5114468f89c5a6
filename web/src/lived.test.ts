import { expect, test } from 'vitest';
import { KEPT_US, Lived } from './lived';
import { firing, frame } from './testing/frames';
import { madeUpHome } from './testing/home';
import type { BodyView } from './wire';

const body = (activity: string, room: number | null): BodyView => ({ at: [0, 0], heading_deg: 0, posture: 'standing', room, activity });

function lived(): Lived {
  const made = new Lived();
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
  expect(all.names).toEqual(['cooking', 'eating']);
  expect(all.activities[0]!.map(([begin, , what]) => [begin, what])).toEqual([[10, 0], [30, 1]]);
  expect(all.rooms[0]).toEqual([[10, 39, 1]]);
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

test('what is too old is forgotten', () => {
  const all = lived();
  all.take(frame({ now_us: 10, firings: [firing(0, 9, 1)], bodies: [body('cooking', 1)] }));
  all.take(frame({ now_us: 20, bodies: [null] }));
  all.take(frame({ now_us: KEPT_US + 100, firings: [firing(1, KEPT_US + 50, 1)], bodies: [null] }));
  expect([all.fired[1], all.activities[0], all.from_us]).toEqual([[KEPT_US + 50], [], 100]);
});
