import { expect, test } from 'vitest';
import { hashOf, nameIn, routeOf } from './routes';

test('an address names a view, and what is looked at in it', () => {
  expect(['#/plan', '#/life/ann', '#/nowhere', ''].map(routeOf)).toEqual(['plan', 'life', 'live', 'live']);
  for (const name of ['ann', 'a/b', 'ä 100 %', '#']) expect(nameIn(hashOf('life', name), 'life')).toBe(name);
  expect(['#/life', '#/life/', '#/playback/a', '#/life/%'].map((hash) => nameIn(hash, 'life'))).toEqual([null, null, null, null]);
});
