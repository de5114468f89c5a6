// Where in the page what is wrong is mended, in which words that is said, and what does it where there is one answer.

import { apply, insert, isObject, valueOf } from '../json';
import { offsetOf, unitsAfter } from '../places';
import { hashOf } from '../routes';
import type { CheckView, FilesView, ProblemView } from '../wire';
import { quoted } from './thing';

export type Way = { word: string; href: string };

/** What does what a problem's hint says. */
export type Mend = {
  /** As a button says it. */
  what: string;
  /** The hint without that. */
  rest: string;
  /** The texts that change, as they are then. */
  texts: () => Record<string, string>;
};

/** The files of a scenario, their texts as they are written now, and what is wrong with them. */
type Texts = { files: FilesView | null; check: CheckView | null; text(name: string): string | undefined };

/** So many problems of a file are told one by one; another of the whole file then stands for the rest. */
const MOST_TOLD = 100;

const QUOTED = String.raw`"(?:[^"\\]|\\.)*"`;
const MEANT = new RegExp(`^did you mean (${QUOTED})\\?$`);
const ENTERABLE = new RegExp(`^write "enterable": true for (${QUOTED})$`);
const PIECE = new RegExp(`; there is room(?: in (${QUOTED}))?: add to "furniture" (\\{.*\\})$`);
const LITERAL = new RegExp(QUOTED, 'y');

/** What a hint has one answer to; nothing where somebody has to choose. */
export function mendOf(problem: ProblemView, texts: Texts): Mend | null {
  const hint = problem.hint ?? '';
  const home = texts.files?.home ?? null;
  const meant = read(MEANT.exec(hint)?.[1]);
  if (typeof meant === 'string') {
    const now = texts.text(problem.file);
    const place = now === undefined ? null : placeOf(problem, now);
    if (now === undefined || place === null) return null;
    const written = now[place.from] === '"' ? JSON.stringify(meant) : meant;
    return { what: `Change to ${quoted(meant)}`, rest: hint, texts: () => ({ [problem.file]: now.slice(0, place.from) + written + now.slice(place.to) }) };
  }
  const ofHome = home === null ? undefined : texts.text(home);
  if (home === null || ofHome === undefined) return null;
  const named = read(ENTERABLE.exec(hint)?.[1]);
  if (typeof named === 'string') {
    return { what: `Let residents use ${quoted(named)}`, rest: hint, texts: () => ({ [home]: enterable(ofHome, named) }) };
  }
  const found = PIECE.exec(hint);
  const [room, piece] = [read(found?.[1]), read(found?.[2])];
  if (found === null || !isObject(piece)) return null;
  const into = typeof room === 'string' ? ` to ${quoted(room)}` : '';
  return { what: `Add ${quoted(String(piece.name))}${into}`, rest: hint.slice(0, found.index), texts: () => ({ [home]: insert(ofHome, 'furniture', piece) }) };
}

function read(json: string | undefined): unknown {
  return json === undefined ? undefined : valueOf(json);
}

/** Where the name or the words stand that a problem is about. */
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

/** The view in which a problem's file is written; nothing for a file that none of them writes. */
export function wayTo({ file, line }: ProblemView, texts: Texts): Way | null {
  const { files } = texts;
  if (files === null) return null;
  const told = texts.check?.problems.filter((other) => other.file === file && other.line > 0).length ?? 0;
  // Of a routine that can be read no sentence is wrong: the home lacks what the life needs, or is in its way.
  const isOfHome = line === 0 && files.lives.some(({ routine }) => routine === file) && texts.text(file) !== undefined && told < MOST_TOLD;
  if (isOfHome && files.home !== null) return { word: 'Plan', href: '#/plan' };
  if (file === files.home) return { word: 'Plan', href: line > 0 ? hashOf('plan', `line ${line}`) : '#/plan' };
  if (file === files.logger) return { word: 'Log', href: '#/log' };
  const lives = files.lives.find(({ routine }) => routine === file);
  return lives === undefined ? null : { word: `Life: ${lives.name.slice(0, 40)}`, href: hashOf('life', lives.name) };
}
