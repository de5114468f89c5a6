import { expect, test } from 'vitest';
import { apply, format, insert, isFault, lineOf, offsetOf, remove, rounded, tree } from './json';

const TEXT = `{
  "name": "flat",
  "walls": [
    { "from": [0, 0], "to": [4.0, 0], "thickness_m": 0.2 },
    { "from": [4.0, 0], "to": [4.0, 3] },

    { "from": [4.0, 3], "to": [0, 3] }
  ],
  "doors": []
}
`;

/** The lines in which two texts differ. */
function differing(before: string, after: string): string[] {
  const old = before.split('\n');
  return after.split('\n').filter((line) => !old.includes(line));
}

test('a number is replaced, and nothing beside it', () => {
  expect(apply(TEXT, [{ path: ['walls', 0, 'to'], value: [4, 0.5] }])).toBe(TEXT.replace('"to": [4.0, 0], "thick', '"to": [4.0, 0.5], "thick'));
});

test('what is said already is left as it was written', () => {
  expect(apply(TEXT, [{ path: ['walls', 1, 'to'], value: [4, 3] }])).toBe(TEXT);
});

test('a property is added and taken away again', () => {
  const wider = apply(TEXT, [{ path: ['walls', 1, 'thickness_m'], value: 0.15 }]);
  expect(differing(TEXT, wider)).toEqual(['    { "from": [4.0, 0], "to": [4.0, 3], "thickness_m": 0.15 },']);
  expect(apply(wider, [{ path: ['walls', 1, 'thickness_m'], value: undefined }])).toBe(TEXT);
});

test('the first of properties goes with its comma, and several go at once', () => {
  const text = '{ "a": { "x": 1, "y": 2, "z": 3 } }';
  expect(apply(text, [{ path: ['a', 'x'], value: undefined }])).toBe('{ "a": { "y": 2, "z": 3 } }');
  expect(apply(text, [{ path: ['a', 'y'], value: undefined }, { path: ['a', 'z'], value: undefined }])).toBe('{ "a": { "x": 1 } }');
  expect(apply(text, ['x', 'y', 'z'].map((key) => ({ path: ['a', key], value: undefined })))).toBe('{ "a": {} }');
});

test('an element comes on a line of its own, and its line goes with it', () => {
  const more = insert(TEXT, 'walls', { from: [0, 3], to: [0, 0] });
  expect(more).toBe(TEXT.replace('"to": [0, 3] }\n', '"to": [0, 3] },\n    { "from": [0, 3], "to": [0, 0] }\n'));
  expect(remove(more, 'walls', [3])).toBe(TEXT);
  expect(remove(TEXT, 'walls', [1])).toBe(TEXT.replace('    { "from": [4.0, 0], "to": [4.0, 3] },\n', ''));
  expect(remove(TEXT, 'walls', [0, 2])).toContain('"walls": [\n    { "from": [4.0, 0], "to": [4.0, 3] }\n');
  expect(remove(TEXT, 'walls', [0, 1, 2])).toContain('"walls": [],');
});

test('a list that is empty, or missing, gets its first element', () => {
  const door = { name: 'door', from: [1, 0], to: [1.9, 0] };
  expect(insert(TEXT, 'doors', door)).toContain('"doors": [\n    { "name": "door", "from": [1, 0], "to": [1.9, 0] }\n  ]\n}');
  const furnished = insert(TEXT, 'places', { name: 'sink', at: [1, 1] });
  expect(JSON.parse(furnished).places).toEqual([{ name: 'sink', at: [1, 1] }]);
  expect(furnished).toContain('"doors": [],\n  "places": [\n    { "name": "sink", "at": [1, 1] }\n  ]\n}');
});

test('the style of a file stays: on one line, spread out, with other line ends', () => {
  expect(insert('{"walls":[{"from":[0,0]}]}', 'walls', { from: [1, 1] })).toBe('{"walls":[{"from":[0,0]}, { "from": [1, 1] }]}');
  const spread = JSON.stringify({ walls: [{ from: [0, 0] }] }, null, 4);
  expect(insert(spread, 'walls', { from: [1, 1] })).toBe(JSON.stringify({ walls: [{ from: [0, 0] }, { from: [1, 1] }] }, null, 4));
  const windows = insert(TEXT.replaceAll('\n', '\r\n'), 'walls', { from: [0, 3], to: [0, 0] });
  expect(windows.replaceAll('\r\n', '')).not.toContain('\n');
  expect(remove(windows, 'walls', [3])).toBe(TEXT.replaceAll('\n', '\r\n'));
});

test('what comes and goes many times leaves no trace', () => {
  let text = TEXT;
  for (let round = 0; round < 30; round++) {
    text = insert(text, 'doors', { name: `door ${round}`, from: [0, 0], to: [1, 0] });
    text = apply(text, [{ path: ['doors', 0, 'open'], value: false }, { path: ['walls', 0, 'to'], value: [round, 0] }]);
    text = apply(text, [{ path: ['walls', 0, 'to'], value: [4, 0] }]);
    expect(() => JSON.parse(text)).not.toThrow();
    text = remove(text, 'doors', [0]);
  }
  expect(text).toBe(TEXT.replace('[4.0, 0], "thick', '[4, 0], "thick'));
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

test('lines and columns are counted in characters, from one', () => {
  const text = '{\n  "😀😀": 1,\n  "b": 2\n}';
  const offset = text.indexOf('1');
  expect(lineOf(text, offset)).toEqual({ line: 2, column: 9 });
  expect(offsetOf(text, 2, 9)).toBe(offset);
  expect(offsetOf(text, 99, 99)).toBeLessThanOrEqual(text.length);
});

test('numbers are whole millimetres and never minus zero', () => {
  expect(rounded(1.23456)).toBe(1.235);
  expect(Object.is(rounded(-0.0001), 0)).toBe(true);
  expect(format({ a: [1, 2.5], b: undefined, c: 'x"y' })).toBe('{ "a": [1, 2.5], "c": "x\\"y" }');
});
