// Edits of a JSON text that leave all as it was written but what they change: an edited file differs from the one before
// in the lines that were meant, and in no other.

import { type Node, type ParseError, findNodeAtLocation, parseTree, printParseErrorCode } from 'jsonc-parser';

export type Path = (string | number)[];

/** A value takes the place of another, or is added; nothing takes a property away. */
export type Change = { path: Path; value: unknown };

type Edit = { offset: number; length: number; content: string };

export type Fault = { what: string; offset: number };

const WORDS: Record<string, string> = {
  InvalidSymbol: 'this is no JSON',
  InvalidNumberFormat: 'this is no number',
  PropertyNameExpected: 'the name of a property, in double quotes, is missing',
  ValueExpected: 'a value is missing',
  ColonExpected: 'a colon is missing',
  CommaExpected: 'a comma is missing',
  CloseBraceExpected: 'a closing brace is missing',
  CloseBracketExpected: 'a closing bracket is missing',
  EndOfFileExpected: 'something stands behind the end',
  InvalidCommentToken: 'JSON has no comments',
  UnexpectedEndOfString: 'the closing quote of a text is missing',
};

/** The tree of a text, or why there is none. */
export function tree(text: string): Node | Fault {
  const errors: ParseError[] = [];
  let root: Node | undefined;
  try {
    root = parseTree(text, errors, { disallowComments: true });
  } catch {
    return { what: 'this is nested too deep', offset: 0 };
  }
  const error = errors[0];
  if (error !== undefined) return { what: WORDS[printParseErrorCode(error.error)] ?? 'this is no JSON', offset: error.offset };
  return root ?? { what: 'the file is empty', offset: 0 };
}

export function isFault(read: Node | Fault): read is Fault {
  return 'what' in read;
}

/** To millimetres, or hundredths of degrees: a multiple of 1 / `parts`. */
export function rounded(value: number, parts = 1000): number {
  return Math.round(value * parts) / parts + 0;
}

/** A value on one line, as the scenarios of the repository have it. */
export function format(value: unknown): string {
  if (Array.isArray(value)) return `[${value.map(format).join(', ')}]`;
  if (typeof value === 'object' && value !== null) {
    const parts = Object.entries(value).filter(([, part]) => part !== undefined).map(([key, part]) => `${JSON.stringify(key)}: ${format(part)}`);
    return parts.length === 0 ? '{}' : `{ ${parts.join(', ')} }`;
  }
  return JSON.stringify(value);
}

/** The text with the changes; a text that is not JSON stays as it is. */
export function apply(text: string, changes: Change[]): string {
  const read = tree(text);
  if (isFault(read)) return text;
  const edits = changes.filter(({ value }) => value !== undefined).flatMap(({ path, value }) => put(text, read, path, value));
  let next = splice(text, edits);
  // What is taken away may stand beside what is taken away before it.
  for (const { path, value } of changes) {
    if (value !== undefined) continue;
    const now = tree(next);
    if (!isFault(now)) next = splice(next, without(next, now, path));
  }
  return next;
}

function splice(text: string, edits: Edit[]): string {
  const ordered = edits.map((edit, order) => ({ ...edit, order })).sort((a, b) => a.offset - b.offset || a.order - b.order);
  let [done, at] = ['', 0];
  for (const { offset, length, content } of ordered) {
    done += text.slice(at, offset) + content;
    at = offset + length;
  }
  return done + text.slice(at);
}

function put(text: string, root: Node, path: Path, value: unknown): Edit[] {
  const there = findNodeAtLocation(root, path);
  if (there !== undefined) return replace(there, value);
  const parent = findNodeAtLocation(root, path.slice(0, -1));
  const key = path.at(-1);
  if (parent?.type !== 'object' || typeof key !== 'string') return [];
  return [addProperty(text, parent, key, format(value))];
}

/** Only the numbers that differ, where the forms are the same. */
function replace(node: Node, value: unknown): Edit[] {
  const children = node.children ?? [];
  if (node.type === 'array' && Array.isArray(value) && value.length === children.length) {
    return children.flatMap((child, index) => replace(child, value[index]));
  }
  if (node.type !== 'array' && node.type !== 'object' && node.value === value) return [];
  return [{ offset: node.offset, length: node.length, content: format(value) }];
}

function addProperty(text: string, parent: Node, key: string, content: string): Edit {
  const last = parent.children?.at(-1);
  const property = `${JSON.stringify(key)}: ${content}`;
  if (last === undefined) return { offset: parent.offset, length: parent.length, content: `{ ${property} }` };
  const indent = indentOf(text, last.offset);
  const between = indent === null ? ' ' : newlineOf(text) + indent;
  return { offset: end(last), length: 0, content: `,${between}${property}` };
}

function without(text: string, root: Node, path: Path): Edit[] {
  const property = findNodeAtLocation(root, path)?.parent;
  return property?.type === 'property' ? takeOut(text, property) : [];
}

/** An element or a property goes, with the comma that is left over, and with its line if it has one to itself. */
function takeOut(text: string, node: Node): Edit[] {
  const siblings = node.parent?.children ?? [];
  const index = siblings.indexOf(node);
  const [before, after] = [siblings[index - 1], siblings[index + 1]];
  if (before === undefined && after === undefined) {
    const { offset, length, type } = node.parent!;
    return [{ offset, length, content: type === 'array' ? '[]' : '{}' }];
  }
  const comma = after === undefined ? end(node) : text.indexOf(',', end(node)) + 1;
  const rest = /^[ \t]*(\r?\n)/.exec(text.slice(comma));
  const indent = indentOf(text, node.offset);
  if (indent !== null && rest !== null) {
    const begin = node.offset - indent.length;
    const line = { offset: begin, length: comma + rest[0].length - begin, content: '' };
    if (after !== undefined || before === undefined) return [line];
    return [{ offset: end(before), length: text.indexOf(',', end(before)) + 1 - end(before), content: '' }, line];
  }
  const [from, to] = after !== undefined ? [node.offset, after.offset] : [end(before!), end(node)];
  return [{ offset: from, length: to - from, content: '' }];
}

/** The text with one more element at the end of a list, on a line of its own if the others have one. */
export function insert(text: string, list: string, value: unknown): string {
  const root = tree(text);
  if (isFault(root) || root.type !== 'object') return text;
  const array = findNodeAtLocation(root, [list]);
  if (array !== undefined && array.type !== 'array') return text;
  const last = array?.children?.at(-1);
  const newline = newlineOf(text);
  if (array !== undefined && last !== undefined) {
    const indent = indentOf(text, last.offset);
    const spread = indent !== null && text.slice(last.offset, end(last)).includes('\n');
    const content = spread ? spreadOut(value, indent, unitOf(text, root), newline) : format(value);
    return splice(text, [{ offset: end(last), length: 0, content: indent === null ? `, ${content}` : `,${newline}${indent}${content}` }]);
  }
  const outer = root.children?.at(-1);
  const indent = outer === undefined ? null : indentOf(text, outer.offset);
  const content = indent === null ? `[${format(value)}]` : `[${newline}${indent}${unitOf(text, root)}${format(value)}${newline}${indent}]`;
  if (array !== undefined) return splice(text, [{ offset: array.offset, length: array.length, content }]);
  return splice(text, [addProperty(text, root, list, content)]);
}

/** The text without some elements of a list. */
export function remove(text: string, list: string, indices: number[]): string {
  let next = text;
  for (const index of [...indices].sort((a, b) => b - a)) {
    const root = tree(next);
    const node = isFault(root) ? undefined : findNodeAtLocation(root, [list, index]);
    if (node !== undefined) next = splice(next, takeOut(next, node));
  }
  return next;
}

function spreadOut(value: unknown, indent: string, unit: string, newline: string): string {
  return JSON.stringify(value, null, unit).replaceAll('\n', newline + indent);
}

function end(node: Node): number {
  return node.offset + node.length;
}

/** What stands before something on its line, if that is only blanks. */
function indentOf(text: string, offset: number): string | null {
  const begin = text.lastIndexOf('\n', offset - 1) + 1;
  const before = text.slice(begin, offset);
  return begin > 0 && /^[ \t]*$/.test(before) ? before : null;
}

/** By how much a file indents. */
function unitOf(text: string, root: Node): string {
  const first = root.children?.[0];
  return (first && indentOf(text, first.offset)) || '  ';
}

function newlineOf(text: string): string {
  return text.includes('\r\n') ? '\r\n' : '\n';
}

/** Line and column, from 1, the column in characters as problems count it. */
export function lineOf(text: string, offset: number): { line: number; column: number } {
  const before = text.slice(0, offset);
  const begin = before.lastIndexOf('\n') + 1;
  return { line: before.split('\n').length, column: [...before.slice(begin)].length + 1 };
}

/** Where a line and a column are in the text. */
export function offsetOf(text: string, line: number, column: number): number {
  let begin = 0;
  for (let at = 1; at < line; at++) {
    const next = text.indexOf('\n', begin);
    if (next < 0) break;
    begin = next + 1;
  }
  let offset = begin;
  for (let at = 1; at < column && offset < text.length; at++) offset += text.codePointAt(offset)! > 0xffff ? 2 : 1;
  return offset;
}
