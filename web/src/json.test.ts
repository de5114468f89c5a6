import { expect, test } from 'vitest';
import { pathAt, valueOf, withValue, without, written } from './json';

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
  expect(written(['a'.repeat(60), 'b'.repeat(60)])).toBe(`[\n  "${'a'.repeat(60)}",\n  "${'b'.repeat(60)}"\n]`);
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
