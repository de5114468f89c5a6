import { expect, test } from 'vitest';
import { ago, freshName, nameOf } from './library.svelte';
import { sketchOf } from './sketch';

test('names and times are told as people say them', () => {
  expect(freshName('flat', ['Flat', 'flat 2'])).toBe('flat 3');
  expect(freshName('flat 2', ['flat 2'])).toBe('flat 3');
  const now = Date.parse('2026-03-02T12:00:00Z');
  expect([10_000, 60_000, 600_000, 3_600_000, 7_200_000].map((past) => ago(now - past, now))).toEqual(['just now', 'a minute ago', '10 minutes ago', 'an hour ago', '2 hours ago']);
  expect(ago(now - 40 * 86_400_000, now)).toBe('21 Jan 2026');
});

test('a home is called as the file that it is made from, as far as it can be', () => {
  expect(['Plan of May.png', 'a:b?.sh3d', '..hidden.jpg', '.png', `${'ä'.repeat(300)}.csv`, 'v1.2 .svg'].map(nameOf)).toEqual(['Plan of May', 'a b', 'hidden', 'home', 'ä'.repeat(100), 'v1.2']);
});

test('a home is sketched while it is wrong, and one that has nothing is not', () => {
  const sketch = sketchOf('{ "walls": [{ "from": [0, 0], "to": [4, 0] }, { "from": 3 }], "doors": [{ "name": "front", "from": [1, 0], "to": [2, 0] }] }')!;
  expect([sketch.walls.length, sketch.doors]).toEqual([1, [{ from: [1, -0], to: [2, -0] }]]);
  expect(sketchOf('{ "rooms": [] }')).toBeNull();
  expect(sketchOf('{')).toBeNull();
});
