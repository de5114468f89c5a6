import { expect, test } from 'vitest';
import { FLAT } from '../../testing/flat';
import { enclosed } from './enclosed';
import { PIECES, SENSORS, type SensorKind, freshName, newPiece, newSensor } from './library';
import { type Home, bearerOf, boundsOf, formOf, isHome, nounOf, of, readHome, spotOf, titleOf, wallsOf } from './model';
import { pictured } from './picture';
import { listed } from './problems';
import { fieldsOf, homeFields } from './schema';
import { targetsOf } from './snap';
import { area, rounded } from './shape';

function home(text = FLAT): Home {
  const read = readHome(text);
  if (!isHome(read)) throw new Error(read.what);
  return read;
}

const flat = home();

test('elements know where they are in the text', () => {
  const bed = flat.byId.get('furniture/0')!;
  expect(FLAT.slice(bed.offset, bed.offset + bed.length)).toMatch(/^\{ "name": "bed".*\}$/);
  expect([titleOf(bed), nounOf(bed)]).toEqual(['bed', 'piece of furniture']);
  expect(titleOf(flat.byId.get('walls/4')!)).toBe('wall 5');
  expect(nounOf(flat.byId.get('sensors/4')!)).toBe('ceiling motion sensor');
  expect(boundsOf(flat)).toEqual([[-0.1, -0.1], [6.1, 3.1]]);
});

test('a sensor is where the thing is that it hangs on', () => {
  expect(spotOf(flat, flat.byId.get('sensors/1')!)).toEqual([1, 2]);
  expect(bearerOf(flat, flat.byId.get('sensors/2')!)?.id).toBe('doors/0');
  expect(bearerOf(flat, flat.byId.get('sensors/3')!)?.id).toBe('rooms/0');
});

test('odd homes are read as far as they can be', () => {
  const odd = [
    '{}', '{"rooms": 3, "walls": [1, null, "x", [], {}]}', '{"rooms": [{"name": 7, "outline": [[0, 0], ["a", 1], [2]]}]}',
    '{"furniture": [{"at": [1, 1], "size_m": "big"}], "sensors": [{"kind": {"__proto__": 1}, "on": ["x"]}, {"kind": "__proto__", "name": "constructor", "at": [1, 1]}]}',
    `{"walls": [{"from": [0, 0], "to": [0, 0]}, {"from": [1e308, 0], "to": [1, 1]}], "doors": [{"from": [0, 0], "to": [0, 0]}]}`,
    `{"rooms": [{"name": ${JSON.stringify('<script>\u202e\n'.repeat(400))}, "outline": [[0, 0], [1, 0], [1, 1]]}]}`,
  ];
  for (const text of odd) {
    const read = home(text);
    for (const element of read.elements) {
      expect(() => [formOf(element), spotOf(read, element), titleOf(element), nounOf(element), fieldsOf(element)]).not.toThrow();
    }
    expect(boundsOf(read).flat().every(Number.isFinite)).toBe(true);
    expect(() => pictured(read, null)).not.toThrow();
  }
  expect(isHome(readHome('[]'))).toBe(false);
});

test('doors cut their walls, and a sign points where the file says', () => {
  const picture = pictured(flat, null);
  const walls = picture.solids.filter(({ kind }) => kind === 'wall');
  expect(walls).toHaveLength(7);
  expect(walls.reduce((sum, { outline }) => sum + Math.abs(area(outline)), 0)).toBeCloseTo(18 * 0.2 + 3 * 0.1 - 0.9 * 0.2 - 0.9 * 0.1);
  expect(picture.sensors[0]!.beams[0]![1][0]).toBeGreaterThan(0.12);
});

test('the enclosed space around a point is found, whatever meets there', () => {
  const walls = wallsOf(flat);
  const sorted = (outline: unknown) => JSON.stringify([...(outline as number[][])].sort((a, b) => a[0]! - b[0]! || a[1]! - b[1]!));
  expect(sorted(enclosed(walls, [1, 1]))).toBe(sorted([[0, 0], [4, 0], [4, 3], [0, 3]]));
  expect(sorted(enclosed(walls, [5, 1]))).toBe(sorted([[4, 0], [6, 0], [6, 3], [4, 3]]));
  expect(enclosed(walls, [7, 1])).toBeNull();
  // An open end, a crossing, and a small gap.
  const more = [...walls, { from: [1, 0], to: [1, 1.5] }, { from: [-0.5, 2], to: [4, 2.01] }] as { from: [number, number]; to: [number, number] }[];
  const upper = enclosed(more, [2, 2.5])!;
  expect(Math.abs(area(upper))).toBeCloseTo(4 * 0.995, 1);
  expect(enclosed(walls.slice(1), [1, 1])).toBeNull();
  expect(enclosed([], [0, 0])).toBeNull();
});

test('all kinds of sensors and all furniture can be put into the home, under names of their own', () => {
  const targets = targetsOf(flat, new Set());
  const spots: Record<(typeof SENSORS)[SensorKind], [number, number]> = { wall: [0.3, 1], ceiling: [2, 1], thing: [1, 2], room: [5, 2], free: [5, 2] };
  for (const kind of Object.keys(SENSORS) as SensorKind[]) {
    const value = newSensor(flat, kind, spots[SENSORS[kind]], targets, 0.05);
    expect(typeof value, kind).toBe('object');
    if (typeof value === 'string') continue;
    expect(value.kind).toBe(kind);
    const needed = fieldsOf({ ...flat.byId.get('sensors/0')!, value }).filter(({ required }) => required);
    for (const field of needed) expect(value, kind).toHaveProperty(String(field.path.at(-1)));
  }
  expect(newSensor(flat, 'contact', [4.05, 1.4], targets, null)).toMatchObject({ on: 'bath door' });
  expect(newSensor(flat, 'bed', [5, 2.5], targets, null)).toMatch(/^Click .* for the bed sensor\.$/);
  expect(newSensor(flat, 'light', [9, 9], targets, null)).toMatch(/^Click the room/);
  expect(newPiece(flat, PIECES[0]!, [1, 1])).toMatchObject({ name: 'bed 2', enterable: true });
  expect(freshName(flat, 'Window')).toBe('Window 2');
});

test('fields come from the schema, with their bounds, units and what holds without them', () => {
  const fields = new Map(fieldsOf(flat.byId.get('sensors/0')!).map((field) => [field.path.at(-1), field]));
  expect(fields.get('facing_deg')).toMatchObject({ form: 'number', unit: '°', required: true, bounds: { least: -360, most: 360 }, label: 'Direction, from east' });
  expect(fields.get('reach_m')).toMatchObject({ form: 'number', unit: 'm', required: false, fallback: 10 });
  expect(fields.get('field_deg')).toMatchObject({ form: 'numbers', fallback: [145, 50] });
  expect(fields.get('at')).toMatchObject({ form: 'numbers', unit: 'm', words: ['East', 'North'] });
  expect(fields.get('preset')).toMatchObject({ form: 'choice' });
  const level = fields.get('level')!;
  expect(level.form === 'way' && level.options.map(({ value, fields }) => [value, fields.length])).toEqual([['paper', 0], ['sensitivity', 1], ['zones', 3]]);
  const role = fieldsOf(flat.byId.get('furniture/0')!).find(({ path }) => path.at(-1) === 'role')!;
  expect(role).toMatchObject({ form: 'choice', label: 'Role', required: false, fallback: undefined });
  expect(role.form === 'choice' && role.options.slice(0, 2).map(({ value, title, about }) => [value, title, about])).toEqual([
    ['', 'from its name', ''], ['bed', 'bed', 'A place to sleep.'],
  ]);
  expect(fieldsOf(flat.byId.get('rooms/0')!).map(({ form }) => form)).toEqual(['text', 'corners', 'text', 'number']);
  expect(fieldsOf(flat.byId.get('sensors/1')!).map(({ form }) => form)).toEqual(['text', 'bearer', 'list', 'number', 'numbers', 'numbers', 'number']);
  const camera = new Map(fieldsOf({ ...flat.byId.get('sensors/0')!, value: { kind: 'camera' } }).map((field) => [field.path.at(-1), field]));
  expect(camera.get('woken_by')).toMatchObject({ form: 'names', label: 'Woken by', required: false });
  expect(camera.get('pixels')).toMatchObject({ form: 'numbers', words: ['Columns', 'Rows'], unit: '', fallback: [160, 120] });
  expect(camera.get('frames_per_s')).toMatchObject({ form: 'number', label: 'Frames', unit: 'a second', fallback: 5 });
  const notice = fields.get('notice')!;
  expect(notice.form === 'way' && notice.options[0]).toMatchObject({ value: '', title: 'as the device does' });
  expect(homeFields().map(({ path }) => path)).toEqual([['name'], ['about'], ['latitude_deg']]);
  for (const list of ['rooms', 'walls', 'doors', 'furniture', 'places'] as const) expect(fieldsOf(of(flat, list)[0]!).length).toBeGreaterThan(0);
});

test('problems are led back to the elements they mean', () => {
  const line = FLAT.split('\n').findIndex((text) => text.includes('"stove"')) + 1;
  const problem = { file: 'home.json', line, column: 7, width: 4, what: 'reaches out', hint: null };
  const other = { ...problem, file: 'scenario.json' };
  const check = { problems: [problem, other], warnings: [{ ...problem, what: 'hardly meant' }] };
  const all = listed(home(FLAT.replace('"at": [1, 2]', '"at": [0.9, 2]')), 'home.json', check, [problem], 'metric');
  expect(all.map(({ file, element, warning }) => [file, element?.id, warning])).toEqual([
    ['home.json', 'furniture/1', false], ['scenario.json', undefined, false], ['home.json', 'furniture/1', true],
    // Its bed overlaps a wall.
    ['home.json', 'furniture/0', true],
  ]);
  expect(listed(flat, 'home.json', { problems: [{ ...problem, line: 0, column: 0 }], warnings: [] }, null, 'metric')[0]!.element).toBeNull();
});

test('many pieces that stand in something are one row with a list', () => {
  const sofas = (count: number) => home(JSON.stringify({ furniture: Array.from({ length: count }, (_, index) => ({ name: `sofa ${index}`, at: [index, 0], size_m: [1.2, 1], enterable: true })) }));
  const rows = (count: number) => listed(sofas(count), 'home.json', null, null, 'metric');
  expect(rows(4).map(({ what, each }) => [what, each])).toEqual([0, 1, 2].map((index) => [`sofa ${index} overlaps sofa ${index + 1} by 0.20 m`, undefined]));
  const [row, ...more] = rows(40);
  expect([row!.what, row!.warning, more]).toEqual(['39 pieces of furniture overlap each other or walls', true, []]);
  expect(row!.each!.map(({ element }) => element.name).slice(0, 2)).toEqual(['sofa 0', 'sofa 1']);
});

test('numbers are whole millimetres and never minus zero', () => {
  expect(rounded(1.23456)).toBe(1.235);
  expect(Object.is(rounded(-0.0001), 0)).toBe(true);
});
