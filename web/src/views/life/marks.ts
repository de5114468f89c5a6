// Positions of problems in the editor's text.

import { unitsAfter } from '../../places';
import { distinct } from '../../problems';
import type { ProblemView } from '../../wire';

type Lines = { lines: number; line: (number: number) => { from: number; to: number; text: string } };

/** The start and end of a problem; null for a problem of the file as a whole, or of a line that is gone. */
export function placeOf(problem: ProblemView, doc: Lines): { from: number; to: number } | null {
  if (problem.line < 1 || problem.line > doc.lines) return null;
  const { from, to, text } = doc.line(problem.line);
  if (problem.column < 1) return { from, to };
  const begin = unitsAfter(text, problem.column - 1);
  const end = begin + unitsAfter(text.slice(begin), Math.max(problem.width, 1));
  return { from: from + begin, to: from + end };
}

/** All known problems once: those of the routine itself come first. */
export function together(file: string, ...lists: ProblemView[][]): ProblemView[] {
  const all = distinct(lists.flat());
  return [...all.filter((problem) => problem.file === file), ...all.filter((problem) => problem.file !== file)];
}
