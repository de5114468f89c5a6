// Where in the page what is wrong is mended, and in which words that is said.

import { hashOf } from '../routes';
import type { FilesView, ProblemView } from '../wire';

export type Way = { word: string; href: string };

/** The view in which a problem's file is written; nothing for a file that none of them writes. */
export function wayTo({ file, line }: ProblemView, files: FilesView | null): Way | null {
  if (files === null) return null;
  if (file === files.home) return { word: 'Plan', href: line > 0 ? hashOf('plan', `line ${line}`) : '#/plan' };
  if (file === files.logger) return { word: 'Log', href: '#/log' };
  const lives = files.lives.find(({ routine }) => routine === file);
  return lives === undefined ? null : { word: `Life of ${lives.name.slice(0, 40)}`, href: hashOf('life', lives.name) };
}
