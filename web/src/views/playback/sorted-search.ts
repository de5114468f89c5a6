// Binary search in a sorted list.

/** The index of the first element of the sorted `all` above `limit`. */
export function above<T>(all: ArrayLike<T>, limit: number, of: (one: T) => number): number {
  let [low, high] = [0, all.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (of(all[middle]!) > limit) high = middle;
    else low = middle + 1;
  }
  return low;
}
