import { expect, test } from 'vitest';
import type { MeasureChart } from '../../wire';
import { described, drawn, said } from './chart';

const chart = (values: (number | null)[], usual: [number, number] | null = null): MeasureChart => ({
  measure: 'sleep',
  title: 'Sleep',
  unit: 'hours',
  little: 0.5,
  is_guess: false,
  days: values.map((value, index) => ({ day: `2024-01-${String(index + 1).padStart(2, '0')}`, value, usual: index < 2 ? null : usual })),
});

test('days that are not known have no dot, and the usual range has gaps', () => {
  const picture = drawn(chart([7, null, 6, 8], [6.5, 7.5]));
  expect(picture.dots.map(({ day }) => day.value)).toEqual([7, 6, 8]);
  expect(picture.usual.length).toBe(1);
  expect(picture.values.map(({ text }) => text)).toEqual(['8.0 h', '6.0 h']);
  const [first, last] = [picture.dots[0]!, picture.dots[2]!];
  expect(first.x).toBeLessThan(last.x);
  expect(first.y).toBeGreaterThan(last.y);
});

test('the ends of a chart are round', () => {
  const texts = (unit: MeasureChart['unit'], values: number[]) => drawn({ ...chart(values), unit }).values.map(({ text }) => text);
  expect(texts('times', [0.7, 2.4])).toEqual(['3', '0']);
  expect(texts('metres_a_second', [0.63, 0.8])).toEqual(['0.80 m/s', '0.60 m/s']);
  expect(texts('clock', [22.2, 24.4])).toEqual(['00:30', '22:00']);
  expect(texts('of_usual', [0.94, 1.07])).toEqual(['110 %', '90 %']);
});

test('one value, and none, are drawn all the same', () => {
  expect(drawn(chart([7])).values.length).toBe(1);
  expect(drawn(chart([null])).dots).toEqual([]);
  expect(described(chart([null]))).toBe('Sleep: no data.');
});

test('values are said as people read them', () => {
  expect([said('clock', 24.5), said('clock', 22.25), said('hours', 7.04), said('times', 2), said('of_usual', 0.93)]).toEqual(['00:30', '22:15', '7.0 h', '2', '93 %']);
  expect(described(chart([7, 7, 8], [6.5, 7.5]))).toBe('Sleep on 3 of 3 days; on Wednesday 3 January 2024 8.0 h, usual 6.5 h to 7.5 h.');
});
