// The words of the fields and choices of statements, where the names of the schema are not plain enough.

import { spoken } from '../../../plan/words';

const LABELS: Readonly<Record<string, string>> = {
  visitor: 'Visitor', does: 'Work of the visitor', key: 'Has a key', eats_out: 'With a meal', thing_on: 'A thing that is on meanwhile', falling: 'The fall',
  when: 'When', days: 'Days', time: 'Time', lasts_s: 'Length', lasts: 'Length', until_s: 'Until', nights: 'Nights', times: 'How many times', is_total: 'In all',
  phase: 'From and until', over_days: 'Full strength after', fading_days: 'Fades over', until: 'Until', weekdays: 'Days of the week', months: 'Months',
  every: 'Every so many days', of_month: 'Days of the month', kind: 'Kind of day', weather: 'Weather', episode: 'Days in a row', poor_nights: 'After poor nights',
  every_days: 'About every', lasts_days: 'Length', chance: 'How often', probability: 'Share of days', becomes: 'Later share', days_a_week: 'Days a week',
  age_years: 'Age', pace_mps: 'Walking speed', rests: 'Rests on the way', after_m: 'After', species: 'Person or animal', name: 'Name',
  effect: 'Change', by_s: 'By', factor: 'Factor', severity: 'Severity', inside: 'Stays inside', very: 'Very', gain: 'How much', of: 'Aversion to',
  whenever: 'Whenever', only_if: 'Only if', response: 'Then', then: 'And then', lapse: 'Forgetting', later: 'Later', holds: 'It holds', state: 'State',
  slowly: 'Slowly', ends: 'End', mostly: 'Mostly', text: 'Text', activity: 'Activity', place: 'Place', thing: 'Thing', condition: 'Condition', on: 'On or open',
};

/** The severities that sentences have words for. */
export function severities(key: string): Readonly<Record<string, number>> | null {
  return key === 'severity' ? { mild: 0.5, moderate: 1, severe: 1.5 } : null;
}

/** The words of a flag that turns a thing on or off. */
export function onOff(key: string): readonly [string, string] | null {
  return key === 'on' ? ['on, or open', 'off, or closed'] : null;
}

/** The words beside the box that states a field. */
const STATED: Readonly<Record<string, string>> = {
  falling: 'Describe the fall', of_month: 'Say which days', episode: 'Say how many days', rests: 'Describe the rests', becomes: 'Say the later share', times: 'Say how many times', lapse: 'Describe the forgetting',
};

export function stateLabel({ key, label }: { key: string; label: string }): string {
  return STATED[key] ?? `Say ${label.toLowerCase()}`;
}

/** The items of lists of a fixed length. */
const ITEMS: Readonly<Record<string, readonly string[]>> = {
  times: ['At least', 'At most'], of_month: ['First day', 'Last day'], becomes: ['Share of days', 'By'], after: ['Activity', 'So long after'], before: ['Activity', 'So long before'],
  between: ['From', 'To'],
};

/** The choices of a field, by the field and the choice, or by the choice alone. */
const CHOICES: Readonly<Record<string, string>> = {
  any_time: 'at any time', 'time at': 'at a time, or between two', 'time within': 'in a part of the day', 'time after': 'after an activity', 'time before': 'before an activity',
  'time with': 'at the same time as an activity', 'time then': 'after the sentence before', with: 'with an activity',
  'trigger away': 'the resident is out', 'trigger in_bed': 'the resident is in bed', 'trigger alone': 'the resident is alone', 'trigger sitting': 'the resident sits',
  'trigger on': 'a thing is on or open', 'trigger at': 'the resident is at a place', 'trigger rings': 'a thing is turned on, such as a doorbell', 'trigger dark': 'it is dark',
  'trigger company': 'another person is there', 'trigger doing': 'the resident does something', 'trigger done': 'the resident has finished something', 'trigger between': 'it is between two times',
  'trigger follows': 'the rule before was answered', 'trigger wakes': 'the resident wakes at night',
  'response turn': 'turn a thing on or off', 'response do': 'do something',
  shows: 'a condition begins', pace: 'walking speed', pace_each_week: 'walking speed, more each week', later: 'an activity is later or earlier', longer: 'an activity is longer or shorter, by a factor',
  longer_by: 'an activity is longer or shorter, by a time', oftener: 'an activity is more or less frequent', skips: 'an activity is left out', irregular: 'hours vary', active: 'movement at home',
  days_differ: 'days differ', days_are: 'quiet or busy days', sleeps_in: 'sleeps in after a late night', restless: 'movements in bed', forgets: 'a thing is left on or open', keeps_on: 'a thing is on for a time or all night',
  range: 'keeps to a room or floor, or never enters it', spares: 'a thing is not used', pulse: 'pulse', respiration: 'breathing', shy: 'keeps away while wandering',
  noon: 'noon', day: 'the whole day', way_to_toilet: 'on the way to the toilet', rising: 'while getting up from a chair', seat: 'out of a chair', bed: 'out of bed', rises: 'gets up alone',
  found: 'lies until a person comes', phone: 'crawls to the phone', open_floor: 'open floor', people: 'other people', going_on: 'walking on',
};

/** The titles of the kinds of statements. */
export const KINDS = {
  habit: 'Habit', sleep: 'Sleep', away: 'Time away', visit: 'Visit', change: 'Change', event: 'Fall or stumble', rule: 'Rule', thing: 'Thing', person: 'Person', note: 'Note',
} as const;

/** Choices that are names, with a capital letter. */
const NAMES_OF_TIME = new Set(['weekdays', 'months']);

const capital = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

export function labelOf(key: string): string {
  return LABELS[key] ?? capital(spoken(key));
}

export function itemLabel(key: string, index: number): string {
  return ITEMS[key]?.[index] ?? `${labelOf(key)} ${index + 1}`;
}

/** @param of what the choice is among, such as `time`. */
export function choiceLabel(of: string, choice: string): string {
  return CHOICES[`${of} ${choice}`] ?? CHOICES[choice] ?? (NAMES_OF_TIME.has(of) ? capital(choice) : spoken(choice));
}
