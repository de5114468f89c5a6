// What the browser keeps for this page. A browser may forbid it; then it is kept until the page is left.

export type Keeper = Pick<Storage, 'getItem' | 'setItem' | 'removeItem'>;

export function read(keeper: () => Keeper, name: string): string | null {
  try {
    return keeper().getItem(name);
  } catch {
    return null;
  }
}

export function keep(keeper: () => Keeper, name: string, value: string | null): void {
  try {
    if (value === null) keeper().removeItem(name);
    else keeper().setItem(name, value);
  } catch {
    // Nothing is lost but that the choice has to be made again.
  }
}
