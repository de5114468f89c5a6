// Time of which what was done is not known: it is hatched, so that it does not look like silence, and said in words.

import type { Ink } from '../plan/pen';
import { type Sight, firstFrom, left, right, xOf } from './axis';

/** A part of the time, and how many firings of a sensor were in it that are not shown. */
export type Unseen = Sight & { missing: number };

/** From one line to the next, in pixels. */
const APART = 6;

/** What of `all` lies in sight. */
export function unseenIn(all: readonly Unseen[] | undefined, { from_us, to_us }: Sight): readonly Unseen[] {
  return (all ?? []).filter((part) => part.to_us > from_us && part.from_us < to_us);
}

/** Slanting lines over the parts in sight, between two heights. */
export function hatch(pen: Ink, width: number, sight: Sight, all: readonly Unseen[] | undefined, [top, high]: [number, number], colour: string): void {
  const parts = unseenIn(all, sight);
  if (parts.length === 0) return;
  const place = (at_us: number) => Math.min(Math.max(xOf(sight.from_us, sight.to_us, width, at_us), left(width)), right(width));
  pen.beginPath();
  for (const part of parts) {
    const [begin, end] = [place(part.from_us), place(part.to_us)];
    // Lines of neighbours go on in each other.
    for (let line = Math.ceil((begin - high) / APART) * APART; line < end; line += APART) {
      const [from, to] = [Math.max(line, begin), Math.min(line + high, end)];
      if (to <= from) continue;
      pen.moveTo(from, top + high - (from - line));
      pen.lineTo(to, top + high - (to - line));
    }
  }
  pen.globalAlpha = 0.55;
  pen.strokeStyle = colour;
  pen.lineWidth = 1;
  pen.stroke();
  pen.globalAlpha = 1;
}

/** What it fired is in order. */
type Row = { fired?: ArrayLike<number>; unseen?: readonly Unseen[] };

const counted = (count: number) => count.toLocaleString('en-GB');

/** What is hatched in what is in sight, in words; nothing where all is known. */
export function unseenWords(bands: readonly Row[], lanes: readonly Row[], sight: Sight): string | null {
  const parts = lanes.flatMap(({ unseen }) => unseenIn(unseen, sight));
  const missing = parts.reduce((sum, part) => sum + part.missing, 0);
  if (missing === 0) return bands.some(({ unseen }) => unseenIn(unseen, sight).length > 0) ? 'Hatched: activities not loaded' : null;
  // Instants are whole: the next one is that after the last in sight.
  const shown = lanes.reduce((sum, { fired = [] }) => sum + firstFrom(fired, Math.floor(sight.to_us) + 1) - firstFrom(fired, sight.from_us), 0);
  const isWhole = parts.every(({ from_us, to_us }) => from_us >= sight.from_us && to_us <= sight.to_us);
  const how = isWhole ? `${counted(shown)} of ${counted(shown + missing)} events are loaded` : `${counted(shown)} events are loaded, up to ${counted(missing)} are not`;
  return `${how}. Hatched: not loaded`;
}
