// Where a problem is in a text. The server counts characters as Unicode does, the editor in the units of JavaScript, in which
// a rare character is two.

import type { ProblemView } from '../../wire';

/** The place in a line after so many of its characters. */
export function unitsAfter(line: string, characters: number): number {
  let [units, left] = [0, characters];
  while (left > 0 && units < line.length) {
    units += line.codePointAt(units)! > 0xffff ? 2 : 1;
    left -= 1;
  }
  return units;
}

type Lines = { lines: number; line: (number: number) => { from: number; to: number; text: string } };

/** From where to where a problem is; nothing where it is of the file as a whole, or of a line that is not there any more. */
export function placeOf(problem: ProblemView, doc: Lines): { from: number; to: number } | null {
  if (problem.line < 1 || problem.line > doc.lines) return null;
  const { from, to, text } = doc.line(problem.line);
  if (problem.column < 1) return { from, to };
  const begin = unitsAfter(text, problem.column - 1);
  const end = begin + unitsAfter(text.slice(begin), Math.max(problem.width, 1));
  return { from: from + begin, to: from + end };
}

/** All that is wrong and known, each thing once: what the routine says of itself comes first. */
export function together(file: string, ...lists: ProblemView[][]): ProblemView[] {
  const seen = new Set<string>();
  const all = lists.flat().filter((problem) => {
    const key = JSON.stringify([problem.file, problem.line, problem.column, problem.what]);
    return !seen.has(key) && seen.add(key);
  });
  return [...all.filter((problem) => problem.file === file), ...all.filter((problem) => problem.file !== file)];
}
