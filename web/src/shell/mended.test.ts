import { expect, test } from 'vitest';
import type { FilesView, ProblemView } from '../wire';
import { wayTo } from './mended';

const files: FilesView = { entry: 'scenario.json', home: 'home.json', logger: 'logger.json', lives: [{ name: 'ann / b', routine: 'ann.routine' }], files: [] };
const problem = (file: string, line: number): ProblemView => ({ file, line, column: 1, width: 1, what: '', hint: null });

test('what is wrong leads to where it is mended', () => {
  expect(wayTo(problem('home.json', 12), files)).toEqual({ word: 'Plan', href: '#/plan/line%2012' });
  expect(wayTo(problem('home.json', 0), files)!.href).toBe('#/plan');
  expect(wayTo(problem('logger.json', 5), files)!.href).toBe('#/log');
  expect(wayTo(problem('ann.routine', 5), files)).toEqual({ word: 'Life of ann / b', href: '#/life/ann%20%2F%20b' });
  expect(wayTo(problem('scenario.json', 1), files)).toBeNull();
  expect(wayTo(problem('home.json', 1), null)).toBeNull();
});
