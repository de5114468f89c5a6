// What is wrong with the scenario, and which element of the home is meant.

import { offsetOf } from '../../places';
import { distinct } from '../../problems';
import type { CheckView, ProblemView } from '../../wire';
import type { Element, Home } from './model';

export type Listed = ProblemView & { element: Element | null; warning: boolean };

/** Of the home's file the server's answer to the last draft is newer than the check of everything; of the others there is only that. */
export function listed(home: Home | null, file: string | null, check: CheckView | null, ofHome: ProblemView[] | null): Listed[] {
  const problems = [...(ofHome ?? []), ...(check?.problems ?? [])].map((problem) => ({ ...problem, warning: false }));
  const warnings = (check?.warnings ?? []).map((problem) => ({ ...problem, warning: true }));
  return distinct([...problems, ...warnings]).map((problem) => ({ ...problem, element: home && problem.file === file ? elementAt(home, problem) : null }));
}

function elementAt(home: Home, { line, column }: ProblemView): Element | null {
  if (line === 0) return null;
  const offset = offsetOf(home.text, line, column);
  return home.elements.find((element) => element.offset <= offset && offset < element.offset + element.length) ?? null;
}
