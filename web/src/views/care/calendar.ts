// The calendar of a log: its months as grids of days, with the marks of each day.

import type { AlertView, CareView, DayKnowledge, NoteView } from '../../wire';
import { inFull, monthOf, monthsLater, shifted, weekday } from './dates';

export interface Cell {
  day: string;
  known: DayKnowledge;
  /** Alerts that are not handled, and handled ones. */
  open: number;
  seen: number;
  /** The number of unusual values. */
  odd: number;
  /** The day has a note. */
  noted: boolean;
}

export interface Month {
  title: string;
  /** From Monday to Sunday; null for a day of another month, or outside of the log. */
  weeks: { days: (Cell | null)[]; numbers: (number | null)[] }[];
}

export const keyOf = ({ day, rule }: Pick<AlertView, 'day' | 'rule'>) => `${day} ${rule}`;

/** A key that differs between alerts: those of several sensors on one day share their notes. */
export const apart = (alert: Pick<AlertView, 'day' | 'rule' | 'words'>) => `${keyOf(alert)} ${alert.words}`;

export function monthsOf(care: Pick<CareView, 'days' | 'alerts'>, notes: readonly NoteView[]): Month[] {
  const [first, last] = [care.days[0]?.day, care.days.at(-1)?.day];
  if (first === undefined || last === undefined) return [];
  const cells = new Map(care.days.map(({ day, known, told }) => {
    const odd = told.filter(({ is_more }) => is_more !== null).length;
    return [day, { day, known, odd, open: 0, seen: 0, noted: false } as Cell];
  }));
  const seen = new Set(notes.filter((note) => note.seen).map(keyOf));
  for (const alert of care.alerts) {
    const cell = cells.get(alert.day);
    if (cell) cell[seen.has(keyOf(alert)) ? 'seen' : 'open'] += 1;
  }
  for (const { day, note } of notes) {
    const cell = cells.get(day);
    if (cell && note !== '') cell.noted = true;
  }
  const months: Month[] = [];
  for (let begin = `${first.slice(0, 7)}-01`; begin <= last; begin = monthsLater(begin, 1)) {
    const weeks: Month['weeks'] = [];
    for (let monday = shifted(begin, -weekday(begin)); monday.slice(0, 7) <= begin.slice(0, 7); monday = shifted(monday, 7)) {
      const week = Array.from({ length: 7 }, (_, index) => shifted(monday, index));
      const isOfMonth = (day: string) => day.startsWith(begin.slice(0, 7));
      const days = week.map((day) => (isOfMonth(day) ? (cells.get(day) ?? null) : null));
      // Weeks outside of the log are left out.
      if (days.every((cell) => cell === null)) continue;
      weeks.push({ days, numbers: week.map((day) => (isOfMonth(day) ? Number(day.slice(8)) : null)) });
    }
    months.push({ title: monthOf(begin), weeks });
  }
  return months;
}

/** A usual value is known, on a day or at all, for any measure or for one with a chart: without it nothing can be unusual. */
export function hasUsual(care: Pick<CareView, 'charts'>, day: string | null = null, measure: string | null = null): boolean {
  const own = care.charts.filter((chart) => chart.measure === measure);
  return (own.length > 0 ? own : care.charts).some((chart) => chart.days.some((point) => point.usual !== null && (day === null || point.day === day)));
}

export function described(cell: Cell): string {
  const parts = [inFull(cell.day)];
  if (cell.known === 'nobody_home') parts.push('away for most of the day');
  if (cell.known === 'partly') parts.push('incomplete data');
  const alerts = (count: number) => `${count} ${count === 1 ? 'alert' : 'alerts'}`;
  if (cell.open > 0) parts.push(`${alerts(cell.open)} open`);
  if (cell.seen > 0) parts.push(`${alerts(cell.seen)} acknowledged`);
  if (cell.odd > 0) parts.push(`${cell.odd} unusual ${cell.odd === 1 ? 'measure' : 'measures'}`);
  if (cell.noted) parts.push('with a note');
  if (parts.length === 1) parts.push('nothing unusual');
  return parts.join(', ');
}

/** The target of a key from a day, within the log; null without one. */
export function stepped(key: string, day: string, first: string, last: string): string | null {
  const to = (() => {
    switch (key) {
      case 'ArrowLeft':
        return shifted(day, -1);
      case 'ArrowRight':
        return shifted(day, 1);
      case 'ArrowUp':
        return shifted(day, -7);
      case 'ArrowDown':
        return shifted(day, 7);
      case 'Home':
        return shifted(day, -weekday(day));
      case 'End':
        return shifted(day, 6 - weekday(day));
      case 'PageUp':
        return monthsLater(day, -1);
      case 'PageDown':
        return monthsLater(day, 1);
      default:
        return null;
    }
  })();
  if (to === null) return null;
  return to < first ? first : to > last ? last : to;
}
