// How a condition comes and goes, and the sentence that says so.

import type { Completion, ConditionView } from '../../wire';

/** A condition and how severe it is, such as `moderate depression`, and from when on. */
export type Coming = { shown: string; week: number; over: number };

/** `From week 6, over 4 weeks, she shows moderate depression.` */
export function sentenceOf({ shown, week, over }: Coming, who: string): string {
  const grows = over > 0 ? `, over ${over} ${over === 1 ? 'week' : 'weeks'},` : '';
  return `From week ${week}${grows} ${who} ${who === 'they' ? 'show' : 'shows'} ${shown}.`;
}

/** The conditions that a routine does not show yet, each with the words for how severe it may be. */
export function others(words: readonly Completion[], shown: readonly ConditionView[]): Map<string, string[]> {
  const known = shown.map(({ name }) => name.replaceAll('-', ' '));
  const all = new Map<string, string[]>();
  for (const { text, kind } of words) {
    // How severe comes first, as in `moderate depression`.
    const [, severity, name] = /^(\S+) (.+)$/.exec(text) ?? [];
    if (kind !== 'condition' || severity === undefined || name === undefined || known.includes(name)) continue;
    all.set(name, [...(all.get(name) ?? []), severity]);
  }
  return all;
}

/** What a routine mostly calls the person it is about. */
export function calls(text: string): string {
  const counts = new Map(['she', 'he', 'they'].map((who) => [who, 0]));
  for (const line of text.split('\n')) {
    for (const [word] of line.replace(/#.*/, '').toLowerCase().matchAll(/\b(she|he|they)\b/g)) counts.set(word, counts.get(word)! + 1);
  }
  const [who, times] = [...counts].reduce((most, next) => (next[1] > most[1] ? next : most));
  return times > 0 ? who : 'the person';
}

/** A text with another line at its end, whichever way its lines end. */
export function withLine(text: string, line: string): string {
  const end = text.includes('\r\n') ? '\r\n' : '\n';
  const before = text.replace(/\s+$/, '');
  return `${before}${before === '' ? '' : end}${line}${end}`;
}

type Course = {
  /** Days counted from 0: the first on which it is there, the first of its strongest, and the last. */
  begins: number;
  full: number;
  ends: number;
  strongest: number;
};

/** When a condition is there; nothing where it never is. */
export function courseOf(severity: readonly number[]): Course | null {
  const begins = severity.findIndex((share) => share > 0);
  if (begins === -1) return null;
  const strongest = severity.reduce((a, b) => Math.max(a, b), 0);
  // A ramp that ends in the middle of a day has all but reached its end on it.
  return { begins, full: severity.findIndex((share) => share >= strongest - 1e-9), ends: severity.findLastIndex((share) => share > 0), strongest };
}

/** `mild`, `moderate`, `severe`, or something between. */
export function strength(severity: number): string {
  if (severity >= 1.45) return 'severe';
  if (severity > 1.05) return 'more than moderate';
  if (severity >= 0.95) return 'moderate';
  if (severity > 0.55) return 'more than mild';
  return severity >= 0.45 ? 'mild' : 'less than mild';
}
