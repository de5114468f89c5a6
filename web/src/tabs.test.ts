import { afterEach, expect, test } from 'vitest';
import { answerOthers, tokenOfOthers } from './tabs';

let stop = () => {};

afterEach(() => stop());

test('a tab that has the token tells one that asks, and one that has none says nothing', async () => {
  stop = answerOthers(() => 'known-token');
  expect(await tokenOfOthers()).toBe('known-token');
  stop();
  stop = answerOthers(() => null);
  expect(await tokenOfOthers()).toBeNull();
});
