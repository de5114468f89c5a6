// The kind of an activity, by its name, so that one kind has one colour. Labels of the program have a kind in its
// table; a scenario names its own activities freely, so the beginnings of words decide.

import { KINDS, KIND_WORDS, KNOWN } from '../activities';
import { type Palette, okabeIto } from '../plan/palette';

type KindId = keyof typeof KINDS;

type ActivityKind = { id: KindId; name: string; colour: (palette: Palette) => string };

/** In the order of the legend. */
export const ACTIVITY_KINDS: readonly ActivityKind[] = Object.entries(KINDS).map(([id, { name, colour }]) => ({
  id: id as KindId,
  name,
  colour: (palette) => (colour === null ? palette.text : okabeIto[colour]),
}));

/** Known names: a year has tens of thousands of intervals, and some dozen names. */
const asked = new Map<string, ActivityKind>();
const MOST_ASKED = 2000;

export function activityKind(activity: string): ActivityKind {
  const known = asked.get(activity);
  if (known !== undefined) return known;
  if (asked.size >= MOST_ASKED) asked.clear();
  const kind = kindOf(activity);
  asked.set(activity, kind);
  return kind;
}

function kindOf(activity: string): ActivityKind {
  const words = activity.replace(/(\p{Ll})(\p{Lu})/gu, '$1 $2').toLowerCase().match(/\p{L}+|\p{N}+/gu) ?? [];
  const id = KNOWN.get(words.join('_')) ?? byWords(` ${words.join(' ')}`);
  return ACTIVITY_KINDS.find((of) => of.id === id)!;
}

function byWords(name: string): KindId {
  return KIND_WORDS.find(([, begins]) => begins.some((begin) => name.includes(` ${begin}`)))?.[0] ?? 'other';
}
