import { expect, test } from 'vitest';
import { LIBRARY, apiOf, homeHref, siteOf } from './site';

test('what a page is of is known from its address', () => {
  expect(siteOf('/')).toEqual({ kind: 'alone' });
  expect(siteOf(LIBRARY)).toEqual({ kind: 'library' });
  for (const name of ['flat', 'a flat', '100 % mine', '好#?', "<b>'"]) {
    const href = homeHref(name, '#/plan');
    const { pathname, hash } = new URL(href, 'http://127.0.0.1:8642');
    expect(siteOf(pathname)).toEqual({ kind: 'home', name });
    expect(hash).toBe('#/plan');
    expect(apiOf(siteOf(pathname))).toBe(`/api/homes/${encodeURIComponent(name)}`);
  }
  expect([apiOf({ kind: 'alone' }), apiOf({ kind: 'library' })]).toEqual(['/api', '/api']);
  for (const none of ['/homes/', '/homes/a/b/', '/homes/a', '/homes/%E0%A4%A/']) expect(siteOf(none)).toEqual({ kind: 'alone' });
});
