// Completions at the cursor. They may be several words long, and begin as far back in the sentence as the text there is
// the beginning of them.

import type { Completion, CompletionKind } from '../../wire';

type Offer = {
  word: Completion;
  /** The column of the first replaced character. */
  from: number;
};

const PREPOSITION = /^(in|on|at|to|into|by|beside|after|before|with|near)\b/i;
const BEFORE_PLACE = /(^|\s)(in|on|at|to|into|by|beside|near)(\s+(the|her|his|their|a|an))?$/i;
const SHOWS = /(^|\s)(shows?|has|have)(\s+signs\s+of)?(\s+an?)?$/i;
const VERB_OF_CONDITION = /^(shows?|has|have)\b/i;
const SUBJECT = /(^|\s)(she|he|they|person|then|and|or)$/i;

/** The sentence at the end of a line, and its start; null in a comment. */
function sentence(before: string): { begin: number; said: string } | null {
  if (before.includes('#')) return null;
  const stop = before.lastIndexOf('. ');
  const begin = stop + 1 > 0 ? stop + 2 : 0;
  const blank = /^\s*/.exec(before.slice(begin))![0].length;
  return { begin: begin + blank, said: before.slice(begin + blank) };
}

/** Words of this kind may follow the text before them in the sentence. */
function fits({ text, kind }: Completion, lead: string, subjects: RegExp): boolean {
  const place = BEFORE_PLACE.test(lead);
  const shows = SHOWS.test(lead);
  const subject = subjects.test(lead);
  const fit: Record<CompletionKind, boolean> = {
    sentence: lead === '',
    activity: subject,
    time: !place && !shows && !subject,
    place: PREPOSITION.test(text) ? lead !== '' && !place && !shows && !subject : place,
    condition: VERB_OF_CONDITION.test(text) ? subject : shows,
  };
  return fit[kind];
}

function subjectsOf(names: string[]): RegExp {
  const own = names.map((name) => name.replace(/[.*+?^${}()|[\]\\]/g, '\\$&'));
  return new RegExp([SUBJECT.source, ...own.map((name) => `(^|\\s)${name}$`)].join('|'), 'i');
}

/**
 * The possible continuations of `before`, the line up to the cursor, the likeliest first.
 *
 * @param names of the person.
 * @param asked by the user; while typing, fewer are offered.
 */
export function offers(before: string, words: readonly Completion[], names: string[], asked: boolean): Offer[] {
  const found = sentence(before);
  if (found === null) return [];
  const { begin, said } = found;
  const subjects = subjectsOf(names);
  const low = said.toLowerCase();
  const starts = [...low.matchAll(/[^\s,]+/g)].map(({ index }) => index);
  const last = starts.at(-1) ?? 0;
  const blank = /[\s,]$|^$/.test(low);
  const leads = (at: number) => said.slice(0, at).replace(/[\s,]+$/, '');
  const ranked: (Offer & { rank: number })[] = [];
  for (const word of words) {
    const text = word.text.toLowerCase();
    const whole = starts.find((start) => text.startsWith(low.slice(start)) && fits(word, leads(start), subjects));
    if (whole !== undefined) {
      // Continuations of complete words come before sentences that begin with them.
      const rank = (word.kind === 'sentence' ? 50 : 1000) + low.length - whole;
      if (text !== low.slice(whole)) ranked.push({ word, from: begin + whole, rank });
    } else if (blank) {
      // After a blank everything that may follow fits; whole sentences are offered only on request.
      const told = asked || (word.kind !== 'time' && word.kind !== 'sentence' && !(word.kind === 'place' && PREPOSITION.test(word.text)));
      if (told && fits(word, leads(said.length), subjects)) ranked.push({ word, from: before.length, rank: 500 });
    } else if ((asked || word.kind !== 'time') && word.kind !== 'sentence' && low.length - last >= 2 && text.split(/\s+/).some((part) => part.startsWith(low.slice(last))) && fits(word, leads(last), subjects)) {
      ranked.push({ word, from: begin + last, rank: 100 });
    }
  }
  return ranked.sort((a, b) => b.rank - a.rank).map(({ word, from }) => ({ word, from }));
}

/** Replacements for unknown words: those that fit after `lead`, the most similar first. */
export function replacements(wrong: string, lead: string, words: readonly Completion[], names: string[]): Completion[] {
  const found = sentence(lead);
  if (found === null) return [];
  const before = found.said.replace(/[\s,]+$/, '');
  const subjects = subjectsOf(names);
  return words
    .filter((word) => fits(word, before, subjects))
    .map((word) => ({ word, alike: alike(wrong, word.text) }))
    .sort((a, b) => b.alike - a.alike)
    .map(({ word }) => word);
}

/** From 0 to 1: the share of pairs of letters that two texts share. */
function alike(a: string, b: string): number {
  const pairs = (text: string) => {
    const low = text.toLowerCase().slice(0, 200);
    return Array.from({ length: Math.max(low.length - 1, 0) }, (_, at) => low.slice(at, at + 2));
  };
  const [of, left] = [pairs(a), pairs(b)];
  const all = of.length + left.length;
  let shared = 0;
  for (const pair of of) {
    const at = left.indexOf(pair);
    if (at === -1) continue;
    left.splice(at, 1);
    shared += 1;
  }
  return all === 0 ? 0 : (2 * shared) / all;
}
