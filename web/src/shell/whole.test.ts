import { flushSync, mount, unmount } from 'svelte';
import { afterEach, expect, test } from 'vitest';
import FullNames from './FullNames.svelte';
import { LONGEST_HINT, isReached, remember, fullNamesOf } from './full-names';

afterEach(() => document.body.replaceChildren());

/** A name in an element, with its width and its room. */
function shown(name: string, [wide, room]: [number, number], within = document.body): HTMLElement {
  const element = document.createElement('bdi');
  element.className = 'name';
  Object.defineProperty(element, 'scrollWidth', { value: wide });
  Object.defineProperty(element, 'clientWidth', { value: room });
  within.append(element);
  remember(element, name);
  return element;
}

test('what is cut is told as a whole to the keys, and to the pointer where no hint has it', () => {
  const row = document.createElement('button');
  document.body.append(row);
  const long = 'very '.repeat(LONGEST_HINT);
  shown('short', [40, 40], row);
  const cut = shown('cut where it stands', [90, 40], row);
  shown(long, [40, 40], row);
  expect(fullNamesOf(row, 'keys')).toEqual(['cut where it stands', long]);
  expect(fullNamesOf(row, 'pointer')).toEqual([long]);
  expect(fullNamesOf(cut, 'pointer')).toEqual([]);
});

test('the keys stop at a name by itself where nothing around it has them', () => {
  const button = document.createElement('button');
  document.body.append(button);
  expect(isReached(shown('a', [9, 4], button))).toBe(true);
  expect(isReached(shown('b', [9, 4]))).toBe(false);
});

test('what the pointer has shown goes with it, also while a field has the keys; what the keys have shown stays', async () => {
  const view = mount(FullNames, { target: document.body });
  flushSync();
  const [row, field] = [document.createElement('button'), document.createElement('input')];
  document.body.append(row, field);
  const name = shown('very '.repeat(LONGEST_HINT), [40, 40], row);
  for (const one of [row, field]) one.matches = ((of: string) => of === ':focus-visible' || Element.prototype.matches.call(one, of)) as typeof one.matches;
  const over = (one: Element) => (one.dispatchEvent(new Event('pointerover', { bubbles: true })), flushSync(), document.querySelector('[role="tooltip"]') !== null);
  field.focus();
  expect([over(name), over(document.body)]).toEqual([true, false]);
  row.focus();
  flushSync();
  expect(over(document.body)).toBe(true);
  await unmount(view);
});
