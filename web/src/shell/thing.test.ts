import { expect, test } from 'vitest';
import type { FilesView, ProblemView } from '../wire';
import { placeOf } from './problem-place';

const files: FilesView = { entry: 'scenario.json', home: 'home.json', logger: 'logger.json', lives: [{ name: 'ann', routine: 'ann.routine' }], files: [] };
const problem = (file: string, line: number, column = 1): ProblemView => ({ file, line, column, width: 1, what: '', hint: null });
const home = '{\n  "sensors": [\n    { "name": "hall motion", "at": [1, 2] },\n    { "at": [1, 2] }\n  ],\n  "latitude_deg": 91\n}\n';
const logger = '{ "ids": {\n  "old chair": "A1"\n} }\n';

test('a problem says which thing it is about', () => {
  expect(placeOf(problem('home.json', 3, 40), files, home)).toBe('Sensor “hall motion”');
  expect(placeOf(problem('home.json', 4, 8), files, home)).toBe('Sensor 2');
  expect(placeOf(problem('home.json', 6, 20), files, home)).toBe('Latitude deg');
  expect(placeOf(problem('logger.json', 2, 5), files, logger)).toBe('Logger, id of “old chair”');
  expect(placeOf(problem('ann.routine', 4), files, 'She sleeps.\n')).toBe('ann’s routine, line 4');
});

test('what is no thing of a file that is known is told by its line, and of what cannot be read as well', () => {
  expect(placeOf(problem('home.json', 0), files, home)).toBe('Home');
  expect(placeOf(problem('other.json', 3), files, undefined)).toBe('other.json, line 3');
  expect(placeOf(problem('home.json', 3), files, '{ "sensors": [')).toBe('Home, line 3');
  expect(placeOf(problem('home.json', 3), null, home)).toBe('home.json 3');
});
