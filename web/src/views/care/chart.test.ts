import { expect, test } from 'vitest';
import type { MeasureChart } from '../../wire';
import { described, drawn, said, unitOf } from './chart';

const chart = (values: (number | null)[], usual: [number, number] | null = null): MeasureChart => ({
  measure: 'sleep',
  title: 'Sleep',
  group: 'night',
  unit: 'hours',
  little: 0.5,
  is_guess: false,
  days: values.map((value, index) => ({ day: `2024-01-${String(index + 1).padStart(2, '0')}`, value, usual: index < 2 ? null : usual })),
});

test('days that are not known have no dot, and the usual range has gaps', () => {
  const picture = drawn(chart([7, null, 6, 8], [6.5, 7.5]));
  expect(picture.dots.map(({ day }) => day.value)).toEqual([7, 6, 8]);
  expect(picture.usual.length).toBe(1);
  expect(picture.values.map(({ text }) => text)).toEqual(['8.0 h', '7.0 h', '6.0 h']);
  const [first, last] = [picture.dots[0]!, picture.dots[2]!];
  expect(first.x).toBeLessThan(last.x);
  expect(first.y).toBeGreaterThan(last.y);
});

test('the labelled values are round, and few', () => {
  const texts = (unit: MeasureChart['unit'], values: number[]) => drawn({ ...chart(values), unit }).values.map(({ text }) => text);
  expect(texts('times', [0.7, 2.4])).toEqual(['3', '2', '1', '0']);
  expect(texts('times', [107, 247])).toEqual(['250', '200', '150', '100']);
  expect(texts('metres_a_second', [0.63, 0.8])).toEqual(['0.80 m/s', '0.70 m/s', '0.60 m/s']);
  expect(texts('clock', [22.2, 24.4])).toEqual(['01:00', '00:00', '23:00', '22:00']);
  expect(texts('of_usual', [0.94, 1.07])).toEqual(['110 %', '100 %', '90 %']);
  expect(texts('amount', [0.61, 0.66])).toEqual(['0.66', '0.64', '0.62', '0.60']);
  expect(texts('amount', [120, 354])).toEqual(['400', '300', '200', '100']);
});

test('one value, and none, are drawn all the same', () => {
  expect(drawn(chart([7])).values.length).toBe(1);
  expect(drawn(chart([null])).dots).toEqual([]);
  expect(described(chart([null]))).toBe('Sleep: no data.');
});

test('the usual range is over the whole width, also over the first days of the usual ones', () => {
  const picture = drawn(chart(Array.from({ length: 14 }, () => 7), [6, 8]), 500);
  const ends = picture.usual.map((path) => path.match(/[\d.]+/g)!.map(Number)[0]);
  expect([ends, picture.usual.length]).toEqual([[picture.dots[0]!.x], 1]);
});

test('spans of days are drawn as far as the chart has them', () => {
  const { span, x, near } = drawn(chart([7, 7, 7, 8, 8]));
  const day = (number: number) => `2024-01-0${number}`;
  expect(span('2023-12-01', '2023-12-31')).toBeNull();
  expect(span('2024-01-06', '2024-02-01')).toBeNull();
  const whole = span('2023-12-01', '2024-02-01')!;
  expect([whole.x <= x(day(1))!, whole.x + whole.width >= x(day(5))!]).toEqual([true, true]);
  const part = span(day(2), day(3))!;
  expect([part.x < x(day(2))!, part.x > x(day(1))!, part.x + part.width > x(day(3))!, part.x + part.width < x(day(4))!]).toEqual([true, true, true, true]);
  expect([near(0)!.day, near(1000)!.day]).toEqual([day(1), day(5)]);
});

test('an axis has a unit', () => {
  const units = (unit: MeasureChart['unit'], measure = 'm') => unitOf({ unit, measure });
  expect([units('hours'), units('clock'), units('amount', 'density_morning'), units('amount')]).toEqual(['hours', 'time of day', 'events an hour', '']);
});

test('values are said as people read them', () => {
  expect([said('clock', 24.5), said('clock', 22.25), said('hours', 7.04), said('times', 2), said('of_usual', 0.93), said('amount', 0.618), said('amount', 354.2)]).toEqual(['00:30', '22:15', '7.0 h', '2', '93 %', '0.62', '354']);
  expect(described(chart([7, 7, 8], [6.5, 7.5]))).toBe('Sleep on 3 of 3 days; on Wednesday 3 January 2024 8.0 h, usual 6.5 h to 7.5 h.');
});
