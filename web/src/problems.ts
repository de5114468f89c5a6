// Lists of problems from several answers of the server.

import type { ProblemView } from './wire';

/** Removes problems that several answers contain. */
export function distinct<P extends ProblemView>(problems: P[]): P[] {
  const seen = new Set<string>();
  return problems.filter(({ file, line, column, what }) => {
    const key = JSON.stringify([file, line, column, what]);
    return !seen.has(key) && seen.add(key);
  });
}
