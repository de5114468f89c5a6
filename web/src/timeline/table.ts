// What is in sight as a table of text, for other programs.

import type { Sight } from '../charts/axis';
import { type Band, type Lane, firstFrom } from '../charts/lanes';

/** A cell: what has a comma, a quote or a line's end stands in quotes, and what a spreadsheet would take for a formula is none. */
function cell(text: string): string {
  const plain = /^[=+\-@\t\r]/.test(text) && !/^-?[\d.]+$/.test(text) ? `'${text}` : text;
  return /[",\n\r]/.test(plain) ? `"${plain.replaceAll('"', '""')}"` : plain;
}

/** A row for each span and each firing, or, of counts, for each part of the time that has some. */
export function tableOf(sight: Sight, bands: readonly Band[], lanes: readonly Lane[], clock: (at_us: number) => string): string {
  const rows: [at: number, string][] = [];
  const row = (begin: number, end: number | null, what: string, name: string, said: string) =>
    rows.push([begin, [clock(begin), end === null ? '' : clock(end), what, name, said].map(cell).join(',')]);
  const { from_us, to_us } = sight;
  for (const { name, spans, names, isRoom } of bands) {
    for (const [begin, end, what] of spans) {
      if (end > from_us && begin < to_us) row(Math.max(begin, from_us), Math.min(end, to_us), isRoom ? 'room' : 'activity', name, names[what] ?? '');
    }
  }
  for (const { name, fired, said, density, curve } of lanes) {
    if (density !== undefined) {
      const { counts, bucket_us } = density;
      for (let part = Math.max(Math.floor(from_us / bucket_us), 0); part < counts.length && part * bucket_us < to_us; part++) {
        if (counts[part]! > 0) row(part * bucket_us, (part + 1) * bucket_us, 'count', name, String(counts[part]));
      }
      continue;
    }
    for (let index = firstFrom(fired, from_us); index < fired.length && fired[index]! <= to_us; index++) {
      row(fired[index]!, null, 'sensor', name, curve === undefined ? (said?.(index) ?? '') : String(curve.values[index]));
    }
  }
  rows.sort(([a], [b]) => a - b);
  return `begin,end,what,name,said\n${rows.map(([, text]) => `${text}\n`).join('')}`;
}
