// The best moment of playback for an observation.

import { FIRST_HOURS, OF_NIGHT } from '../../measures';
import type { CareView } from '../../wire';
import { shifted } from './dates';

/** Playback starts this long before, to show the beginning (our choice). */
const BEFORE_H = 0.25;

/** Defaults (our choice). */
const [TO_BED_H, UP_H] = [22, 7];

/** The date and the time on the home's clock at which a measure of a day, or the day itself, begins. */
export function momentOf(care: Pick<CareView, 'charts'>, measure: string | null, day: string): string {
  const value = (name: string) => care.charts.find((chart) => chart.measure === name)?.days.find((point) => point.day === day)?.value ?? null;
  if (measure !== null && measure in FIRST_HOURS) return at(day, FIRST_HOURS[measure]!);
  // Bedtimes are hours of the day before.
  if (measure !== null && OF_NIGHT.has(measure)) return at(shifted(day, -1), (value('bedtime') ?? TO_BED_H) - BEFORE_H);
  return at(day, (value('rising') ?? UP_H) - BEFORE_H);
}

function at(day: string, hours: number): string {
  const minutes = Math.max(Math.round(hours * 60), 0);
  const two = (part: number) => String(part).padStart(2, '0');
  return `${shifted(day, Math.floor(minutes / 1440))}T${two(Math.floor(minutes / 60) % 24)}:${two(minutes % 60)}:00`;
}
