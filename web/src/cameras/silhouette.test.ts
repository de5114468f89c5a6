import { expect, test } from 'vitest';
import { areaOf, isSame, unpacked, wordOf } from './silhouette';

test('runs of pixels that are off and on stand in turns', () => {
  const pixels = unpacked([3, 2, 1, 4], [4, 3]);
  expect([...pixels]).toEqual([0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 0]);
  expect(areaOf([3, 2, 1, 4])).toBe(6);
});

test('long runs have several bytes, and what is beyond the picture is left out', () => {
  // 200 is 72 + 128, so the two bytes are 200 and 1.
  const pixels = unpacked([200, 1, 130, 1], [16, 16]);
  expect(pixels.indexOf(1)).toBe(200);
  expect(pixels.length).toBe(256);
  expect(areaOf([200, 1, 130, 1])).toBe(130);
});

test('what a camera shows is said in a word', () => {
  expect([null, { awake: false, packed: [] }, { awake: true, packed: [] }, { awake: true, packed: [3, 2] }].map(wordOf)).toEqual(['not loaded', 'asleep', 'no person in view', 'person in view']);
  expect(isSame({ awake: true, packed: [3, 2] }, { awake: true, packed: new Uint8Array([3, 2]) })).toBe(true);
  expect(isSame({ awake: true, packed: [3, 2] }, { awake: true, packed: [3, 3] })).toBe(false);
  expect(isSame({ awake: true, packed: [] }, null)).toBe(false);
});
