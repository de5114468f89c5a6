// The view of a problem, its wording, and its fix, if it is unique.

import { apply, insert, isObject, valueOf } from '../json';
import { offsetOf, unitsAfter } from '../places';
import { hashOf } from '../routes';
import type { CheckView, FilesView, ProblemView } from '../wire';
import { quoted } from './problem-place';

export type ViewLink = { word: string; href: string };

/** A problem's fix as a button. */
export type FixButton = {
  /** The label of the button. */
  what: string;
  /** The hint without the fix. */
  rest: string;
  /** The changed texts, computed on demand. */
  texts: () => Record<string, string>;
};

/** The files of a scenario, their present texts, and their problems. */
type Texts = { files: FilesView | null; check: CheckView | null; text(name: string): string | undefined };

/** Largest number of problems of a file that are reported one by one; another of the whole file then stands for the rest. */
const MOST_TOLD = 100;

/** A JSON string. */
const LITERAL = /"(?:[^"\\]|\\.)*"/y;

/** The button for a problem's fix; null without a fix, or if the page lacks the file or the place that it changes. */
export function fixOf(problem: ProblemView, texts: Texts): FixButton | null {
  const { fix } = problem;
  if (fix === undefined) return null;
  const hint = problem.hint ?? '';
  if (fix.kind === 'replace') {
    const now = texts.text(problem.file);
    const place = now === undefined ? null : placeOf(problem, now);
    if (now === undefined || place === null) return null;
    const written = now[place.from] === '"' ? JSON.stringify(fix.with) : fix.with;
    return { what: `Change to ${quoted(fix.with)}`, rest: hint, texts: () => ({ [problem.file]: now.slice(0, place.from) + written + now.slice(place.to) }) };
  }
  const home = texts.files?.home ?? null;
  const ofHome = home === null ? undefined : texts.text(home);
  if (home === null || ofHome === undefined) return null;
  if (fix.kind === 'let_enter') {
    return { what: `Let residents be in or on ${quoted(fix.furniture)}`, rest: hint, texts: () => ({ [home]: enterable(ofHome, fix.furniture) }) };
  }
  const into = fix.room === null ? '' : ` to ${quoted(fix.room)}`;
  return { what: `Add ${quoted(String(fix.piece.name))}${into}`, rest: fix.rest, texts: () => ({ [home]: insert(ofHome, 'furniture', fix.piece) }) };
}

/** The position of the name or the words of a problem. */
function placeOf({ file, line, column, width }: ProblemView, text: string): { from: number; to: number } | null {
  if (line <= 0) return null;
  const from = offsetOf(text, line, column);
  if (!file.endsWith('.json')) return { from, to: from + unitsAfter(text.slice(from), width) };
  LITERAL.lastIndex = from;
  const found = LITERAL.exec(text);
  return found === null ? null : { from, to: from + found[0].length };
}

function enterable(home: string, name: string): string {
  const value = valueOf(home);
  const pieces = isObject(value) && Array.isArray(value.furniture) ? value.furniture : [];
  const index = pieces.findIndex((piece) => isObject(piece) && piece.name === name);
  return index < 0 ? home : apply(home, [{ path: ['furniture', index, 'enterable'], value: true }]);
}

/** The view of a problem's file; null for a file without a view. */
export function linkTo({ file, line }: ProblemView, texts: Texts): ViewLink | null {
  const { files } = texts;
  if (files === null) return null;
  const told = texts.check?.problems.filter((other) => other.file === file && other.line > 0).length ?? 0;
  // A readable routine has no wrong sentence: the home lacks something for it, or blocks a way.
  const isOfHome = line === 0 && files.lives.some(({ routine }) => routine === file) && texts.text(file) !== undefined && told < MOST_TOLD;
  if (isOfHome && files.home !== null) return { word: 'Plan', href: '#/plan' };
  if (file === files.home) return { word: 'Plan', href: line > 0 ? hashOf('plan', `line ${line}`) : '#/plan' };
  if (file === files.logger) return { word: 'Log', href: '#/log' };
  const lives = files.lives.find(({ routine }) => routine === file);
  return lives === undefined ? null : { word: `Life: ${lives.name.slice(0, 40)}`, href: hashOf('life', lives.name) };
}
