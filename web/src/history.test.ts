import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { History } from './history.svelte';

let history: History<{ text: string }>;
let text: string;

function write(next: string, tag = ''): void {
  history.keep({ text }, tag);
  text = next;
}

function step(way: 'undo' | 'redo'): string {
  text = history[way]({ text })?.text ?? text;
  return text;
}

beforeEach(() => {
  vi.useFakeTimers();
  history = new History();
  text = 'a';
});

afterEach(() => vi.useRealTimers());

test('undo and redo go there and back', () => {
  expect([history.canUndo, history.canRedo, step('undo'), step('redo')]).toEqual([false, false, 'a', 'a']);
  write('b');
  write('c');
  expect([step('undo'), step('undo'), history.canUndo, step('redo'), step('redo'), history.canRedo]).toEqual(['b', 'a', false, 'b', 'c', false]);
});

test('after a change there is nothing to redo', () => {
  write('b');
  step('undo');
  write('c');
  expect([history.canRedo, step('undo')]).toEqual([false, 'a']);
});

test('changes of one kind that follow at once are one step', () => {
  write('b', 'typed');
  write('c', 'typed');
  write('d', 'other');
  vi.advanceTimersByTime(2000);
  write('e', 'other');
  expect([step('undo'), step('undo'), step('undo')]).toEqual(['d', 'c', 'a']);
  // A change after an undo is a step of its own.
  step('redo');
  write('f', 'typed');
  write('g', 'typed');
  expect([step('undo'), step('undo')]).toEqual(['c', 'a']);
});

test('long texts are not kept for ever, but the last one is', () => {
  const long = 'x'.repeat(50_000_000);
  write(long);
  write('b');
  write('c');
  expect([step('undo'), step('undo'), history.canUndo]).toEqual(['b', long, true]);
  write(`${long}1`);
  write(`${long}2`);
  expect([step('undo').length, history.canUndo]).toEqual([50_000_001, false]);
});
