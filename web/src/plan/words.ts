// Names for drawings. They come from files of unknown origin: as long as a book, in any script, or with marks that
// reverse the text next to them.

/** Marks that reorder or break the text around them. */
const UNRULY = /[\u0000-\u001f\u007f-\u009f\u200e\u200f\u2028-\u202e\u2066-\u2069]/g;

const [ISOLATE, END] = ['\u2068', '\u2069'];

const letters = new Intl.Segmenter(undefined, { granularity: 'grapheme' });

/** At most `most` letters of a name, on one line. */
export function shortened(name: string, most: number): string {
  // A letter has few code units, so a long name is never split as a whole.
  const begin = name.slice(0, most * 16).replace(UNRULY, ' ');
  // Plain letters are single code units.
  if (/^[ -~]*$/.test(begin)) return begin.length > most ? `${begin.slice(0, most).trimEnd()}…` : begin;
  let [text, count] = ['', 0];
  for (const { segment } of letters.segment(begin)) {
    if (count === most) return `${text.trimEnd()}…`;
    text += segment;
    count += 1;
  }
  return begin.length < name.length ? `${text}…` : text;
}

/** The longest beginning of `name` within a width; null if fewer than two letters fit. */
export function fitting(name: string, width: number, measure: (text: string) => number): string | null {
  const whole = shortened(name, 48);
  if (measure(whole) <= width) return whole;
  for (let most = Math.min(whole.length - 1, 47); most >= 2; most -= 1) {
    const text = shortened(name, most);
    if (measure(text) <= width) return text;
  }
  return null;
}

/** A name with a direction of its own. */
export function isolated(text: string): string {
  return `${ISOLATE}${text}${END}`;
}

/** A word of a file or a log for display: `preparing breakfast`. */
export function spoken(word: string): string {
  return word.replaceAll('_', ' ');
}
