// Two intervals of days side by side: the value of each measure in both, and the differences in words.

import type { CareView, MeasureChart, ValueForm } from '../../wire';
import { said } from './chart';
import { shifted } from './dates';

/** First and last day. */
export interface Span {
  from: string;
  to: string;
}

export interface MeasureComparison {
  measure: string;
  title: string;
  is_guess: boolean;
  first: Side;
  second: Side;
  /** The first compared with the second. */
  words: string;
  /** More in the first, or less; null if about the same, or unknown. */
  is_more: boolean | null;
}

export interface Side {
  /** The values of known days. */
  values: number[];
  mean: number | null;
  words: string;
}

/** Smallest number of days of each for a difference (our choice). */
const LEAST_DAYS = 3;

/** Smallest number of standard errors of a difference (our choice). */
const APART_SE = 2;

/** The last two weeks and the two before; the halves of a short log. */
export function usualSpans(care: Pick<CareView, 'days' | 'day'>): [Span, Span] | null {
  const [first, last] = [care.days[0]?.day, care.day ?? care.days.at(-1)?.day];
  if (first === undefined || last === undefined) return null;
  const known = care.days.findIndex(({ day }) => day === last) + 1;
  const length = Math.max(Math.min(14, Math.floor(known / 2)), 1);
  const middle = shifted(last, 1 - length);
  const before = shifted(middle, -1);
  return [{ from: middle, to: last }, { from: shifted(middle, -length), to: before < first ? first : before }];
}

export function compared(care: Pick<CareView, 'charts'>, first: Span, second: Span): MeasureComparison[] {
  return care.charts.map((chart) => {
    const [one, other] = [sideOf(chart, first), sideOf(chart, second)];
    const { words, is_more } = difference(chart, one, other);
    return { measure: chart.measure, title: chart.title, is_guess: chart.is_guess, first: one, second: other, words, is_more };
  });
}

function sideOf(chart: MeasureChart, { from, to }: Span): Side {
  const values = chart.days.flatMap(({ day, value }) => (value !== null && day >= from && day <= to ? [value] : []));
  const mean = values.length === 0 ? null : values.reduce((sum, value) => sum + value, 0) / values.length;
  return { values, mean, words: mean === null ? 'no data' : said(chart.unit, mean) };
}

function difference(chart: MeasureChart, one: Side, other: Side): Pick<MeasureComparison, 'words' | 'is_more'> {
  if (one.mean === null || other.mean === null || Math.min(one.values.length, other.values.length) < LEAST_DAYS) {
    return { words: 'too few days', is_more: null };
  }
  const by = one.mean - other.mean;
  const error = Math.sqrt(variance(one.values, one.mean) / one.values.length + variance(other.values, other.mean) / other.values.length);
  // Random differences, and those that people would not notice, count as none.
  if (Math.abs(by) < Math.max(APART_SE * error, chart.little / 2)) return { words: 'about the same', is_more: null };
  return { words: inWords(chart.unit, by, other.mean), is_more: by > 0 };
}

function variance(values: readonly number[], mean: number): number {
  return values.reduce((sum, value) => sum + (value - mean) ** 2, 0) / Math.max(values.length - 1, 1);
}

function inWords(unit: ValueForm, by: number, before: number): string {
  const much = Math.abs(by);
  const percent = () => `${Math.round((much / before) * 100)} %`;
  switch (unit) {
    case 'clock':
      return `${long(much)} ${by > 0 ? 'later' : 'earlier'}`;
    case 'hours':
      return `${long(much)} ${by > 0 ? 'more' : 'less'} a day`;
    case 'of_usual':
    case 'metres_a_second':
      return `${percent()} ${by > 0 ? 'faster' : 'slower'}`;
    case 'times':
      return `${much.toFixed(1)} ${by > 0 ? 'more' : 'fewer'} a day`;
  }
}

/** Hours in words: `25 minutes`, `1 hour 10 minutes`. */
function long(hours: number): string {
  const minutes = Math.round(hours * 60);
  const [whole, rest] = [Math.floor(minutes / 60), minutes % 60];
  const part = (count: number, one: string) => (count === 0 ? [] : [`${count} ${one}${count === 1 ? '' : 's'}`]);
  return [...part(whole, 'hour'), ...part(rest, 'minute')].join(' ');
}
