// Two periods of days: their presets, the value of each measure in both, and the differences in words.

import type { CareView, MeasureChart, MeasureGroup, ValueForm } from '../../wire';
import { said } from './chart';
import { between, shifted } from './dates';

/** First and last day. */
export interface Span {
  from: string;
  to: string;
}

export interface MeasureComparison {
  measure: string;
  title: string;
  group: MeasureGroup;
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

/** Days of the periods of a preset (our choice). */
const [LAST_DAYS, MONTH_DAYS] = [14, 28];
/** A year of whole weeks, so that weekdays are the same. */
const YEAR_DAYS = 364;

export type PresetName = 'reference' | 'month' | 'year' | 'halves';

/** A pair of periods that the log has. */
export interface Preset {
  name: PresetName;
  /** The second period, in words. */
  words: string;
  spans: [Span, Span];
}

type Days = Pick<CareView, 'days' | 'day' | 'reference'>;

/** The first day of the log, and the last one that counts. */
function boundsOf(care: Pick<CareView, 'days' | 'day'>): Span | null {
  const [from, to] = [care.days[0]?.day, care.day ?? care.days.at(-1)?.day];
  return from === undefined || to === undefined ? null : { from, to };
}

const least = (a: string, b: string) => (a < b ? a : b);
const most = (a: string, b: string) => (a > b ? a : b);

/** A period within others; null if too few days are left. */
function within({ from, to }: Span, bounds: Span): Span | null {
  const span = { from: most(from, bounds.from), to: least(to, bounds.to) };
  return between(span.from, span.to) + 1 < LEAST_DAYS ? null : span;
}

/** The presets that a log has, the best first. No period overlaps the other, or begins before the log. */
export function presetsOf(care: Days): Preset[] {
  const bounds = boundsOf(care);
  if (bounds === null) return [];
  const { from: first, to: last } = bounds;
  const recent = within({ from: shifted(last, 1 - LAST_DAYS), to: last }, bounds);
  const presets: Preset[] = [];
  const add = (name: PresetName, words: string, one: Span | null, other: Span | null) => {
    if (one !== null && other !== null) presets.push({ name, words, spans: [one, other] });
  };
  if (recent === null) return [];
  const { reference } = care;
  if (reference !== null) {
    const after = within({ from: most(recent.from, shifted(reference.to, 1)), to: last }, bounds);
    add('reference', 'the usual days', after, within(reference, bounds));
  }
  add('month', 'the month before', recent, within({ from: shifted(recent.from, -MONTH_DAYS), to: shifted(recent.from, -1) }, bounds));
  const yearBefore = { from: shifted(recent.from, -YEAR_DAYS), to: shifted(recent.to, -YEAR_DAYS) };
  add('year', 'the same weeks last year', recent, yearBefore.from < first ? null : yearBefore);
  if (presets.length === 0) {
    const middle = shifted(first, Math.ceil((between(first, last) + 1) / 2));
    add('halves', 'the days before', within({ from: middle, to: last }, bounds), within({ from: first, to: shifted(middle, -1) }, bounds));
  }
  return presets;
}

/** The days from a day on, and those before it: at most a month of each. */
export function aroundDay(care: Pick<CareView, 'days' | 'day'>, day: string): [Span, Span] | null {
  const bounds = boundsOf(care);
  if (bounds === null) return null;
  const [after, before] = [within({ from: day, to: shifted(day, MONTH_DAYS - 1) }, bounds), within({ from: shifted(day, -MONTH_DAYS), to: shifted(day, -1) }, bounds)];
  return after === null || before === null ? null : [after, before];
}

/** A period with another end, within the log; an end that passes the other sets both. */
export function changed(care: Pick<CareView, 'days' | 'day'>, { from, to }: Span, end: keyof Span, day: string): Span {
  const bounds = boundsOf(care) ?? { from: day, to: day };
  const inside = least(most(day, bounds.from), bounds.to);
  return end === 'from' ? { from: inside, to: most(inside, to) } : { from: least(from, inside), to: inside };
}

export const overlap = (one: Span, other: Span) => one.from <= other.to && other.from <= one.to;

export function compared(care: Pick<CareView, 'charts'>, first: Span, second: Span): MeasureComparison[] {
  return care.charts.map((chart) => {
    const [one, other] = [sideOf(chart, first), sideOf(chart, second)];
    const { words, is_more } = difference(chart, one, other);
    return { measure: chart.measure, title: chart.title, group: chart.group, is_guess: chart.is_guess, first: one, second: other, words, is_more };
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
  const percent = () => (before === 0 ? said(unit, much) : `${Math.round((much / Math.abs(before)) * 100)} %`);
  switch (unit) {
    case 'clock':
      return `${long(much)} ${by > 0 ? 'later' : 'earlier'}`;
    case 'hours':
      return `${long(much)} ${by > 0 ? 'more' : 'less'} a day`;
    case 'of_usual':
    case 'metres_a_second':
      return `${percent()} ${by > 0 ? 'faster' : 'slower'}`;
    case 'amount':
      return `${percent()} ${by > 0 ? 'more' : 'less'}`;
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
