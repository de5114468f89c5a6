// Days in the words of the care view. A day is a date such as `2009-03-02`; the page knows no time zone.

import { read } from '../../clock';

const DAY_MS = 86_400_000;

const form = (options: Intl.DateTimeFormatOptions) => new Intl.DateTimeFormat('en-GB', { timeZone: 'UTC', ...options });
const long = form({ weekday: 'long', day: 'numeric', month: 'long', year: 'numeric' });
const medium = form({ weekday: 'short', day: 'numeric', month: 'short' });
const short = form({ day: 'numeric', month: 'short' });
const date = form({ day: 'numeric', month: 'long' });
const whole = form({ day: 'numeric', month: 'long', year: 'numeric' });
const month = form({ month: 'long', year: 'numeric' });

const ms = (day: string) => read(`${day} 00:00:00`);
const said = (format: Intl.DateTimeFormat, day: string) => (Number.isFinite(ms(day)) ? format.format(ms(day)) : day);

/** `Monday 2 March 2009`. */
export const inFull = (day: string) => said(long, day).replace(',', '');

/** `Mon 2 Mar`. */
export const inShort = (day: string) => said(medium, day).replace(',', '');

/** `2 Mar`. */
export const dayAndMonth = (day: string) => said(short, day);

/** `2 March`. */
export const inWords = (day: string) => said(date, day);

/** `2 March 2009`. */
export const withYear = (day: string) => said(whole, day);

/** `2 to 29 March 2009`, with all parts in which both differ. */
export function spanInWords(from: string, to: string): string {
  if (from === to) return withYear(to);
  const begin = from.slice(0, 7) === to.slice(0, 7) ? String(Number(from.slice(8))) : from.slice(0, 4) === to.slice(0, 4) ? inWords(from) : withYear(from);
  return `${begin} to ${withYear(to)}`;
}

/** `March 2009`. */
export const monthOf = (day: string) => said(month, day);

/** A number of days later. */
export function shifted(day: string, days: number): string {
  return new Date(ms(day) + days * DAY_MS).toISOString().slice(0, 10);
}

/** The number of days from one to another. */
export function between(from: string, to: string): number {
  return Math.round((ms(to) - ms(from)) / DAY_MS);
}

/** The day of the week, 0 for Monday. */
export function weekday(day: string): number {
  return (new Date(ms(day)).getUTCDay() + 6) % 7;
}

/** The same day of another month, or its last one. */
export function monthsLater(day: string, months: number): string {
  const [year, of, date] = day.split('-').map(Number) as [number, number, number];
  const first = new Date(Date.UTC(year, of - 1 + months, 1));
  const last = new Date(Date.UTC(year, of + months, 0)).getUTCDate();
  return shifted(first.toISOString().slice(0, 10), Math.min(date, last) - 1);
}
