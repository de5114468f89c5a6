// The visible interval as a table of text, for other programs.

import type { Sight } from '../charts/axis';
import type { Runs } from './caption';
import { firstFrom } from '../charts/axis';
import type { Band, Counts, Lane } from '../charts/lanes';
import { unseenIn } from '../charts/unseen';

/** A cell: commas, quotes and line ends are quoted, and formulas of spreadsheets are defused. */
function cell(text: string): string {
  const plain = /^[=+\-@\t\r]/.test(text) && !/^-?[\d.]+$/.test(text) ? `'${text}` : text;
  return /[",\n\r]/.test(plain) ? `"${plain.replaceAll('"', '""')}"` : plain;
}

/**
 * A row for each interval and each firing, or, for counts, for each part with some. Rows of another run are marked, and
 * so are unknown parts, with their number of firings.
 */
export function tableOf(
  sight: Sight, bands: readonly Band[], lanes: readonly Lane[], clock: (at_us: number) => string, { first, second }: Pick<Runs, 'first' | 'second'>,
): string {
  const rows: [at: number, string][] = [];
  const row = (begin: number, end: number | null, what: string, isBeside: boolean, name: string, said: string) => {
    const cells = [clock(begin), end === null ? '' : clock(end), isBeside ? `${what} beside` : what, name, said, isBeside ? (second ?? '') : first];
    rows.push([begin, cells.map(cell).join(',')]);
  };
  const { from_us, to_us } = sight;
  const notSeen = (name: string, unseen: Lane['unseen']) => {
    for (const part of unseenIn(unseen, sight)) {
      // With its full length, since the number belongs to all of it.
      row(part.from_us, part.to_us, 'not seen', false, name, part.missing === 0 ? '' : part.missing === 1 ? '1 firing' : `${part.missing} firings`);
    }
  };
  for (const { name, spans, names, isRoom, isBeside, unseen } of bands) {
    notSeen(name, unseen);
    for (const [begin, end, what] of spans) {
      if (end > from_us && begin < to_us) row(Math.max(begin, from_us), Math.min(end, to_us), isRoom ? 'room' : 'activity', isBeside ?? false, name, names[what] ?? '');
    }
  }
  const counted = (name: string, { counts, bucket_us }: Counts, isBeside: boolean) => {
    for (let part = Math.max(Math.floor(from_us / bucket_us), 0); part < counts.length && part * bucket_us < to_us; part++) {
      if (counts[part]! > 0) row(part * bucket_us, (part + 1) * bucket_us, 'count', isBeside, name, String(Math.round(counts[part]! * 100) / 100));
    }
  };
  const fires = (name: string, fired: ArrayLike<number>, isBeside: boolean, said: (index: number) => string) => {
    for (let index = firstFrom(fired, from_us); index < fired.length && fired[index]! <= to_us; index++) row(fired[index]!, null, 'sensor', isBeside, name, said(index));
  };
  for (const lane of lanes) {
    notSeen(lane.name, lane.unseen);
    const { name, fired, said, density, curve } = lane;
    if (density !== undefined) {
      counted(name, density, false);
      if (lane.densityBeside) counted(name, lane.densityBeside.counts, true);
      continue;
    }
    fires(name, fired, false, (index) => (curve === undefined ? (said?.(index) ?? '') : String(curve.values[index])));
    if (lane.beside) fires(name, lane.beside.fired, true, lane.beside.said);
  }
  rows.sort(([a], [b]) => a - b);
  return `begin,end,what,name,said,run\n${rows.map(([, text]) => `${text}\n`).join('')}`;
}
