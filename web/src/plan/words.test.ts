import { expect, test } from 'vitest';
import { hostile } from '../testing/fake';
import { fitting, shortened } from './words';

test('a long name is cut, a short one is not', () => {
  expect(shortened('bedroom', 10)).toBe('bedroom');
  expect(shortened('bedroom motion', 8)).toBe('bedroom…');
  expect(shortened('a'.repeat(4096), 5)).toBe('aaaaa…');
});

test('a family is one letter, and is not torn apart', () => {
  expect(shortened('👩‍👩‍👧‍👦👩‍👩‍👧‍👦👩‍👩‍👧‍👦', 2)).toBe('👩‍👩‍👧‍👦👩‍👩‍👧‍👦…');
});

test('marks that turn what stands beside them are gone', () => {
  expect(shortened('\u202eabc\u2069\nd', 20)).toBe(' abc  d');
});

test('the longest beginning that fits', () => {
  const measure = (text: string) => text.length * 7;
  expect(fitting('kitchen', 49, measure)).toBe('kitchen');
  expect(fitting('kitchen', 48, measure)).toBe('kitch…');
  expect(fitting('kitchen', 6, measure)).toBeNull();
});

test('no name costs more than a short one', () => {
  const seen: number[] = [];
  const measure = (text: string) => {
    seen.push(text.length);
    return text.length * 7;
  };
  for (const name of ['sofa', 'bathroom', 'refrigerator', 'study', 'armchair', 'washbasin']) fitting(hostile(name), 60, measure);
  expect(Math.max(...seen)).toBeLessThanOrEqual(200);
});
