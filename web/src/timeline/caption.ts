// The caption of a picture of the time line: its interval, its run or both runs, and the unknown parts.

import type { Sight } from '../charts/axis';
import { date, time } from '../clock';
import { type Calendar, clockOf } from '../localtime';
import type { Palette } from '../plan/palette';
import { FONT, type Ink } from '../plan/pen';
import { isolated, shortened } from '../plan/words';

/** One run, or two that are compared; `isCounts` for a drawing of counts. */
export type Runs = { first: string; second: string | null; isCounts: boolean };

const ROW = 17;
const MARGIN = 6;
/** Longest name of a run in the narrowest picture: a longer one keeps its beginning and its end, because names of twins differ at the end. */
const LONGEST_NAME = 80;

const rows = ({ second }: Runs, unseen: string | null) => (second === null ? 2 : 4) + (unseen === null ? 0 : 1);

export function captionHeight(runs: Runs, unseen: string | null): number {
  return rows(runs, unseen) * ROW + 2 * MARGIN;
}

/** @param unseen the unknown parts, in words. */
export function drawCaption(
  pen: Ink, top: number, calendar: Calendar, { from_us, to_us }: Sight, { first, second, isCounts }: Runs, unseen: string | null, palette: Palette,
): void {
  const when = (at_us: number) => {
    const clock = clockOf(calendar, Math.min(Math.max(at_us, 0), calendar.length_us));
    return `${date(clock)}, ${time(clock)}`;
  };
  let middle = top + MARGIN + ROW / 2;
  const line = (words: string, colour: string | null) => {
    if (colour !== null) {
      pen.fillStyle = colour;
      pen.fillRect(10, middle - 5.5, 3, 11);
    }
    pen.fillStyle = palette.text;
    pen.fillText(words, colour === null ? 8 : 20, middle + 0.5);
    middle += ROW;
  };
  pen.font = `11.5px ${FONT}`;
  pen.textAlign = 'left';
  pen.textBaseline = 'middle';
  line(`${when(from_us)} to ${when(to_us)}`, null);
  if (unseen !== null) line(unseen, null);
  if (second === null) return line(name(first), null);
  line(`above the line: ${name(first)}`, palette.seen);
  line(`below the line: ${name(second)}`, palette.beam);
  line(`The colours show ${isCounts ? 'where one run has more' : 'events that only one run has, and curves of values'}. Of two bands, the upper one is the run above the line.`, null);
}

function name(run: string): string {
  const letters = [...shortened(run, 1000)];
  const half = LONGEST_NAME / 2;
  return isolated(letters.length <= LONGEST_NAME ? letters.join('') : `${letters.slice(0, half - 1).join('')}…${letters.slice(-half).join('')}`);
}
