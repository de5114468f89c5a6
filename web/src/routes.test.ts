import { expect, test } from 'vitest';
import { hashOf, momentIn, nameIn, panelIn, routeOf } from './routes';

test('an address names a view, and what is looked at in it', () => {
  expect(['#/plan', '#/life/ann', '#/nowhere', ''].map(routeOf)).toEqual(['plan', 'life', 'live', 'live']);
  for (const name of ['ann', 'a/b', 'ä 100 %', '#']) expect(nameIn(hashOf('life', name), 'life')).toBe(name);
  expect(['#/life', '#/life/', '#/playback/a', '#/life/%'].map((hash) => nameIn(hash, 'life'))).toEqual([null, null, null, null]);
});

test('an address may name a panel, which no name is taken for', () => {
  expect([panelIn('#/plan/@image', 'plan'), nameIn('#/plan/@image', 'plan'), routeOf('#/plan/@image')]).toEqual(['image', null, 'plan']);
  expect(['#/plan', '#/life/@image', hashOf('plan', '@image')].map((hash) => panelIn(hash, 'plan'))).toEqual([null, null, null]);
});

test('an address may name a moment as well, whatever the name', () => {
  for (const name of ['ann', 'a@2009-03-02', '@']) {
    const hash = hashOf('playback', name, '2009-03-02T07:30:00');
    expect([nameIn(hash, 'playback'), momentIn(hash)]).toEqual([name, '2009-03-02T07:30:00']);
    expect(momentIn(hashOf('playback', name))).toBeNull();
  }
  expect(['#/care/a@2009-03-02', '#/care/a@now', ''].map(momentIn)).toEqual(['2009-03-02', null, null]);
});
