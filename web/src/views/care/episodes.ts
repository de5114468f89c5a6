// Episodes, the reference and the groups of measures, in words.

import type { CareView, Course, ChangeEpisode, HeadlineState, MeasureGroup, NoteView, ReferenceDays, SeenWith } from '../../wire';
import { shifted, spanInWords, withYear } from './dates';
import type { Subject } from './notes.svelte';

/** Complete days of a whole reference, and those before which no change can be seen, as in the program. */
const [WHOLE_DAYS, LEAST_DAYS] = [28, 7];

export const STATES: Record<HeadlineState, string> = { look_today: 'Look today', changed: 'Changed', as_usual: 'As usual', not_known: 'Not known' };

export const GROUPS: Record<MeasureGroup, string> = { night: 'Night', bathroom: 'Bathroom', meals: 'Meals', out: 'Out and visitors', moving: 'Moving at home', rhythm: 'Rhythm' };

const COURSES: Record<Course, string> = { growing: 'still growing', steady: 'still so', easing: 'easing', over: 'over' };

/** Conditions for readers without training; another one has its own name. */
const PLAIN: Record<string, string> = {
  depression: 'low mood (depression)',
  'cognitive-decline': 'worsening memory (cognitive decline)',
  frailty: 'loss of strength (frailty)',
  grief: 'grief',
  'heart-failure': 'a weak heart (heart failure)',
  insomnia: 'poor sleep (insomnia)',
  'urinary-tract-infection': 'a urinary tract infection',
};

/** Parts of a list by the groups of their measures, without empty groups. */
export function grouped<T>(all: readonly T[], groupOf: (one: T) => MeasureGroup | undefined): { group: MeasureGroup; title: string; of: T[] }[] {
  const groups = Object.entries(GROUPS).map(([group, title]) => ({ group: group as MeasureGroup, title, of: all.filter((one) => (groupOf(one) ?? 'rhythm') === group) }));
  return groups.filter(({ of }) => of.length > 0);
}

export const noteOn = (episode: ChangeEpisode): Subject => ({ day: episode.found, about: 'episode' });

/** The episode of a day: from its first day until the days are as usual again. */
export function episodeOn(care: Pick<CareView, 'episodes'>, day: string): ChangeEpisode | undefined {
  return care.episodes.find(({ since, over }) => since <= day && (over === null || day < over));
}

/** The last day of an episode within the log. */
export function lastDay(care: Pick<CareView, 'days'>, { over }: ChangeEpisode): string {
  return over === null ? (care.days.at(-1)?.day ?? '') : shifted(over, -1);
}

/** Open episodes first, then those that were dealt with, then those that are over; each in the order of the list. */
export function inOrder(episodes: readonly ChangeEpisode[], isDealtWith: (episode: ChangeEpisode) => boolean): ChangeEpisode[] {
  const rank = (episode: ChangeEpisode) => (episode.over !== null ? 2 : isDealtWith(episode) ? 1 : 0);
  return [0, 1, 2].flatMap((of) => episodes.filter((episode) => rank(episode) === of));
}

export function courseInWords({ course, over }: Pick<ChangeEpisode, 'course' | 'over'>): string {
  return over === null ? COURSES[course] : `over since ${withYear(over)}`;
}

/** The conditions that make such signs, in careful words. */
export function seenWithInWords(seen: readonly SeenWith[], person: string): string {
  const names = seen.map(({ condition }) => plain(condition));
  const listed = names.length > 1 ? `${names.slice(0, -1).join(', ')} or ${names.at(-1)}` : names[0];
  return `In simulated lives, such signs are seen with ${listed}. Ask ${person === 'the residents' ? 'them' : person}; this is no diagnosis.`;
}

export function ratiosInWords(seen: readonly SeenWith[]): string {
  const ratios = seen.map(({ condition, likelihood_ratio }) => `${likelihood_ratio.toFixed(1)} for ${condition.replace(/[-_]/g, ' ')}`);
  return `Likelihood ratio: ${ratios.join(', ')}. Simulated people with the condition show such signs so many times as often as people without it.`;
}

function plain(condition: string): string {
  return PLAIN[condition] ?? condition.replace(/[-_]/g, ' ');
}

/** The days of the reference, without a full stop. */
export function referenceInWords(reference: ReferenceDays | null): string {
  if (reference === null) return 'There is nothing to compare with: no complete day is known yet';
  const { from, to, days } = reference;
  return `${days < LEAST_DAYS ? 'Known so far:' : 'Compared with'} ${spanInWords(from, to)} (${days} complete ${days === 1 ? 'day' : 'days'})`;
}

/** The changes that a reference shows that is not whole yet; empty for a whole one. */
export function limitInWords(reference: ReferenceDays | null): string {
  const days = reference?.days ?? 0;
  if (days >= WHOLE_DAYS) return '';
  if (days < LEAST_DAYS) return `No change can be seen yet: large changes need ${LEAST_DAYS} complete days, slow changes need ${WHOLE_DAYS}.`;
  return `Only large changes can be seen yet: slow changes need ${WHOLE_DAYS} complete days.`;
}

/** A change could be found: the reference has enough days. */
export const canCompare = (reference: ReferenceDays | null) => (reference?.days ?? 0) >= LEAST_DAYS;

/** The reason why a measure of a day has no usual value. */
export function unknownInWords(reference: ReferenceDays | null, day: string): string {
  if (!canCompare(reference)) return 'too few complete days yet to know what is usual';
  if (reference !== null && day <= reference.to) return 'too few complete days before this one';
  return 'too few of the days in comparison have this measure';
}

/** The author and the time of a note; empty without both. */
export function writtenBy({ who, at }: Pick<NoteView, 'who' | 'at'>): string {
  const when = /^(\d{4}-\d{2}-\d{2})T(\d{2}:\d{2})/.exec(at);
  return [who === '' ? '' : `by ${who}`, when === null ? '' : `on ${withYear(when[1]!)} at ${when[2]}`].filter(Boolean).join(' ');
}

export function absenceInWords({ from, to }: { from: string; to: string }): string {
  return from === to ? `Away on ${withYear(from)}` : `Away from ${spanInWords(from, to)}`;
}
