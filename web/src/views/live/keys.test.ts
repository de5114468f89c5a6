import { beforeEach, expect, test } from 'vitest';
import type { Key } from '../../wire';
import { HeldKeys, type Pressed } from './keys';

let said: Key[][];
let keys: HeldKeys;

beforeEach(() => {
  said = [];
  keys = new HeldKeys((held) => said.push(held));
});

function pressed(code: string, more: Partial<Pressed> = {}): Pressed {
  return { code, shiftKey: false, ctrlKey: false, altKey: false, metaKey: false, ...more };
}

test('only changes are said, however often a key repeats', () => {
  for (let time = 0; time < 20; time++) keys.down(pressed('KeyW'));
  keys.down(pressed('ArrowUp'));
  keys.up(pressed('KeyW'));
  expect(said).toEqual([['up']]);
  keys.up(pressed('ArrowUp'));
  expect(said).toEqual([['up'], []]);
});

test('keys are known by their place: W, A, S and D, and the arrows', () => {
  for (const code of ['KeyD', 'KeyA', 'ArrowDown', 'KeyW', 'ShiftLeft', 'KeyC']) expect(keys.down(pressed(code, { shiftKey: true }))).toBe(true);
  expect(said.at(-1)).toEqual(['up', 'down', 'left', 'right', 'fast', 'slow']);
  expect(keys.down(pressed('KeyQ'))).toBe(false);
  expect(keys.down(pressed('Tab'))).toBe(false);
});

test('Shift and Ctrl change the pace', () => {
  keys.down(pressed('KeyW'));
  keys.down(pressed('ControlLeft', { ctrlKey: true }));
  expect(said.at(-1)).toEqual(['up', 'slow']);
  keys.up(pressed('ControlLeft'));
  keys.down(pressed('ShiftRight', { shiftKey: true }));
  expect(said.at(-1)).toEqual(['up', 'fast']);
});

test('a Shift key whose going up was not told is let go with the next', () => {
  keys.down(pressed('ShiftLeft', { shiftKey: true }));
  keys.down(pressed('ShiftRight', { shiftKey: true }));
  keys.up(pressed('ShiftRight'));
  expect(keys.held).toEqual([]);
});

test('letting go of all says so once, and not at all where nothing is held', () => {
  keys.releaseAll();
  expect(said).toEqual([]);
  keys.down(pressed('KeyW'));
  keys.down(pressed('KeyA'));
  keys.releaseAll();
  keys.releaseAll();
  expect(said).toEqual([['up'], ['up', 'left'], []]);
});

test('shortcuts of the browser walk nobody', () => {
  expect(keys.down(pressed('KeyC', { ctrlKey: true }))).toBe(false);
  expect(keys.down(pressed('ArrowLeft', { altKey: true }))).toBe(false);
  expect(said).toEqual([]);
  keys.down(pressed('KeyA'));
  keys.down(pressed('KeyA', { metaKey: true }));
  expect(said.at(-1)).toEqual([]);
});

test('two fingers on the pad are two keys', () => {
  keys.press('pad up', 'up');
  keys.press('pad fast', 'fast');
  keys.release('pad up');
  keys.release('pad up');
  expect(said).toEqual([['up'], ['up', 'fast'], ['fast']]);
});

test('after a cut what is held is said anew', () => {
  keys.down(pressed('KeyW'));
  keys.forget();
  keys.down(pressed('KeyW'));
  expect(said).toEqual([['up'], ['up']]);
});
