// The problems of the scenario, with their elements of the home.

import { lineOf, offsetOf } from '../../places';
import { distinct } from '../../problems';
import type { CheckView, ProblemView } from '../../wire';
import type { Units } from '../../units';
import type { Element, Home } from './model';
import { mistakesOf, told } from './overlaps';

export type Listed = ProblemView & {
  element: Element | null;
  warning: boolean;
  /** The parts of a row that stands for many. */
  each?: { element: Element; what: string }[];
};

/** Largest number of rows for overlaps; more become one row, as imported plans may have dozens (our choice). */
const MOST_ROWS = 3;

/** The server's answer about the latest home is newer than the check of all files, which covers the others. */
export function listed(home: Home | null, file: string | null, check: CheckView | null, ofHome: ProblemView[] | null, units: Units): Listed[] {
  const problems = [...(ofHome ?? []), ...(check?.problems ?? [])].map((problem) => ({ ...problem, warning: false }));
  const warnings = (check?.warnings ?? []).map((problem) => ({ ...problem, warning: true }));
  const all = distinct([...problems, ...warnings]).map((problem) => ({ ...problem, element: home && problem.file === file ? elementAt(home, problem) : null }));
  return home && file ? [...all, ...overlapping(home, file, units)] : all;
}

/** Overlapping furniture: it does not prevent a run, but is probably a mistake. */
function overlapping(home: Home, file: string, units: Units): Listed[] {
  const each = mistakesOf(home).map((overlap) => ({ element: overlap.piece, what: told(overlap, units) }));
  const warning = { file, width: 1, warning: true };
  if (each.length > MOST_ROWS) {
    return [{ ...warning, line: 0, column: 0, what: `${new Set(each.map(({ element }) => element)).size} pieces of furniture overlap each other or walls`, hint: 'runs still work; move or turn the pieces', element: null, each }];
  }
  return each.map(({ element, what }) => ({ ...warning, ...lineOf(home.text, element.offset), what, hint: 'move or turn one of them', element }));
}

function elementAt(home: Home, { line, column }: ProblemView): Element | null {
  if (line === 0) return null;
  const offset = offsetOf(home.text, line, column);
  return home.elements.find((element) => element.offset <= offset && offset < element.offset + element.length) ?? null;
}
