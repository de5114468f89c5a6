// Settings of the page in the browser's storage. If the browser forbids storage, they last until the page is closed.

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
    // The user only has to choose again.
  }
}
