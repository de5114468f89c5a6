// The calendar of a log: its months as grids of days, with the marks of each day.

import type { CareView, DayKnowledge, NoteView } from '../../wire';
import { inFull, inWords, monthOf, monthsLater, shifted, weekday } from './dates';
import { episodeOn } from './episodes';

export interface Cell {
  day: string;
  known: DayKnowledge;
  /** The first day of the episode that the day is within, which lasts or is over. */
  since: string | null;
  isOver: boolean;
  /** An episode was found on this day. */
  isFound: boolean;
  /** The number of unusual values. */
  odd: number;
  /** The day has a note. */
  noted: boolean;
  /** A reference begins on this day. */
  begins: boolean;
}

export interface Month {
  title: string;
  /** From Monday to Sunday; null for a day of another month, or outside of the log. */
  weeks: { days: (Cell | null)[]; numbers: (number | null)[] }[];
}

export function monthsOf(care: Pick<CareView, 'days' | 'episodes'>, notes: readonly NoteView[]): Month[] {
  const [first, last] = [care.days[0]?.day, care.days.at(-1)?.day];
  if (first === undefined || last === undefined) return [];
  const found = new Set(care.episodes.map((episode) => episode.found));
  const noted = new Set(notes.filter(({ note }) => note !== '').map(({ day }) => day));
  const begins = new Set(notes.filter(({ about, seen }) => about === 'reference' && seen).map(({ day }) => day));
  const cells = new Map(care.days.map(({ day, known, told }): [string, Cell] => {
    const episode = episodeOn(care, day);
    const odd = told.filter(({ beside }) => beside === 'more' || beside === 'less').length;
    return [day, { day, known, odd, since: episode?.since ?? null, isOver: (episode?.over ?? null) !== null, isFound: found.has(day), noted: noted.has(day), begins: begins.has(day) }];
  }));
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

export function described(cell: Cell): string {
  const parts = [inFull(cell.day)];
  if (cell.known === 'nobody_home') parts.push('away for most of the day');
  if (cell.known === 'partly') parts.push('incomplete data');
  if (cell.odd > 0) parts.push(`${cell.odd} unusual ${cell.odd === 1 ? 'measure' : 'measures'}`);
  if (cell.since !== null) parts.push(`within the change since ${inWords(cell.since)}${cell.isOver ? ', which is over' : ''}`);
  if (cell.isFound) parts.push('a change was found');
  if (cell.begins) parts.push('a comparison begins');
  if (parts.length === 1) parts.push('nothing unusual');
  if (cell.noted) parts.push('with a note');
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
