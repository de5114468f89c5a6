// What kind of activity a name is of, so that one kind has one colour. What lives tell of has its kind in the program's table;
// a scenario names its own activities as it likes, so there the beginnings of a name's words decide.

import { type ActivityKindId, KIND_NAMES, KIND_WORDS, KNOWN_KINDS } from '../../activities';
import { type Palette, okabeIto } from '../../plan/palette';

type ActivityKind = { id: ActivityKindId; name: string; colour: (palette: Palette) => string };

const kind = (id: ActivityKindId, colour: ActivityKind['colour']): ActivityKind => ({ id, name: KIND_NAMES[id], colour });

/** In the order of the legend. */
export const ACTIVITY_KINDS: readonly ActivityKind[] = [
  kind('sleep', () => okabeIto.blue),
  kind('care', () => okabeIto.sky),
  kind('food', () => okabeIto.orange),
  kind('medicine', () => okabeIto.vermillion),
  kind('leisure', () => okabeIto.green),
  kind('housework', () => okabeIto.purple),
  kind('out', (palette) => palette.text),
  kind('other', () => okabeIto.yellow),
];

export function activityKind(activity: string): ActivityKind {
  const id = KNOWN_KINDS.get(activity) ?? byWords(activity);
  return ACTIVITY_KINDS.find((of) => of.id === id)!;
}

function byWords(activity: string): ActivityKindId {
  const parts = activity.replace(/(\p{Ll})(\p{Lu})/gu, '$1 $2').toLowerCase().match(/\p{L}+|\p{N}+/gu) ?? [];
  const name = ` ${parts.join(' ')}`;
  return KIND_WORDS.find(([, begins]) => begins.some((begin) => name.includes(` ${begin}`)))?.[0] ?? 'other';
}
