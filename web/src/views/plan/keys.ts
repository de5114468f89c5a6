// Keys of the editor. Single letters count while the drawing has the focus, or nothing has; those with Ctrl in all of the view, but
// for fields, which have their own.

import type { Editor, Tool } from './editor.svelte';
import { PIECES } from './library';

const TOOLS: Record<string, Tool> = {
  v: { tool: 'select' },
  w: { tool: 'wall' },
  r: { tool: 'room' },
  f: { tool: 'fill' },
  d: { tool: 'door' },
  u: { tool: 'furniture', piece: PIECES[0]! },
  p: { tool: 'place' },
  s: { tool: 'sensor', kind: 'motion' },
};

function toolOf(key: string): Tool | null {
  const letter = key.toLowerCase();
  return Object.hasOwn(TOOLS, letter) ? TOOLS[letter]! : null;
}

const FIELDS = 'input:not([type="checkbox"]):not([type="range"]):not([type="radio"]), select, textarea, [contenteditable]';

/** Whether keys are for a field or a dialog now, not for the plan. */
const isElsewhere = () => (document.activeElement?.matches(FIELDS) ?? false) || document.querySelector('dialog[open]') !== null;

/** @returns the tool that a key takes while the focus is on the drawing, or nowhere. */
export function toolTaken(event: KeyboardEvent, drawing: HTMLElement): Tool | null {
  const focused = document.activeElement;
  const isHere = focused === null || focused === document.body || focused === drawing;
  if (!isHere || isElsewhere() || event.ctrlKey || event.metaKey || event.altKey || event.repeat || event.defaultPrevented) return null;
  return toolOf(event.key);
}

/** @returns whether the key was one of these. */
export function shortcut(event: KeyboardEvent, editor: Editor): boolean {
  if (!(event.ctrlKey || event.metaKey) || event.altKey || isElsewhere()) return false;
  const key = event.key.toLowerCase();
  if (key === 'z') {
    if (event.shiftKey) editor.redo();
    else editor.undo();
  } else if (key === 'y') editor.redo();
  else if (key === 'd') editor.duplicate();
  else if (key === 'a' && editor.home) editor.select(editor.home.elements.map(({ id }) => id));
  // Text that is marked anywhere is copied as text.
  else if ((key === 'c' || key === 'x') && (editor.chosen.length === 0 || String(window.getSelection()) !== '')) return false;
  else if (key === 'c') editor.copy();
  else if (key === 'x') {
    editor.copy();
    editor.delete();
  } else if (key === 'v' && editor.copied.length > 0) editor.paste();
  else return false;
  return true;
}
