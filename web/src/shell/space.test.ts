import { expect, test } from 'vitest';
import { takesSpace } from './space';

test('Space belongs to the run, except where it means something else', () => {
  const [input, button, plan] = [document.createElement('input'), document.createElement('button'), document.createElement('div')];
  expect(takesSpace(null, null)).toBe(false);
  expect(takesSpace(plan, null)).toBe(false);
  expect(takesSpace(input, input)).toBe(true);
  expect(takesSpace(button, null)).toBe(true);
  expect(takesSpace(button, button)).toBe(false);
});
