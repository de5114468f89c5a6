// Positions in a text. Problems have lines and columns, both from 1, with columns in Unicode characters; JavaScript
// counts code units, and rare characters have two.

/** The index after a number of characters. */
export function unitsAfter(text: string, characters: number): number {
  let [units, left] = [0, characters];
  while (left > 0 && units < text.length) {
    units += text.codePointAt(units)! > 0xffff ? 2 : 1;
    left -= 1;
  }
  return units;
}

export function lineOf(text: string, offset: number): { line: number; column: number } {
  const before = text.slice(0, offset);
  const begin = before.lastIndexOf('\n') + 1;
  return { line: before.split('\n').length, column: [...before.slice(begin)].length + 1 };
}

/** The index of a line and a column; beyond the last line it is in the last one, beyond a line's end at its end. */
export function offsetOf(text: string, line: number, column: number): number {
  let begin = 0;
  for (let at = 1; at < line; at++) {
    const next = text.indexOf('\n', begin);
    if (next < 0) break;
    begin = next + 1;
  }
  const until = text.indexOf('\n', begin);
  return begin + unitsAfter(text.slice(begin, until < 0 ? undefined : until), column - 1);
}
