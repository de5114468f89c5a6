// A chart of a measure: the positions of its days, its usual range, spans of days and its axes. Lengths are pixels.

import type { ChartPoint, MeasureChart, ValueForm } from '../../wire';
import { dayAndMonth, inFull } from './dates';

/** Default width, before it is measured. */
export const WIDTH = 560;
export const HEIGHT = 128;
export const LEFT = 58;
export const BOTTOM = 22;
export const TOP = 10;
/** Distance between readable dates, and from the last day to the edge. */
const DATE_APART = 52;
const RIGHT = 12;
/** Distances of labelled values in their unit, the smallest first; larger ones, and those of amounts, are 1, 2 or 5 with zeros. */
const STEPS: Record<ValueForm, readonly number[]> = { hours: [0.5, 1, 2, 4, 8], clock: [0.5, 1, 2, 4, 8], times: [1], of_usual: [0.1, 0.2, 0.5], metres_a_second: [0.1, 0.2, 0.5], amount: [0.01] };
/** Largest number of steps of an axis (our choice). */
const MOST_STEPS = 4;

const UNITS: Record<ValueForm, string> = { hours: 'hours', clock: 'time of day', times: 'times a day', of_usual: 'of the usual pace', metres_a_second: 'metres a second', amount: '' };
/** Units of amounts, by measure. */
const AMOUNTS: Record<string, string> = { restlessness: 'bouts an hour', density_night: 'events an hour', density_morning: 'events an hour', density_afternoon: 'events an hour', density_evening: 'events an hour' };

export interface Drawn {
  /** The usual range, as paths: one for each series of days with a usual value. */
  usual: string[];
  /** The known days. */
  dots: { x: number; y: number; day: ChartPoint }[];
  /** The first day of each month, or of each week of a short log. */
  dates: { x: number; text: string }[];
  /** The position of a day. */
  x: (day: string) => number | null;
  /** The left edge and the width of a span of days, as far as the chart has them. */
  span: (from: string, to: string) => { x: number; width: number } | null;
  /** The known day that is nearest to a position. */
  near: (x: number) => ChartPoint | null;
  /** The labelled values, with their positions. */
  values: { y: number; text: string }[];
}

export function unitOf({ unit, measure }: Pick<MeasureChart, 'unit' | 'measure'>): string {
  return unit === 'amount' ? (AMOUNTS[measure] ?? '') : UNITS[unit];
}

/** A value in words. */
export function said(unit: ValueForm, value: number): string {
  switch (unit) {
    case 'clock': {
      const minutes = Math.round(value * 60);
      const two = (part: number) => String(part).padStart(2, '0');
      return `${two(Math.floor(minutes / 60) % 24)}:${two(((minutes % 60) + 60) % 60)}`;
    }
    case 'hours':
      return `${value.toFixed(1)} h`;
    case 'of_usual':
      return `${Math.round(value * 100)} %`;
    case 'metres_a_second':
      return `${value.toFixed(2)} m/s`;
    case 'times':
      return Number.isInteger(value) || value >= 20 ? value.toFixed(0) : value.toFixed(1);
    case 'amount':
      return value.toFixed(value >= 20 ? 0 : value >= 2 ? 1 : 2);
  }
}

/** The largest multiple of a step that is at most a value. */
function floored(value: number, step: number): number {
  // Rounding errors do not matter.
  return Math.floor(value / step + 1e-6) * step;
}

/** The labelled values of an axis, the highest first: multiples of a round step, around all values. */
function labelled(unit: ValueForm, values: readonly number[]): number[] {
  if (values.length === 0) return [1, 0];
  const [least, most] = [Math.min(...values), Math.max(...values)];
  const decades = [0.01, 0.1, 1, 10, 100, 1000, 10_000].flatMap((ten) => [1, 2, 5].map((times) => times * ten));
  const steps = [...STEPS[unit], ...decades.filter((step) => step > STEPS[unit].at(-1)!)];
  const step = steps.find((step) => (most - least) / step <= MOST_STEPS - 1) ?? most - least;
  const [low, high] = [floored(least, step), -floored(-most, step)];
  return Array.from({ length: Math.round((high - low) / step) + 1 }, (_, index) => high - index * step);
}

/** The usual range of each day. The first days of a reference have the range of the same weekday later. */
function ranges({ days }: MeasureChart): (readonly [number, number] | null)[] {
  const all: (readonly [number, number] | null)[] = days.map(({ usual }) => usual);
  for (let day = all.length - 1; day >= 0; day--) all[day] ??= all[day + 7] ?? null;
  return all;
}

/** The usual range as paths: one for each series of days that have one. */
function bands(all: readonly (readonly [number, number] | null)[], x: (day: number) => number, y: (value: number) => number): string[] {
  const paths: string[] = [];
  let from: number | null = null;
  for (let day = 0; day <= all.length; day++) {
    const has = day < all.length && all[day] !== null;
    if (has) from ??= day;
    if (has || from === null) continue;
    const days = Array.from({ length: day - from }, (_, index) => from! + index);
    const edge = (of: 0 | 1, among: number[]) => among.map((one) => `${x(one).toFixed(1)},${y(all[one]![of]).toFixed(1)}`);
    paths.push(`M${[...edge(1, days), ...edge(0, days.toReversed())].join('L')}Z`);
    from = null;
  }
  return paths;
}

/** The positions of all parts of a chart. */
export function drawn(chart: MeasureChart, width = WIDTH): Drawn {
  const usual = ranges(chart);
  const labels = labelled(chart.unit, [...chart.days.flatMap(({ value }) => value ?? []), ...usual.flatMap((range) => range ?? [])]);
  const [high, low] = [labels[0]!, labels.at(-1)!];
  const step = (width - LEFT - RIGHT) / Math.max(chart.days.length - 1, 1);
  const x = (day: number) => LEFT + day * step;
  const y = (value: number) => TOP + ((high - value) / (high - low || 1)) * (HEIGHT - TOP - BOTTOM);
  const dots = chart.days.flatMap((day, index) => (day.value === null ? [] : [{ x: x(index), y: y(day.value), day }]));
  const at = new Map(chart.days.map(({ day }, index) => [day, x(index)]));
  const [first, last] = [chart.days[0]?.day ?? '', chart.days.at(-1)?.day ?? ''];
  const span = (from: string, to: string) => {
    if (to < first || from > last || from > to) return null;
    const [begin, end] = [at.get(from < first ? first : from)!, at.get(to > last ? last : to)!];
    const left = Math.max(begin - step / 2, LEFT);
    return { x: left, width: Math.min(end + step / 2, width) - left };
  };
  const near = (place: number) => dots.reduce<(typeof dots)[number] | null>((best, dot) => (best === null || Math.abs(dot.x - place) < Math.abs(best.x - place) ? dot : best), null)?.day ?? null;
  return { usual: bands(usual, x, y), dots, dates: datesOf(chart, x, step, width), x: (day) => at.get(day) ?? null, span, near, values: labels.map((value) => ({ y: y(value), text: said(chart.unit, value) })) };
}

/** The labelled dates, as close as they are readable. */
function datesOf(chart: MeasureChart, x: (day: number) => number, step: number, width: number): Drawn['dates'] {
  const isLong = chart.days.length > 70;
  let last = -Infinity;
  return chart.days.flatMap(({ day }, index) => {
    const begins = isLong ? day.endsWith('-01') : index % 7 === 0;
    if (!begins || index * step >= width - LEFT - 24 || x(index) - last < DATE_APART) return [];
    last = x(index);
    return [{ x: x(index), text: dayAndMonth(day) }];
  });
}

/** A chart in a sentence, for screen readers. */
export function described(chart: MeasureChart): string {
  const known = chart.days.filter(({ value }) => value !== null);
  const last = known.at(-1);
  if (!last) return `${chart.title}: no data.`;
  const usual = last.usual ? `, usual ${said(chart.unit, last.usual[0])} to ${said(chart.unit, last.usual[1])}` : '';
  return `${chart.title} on ${known.length} of ${chart.days.length} days; on ${inFull(last.day)} ${said(chart.unit, last.value!)}${usual}.`;
}
