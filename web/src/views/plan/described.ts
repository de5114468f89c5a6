// What an element measures, in words, as it is dragged and selected.

import { type At, distance } from '../../plan/geometry';
import { type Units, length } from '../../units';
import { type Element, atOf, number, point, spanOf } from './model';

export function described(of: Element | [At, At], units: Units): string {
  if (Array.isArray(of)) return length(distance(...of), units);
  const [span, at, size] = [spanOf(of), atOf(of), point(of.value.size_m)];
  const parts: string[] = [];
  if (span) parts.push(`${length(distance(span.from, span.to), units)} ${of.list === 'doors' ? 'wide' : 'long'}`);
  if (size) parts.push(`${length(size[0], units)} × ${length(size[1], units)}`);
  if (at) parts.push(`${length(at[0], units)} east, ${length(at[1], units)} north`);
  const facing = number(of.value.facing_deg);
  if (facing !== null) parts.push(`looks to ${facing}°`);
  return parts.join(' · ');
}
