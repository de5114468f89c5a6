// What kind of activity a name is of, so that one kind has one colour. A scenario names its own activities as it likes, so
// the beginnings of a name's words decide; the program's charts of days go by the same ones.

import { type Palette, okabeIto } from '../../plan/palette';

type ActivityKind = { id: string; name: string; colour: (palette: Palette) => string };

const kind = (id: string, name: string, colour: string): ActivityKind => ({ id, name, colour: () => colour });

const sleep = kind('sleep', 'sleep', okabeIto.blue);
const care = kind('care', 'toilet, washing, dressing', okabeIto.sky);
const food = kind('food', 'meals and kitchen', okabeIto.orange);
const housework = kind('housework', 'housework', okabeIto.purple);
const leisure = kind('leisure', 'leisure and work', okabeIto.green);
const medicine = kind('medicine', 'medicine', okabeIto.vermillion);
const out: ActivityKind = { id: 'out', name: 'out of the home', colour: (palette) => palette.text };
const other = kind('other', 'other', okabeIto.yellow);

/** In the order of the legend. */
export const ACTIVITY_KINDS: readonly ActivityKind[] = [sleep, care, food, medicine, leisure, housework, out, other];

/** The first whose words are in the name. */
const WORDS: [ActivityKind, string[]][] = [
  [medicine, ['medic', 'pill', 'tablet']],
  [food, ['dish', 'washing up', 'wash up']],
  [care, ['toilet', 'bath', 'shower', 'wash', 'hygien', 'groom', 'dress', 'getting up', 'get up', 'teeth', 'shav']],
  [out, ['away', 'out', 'outing', 'leav', 'coming home', 'enter home', 'errand', 'shop', 'church', 'visiting']],
  [sleep, ['sleep', 'nap', 'bed', 'night']],
  [food, ['cook', 'eat', 'meal', 'breakfast', 'lunch', 'dinner', 'supper', 'snack', 'drink', 'tea', 'coffee', 'food']],
  [housework, ['laundry', 'house', 'clean', 'tid', 'vacuum', 'iron', 'chore']],
  [leisure, ['relax', 'rest', 'read', 'tele', 'tv', 'watch', 'knit', 'phone', 'work', 'desk', 'comput', 'music', 'sit', 'hobby']],
];

export function activityKind(activity: string): ActivityKind {
  const parts = activity.replace(/(\p{Ll})(\p{Lu})/gu, '$1 $2').toLowerCase().match(/\p{L}+|\p{N}+/gu) ?? [];
  const name = ` ${parts.join(' ')}`;
  return WORDS.find(([, begins]) => begins.some((begin) => name.includes(` ${begin}`)))?.[0] ?? other;
}

