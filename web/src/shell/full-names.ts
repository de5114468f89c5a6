// Full texts of cut names, for the focus and the pointer.

/** Longest text in a browser's tooltip, and of a name in a line at all. */
export const LONGEST_HINT = 300;

/** By the element that shows a name. */
const names = new WeakMap<Element, string>();

/** Elements that can have the focus. */
const FOCUSED = 'a[href], button, summary, input, select, textarea, label, [tabindex]';

export function remember(element: Element, name: string): void {
  names.set(element, name);
}

/** The browser's tooltip has only a part of the name. */
function isLong(element: Element): boolean {
  return (names.get(element)?.length ?? 0) > LONGEST_HINT;
}

/** The element shows only a part of the name. */
export function isCut(element: Element): boolean {
  return element.scrollWidth > element.clientWidth + 1 || isLong(element);
}

/** An element around it has the keyboard focus. */
export function isReached(element: Element): boolean {
  return element.parentElement?.closest(FOCUSED) != null;
}

/** The cut names in the focused element, or, below the pointer, those that no tooltip shows in full. */
export function fullNamesOf(target: Element, by: 'keys' | 'pointer'): string[] {
  const within = target.closest('.name') ? [target.closest('.name')!] : [...target.querySelectorAll('.name')];
  return within.filter((element) => names.has(element) && (by === 'keys' ? isCut : isLong)(element)).map((element) => names.get(element)!);
}
