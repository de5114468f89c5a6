// Names that are longer than their place: what they are as a whole, and where that is asked for.

/** So much of a name is in a browser's own hint, and in a line at all. */
export const LONGEST_HINT = 300;

/** By the element that shows a name. */
const names = new WeakMap<Element, string>();

/** What can have the keys. */
const FOCUSED = 'a[href], button, summary, input, select, textarea, label, [tabindex]';

export function remember(element: Element, name: string): void {
  names.set(element, name);
}

/** Whether a browser's own hint has less of a name than there is. */
function isLong(element: Element): boolean {
  return (names.get(element)?.length ?? 0) > LONGEST_HINT;
}

/** Whether less of a name is shown than there is. */
export function isCut(element: Element): boolean {
  return element.scrollWidth > element.clientWidth + 1 || isLong(element);
}

/** Whether the keys come to it by what is around it. */
export function isReached(element: Element): boolean {
  return element.parentElement?.closest(FOCUSED) != null;
}

/** The whole names that are cut in what has the keys, or, below the pointer, those that no hint of the browser's has. */
export function wholesOf(target: Element, by: 'keys' | 'pointer'): string[] {
  const within = target.closest('.name') ? [target.closest('.name')!] : [...target.querySelectorAll('.name')];
  return within.filter((element) => names.has(element) && (by === 'keys' ? isCut : isLong)(element)).map((element) => names.get(element)!);
}
