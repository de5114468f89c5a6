// Made from the table in crates/homebody-core/src/activity.rs, which says what each means.

/** In the order of legends; no colour is that of text. */
export const KINDS = {
  sleep: { name: 'sleep', colour: 'blue' },
  care: { name: 'toilet, washing, dressing', colour: 'sky' },
  food: { name: 'meals and kitchen', colour: 'orange' },
  housework: { name: 'housework', colour: 'purple' },
  leisure: { name: 'leisure and work', colour: 'green' },
  medicine: { name: 'medicine', colour: 'vermillion' },
  out: { name: 'out of the home', colour: null },
  other: { name: 'other', colour: 'yellow' },
} as const;

/** What lives tell of, by the label of the truth. */
export const KNOWN: ReadonlyMap<string, keyof typeof KINDS> = new Map([
  ['getting_up', 'care'],
  ['using_bathroom', 'care'],
  ['showering', 'care'],
  ['washing', 'care'],
  ['dressing', 'care'],
  ['taking_medicine', 'medicine'],
  ['preparing_breakfast', 'food'],
  ['preparing_lunch', 'food'],
  ['preparing_dinner', 'food'],
  ['eating_breakfast', 'food'],
  ['eating_lunch', 'food'],
  ['eating_dinner', 'food'],
  ['washing_up', 'food'],
  ['watching_television', 'leisure'],
  ['reading', 'leisure'],
  ['telephoning', 'leisure'],
  ['napping', 'sleep'],
  ['laundry', 'housework'],
  ['housework', 'housework'],
  ['leaving_home', 'out'],
  ['away', 'out'],
  ['coming_home', 'out'],
  ['visit', 'other'],
  ['visiting', 'out'],
  ['going_to_bed', 'sleep'],
  ['sleeping', 'sleep'],
  ['lying_awake', 'other'],
  ['drinking', 'food'],
  ['having_a_snack', 'food'],
  ['exercising', 'other'],
  ['using_computer', 'leisure'],
  ['relaxing', 'leisure'],
  ['wandering', 'other'],
  ['pacing', 'other'],
  ['lapping', 'other'],
  ['fallen', 'other'],
  ['resting', 'leisure'],
  ['roaming', 'other'],
]);

/** How the words of other names begin, by kind; the first that fits counts. */
export const KIND_WORDS: readonly (readonly [keyof typeof KINDS, readonly string[]])[] = [
  ['medicine', ['medic', 'pill', 'tablet']],
  ['food', ['dish', 'washing up', 'wash up']],
  ['care', ['toilet', 'bath', 'shower', 'wash', 'hygien', 'groom', 'dress', 'getting up', 'get up', 'teeth', 'shav']],
  ['out', ['away', 'out', 'outing', 'leav', 'coming home', 'enter home', 'errand', 'shop', 'church', 'visiting']],
  ['sleep', ['sleep', 'nap', 'bed', 'night']],
  ['food', ['cook', 'eat', 'meal', 'breakfast', 'lunch', 'dinner', 'supper', 'snack', 'drink', 'tea', 'coffee', 'food']],
  ['housework', ['laundry', 'house', 'clean', 'tid', 'vacuum', 'iron', 'chore']],
  ['leisure', ['relax', 'rest', 'read', 'tele', 'tv', 'watch', 'knit', 'phone', 'work', 'desk', 'comput', 'music', 'sit', 'hobby']],
];
