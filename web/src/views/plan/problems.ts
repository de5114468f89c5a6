// What is wrong with the scenario, and which element of the home is meant.

import { lineOf, offsetOf } from '../../places';
import { distinct } from '../../problems';
import type { CheckView, ProblemView } from '../../wire';
import type { Units } from '../../units';
import type { Element, Home } from './model';
import { mistakesOf, told } from './overlaps';

export type Listed = ProblemView & {
  element: Element | null;
  warning: boolean;
  /** What it stands for, where one row tells of many. */
  each?: { element: Element; what: string }[];
};

/** More than so many pieces that stand in something are one row: a plan that was drawn elsewhere may have dozens (ours). */
const MOST_ROWS = 3;

/** Of the home's file the server's answer to the last draft is newer than the check of everything; of the others there is only that. */
export function listed(home: Home | null, file: string | null, check: CheckView | null, ofHome: ProblemView[] | null, units: Units): Listed[] {
  const problems = [...(ofHome ?? []), ...(check?.problems ?? [])].map((problem) => ({ ...problem, warning: false }));
  const warnings = (check?.warnings ?? []).map((problem) => ({ ...problem, warning: true }));
  const all = distinct([...problems, ...warnings]).map((problem) => ({ ...problem, element: home && problem.file === file ? elementAt(home, problem) : null }));
  return home && file ? [...all, ...overlapping(home, file, units)] : all;
}

/** Furniture that stands where something else does: nobody is kept from living there, but hardly anybody means it. */
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
