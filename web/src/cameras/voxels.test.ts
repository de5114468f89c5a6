import { expect, test } from 'vitest';
import type { PersonView } from '../wire';
import { inOrder, stateOf } from './voxels';

test('what is nearer to the south-east is drawn later, and of one column the upper cube', () => {
  expect(inOrder([5, 1, 0, 1, 5, 0, 3, 3, 1, 3, 3, 0])).toEqual([[1, 5, 0], [3, 3, 0], [3, 3, 1], [5, 1, 0]]);
});

test('the state that holds most is said', () => {
  const person = { upright: 0.2, in_between: 0.1, on_the_ground: 0.9 } as PersonView;
  expect(stateOf(person)).toBe('on the ground');
  expect(stateOf({ ...person, upright: 1 })).toBe('upright');
  expect(stateOf({ ...person, upright: 0, in_between: 0, on_the_ground: 0 })).toBe('unclear');
});
