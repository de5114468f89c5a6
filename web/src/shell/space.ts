// Elements that need the Space key for themselves.

const FIELDS = 'input, select, textarea, button, a[href], summary, [contenteditable], [role="slider"]';

/** Space has another meaning for the focused element. A button that was only clicked leaves Space to the run. */
export function takesSpace(focused: Element | null, clicked: Element | null): boolean {
  if (focused === null || !focused.matches(FIELDS)) return false;
  return !(focused === clicked && focused.matches('button'));
}
