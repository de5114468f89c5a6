import { expect, test } from 'vitest';
import { WORDS } from '../../testing/life';
import type { ProblemView } from '../../wire';
import { ACTIVITY_KINDS, activityKind } from '../../charts/kinds-of-activities';
import { calls, courseOf, others, sentenceOf, strength, withLine } from './condition';
import { placeOf, together } from './marks';
import { roomy, stacked } from './rows';
import { bar, lasting, often } from './words';

const doc = (text: string) => {
  const lines = text.split('\n');
  const from = (number: number) => lines.slice(0, number - 1).reduce((sum, line) => sum + line.length + 1, 0);
  return { lines: lines.length, line: (number: number) => ({ from: from(number), to: from(number) + lines[number - 1]!.length, text: lines[number - 1]! }) };
};
const problem = (line: number, column: number, width: number, with_: Partial<ProblemView> = {}): ProblemView => ({ file: 'a', line, column, width, what: 'wrong', hint: null, ...with_ });

test('problems are counted in characters, the editor in units', () => {
  expect(placeOf(problem(2, 3, 2), doc('x\n👩 ab'))).toEqual({ from: 5, to: 7 });
  expect(placeOf(problem(1, 0, 0), doc('abc'))).toEqual({ from: 0, to: 3 });
  expect(placeOf(problem(1, 2, 0), doc('abc'))).toEqual({ from: 1, to: 2 });
  expect([placeOf(problem(0, 0, 0), doc('a')), placeOf(problem(3, 1, 1), doc('a'))]).toEqual([null, null]);
});

test('the same problem is told once, and those of the routine first', () => {
  const [own, far] = [problem(1, 1, 1), problem(1, 1, 1, { file: 'b' })];
  expect(together('a', [far, own], [own, problem(2, 1, 1)])).toEqual([own, problem(2, 1, 1), far]);
});

test('a sentence that shows a condition', () => {
  expect(sentenceOf({ shown: 'moderate depression', week: 6, over: 4 }, 'she')).toBe('From week 6, over 4 weeks, she shows moderate depression.');
  expect(sentenceOf({ shown: 'mild grief', week: 2, over: 1 }, 'they')).toBe('From week 2, over 1 week, they show mild grief.');
  expect(sentenceOf({ shown: 'mild grief', week: 2, over: 0 }, 'the person')).toBe('From week 2 the person shows mild grief.');
});

test('a person is called as in the routine', () => {
  expect(calls('# She\nHe reads. Then he rests. She')).toBe('he');
  expect(calls('Agnes is 82.')).toBe('the person');
});

test('a line is added at the end, and lines end as they did', () => {
  expect(withLine('a\n\n', 'b')).toBe('a\nb\n');
  expect(withLine('a\r\n', 'b')).toBe('a\r\nb\r\n');
  expect(withLine('', 'b')).toBe('b\n');
});

test('conditions that are not shown yet can be chosen', () => {
  expect([...others(WORDS, [{ name: 'depression', severity: [], sentences: [] }])]).toEqual([['grief', ['mild', 'moderate', 'severe']]]);
  const long = { text: 'mild heart failure', kind: 'condition' as const, about: '' };
  expect(others([long], [{ name: 'heart-failure', severity: [], sentences: [] }]).size).toBe(0);
});

test('the course of a condition', () => {
  expect(courseOf([0, 0])).toBeNull();
  expect(courseOf([0, 0.5, 1, 1, 0])).toEqual({ begins: 1, full: 2, ends: 3, strongest: 1 });
  expect([0.4, 0.5, 0.8, 1, 1.2, 1.5].map(strength)).toEqual(['less than mild', 'mild', 'more than mild', 'moderate', 'more than moderate', 'severe']);
});

test('activities are of the kinds that the charts of days have, too', () => {
  const kinds = ['sleeping', 'going_to_bed', 'using_bathroom', 'washing_up', 'preparing_lunch', 'laundry', 'watching_television', 'taking_medicine', 'away', 'getting_up', 'Enter_Home', 'LyingAwake', 'strolling', ''];
  expect(kinds.map((name) => activityKind(name).id)).toEqual(['sleep', 'sleep', 'care', 'food', 'food', 'housework', 'leisure', 'medicine', 'out', 'care', 'out', 'other', 'other', 'other']);
  expect(new Set(ACTIVITY_KINDS.map(({ id }) => id)).size).toBe(8);
});

test('rows stand beside their lines, or below the one before', () => {
  expect(stacked([0, 24, 24, 24, 200], 24)).toEqual([0, 24, 48, 72, 200]);
});

test('a row has a second line where the next one leaves room', () => {
  expect(roomy([0, 24, 72, 120], 24)).toEqual([false, true, true, true]);
});

test('few words', () => {
  expect([often('p 1'), often('Mon Wed p 1'), often('p 1; Sun'), often('Sun p 0.2'), often('p 0.85')]).toEqual(['', 'Mon Wed', 'Sun', 'Sun 20 %', '85 %']);
  expect([lasting(30), lasting(59.6), lasting(5400), lasting(7200)]).toEqual(['30 s', '1 min', '1 h 30 min', '2 h']);
  const half = 43_200;
  expect(bar([half, half, half], [0, half / 2, 0])).toEqual({ least: 0.5, mean: 0.5, most: 0.5, end: 0.75 });
  expect(bar([86_400 + 3600, 86_400 + 7200, 86_400 + 7200], null).mean).toBeCloseTo(7200 / 86_400);
});
