// Aids for drawing on the plan: the grid and dimension lines. The browser stores the choice.

import { keep, read } from '../../browser-storage';

type Mark = 'grid' | 'sizes';

const storage = () => window.localStorage;
const nameOf = (mark: Mark) => `homebody-plan-${mark}`;

class Marks {
  grid = $state(read(storage, nameOf('grid')) !== 'off');
  sizes = $state(read(storage, nameOf('sizes')) !== 'off');

  turn(mark: Mark): void {
    this[mark] = !this[mark];
    keep(storage, nameOf(mark), this[mark] ? null : 'off');
  }
}

export const marks = new Marks();
