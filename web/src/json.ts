// Small edits of a JSON text: line ends, indentation and blank lines outside of the change stay, so that an edited file
// differs in few lines. New parts take the layout of their neighbours.

import { type Node, type ParseError, findNodeAtOffset, getNodePath, parseTree, printParseErrorCode } from 'jsonc-parser';
import { offsetOf } from './places';

export type Path = (string | number)[];

/** Replaces a value, or adds it with all missing parents; `undefined` removes it. */
export type Change = { path: Path; value: unknown };

export type Fault = { what: string; offset: number };

type Edit = { offset: number; length: number; content: string };

/** Longer lines are broken. */
const WIDEST = 100;

const WORDS: Record<string, string> = {
  InvalidSymbol: 'this is not valid JSON',
  InvalidNumberFormat: 'this is not a valid number',
  PropertyNameExpected: 'a property name in double quotes is missing',
  ValueExpected: 'a value is missing',
  ColonExpected: 'a colon is missing',
  CommaExpected: 'a comma is missing',
  CloseBraceExpected: 'a closing brace is missing',
  CloseBracketExpected: 'a closing bracket is missing',
  EndOfFileExpected: 'there is text after the end',
  InvalidCommentToken: 'JSON does not allow comments',
  UnexpectedEndOfString: 'the closing quote is missing',
};

/** The value of a text; `undefined` for invalid JSON. */
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

/** The tree of a text, or its syntax error. */
export function tree(text: string): Node | Fault {
  const errors: ParseError[] = [];
  let root: Node | undefined;
  try {
    root = parseTree(text, errors, { disallowComments: true });
  } catch {
    return { what: 'this is nested too deeply', offset: 0 };
  }
  const error = errors[0];
  if (error !== undefined) return { what: WORDS[printParseErrorCode(error.error)] ?? 'this is not valid JSON', offset: error.offset };
  return root ?? { what: 'the file is empty', offset: 0 };
}

export function isFault(read: Node | Fault): read is Fault {
  return 'what' in read;
}

/** Applies changes that do not contain each other; invalid JSON stays unchanged. */
export function apply(text: string, changes: Change[]): string {
  const root = tree(text);
  if (isFault(root)) return text;
  const found = changes.map(({ path, value }) => ({ path, value, node: nodeAt(root, path) }));
  let next = splice(text, found.flatMap(({ node, value }) => (node === null || value === undefined ? [] : replace(text, node, value))));
  // Additions and removals may be next to earlier ones.
  const edit = (edits: (root: Node) => Edit[]) => {
    const now = tree(next);
    if (!isFault(now)) next = splice(next, edits(now));
  };
  for (const { path, value, node } of found) if (node === null && value !== undefined) edit((now) => put(next, now, path, value));
  // From the end, so that earlier elements keep their index.
  const gone = found.filter(({ node, value }) => node !== null && value === undefined).sort((a, b) => b.node!.offset - a.node!.offset);
  for (const { path } of gone) edit((now) => takeOut(next, nodeAt(now, path)));
  return next;
}

/** Appends an element to a list of the root object, on a line of its own if the others have one. */
export function insert(text: string, list: string, value: unknown): string {
  const root = tree(text);
  if (isFault(root) || root.type !== 'object') return text;
  const array = childAt(root, list);
  if (array === null) return insert(apply(text, [{ path: [list], value: [] }]), list, value);
  return array.type === 'array' ? splice(text, [add(text, array, array.children!.length, value)]) : text;
}

/** The path of the value at a line and a column, if there is one. */
export function pathAt(text: string, line: number, column: number): Path | null {
  const root = tree(text);
  if (isFault(root) || line < 1 || line > text.split('\n').length) return null;
  const node = findNodeAtOffset(root, offsetOf(text, line, column), true);
  return node === undefined ? null : getNodePath(node);
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

/** Of a repeated key, the last one counts, as in the program. */
function childAt(node: Node, part: string | number): Node | null {
  if (node.type === 'array') return typeof part === 'number' ? (node.children![part] ?? null) : null;
  if (node.type !== 'object') return null;
  return node.children!.findLast(({ children }) => children![0]!.value === part)?.children![1] ?? null;
}

function nodeAt(root: Node, path: Path): Node | null {
  return path.reduce<Node | null>((node, part) => node && childAt(node, part), root);
}

/** A value of another kind than the path needs is replaced. */
function put(text: string, root: Node, path: Path, value: unknown): Edit[] {
  let node = root;
  for (const [index, part] of path.entries()) {
    const next = childAt(node, part);
    if (next === null) {
      const rest = nested(path.slice(index + 1), value);
      if (node.type !== (typeof part === 'string' ? 'object' : 'array')) return replace(text, node, nested([part], rest));
      // An index far beyond the end belongs to a list that has changed meanwhile.
      return typeof part === 'number' && part !== node.children!.length ? [] : [add(text, node, part, rest)];
    }
    node = next;
  }
  return replace(text, node, value);
}

function nested(path: Path, value: unknown): unknown {
  return path.reduceRight((inner, part) => (typeof part === 'string' ? { [part]: inner } : [inner]), value);
}

/** Replaces only the numbers that differ, if both have the same structure. */
function replace(text: string, node: Node, value: unknown): Edit[] {
  const children = node.children ?? [];
  if (node.type === 'array' && Array.isArray(value) && value.length === children.length) {
    return children.flatMap((child, index) => replace(text, child, value[index]));
  }
  if (node.type !== 'array' && node.type !== 'object' && node.value === value) return [];
  const content = isInList(node) ? onLine(value) : written(value, indentAt(text, node.offset), unitOf(text), newlineOf(text));
  return [{ offset: node.offset, length: node.length, content }];
}

function add(text: string, into: Node, key: string | number, value: unknown): Edit {
  const [newline, unit, outer] = [newlineOf(text), unitOf(text), indentAt(text, into.offset)];
  const all = into.children!;
  const last = all.at(-1);
  const name = typeof key === 'string' ? `${JSON.stringify(key)}: ` : '';
  const within = (content: string): Edit => ({ offset: into.offset + 1, length: into.length - 2, content });
  const behind = (content: string): Edit => ({ offset: end(last ?? into), length: 0, content });
  const isOpen = indentOf(text, (into.parent ?? into).offset) !== null;
  const first = into.parent === undefined || (isOpen && into.type === 'array' && isObject(value)) ? outer + unit : null;
  const indent = last ? indentOf(text, last.offset) : first;
  if (indent !== null) {
    const spread = into.type === 'array' && isObject(value) && last !== undefined && text.slice(last.offset, end(last)).includes('\n');
    const one = spread ? JSON.stringify(value, null, unit).replaceAll('\n', newline + indent)
      : into.type === 'array' || isInList(into) ? onLine(value)
      : written(value, indent, unit, newline);
    return last ? behind(`,${newline}${indent}${name}${one}`) : within(`${newline}${indent}${name}${one}${newline}${outer}`);
  }
  const space = into.type === 'object' ? ' ' : '';
  const flat = last ? behind(`, ${name}${onLine(value)}`) : within(space + name + onLine(value) + space);
  const breaks = isOpen && !isInList(into) && lineAt(text, into.offset).length <= WIDEST && lineAt(splice(text, [flat]), into.offset).length > WIDEST;
  if (!breaks) return flat;
  const parts = [...all.map((one) => text.slice(one.offset, end(one))), name + written(value, outer + unit, unit, newline)];
  return within(`${parts.map((one) => `${newline}${outer}${unit}${one}`).join(',')}${newline}${outer}`);
}

/** Removes an element or a property with its surplus comma, and its line if it has one to itself. */
function takeOut(text: string, value: Node | null): Edit[] {
  const node = value?.parent?.type === 'property' ? value.parent : value;
  if (node?.parent === undefined) return [];
  const siblings = node.parent.children!;
  const index = siblings.indexOf(node);
  const [before, after] = [siblings[index - 1], siblings[index + 1]];
  if (before === undefined && after === undefined) {
    const { offset, length, type } = node.parent;
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

/** A value on one line, if that is short enough. */
function written(value: unknown, indent: string, unit: string, newline: string): string {
  const short = onLine(value);
  if (indent.length + short.length <= WIDEST || typeof value !== 'object' || value === null) return short;
  const deeper = indent + unit;
  const parts = Array.isArray(value)
    ? value.map((one) => written(one, deeper, unit, newline))
    : Object.entries(value).flatMap(([key, one]) => (one === undefined ? [] : [`${JSON.stringify(key)}: ${written(one, deeper, unit, newline)}`]));
  const [open, close] = Array.isArray(value) ? ['[', ']'] : ['{', '}'];
  return `${open}${newline}${parts.map((part) => deeper + part).join(`,${newline}`)}${newline}${indent}${close}`;
}

function onLine(value: unknown): string {
  if (Array.isArray(value)) return `[${value.map(onLine).join(', ')}]`;
  if (!isObject(value)) return JSON.stringify(value);
  const parts = Object.entries(value).flatMap(([key, one]) => (one === undefined ? [] : [`${JSON.stringify(key)}: ${onLine(one)}`]));
  return parts.length === 0 ? '{}' : `{ ${parts.join(', ')} }`;
}

/** An element of a list, such as a wall, and everything in it stays on one line, however long. */
function isInList({ parent }: Node): boolean {
  return parent !== undefined && (parent.type === 'array' || isInList(parent));
}

function end(node: Node): number {
  return node.offset + node.length;
}

function newlineOf(text: string): string {
  return text.includes('\r\n') ? '\r\n' : '\n';
}

/** The indentation of the file. */
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

/** The blanks before a position on its line, if nothing else precedes it and earlier lines exist. */
function indentOf(text: string, offset: number): string | null {
  const begin = text.lastIndexOf('\n', offset - 1) + 1;
  const before = text.slice(begin, offset);
  return begin > 0 && /^[ \t]*$/.test(before) ? before : null;
}
