import { expect, test } from 'vitest';
import { type Path, apply, insert, isFault, pathAt, tree, valueOf } from './json';

const withValue = (text: string, path: Path, value: unknown) => apply(text, [{ path, value }]);
const without = (text: string, ...paths: Path[]) => apply(text, paths.map((path) => ({ path, value: undefined })));
const remove = (text: string, list: string, indices: number[]) => without(text, ...indices.map((index) => [list, index]));

const FILE = `{
  "to":   ["sqlite:log.db"],
  "columns": { "time": "ts_local" },
  "ids": {
    "bed": "A1",
    "hall": "A3"
  },
  "time": "local"
}
`;

const HOME = `{
  "name": "flat",
  "walls": [
    { "from": [0, 0], "to": [4.0, 0], "thickness_m": 0.2 },
    { "from": [4.0, 0], "to": [4.0, 3] },

    { "from": [4.0, 3], "to": [0, 3] }
  ],
  "doors": []
}
`;

test('a value is replaced, and all else stays as it was written', () => {
  expect(withValue(FILE, ['to', 0], 'csv:log.csv')).toBe(FILE.replace('sqlite:log.db', 'csv:log.csv'));
  expect(withValue(FILE, ['ids', 'bed'], 'B1')).toBe(FILE.replace('A1', 'B1'));
  expect(withValue(FILE, ['time'], { a: [1, 'x'] })).toBe(FILE.replace('"local"', '{ "a": [1, "x"] }'));
});

test('what is new is laid out as its neighbours are', () => {
  expect(withValue(FILE, ['columns', 'value'], 'code')).toBe(FILE.replace('"ts_local" }', '"ts_local", "value": "code" }'));
  expect(withValue(FILE, ['ids', 'sofa'], 'B1')).toBe(FILE.replace('"A3"', '"A3",\n    "sofa": "B1"'));
  expect(withValue(FILE, ['to', 1], 'csv:a')).toBe(FILE.replace('.db"]', '.db", "csv:a"]'));
  expect(withValue(FILE, ['table'], 'event')).toBe(FILE.replace('"local"\n', '"local",\n  "table": "event"\n'));
});

test('what is missing on the way is made, and what is of another kind gives way', () => {
  expect(withValue('{}', ['ids', 'bed'], 'A1')).toBe('{\n  "ids": { "bed": "A1" }\n}');
  expect(valueOf(withValue('{"ids": 5}', ['ids', 'bed'], 'A1'))).toEqual({ ids: { bed: 'A1' } });
  expect(valueOf(withValue('[]', ['a', 0], 1))).toEqual({ a: [1] });
  expect(withValue('{ "a": {} }', ['a', 'b'], 1)).toBe('{ "a": { "b": 1 } }');
});

test('tabs, and lines that end as on Windows, stay', () => {
  expect(withValue('{\r\n\t"a": 1\r\n}\r\n', ['b'], 2)).toBe('{\r\n\t"a": 1,\r\n\t"b": 2\r\n}\r\n');
});

test('a line that would grow too long is broken', () => {
  const text = `{\n  "ids": { "${'a'.repeat(60)}": "1" }\n}`;
  expect(withValue(text, ['ids', 'b'.repeat(40)], '2')).toBe(`{\n  "ids": {\n    "${'a'.repeat(60)}": "1",\n    "${'b'.repeat(40)}": "2"\n  }\n}`);
  expect(withValue('{\n  "to": 1\n}', ['to'], ['a'.repeat(60), 'b'.repeat(60)])).toBe(`{\n  "to": [\n    "${'a'.repeat(60)}",\n    "${'b'.repeat(60)}"\n  ]\n}`);
});

test('what is taken away takes its comma along', () => {
  expect(without(FILE, ['ids', 'bed'])).toBe(FILE.replace('"bed": "A1",\n    ', ''));
  expect(without(FILE, ['ids', 'hall'])).toBe(FILE.replace(',\n    "hall": "A3"', ''));
  expect(without(FILE, ['to', 0])).toBe(FILE.replace('["sqlite:log.db"]', '[]'));
  expect(without(FILE, ['none', 'of', 'it'])).toBe(FILE);
  expect(without(FILE, [])).toBe(FILE);
});

test('of a key that stands twice the last one is meant, as the program reads it', () => {
  expect(withValue('{ "a": 1, "a": 2 }', ['a'], 3)).toBe('{ "a": 1, "a": 3 }');
});

test('keys may be hostile', () => {
  for (const key of ['__proto__', 'constructor', '"\\\n', '🛁', '']) {
    const text = withValue('{\n  "ids": {}\n}', ['ids', key], 'A1');
    expect(Object.entries((valueOf(text) as { ids: object }).ids)).toEqual([[key, 'A1']]);
    expect(valueOf(without(text, ['ids', key]))).toEqual({ ids: {} });
  }
});

test('a text that is not JSON is left alone', () => {
  for (const text of ['', '{', '{ "a": }', '// no\n{}', '['.repeat(20_000)]) {
    expect(withValue(text, ['a'], 1)).toBe(text);
    expect(without(text, ['a'])).toBe(text);
    expect(pathAt(text, 1, 1)).toBe(null);
  }
  const deep = '['.repeat(20_000) + ']'.repeat(20_000);
  expect(() => withValue(deep, [0, 0], 1)).not.toThrow();
});

test('a place in the text is a path, counted in characters', () => {
  expect(pathAt(FILE, 2, 12)).toEqual(['to', 0]);
  expect(pathAt(FILE, 5, 5)).toEqual(['ids', 'bed']);
  expect(pathAt(FILE, 5, 13)).toEqual(['ids', 'bed']);
  expect(pathAt('{ "🛁🛁": 1, "b": 2 }', 1, 12)).toEqual(['b']);
  expect(pathAt(FILE, 0, 0)).toBe(null);
  expect(pathAt(FILE, 99, 1)).toBe(null);
});

function differing(before: string, after: string): string[] {
  const old = before.split('\n');
  return after.split('\n').filter((line) => !old.includes(line));
}

test('a number is replaced, and nothing beside it', () => {
  expect(apply(HOME, [{ path: ['walls', 0, 'to'], value: [4, 0.5] }])).toBe(HOME.replace('"to": [4.0, 0], "thick', '"to": [4.0, 0.5], "thick'));
});

test('what is said already is left as it was written', () => {
  expect(apply(HOME, [{ path: ['walls', 1, 'to'], value: [4, 3] }])).toBe(HOME);
});

test('a property is added and taken away again', () => {
  const wider = apply(HOME, [{ path: ['walls', 1, 'thickness_m'], value: 0.15 }]);
  expect(differing(HOME, wider)).toEqual(['    { "from": [4.0, 0], "to": [4.0, 3], "thickness_m": 0.15 },']);
  expect(apply(wider, [{ path: ['walls', 1, 'thickness_m'], value: undefined }])).toBe(HOME);
});

test('the first of properties goes with its comma, and several go at once', () => {
  const text = '{ "a": { "x": 1, "y": 2, "z": 3 } }';
  expect(apply(text, [{ path: ['a', 'x'], value: undefined }])).toBe('{ "a": { "y": 2, "z": 3 } }');
  expect(apply(text, [{ path: ['a', 'y'], value: undefined }, { path: ['a', 'z'], value: undefined }])).toBe('{ "a": { "x": 1 } }');
  expect(apply(text, ['x', 'y', 'z'].map((key) => ({ path: ['a', key], value: undefined })))).toBe('{ "a": {} }');
});

test('an element comes on a line of its own, and its line goes with it', () => {
  const more = insert(HOME, 'walls', { from: [0, 3], to: [0, 0] });
  expect(more).toBe(HOME.replace('"to": [0, 3] }\n', '"to": [0, 3] },\n    { "from": [0, 3], "to": [0, 0] }\n'));
  expect(remove(more, 'walls', [3])).toBe(HOME);
  expect(remove(HOME, 'walls', [1])).toBe(HOME.replace('    { "from": [4.0, 0], "to": [4.0, 3] },\n', ''));
  expect(remove(HOME, 'walls', [0, 2])).toContain('"walls": [\n    { "from": [4.0, 0], "to": [4.0, 3] }\n');
  expect(remove(HOME, 'walls', [0, 1, 2])).toContain('"walls": [],');
});

test('a list that is empty, or missing, gets its first element', () => {
  const door = { name: 'door', from: [1, 0], to: [1.9, 0] };
  expect(insert(HOME, 'doors', door)).toContain('"doors": [\n    { "name": "door", "from": [1, 0], "to": [1.9, 0] }\n  ]\n}');
  const furnished = insert(HOME, 'places', { name: 'sink', at: [1, 1] });
  expect(JSON.parse(furnished).places).toEqual([{ name: 'sink', at: [1, 1] }]);
  expect(furnished).toContain('"doors": [],\n  "places": [\n    { "name": "sink", "at": [1, 1] }\n  ]\n}');
});

test('the style of a file stays: on one line, spread out, with other line ends', () => {
  expect(insert('{"walls":[{"from":[0,0]}]}', 'walls', { from: [1, 1] })).toBe('{"walls":[{"from":[0,0]}, { "from": [1, 1] }]}');
  const spread = JSON.stringify({ walls: [{ from: [0, 0] }] }, null, 4);
  expect(insert(spread, 'walls', { from: [1, 1] })).toBe(JSON.stringify({ walls: [{ from: [0, 0] }, { from: [1, 1] }] }, null, 4));
  const windows = insert(HOME.replaceAll('\n', '\r\n'), 'walls', { from: [0, 3], to: [0, 0] });
  expect(windows.replaceAll('\r\n', '')).not.toContain('\n');
  expect(remove(windows, 'walls', [3])).toBe(HOME.replaceAll('\n', '\r\n'));
});

test('what comes and goes many times leaves no trace', () => {
  let text = HOME;
  for (let round = 0; round < 30; round++) {
    text = insert(text, 'doors', { name: `door ${round}`, from: [0, 0], to: [1, 0] });
    text = apply(text, [{ path: ['doors', 0, 'open'], value: false }, { path: ['walls', 0, 'to'], value: [round, 0] }]);
    text = apply(text, [{ path: ['walls', 0, 'to'], value: [4, 0] }]);
    expect(() => JSON.parse(text)).not.toThrow();
    text = remove(text, 'doors', [0]);
  }
  expect(text).toBe(HOME.replace('[4.0, 0], "thick', '[4, 0], "thick'));
});

test('what is no JSON is not touched, and what is wrong is said', () => {
  for (const [text, what] of [['{ "a": 1 "b" }', 'comma'], ['', 'value'], ['{ // no\n}', 'comments'], ['{ "a": [1, 2 }', 'comma or bracket'], ['['.repeat(200_000), 'deep or bracket']] as const) {
    const read = tree(text);
    expect(isFault(read), text.slice(0, 20)).toBe(true);
    if (isFault(read)) expect(what.split(' or ').some((word) => read.what.includes(word)), read.what).toBe(true);
    expect(apply(text, [{ path: ['a'], value: 2 }])).toBe(text);
    expect(insert(text, 'walls', {})).toBe(text);
    expect(remove(text, 'walls', [0])).toBe(text);
  }
  expect(insert('[]', 'walls', {})).toBe('[]');
  expect(insert('{"walls": 3}', 'walls', {})).toBe('{"walls": 3}');
});

test('elements of lists keep to a line each, and what is one line stays one, however long', () => {
  const outline = Array.from({ length: 30 }, (_, corner) => [corner, corner / 2]);
  const rooms = insert('{\n  "rooms": [\n    { "name": "hall", "outline": [[0, 0]] }\n  ]\n}', 'rooms', { name: 'attic', outline });
  expect(rooms.split('\n')).toHaveLength(6);
  expect(withValue(rooms, ['rooms', 0, 'outline'], outline).split('\n')).toHaveLength(6);
  expect(withValue(rooms, ['rooms', 1, 'about'], 'x'.repeat(99)).split('\n')).toHaveLength(6);
  const flat = JSON.stringify({ walls: outline.map((from) => ({ from })) });
  expect(insert(flat, 'walls', { from: [1, 1] })).not.toContain('\n');
});

test('several changes at once: set, made, and taken away', () => {
  const text = '{\n  "a": {},\n  "b": [1, 2, 3],\n  "c": 1\n}';
  const changes = [{ path: ['a', 'x'], value: 1 }, { path: ['a', 'y'], value: 2 }, { path: ['b', 0], value: undefined }, { path: ['b', 2], value: undefined }, { path: ['c'], value: 4 }];
  expect(apply(text, changes)).toBe('{\n  "a": { "x": 1, "y": 2 },\n  "b": [2],\n  "c": 4\n}');
});

test('an element far behind the end of a list is not made', () => {
  expect(withValue(HOME, ['walls', 9, 'to'], [1, 1])).toBe(HOME);
  expect(without(HOME, ['walls', 9])).toBe(HOME);
});

test('what has no value is left out', () => {
  expect(withValue('{ "x": 0 }', ['x'], { a: [1, 2.5], b: undefined, c: 'x"y' })).toBe('{ "x": { "a": [1, 2.5], "c": "x\\"y" } }');
});
