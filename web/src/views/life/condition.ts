// The course of a condition, and its sentence.

import type { Completion, ConditionView } from '../../wire';

/** A condition with its severity, such as `moderate depression`, and its start. */
export type Coming = { shown: string; week: number; over: number };

/** `From week 6, over 4 weeks, she shows moderate depression.` */
export function sentenceOf({ shown, week, over }: Coming, who: string): string {
  const grows = over > 0 ? `, over ${over} ${over === 1 ? 'week' : 'weeks'},` : '';
  return `From week ${week}${grows} ${who} ${who === 'they' ? 'show' : 'shows'} ${shown}.`;
}

/** The conditions that a routine does not have yet, each with the words for its severities. */
export function others(words: readonly Completion[], shown: readonly ConditionView[]): Map<string, string[]> {
  const known = shown.map(({ name }) => name.replaceAll('-', ' '));
  const all = new Map<string, string[]>();
  for (const { text, kind } of words) {
    // The severity comes first, as in `moderate depression`.
    const [, severity, name] = /^(\S+) (.+)$/.exec(text) ?? [];
    if (kind !== 'condition' || severity === undefined || name === undefined || known.includes(name)) continue;
    all.set(name, [...(all.get(name) ?? []), severity]);
  }
  return all;
}

/** The most frequent name of the person in a routine. */
export function calls(text: string): string {
  const counts = new Map(['she', 'he', 'they'].map((who) => [who, 0]));
  for (const line of text.split('\n')) {
    for (const [word] of line.replace(/#.*/, '').toLowerCase().matchAll(/\b(she|he|they)\b/g)) counts.set(word, counts.get(word)! + 1);
  }
  const [who, times] = [...counts].reduce((most, next) => (next[1] > most[1] ? next : most));
  return times > 0 ? who : 'the person';
}

/** A text with another line at its end, with its own line ends. */
export function withLine(text: string, line: string): string {
  const end = text.includes('\r\n') ? '\r\n' : '\n';
  const before = text.replace(/\s+$/, '');
  return `${before}${before === '' ? '' : end}${line}${end}`;
}

type Course = {
  /** Days counted from 0: the first day with the condition, the first of its strongest, and the last. */
  begins: number;
  full: number;
  ends: number;
  strongest: number;
};

/** The course of a condition; null if it never occurs. */
export function courseOf(severity: readonly number[]): Course | null {
  const begins = severity.findIndex((share) => share > 0);
  if (begins === -1) return null;
  const strongest = severity.reduce((a, b) => Math.max(a, b), 0);
  // A ramp that ends in the middle of a day has nearly reached its end on it.
  return { begins, full: severity.findIndex((share) => share >= strongest - 1e-9), ends: severity.findLastIndex((share) => share > 0), strongest };
}

/** `mild`, `moderate`, `severe`, or in between. */
export function strength(severity: number): string {
  if (severity >= 1.45) return 'severe';
  if (severity > 1.05) return 'more than moderate';
  if (severity >= 0.95) return 'moderate';
  if (severity > 0.55) return 'more than mild';
  return severity >= 0.45 ? 'mild' : 'less than mild';
}
