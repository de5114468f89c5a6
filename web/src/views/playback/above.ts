// Where in what is in order.

/** The first place in `all`, in order, whose number is above `limit`. */
export function above<T>(all: ArrayLike<T>, limit: number, of: (one: T) => number): number {
  let [low, high] = [0, all.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (of(all[middle]!) > limit) high = middle;
    else low = middle + 1;
  }
  return low;
}
