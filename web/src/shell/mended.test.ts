import { expect, test } from 'vitest';
import type { FilesView, FixView, ProblemView } from '../wire';
import { fixOf, linkTo } from './fixes';

const files: FilesView = { entry: 'scenario.json', home: 'home.json', logger: 'logger.json', lives: [{ name: 'ann / b', routine: 'ann.routine' }], files: [] };
const problem = (file: string, line: number): ProblemView => ({ file, line, column: 1, width: 1, what: '', hint: null });

test('what is wrong leads to where it is mended', () => {
  const at = (of: ProblemView, more: Partial<Parameters<typeof linkTo>[1]> = {}) => linkTo(of, { files, check: null, text: () => '', ...more });
  expect(at(problem('home.json', 12))).toEqual({ word: 'Plan', href: '#/plan/line%2012' });
  expect(at(problem('home.json', 0))!.href).toBe('#/plan');
  expect(at(problem('logger.json', 5))!.href).toBe('#/log');
  expect(at(problem('ann.routine', 5))).toEqual({ word: 'Life: ann / b', href: '#/life/ann%20%2F%20b' });
  // A routine that does not fit the home is fixed in the home.
  const homeless = { ...problem('ann.routine', 0), what: 'Ann cannot get from "bed" to "sofa"' };
  expect(at(homeless)!.word).toBe('Plan');
  expect(at({ ...homeless, line: 3 })!.word).toBe('Life: ann / b');
  // The text of an unreadable routine is unknown.
  expect(at(homeless, { text: () => undefined })!.word).toBe('Life: ann / b');
  // The last problem stands for further ones of its sentences, whatever its text.
  const problems = (count: number) => ({ problems: [...Array.from({ length: count }, (_, line) => problem('ann.routine', line + 1)), homeless], warnings: [] });
  expect([99, 100].map((count) => at(homeless, { check: problems(count) })!.word)).toEqual(['Plan', 'Life: ann / b']);
  expect(at(problem('scenario.json', 1))).toBeNull();
  expect(at(problem('home.json', 1), { files: null })).toBeNull();
});

const home = '{\n  "furniture": [\n    { "name": "table", "at": [1, 1] }\n  ],\n  "sensors": [\n    { "kind": "contact", "on": "dor \\"1\\"", "nam": "x" }\n  ]\n}\n';
const texts: Record<string, string> = { 'home.json': home, 'ann.routine': 'Ann is 80.\nShe 😀 wtches television at 8.\n' };
const mend = (of: Partial<ProblemView>) => fixOf({ ...problem('home.json', 1), ...of }, { files, check: null, text: (name) => texts[name] });
const meant = (name: string): FixView => ({ kind: 'replace', with: name });

test('a name that is nearly one is written as it was meant, in files of JSON and in sentences', () => {
  const value = mend({ line: 6, column: 32, hint: 'another door is meant', fix: meant('door "1"') })!;
  expect([value.what, value.rest]).toEqual(['Change to “door "1"”', 'another door is meant']);
  expect(value.texts()).toEqual({ 'home.json': home.replace('dor', 'door') });
  expect(mend({ line: 6, column: 45, fix: meant('name') })!.texts()).toEqual({ 'home.json': home.replace('"nam"', '"name"') });
  const said = mend({ file: 'ann.routine', line: 2, column: 7, width: 17, fix: meant('watches television') })!;
  expect(said.texts()).toEqual({ 'ann.routine': 'Ann is 80.\nShe 😀 watches television at 8.\n' });
  // A place without a name, or with several candidates, has no fix.
  expect(mend({ line: 6, column: 5, fix: meant('door') })).toBeNull();
  expect(mend({ line: 6, column: 32, hint: 'did you mean "door"?' })).toBeNull();
  expect(mend({ file: 'gone.json', line: 6, column: 32, fix: meant('door') })).toBeNull();
  expect(mend({ line: 0, fix: meant('door') })).toBeNull();
});

test('what the home lacks is put where there is room for it', () => {
  const bed = { name: 'bed', at: [0.55, 1.05], size_m: [0.9, 2], height_m: 0.5, enterable: true };
  const fix: FixView = { kind: 'add', piece: bed, room: 'room', rest: 'give it a bed' };
  const lacks = mend({ file: 'ann.routine', line: 0, hint: `give it a bed; add ${JSON.stringify(bed)}`, fix })!;
  expect([lacks.what, lacks.rest]).toEqual(['Add “bed” to “room”', 'give it a bed']);
  expect(JSON.parse(lacks.texts()['home.json']!).furniture).toEqual([{ name: 'table', at: [1, 1] }, bed]);
  expect(mend({ fix: { ...fix, room: null } })!.what).toBe('Add “bed”');
  const enterable = mend({ fix: { kind: 'let_enter', furniture: 'table' } })!;
  expect(enterable.what).toBe('Let residents be in or on “table”');
  expect(JSON.parse(enterable.texts()['home.json']!).furniture).toEqual([{ name: 'table', at: [1, 1], enterable: true }]);
  expect(mend({ hint: 'add to "furniture" what it lacks' })).toBeNull();
});
