// Intervals with unknown activities: hatched, so that they do not look like silence, and stated in words.

import type { Ink } from '../plan/pen';
import { type Sight, firstFrom, left, right, xOf } from './axis';

/** An interval, and the number of a sensor's firings in it that are not shown. */
export type Unseen = Sight & { missing: number };

/** Distance between lines, in pixels. */
const APART = 6;

export function unseenIn(all: readonly Unseen[] | undefined, { from_us, to_us }: Sight): readonly Unseen[] {
  return (all ?? []).filter((part) => part.to_us > from_us && part.from_us < to_us);
}

/** Slanting lines over the visible parts, between two heights. */
export function hatch(pen: Ink, width: number, sight: Sight, all: readonly Unseen[] | undefined, [top, high]: [number, number], colour: string): void {
  const parts = unseenIn(all, sight);
  if (parts.length === 0) return;
  const place = (at_us: number) => Math.min(Math.max(xOf(sight.from_us, sight.to_us, width, at_us), left(width)), right(width));
  pen.beginPath();
  for (const part of parts) {
    const [begin, end] = [place(part.from_us), place(part.to_us)];
    // Lines of neighbours continue each other.
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

/** `fired` is in order. */
type Row = { fired?: ArrayLike<number>; unseen?: readonly Unseen[] };

const counted = (count: number) => count.toLocaleString('en-GB');

/** The hatched part of the visible interval, in words; null if all is known. */
export function unseenWords(bands: readonly Row[], lanes: readonly Row[], sight: Sight): string | null {
  const parts = lanes.flatMap(({ unseen }) => unseenIn(unseen, sight));
  const missing = parts.reduce((sum, part) => sum + part.missing, 0);
  if (missing === 0) return bands.some(({ unseen }) => unseenIn(unseen, sight).length > 0) ? 'Hatched: activities not loaded' : null;
  // Instants are whole: the next one is the first after the interval.
  const shown = lanes.reduce((sum, { fired = [] }) => sum + firstFrom(fired, Math.floor(sight.to_us) + 1) - firstFrom(fired, sight.from_us), 0);
  const isWhole = parts.every(({ from_us, to_us }) => from_us >= sight.from_us && to_us <= sight.to_us);
  const how = isWhole ? `${counted(shown)} of ${counted(shown + missing)} events are loaded` : `${counted(shown)} events are loaded, up to ${counted(missing)} are not`;
  return `${how}. Hatched: not loaded`;
}
