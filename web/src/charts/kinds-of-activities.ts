// What kind of activity a name is of, so that one kind has one colour. What lives tell of has its kind in the program's table;
// a scenario names its own activities as it likes, so there the beginnings of a name's words decide.

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

export function activityKind(activity: string): ActivityKind {
  const words = activity.replace(/(\p{Ll})(\p{Lu})/gu, '$1 $2').toLowerCase().match(/\p{L}+|\p{N}+/gu) ?? [];
  const id = KNOWN.get(words.join('_')) ?? byWords(` ${words.join(' ')}`);
  return ACTIVITY_KINDS.find((of) => of.id === id)!;
}

function byWords(name: string): KindId {
  return KIND_WORDS.find(([, begins]) => begins.some((begin) => name.includes(` ${begin}`)))?.[0] ?? 'other';
}
