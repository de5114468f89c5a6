// The measures of an element in words, while it is dragged and selected.

import { type At, distance, minus } from '../../plan/geometry';
import { type Units, length } from '../../units';
import { angleOf, windOf, wrapped } from './shape';
import { type Element, atOf, number, point, spanOf } from './model';

export function described(of: Element | [At, At], units: Units): string {
  if (Array.isArray(of)) {
    const angle = angleOf(minus(of[1], of[0]));
    return `${length(distance(...of), units)} at ${Math.round(wrapped(angle))}° (${windOf(angle)})`;
  }
  const [span, at, size] = [spanOf(of), atOf(of), point(of.value.size_m)];
  const parts: string[] = [];
  if (span) parts.push(`${length(distance(span.from, span.to), units)} ${of.list === 'doors' ? 'wide' : 'long'}`);
  if (size) parts.push(`${length(size[0], units)} × ${length(size[1], units)}`);
  if (at) parts.push(`${length(at[0], units)} east, ${length(at[1], units)} north`);
  const facing = number(of.value.facing_deg);
  if (facing !== null) parts.push(`faces ${windOf(facing)} (${facing}° from east)`);
  return parts.join(' · ');
}
