// A small chart: the positions of its days, its usual range and its lines. Lengths are pixels.

import type { ChartPoint, MeasureChart, ValueForm } from '../../wire';
import { dayAndMonth, inFull } from './dates';

/** Default width, before it is measured. */
export const WIDTH = 560;
export const HEIGHT = 120;
export const LEFT = 58;
const BOTTOM = 20;
const TOP = 8;
/** Distance between readable dates. */
const DATE_APART = 52;
/** The ends of a chart are multiples of these, in its unit. */
const STEPS: Record<ValueForm, number> = { hours: 0.5, clock: 0.5, times: 1, of_usual: 0.1, metres_a_second: 0.1 };

export interface Drawn {
  /** The usual range, as paths: one for each series of days with a usual value. */
  usual: string[];
  /** The known days. */
  dots: { x: number; y: number; day: ChartPoint }[];
  /** The first day of each month, or of each week of a short log. */
  dates: { x: number; text: string }[];
  /** The position of a day. */
  x: (day: string) => number | null;
  /** The lowest and the highest value, with their positions. */
  values: { y: number; text: string }[];
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
      return Number.isInteger(value) ? String(value) : value.toFixed(1);
  }
}

/** The largest multiple of a step that is at most a value. */
function floored(value: number, step: number): number {
  // Rounding errors do not matter.
  return Math.floor(value / step + 1e-6) * step;
}

/** The positions of all parts of a chart. */
export function drawn(chart: MeasureChart, width = WIDTH): Drawn {
  const values = chart.days.flatMap(({ value, usual }) => [...(value === null ? [] : [value]), ...(usual ?? [])]);
  const whole = STEPS[chart.unit];
  const [low, high] = values.length > 0 ? [floored(Math.min(...values), whole), -floored(-Math.max(...values), whole)] : [0, 1];
  const span = high - low || 1;
  const step = (width - LEFT - 12) / Math.max(chart.days.length - 1, 1);
  const x = (day: number) => LEFT + day * step;
  const y = (value: number) => TOP + ((high - value) / span) * (HEIGHT - TOP - BOTTOM);
  const usual: string[] = [];
  let from: number | null = null;
  for (let day = 0; day <= chart.days.length; day++) {
    const has = day < chart.days.length && chart.days[day]!.usual !== null;
    if (has && from === null) from = day;
    if (!has && from !== null) {
      const days = Array.from({ length: day - from }, (_, index) => from! + index);
      const edge = (of: 0 | 1, among: number[]) => among.map((one) => `${x(one).toFixed(1)},${y(chart.days[one]!.usual![of]).toFixed(1)}`);
      usual.push(`M${[...edge(1, days), ...edge(0, [...days].reverse())].join('L')}Z`);
      from = null;
    }
  }
  const dots = chart.days.flatMap((day, index) => (day.value === null ? [] : [{ x: x(index), y: y(day.value), day }]));
  const apart = chart.days.length > 70 ? 'month' : 'week';
  let last = -Infinity;
  const dates = chart.days.flatMap((day, index) => {
    const begins = apart === 'month' ? day.day.endsWith('-01') : index % 7 === 0;
    const isFar = index * step < width - LEFT - 24 && x(index) - last >= DATE_APART;
    if (begins && isFar) last = x(index);
    return begins && isFar ? [{ x: x(index), text: dayAndMonth(day.day) }] : [];
  });
  const ends = low === high ? [low] : [high, low];
  const at = new Map(chart.days.map(({ day }, index) => [day, x(index)]));
  return { usual, dots, dates, x: (day) => at.get(day) ?? null, values: ends.map((value) => ({ y: y(value), text: said(chart.unit, value) })) };
}

/** A chart in a sentence, for screen readers. */
export function described(chart: MeasureChart): string {
  const known = chart.days.filter(({ value }) => value !== null);
  const last = known.at(-1);
  if (!last) return `${chart.title}: no data.`;
  const usual = last.usual ? `, usual ${said(chart.unit, last.usual[0])} to ${said(chart.unit, last.usual[1])}` : '';
  return `${chart.title} on ${known.length} of ${chart.days.length} days; on ${inFull(last.day)} ${said(chart.unit, last.value!)}${usual}.`;
}
