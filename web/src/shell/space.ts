// Which of what has the focus wants Space for itself.

const FIELDS = 'input, select, textarea, button, a[href], summary, [contenteditable], [role="slider"]';

/** Whether Space means something else where it is pressed. A button that was only clicked gives Space back to the run. */
export function takesSpace(focused: Element | null, clicked: Element | null): boolean {
  if (focused === null || !focused.matches(FIELDS)) return false;
  return !(focused === clicked && focused.matches('button'));
}
