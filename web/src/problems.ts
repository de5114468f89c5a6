// Lists of what is wrong, as they come from several answers of the server.

import type { ProblemView } from './wire';

/** Each thing once, though more than one answer has it. */
export function distinct<P extends ProblemView>(problems: P[]): P[] {
  const seen = new Set<string>();
  return problems.filter(({ file, line, column, what }) => {
    const key = JSON.stringify([file, line, column, what]);
    return !seen.has(key) && seen.add(key);
  });
}
