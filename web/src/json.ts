// Small changes of a JSON text: a value is set or taken away at a path, and every other byte stays as somebody wrote it. What
// is new is laid out as its neighbours are.

import { type Node, findNodeAtOffset, getNodePath, parseTree } from 'jsonc-parser';

export type Path = (string | number)[];

/** A line that would be longer is broken. */
const WIDEST = 100;

/** What a text says; nothing where it is not JSON. */
export function valueOf(text: string): unknown {
  try {
    return JSON.parse(text) as unknown;
  } catch {
    return undefined;
  }
}

export function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

/** The text with a value at a path; what is missing on the way there is made. A text that is not JSON stays as it is. */
export function withValue(text: string, path: Path, value: unknown): string {
  const root = tree(text);
  if (root === null) return text;
  let node = root;
  for (const [index, part] of path.entries()) {
    const next = childAt(node, part);
    if (next === null) {
      const rest = nested(path.slice(index + 1), value);
      const fits = node.type === (typeof part === 'string' ? 'object' : 'array');
      return fits ? inserted(text, node, part, rest) : replaced(text, node, nested([part], rest));
    }
    node = next;
  }
  return replaced(text, node, value);
}

/** The text without what is at a path, and without the comma that parted it from its neighbour. */
export function without(text: string, path: Path): string {
  const root = tree(text);
  let node = root;
  for (const part of path) node = node && childAt(node, part);
  if (node === null || node === root) return text;
  const own = node.parent!.type === 'property' ? node.parent! : node;
  const all = own.parent!.children!;
  const at = all.indexOf(own);
  const [before, after] = [all[at - 1], all[at + 1]];
  if (after) return cut(text, own.offset, after.offset, '');
  if (before) return cut(text, end(before), end(own), '');
  return cut(text, own.parent!.offset + 1, end(own.parent!) - 1, '');
}

/** The path of what stands at a line and a column, both from 1, in characters; nothing where nothing stands there. */
export function pathAt(text: string, line: number, column: number): Path | null {
  const root = tree(text);
  if (root === null || line < 1) return null;
  const lines = text.split('\n');
  if (line > lines.length) return null;
  const before = lines.slice(0, line - 1).reduce((sum, one) => sum + one.length + 1, 0);
  const within = [...lines[line - 1]!].slice(0, Math.max(column - 1, 0)).join('').length;
  const node = findNodeAtOffset(root, before + within, true);
  return node === undefined ? null : getNodePath(node);
}

/** A value as it is written into a file: on one line, if that is short enough. */
export function written(value: unknown, indent = '', unit = '  ', eol = '\n'): string {
  const short = onLine(value);
  if (indent.length + short.length <= WIDEST || typeof value !== 'object' || value === null) return short;
  const deeper = indent + unit;
  const parts = Array.isArray(value)
    ? value.map((one) => written(one, deeper, unit, eol))
    : Object.entries(value).map(([key, one]) => `${JSON.stringify(key)}: ${written(one, deeper, unit, eol)}`);
  const [open, close] = Array.isArray(value) ? ['[', ']'] : ['{', '}'];
  return `${open}${eol}${parts.map((part) => deeper + part).join(`,${eol}`)}${eol}${indent}${close}`;
}

function onLine(value: unknown): string {
  if (Array.isArray(value)) return `[${value.map(onLine).join(', ')}]`;
  if (!isObject(value)) return JSON.stringify(value);
  const parts = Object.entries(value).map(([key, one]) => `${JSON.stringify(key)}: ${onLine(one)}`);
  return parts.length === 0 ? '{}' : `{ ${parts.join(', ')} }`;
}

function tree(text: string): Node | null {
  if (valueOf(text) === undefined) return null;
  try {
    return parseTree(text) ?? null;
  } catch {
    // Brackets nested by the thousand.
    return null;
  }
}

/** Of a key that stands twice the last one counts. */
function childAt(node: Node, part: string | number): Node | null {
  if (node.type === 'array') return typeof part === 'number' ? (node.children![part] ?? null) : null;
  if (node.type !== 'object') return null;
  return node.children!.findLast(({ children }) => children![0]!.value === part)?.children![1] ?? null;
}

function nested(path: Path, value: unknown): unknown {
  return path.reduceRight((inner, part) => (typeof part === 'string' ? { [part]: inner } : [inner]), value);
}

function inserted(text: string, into: Node, key: string | number, value: unknown): string {
  const [eol, unit] = [endOfLine(text), unitOf(text)];
  const all = into.children!;
  const outer = indentAt(text, into.offset);
  const broken = all.length > 0 ? text.slice(into.offset, all[0]!.offset).includes('\n') : into.parent === undefined;
  const indent = !broken ? outer : all.length > 0 ? indentAt(text, all[0]!.offset) : outer + unit;
  const name = typeof key === 'string' ? `${JSON.stringify(key)}: ` : '';
  const part = name + written(value, indent, unit, eol);
  if (broken) {
    if (all.length === 0) return cut(text, into.offset + 1, end(into) - 1, `${eol}${indent}${part}${eol}${outer}`);
    return cut(text, end(all.at(-1)!), end(all.at(-1)!), `,${eol}${indent}${part}`);
  }
  const space = into.type === 'object' ? ' ' : '';
  const last = all.at(-1);
  const flat = last ? cut(text, end(last), end(last), `, ${part}`) : cut(text, into.offset + 1, end(into) - 1, space + part + space);
  if (lineAt(flat, into.offset).length <= WIDEST) return flat;
  const parts = [...all.map((one) => text.slice(one.offset, end(one))), name + written(value, outer + unit, unit, eol)];
  return cut(text, into.offset + 1, end(into) - 1, `${parts.map((one) => `${eol}${outer}${unit}${one}`).join(',')}${eol}${outer}`);
}

function replaced(text: string, node: Node, value: unknown): string {
  return cut(text, node.offset, end(node), written(value, indentAt(text, node.offset), unitOf(text), endOfLine(text)));
}

function cut(text: string, from: number, to: number, by: string): string {
  return text.slice(0, from) + by + text.slice(to);
}

function end(node: Node): number {
  return node.offset + node.length;
}

function endOfLine(text: string): string {
  return text.includes('\r\n') ? '\r\n' : '\n';
}

/** By how much the file indents. */
function unitOf(text: string): string {
  return /\n([ \t]+)\S/.exec(text)?.[1] ?? '  ';
}

function lineAt(text: string, offset: number): string {
  const begin = text.lastIndexOf('\n', offset - 1) + 1;
  const until = text.indexOf('\n', offset);
  return text.slice(begin, until === -1 ? undefined : until);
}

function indentAt(text: string, offset: number): string {
  return /^[ \t]*/.exec(lineAt(text, offset))![0];
}
