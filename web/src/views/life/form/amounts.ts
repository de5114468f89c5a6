// Amounts of statements as people write them: times of day as hh:mm, lengths in minutes, shares in percent.

/** The usual values go from `from` to `to`; no value is below `low` or above `high`. */
export type Trapezoid = { low: number; from: number; to: number; high: number };

export type Amount = 'clock' | 'minutes' | 'percent' | 'days' | 'metres' | 'speed' | 'factor' | 'rate' | 'plain';

const DAY_S = 86_400;

/** How far a time of day without another word varies, in seconds, and a length as a share: as the language has it. */
const PLAIN_TIME_S = 300;
const PLAIN_SHARE = 0.1;

/** A unit after the field, and the size of one in the data. */
export const UNITS: Readonly<Record<Amount, { unit: string; size: number }>> = {
  clock: { unit: 'hh:mm', size: 1 },
  minutes: { unit: 'min', size: 60 },
  percent: { unit: '%', size: 0.01 },
  days: { unit: 'days', size: 1 },
  metres: { unit: 'm', size: 1 },
  speed: { unit: 'm/s', size: 1 },
  factor: { unit: 'times', size: 1 },
  rate: { unit: 'a minute', size: 1 },
  plain: { unit: '', size: 1 },
};

/** The values that a number may have. */
export type Limits = { whole?: boolean; least?: number | undefined; most?: number | undefined };

/** The largest number that a field takes (our choice). */
const LARGEST = 1e9;

const two = (number: number) => String(number).padStart(2, '0');

/** A value as the text of its field. */
export function shown(value: number, amount: Amount): string {
  if (amount === 'clock') {
    const minutes = Math.round((((value % DAY_S) + DAY_S) % DAY_S) / 60) % 1440;
    return `${two(Math.floor(minutes / 60))}:${two(minutes % 60)}`;
  }
  return String(Number((value / UNITS[amount].size).toPrecision(10)));
}

/**
 * The value of a field's text; null for a text that is none.
 * @param old decides whether a time is after midnight.
 */
export function read(text: string, amount: Amount, old = 0): number | null {
  const written = text.trim().replace(',', '.');
  if (amount === 'clock') {
    const found = /^(\d{1,2})(?:[:.]?(\d{2}))?$/.exec(written);
    const [hours, minutes] = [Number(found?.[1]), Number(found?.[2] ?? 0)];
    if (found === null || hours > 24 || minutes > 59 || (hours === 24 && minutes > 0)) return null;
    return hours * 3600 + minutes * 60 + (old >= DAY_S && hours < 24 ? DAY_S : 0);
  }
  const number = Number(written);
  // 7 % is 0.07, not 0.07000000000000001.
  const value = amount === 'percent' ? number / 100 : Number((number * UNITS[amount].size).toPrecision(15));
  return written !== '' && Math.abs(value) <= LARGEST ? value : null;
}

/** The fault of a field's text; empty for a value. */
export function faultOf(text: string, amount: Amount, { whole = false, least, most }: Limits, old = 0): string {
  const value = read(text, amount, old);
  const isInside = value !== null && (!whole || Number.isInteger(value)) && value >= (least ?? -LARGEST) && value <= (most ?? LARGEST);
  if (isInside) return '';
  const [from, to] = [least, most].map((limit) => (limit === undefined ? '' : shown(limit, amount)));
  if (amount === 'clock') return value === null ? 'Write a time such as 14:30.' : `Write a time ${value < (least ?? 0) ? `from ${from} on` : `up to ${to}`}.`;
  const bounds = from !== '' && to !== '' ? ` from ${from} to ${to}` : from !== '' ? `, ${from} or more` : to !== '' ? `, ${to} or less` : '';
  return `Write a ${whole ? 'whole ' : ''}number${bounds}.`;
}

/** A time after midnight that belongs to the evening before. */
export const isAfterMidnight = (value: Trapezoid) => value.from >= DAY_S;

export function setAfterMidnight(value: Trapezoid, is: boolean): Trapezoid {
  const by = is === isAfterMidnight(value) ? 0 : is ? DAY_S : -DAY_S;
  return { low: value.low + by, from: value.from + by, to: value.to + by, high: value.high + by };
}

/** Usual values with the outer bounds of a sentence that states no others. */
export function plain(from: number, to: number, amount: Amount): Trapezoid {
  const [below, above] = from !== to ? [0, 0] : amount === 'clock' ? [PLAIN_TIME_S, PLAIN_TIME_S] : amount === 'minutes' ? [from * PLAIN_SHARE, to * PLAIN_SHARE] : [0, 0];
  return { low: from - below, from, to, high: to + above };
}

const isNear = (a: number, b: number) => Math.abs(a - b) <= 1e-6 * Math.max(1, Math.abs(a), Math.abs(b));

function hasPlainBounds(value: Trapezoid, amount: Amount): boolean {
  const usual = plain(value.from, value.to, amount);
  return isNear(value.low, usual.low) && isNear(value.high, usual.high);
}

/** Whether outer bounds are stated that reach further than the usual values and than those of a plain sentence. */
export function hasOwnBounds(value: Trapezoid, amount: Amount): boolean {
  const isExact = isNear(value.low, value.from) && isNear(value.high, value.to);
  return !isExact && !hasPlainBounds(value, amount);
}

/** Longest time between the two ends of a range across midnight, in seconds (our choice). */
const LONGEST_NIGHT_S = DAY_S / 2;

/** The end of a range of times of day: from 23:00 to 01:00, it is on the next day. */
function endOf(from: number, to: number): number {
  const sameDay = (to % DAY_S) + Math.floor(from / DAY_S) * DAY_S;
  return sameDay < from && sameDay + DAY_S - from <= LONGEST_NIGHT_S ? sameDay + DAY_S : sameDay;
}

/** The second value is before the first. */
export const isTurned = (value: Trapezoid) => value.to < value.from;

/** Another first or second usual value. The other one stays, and outer bounds that were stated keep their distance. */
export function withUsual(value: Trapezoid, side: 'from' | 'to', next: number, amount: Amount): Trapezoid {
  const [first, second] = side === 'from' ? [next, value.to] : [value.from, next];
  return between(value, first, amount === 'clock' ? endOf(first, second) : second, amount);
}

/** A single usual value. */
export function withSingle(value: Trapezoid, next: number, amount: Amount): Trapezoid {
  return between(value, next, next, amount);
}

function between(value: Trapezoid, from: number, to: number, amount: Amount): Trapezoid {
  if (hasPlainBounds(value, amount)) return plain(from, to, amount);
  return { low: from - (value.from - value.low), from, to, high: to + (value.high - value.to) };
}

/** Other outer bounds. The language states both by one "give or take". */
export function withSpread(value: Trapezoid, spread: number): Trapezoid {
  return { ...value, low: value.from - spread, high: value.to + spread };
}
