// Keys of the editor. Single letters work while the drawing has the focus, or nothing has; keys with Ctrl work in all
// of the view, except in fields, which have their own.

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

/** A field or a dialog has the keys, not the plan. */
const isElsewhere = () => (document.activeElement?.matches(FIELDS) ?? false) || document.querySelector('dialog[open]') !== null;

/** @returns the tool of a key while the drawing has the focus, or nothing has. */
export function toolTaken(event: KeyboardEvent, drawing: HTMLElement): Tool | null {
  const focused = document.activeElement;
  const isHere = focused === null || focused === document.body || focused === drawing;
  if (!isHere || isElsewhere() || event.ctrlKey || event.metaKey || event.altKey || event.repeat || event.defaultPrevented) return null;
  return toolOf(event.key);
}

/** @returns whether the key was a shortcut. */
export function shortcut(event: KeyboardEvent, editor: Editor): boolean {
  if (!(event.ctrlKey || event.metaKey) || event.altKey || isElsewhere()) return false;
  const key = event.key.toLowerCase();
  if (key === 'z') {
    if (event.shiftKey) editor.redo();
    else editor.undo();
  } else if (key === 'y') editor.redo();
  else if (key === 'd') editor.duplicate();
  else if (key === 'a' && editor.home) editor.select(editor.home.elements.map(({ id }) => id));
  // Selected text is copied as text.
  else if ((key === 'c' || key === 'x') && (editor.chosen.length === 0 || String(window.getSelection()) !== '')) return false;
  else if (key === 'c') editor.copy();
  else if (key === 'x') {
    editor.copy();
    editor.delete();
  } else if (key === 'v' && editor.copied.length > 0) editor.paste();
  else return false;
  return true;
}
