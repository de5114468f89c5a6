import { expect, test } from 'vitest';
import { ticksOf, xOf } from '../charts/axis';
import { type Lane, countBetween, countIn, countsOf, drawFirings, drawHead, drawMarks } from '../charts/lanes';
import { unseenWords } from '../charts/unseen';
import { light } from '../plan/palette';
import { daysFrom } from '../testing/dates';
import { captionHeight, drawCaption } from './caption';
import { SvgInk } from './ink';
import { ordered } from './order';
import { bandAt, laneAt, neighbour } from './read';
import { following, kept, lengthOf, moved, within, zoomed } from './sight';
import { tableOf } from './table';

const [SECOND, HOUR, DAY] = [1e6, 3_600e6, 86_400e6];
const whole = { from_us: 0, to_us: 365 * DAY };
const lane = (name: string, fired: number[], with_: Partial<Lane> = {}): Lane => ({ name, kind: 'motion', fired, said: () => 'ON', ...with_ });

test('what is in sight goes from a second to all there is, about the instant that is pointed at', () => {
  const sight = { from_us: 10 * DAY, to_us: 11 * DAY };
  const near = zoomed(sight, 0.5, 10.25 * DAY, whole);
  expect([near.to_us - near.from_us, (10.25 * DAY - near.from_us) / (near.to_us - near.from_us)]).toEqual([DAY / 2, 0.25]);
  const least = zoomed(sight, 1e-12, 10.5 * DAY, whole);
  expect(least.to_us - least.from_us).toBe(SECOND);
  expect(zoomed(sight, 1e6, 10.5 * DAY, whole)).toEqual(whole);
  expect(moved(sight, -20 * DAY, whole)).toEqual({ from_us: 0, to_us: DAY });
  expect(within({ from_us: 364.5 * DAY, to_us: 366 * DAY }, whole)).toEqual({ from_us: 363.5 * DAY, to_us: 365 * DAY });
});

test('what plays on past the end turns the page, and who jumps away is followed', () => {
  const sight = { from_us: 0, to_us: HOUR };
  expect(following(sight, HOUR / 2, whole)).toBe(sight);
  expect(following(sight, HOUR + SECOND, whole)).toEqual({ from_us: HOUR, to_us: 2 * HOUR });
  expect(following(sight, 10 * HOUR, whole)).toEqual({ from_us: 9.5 * HOUR, to_us: 10.5 * HOUR });
  expect([SECOND, 90 * SECOND, HOUR, 26 * HOUR, 20 * DAY].map((to_us) => lengthOf({ from_us: 0, to_us }))).toEqual(['1 s', '1 min 30 s', '1 h', '1 d 2 h', '20 d']);
});

test('times are as far apart as there is room for, from seconds to months', () => {
  const calendar = { days: daysFrom('2009-03-02', 365 * DAY) };
  const labels = (from_us: number, to_us: number) => ticksOf(calendar, { from_us, to_us }, 800).map(({ label }) => label);
  expect(labels(7 * HOUR, 7 * HOUR + 10 * SECOND).slice(0, 2)).toEqual(['07:00:00', '07:00:01']);
  expect(labels(0, DAY).slice(0, 2)).toEqual(['00:00', '02:00']);
  expect(labels(0, 5 * DAY)).toContain('4 Mar');
  const year = labels(0, 365 * DAY);
  expect(year.length).toBeGreaterThan(5);
  expect(year.length).toBeLessThan(14);
  expect(year).toEqual(expect.arrayContaining(['1 Apr 2009', '1 May', '2010']));
  expect(labels(0, 5 * DAY)[0]).toBe('2 Mar 2009');
  // Days of a single year need no year.
  expect(ticksOf({ days: daysFrom('2009-03-02', 60 * DAY) }, { from_us: 0, to_us: 60 * DAY }, 800).map(({ label }) => label)).toEqual(['2 Mar', '9 Mar', '16 Mar', '23 Mar', '30 Mar', '6 Apr', '13 Apr', '20 Apr', '27 Apr']);
});

test('ten years have their years, and are told in years', () => {
  const length = 3650 * DAY;
  const labels = ticksOf({ days: daysFrom('2009-03-02', length) }, { from_us: 0, to_us: length }, 800).map(({ label }) => label);
  expect(labels).toEqual(['2010', '2011', '2012', '2013', '2014', '2015', '2016', '2017', '2018', '2019']);
  expect([lengthOf({ from_us: 0, to_us: length }), lengthOf({ from_us: 0, to_us: 1000 * DAY }), lengthOf({ from_us: 0, to_us: 700 * DAY })]).toEqual(['10 years', '2.7 years', '700 d']);
});

test('who looks elsewhere goes on looking there, until somebody goes to another time or time runs out of what is in sight', () => {
  const sight = { from_us: 0, to_us: HOUR };
  // Zoomed away from the time, which stands, or plays on out of sight.
  expect(kept(sight, 5 * HOUR, 5 * HOUR, false, whole)).toBe(sight);
  expect(kept(sight, 5 * HOUR, 5 * HOUR + SECOND, false, whole)).toBe(sight);
  expect(kept(sight, HOUR, HOUR + SECOND, false, whole)).toEqual({ from_us: HOUR, to_us: 2 * HOUR });
  expect(kept(sight, 5 * HOUR, 10 * HOUR, true, whole)).toEqual({ from_us: 9.5 * HOUR, to_us: 10.5 * HOUR });
});

test('lanes stand by the home, by room, by how busy they are in sight, or by name; silent ones may be left out', () => {
  const lanes = [lane('b', [1, 2, 3], { place: 'hall' }), lane('c', [5]), lane('a', [9, 10, 11, 12], { place: 'bath' }), lane('d', [], { place: 'hall' })];
  const sight = { from_us: 0, to_us: 6 };
  expect(ordered(lanes, 'home', false, sight)).toEqual([0, 1, 2, 3]);
  expect(ordered(lanes, 'place', false, sight)).toEqual([0, 3, 2, 1]);
  expect(ordered(lanes, 'active', false, sight)).toEqual([0, 1, 2, 3]);
  expect(ordered(lanes, 'active', false, { from_us: 0, to_us: 20 })).toEqual([2, 0, 1, 3]);
  expect(ordered(lanes, 'name', false, sight)).toEqual([2, 0, 1, 3]);
  expect(ordered(lanes, 'home', true, sight)).toEqual([0, 1]);
});

test('counts of parts come to what there was between two instants', () => {
  const counts = countsOf(HOUR, [4, 0, 8]);
  expect([countBetween(counts, 0, 3 * HOUR), countBetween(counts, 0, HOUR / 2), countBetween(counts, 2.5 * HOUR, 9 * HOUR), countBetween(counts, -9 * HOUR, 0)]).toEqual([12, 2, 4, 0]);
  expect(countIn(lane('x', [], { density: counts }), { from_us: HOUR, to_us: 2 * HOUR })).toBe(0);
});

test('a place on a lane tells what is near, a place on a band what was done', () => {
  const one = lane('x', [10, 20], { said: (index) => ['ON', 'OPEN'][index]! });
  expect(laneAt(one, 18, 3)).toEqual({ at_us: 20, words: 'OPEN' });
  expect(laneAt(one, 15, 3)).toBeNull();
  expect([neighbour(one.fired, 10, true), neighbour(one.fired, 10, false), neighbour(one.fired, 20, false), neighbour(one.fired, 20, true)]).toEqual([20, null, 10, null]);
  const band = { name: 'Ada', who: 0, names: ['using_bathroom'], spans: [[0, 5, 0]] as [number, number, number][] };
  expect(bandAt(band, 3)).toEqual({ begin_us: 0, end_us: 5, words: 'using bathroom' });
  expect(bandAt(band, 5)).toBeNull();
});

test('a table has what is in sight, and no formulas', () => {
  const bands = [{ name: '=evil()', who: 0, names: ['sleep,ing'], spans: [[0, 50, 0]] as [number, number, number][] }];
  const text = tableOf({ from_us: 10, to_us: 40 }, bands, [lane('x', [5, 20]), lane('t', [30], { curve: { values: [-1.5], low: -1.5, high: 3 } })], (at) => `t${at}`, { first: 'run', second: null });
  expect(text).toBe('begin,end,what,name,said,run\nt10,t40,activity,\'=evil(),"sleep,ing",run\nt20,,sensor,x,ON,run\nt30,,sensor,t,-1.5,run\n');
});

/** The rectangles of a drawing: left, top, width, height. */
const rects = (ink: SvgInk) => [...ink.svg(10, 10, '#fff').matchAll(/<rect x="(.*?)" y="(.*?)" width="(.*?)" height="(.*?)"/g)].map((found) => found.slice(1).map(Number));

test('what was found and is short is a stripe over all lanes, what is long a thin one in the first row', () => {
  const sight = { from_us: 0, to_us: DAY };
  const drawn = (begin_us: number, end_us: number, flags = true) => {
    const ink = new SvgInk(null);
    drawMarks(ink, 1000, 10, 300, sight, [{ begin_us, end_us }], light, flags);
    return rects(ink).filter(([, , wide]) => wide! > 1).map(([, , wide, high]) => [Math.round(wide!), high]);
  };
  expect(drawn(2 * HOUR, 3 * HOUR)).toEqual([[35, 300]]);
  expect(drawn(-5 * HOUR, 30 * HOUR)).toEqual([[838, 3]]);
  expect(drawn(2 * HOUR, 5 * HOUR)).toEqual([[105, 3]]);
  // The lanes contain nothing of it.
  expect(drawn(-5 * HOUR, 30 * HOUR, false)).toEqual([]);
  expect(drawn(2 * HOUR, 3 * HOUR, false)).toEqual([[35, 300]]);
});

test('a kept picture says from when to when it is and of which runs, and which colour is whose', () => {
  const calendar = { days: daysFrom('2009-03-02', 2 * DAY), length_us: 2 * DAY };
  const caption = (second: string | null, isCounts = false, unseen: string | null = null) => {
    const ink = new SvgInk(null);
    const runs = { first: 'flat-1', second, isCounts };
    drawCaption(ink, 100, calendar, { from_us: DAY, to_us: 2 * DAY }, runs, unseen, light);
    const svg = ink.svg(600, 100 + captionHeight(runs, unseen), '#fff');
    const rows = [...svg.matchAll(/<text x=".*?" y="(.*?)".*?>(.*?)<\/text>/g)].map(([, y, words]) => [Number(y), words] as const);
    expect(rows.every(([y]) => y > 100 && y < 100 + captionHeight(runs, unseen))).toBe(true);
    return { words: rows.map(([, words]) => words), colours: [...svg.matchAll(/<rect x="10".*? fill="(.*?)"/g)].map(([, colour]) => colour) };
  };
  const span = 'Tue, 3 March 2009, 00:00:00 to Wed, 4 March 2009, 00:00:00';
  expect(caption(null)).toEqual({ words: [span, 'flat-1'], colours: [] });
  expect(caption(null, false, '2 of 5 events are loaded').words).toEqual([span, '2 of 5 events are loaded', 'flat-1']);
  const two = caption('flat-2 without depression');
  expect(two.words.slice(0, 3)).toEqual([span, 'above the line: flat-1', 'below the line: flat-2 without depression']);
  expect(two.colours).toEqual([light.seen, light.beam]);
  expect([two.words[3], caption('x', true).words[3]].map((words) => /colours show (.*?)\./.exec(words!)![1])).toEqual(['events that only one run has, and curves of values', 'where one run has more']);
  // Names of twins differ at their ends.
  expect(caption(`${'x'.repeat(900)} without depression`).words[2]).toMatch(/^below the line: x{39}…x+ without depression$/);
});

test('what is drawn as lines is text where it is text', () => {
  const ink = new SvgInk(null);
  ink.fillStyle = '#123456';
  ink.globalAlpha = 0.5;
  ink.fillText('<script>&"', 1, 2);
  ink.beginPath();
  ink.moveTo(0, 0);
  ink.lineTo(1.239, 4);
  ink.stroke();
  const svg = ink.svg(10, 20, '#fff');
  expect(svg).not.toContain('<script');
  expect(new DOMParser().parseFromString(svg, 'image/svg+xml').documentElement.tagName).toBe('svg');
  expect(svg).toContain('M0 0L1.24 4');
});

test('what was not seen is hatched, said in words, and a row of the table', () => {
  const unseen = [{ from_us: 10, to_us: 40, missing: 983 }];
  const [bands, lanes] = [[{ name: 'Ada', who: 0, names: ['sleep'], spans: [], unseen: [{ from_us: 10, to_us: 50, missing: 0 }] }], [lane('x', [45, 50], { unseen }), lane('y', [5])]];
  const sight = { from_us: 0, to_us: 100 };
  expect(unseenWords(bands, lanes, sight)).toBe('3 of 986 events are loaded. Hatched: not loaded');
  expect(unseenWords(bands, lanes, { from_us: 20, to_us: 100 })).toBe('2 events are loaded, up to 983 are not. Hatched: not loaded');
  expect(unseenWords(bands, lanes, { from_us: 42, to_us: 100 })).toBe('Hatched: activities not loaded');
  expect(unseenWords(bands, lanes, { from_us: 60, to_us: 100 })).toBeNull();
  // A lane with unknown parts only is not silent.
  expect(ordered([lane('z', [], { unseen }), lane('y', [])], 'home', true, sight)).toEqual([0]);
  const table = tableOf(sight, bands, lanes, (at) => `t${at}`, { first: 'run', second: null });
  expect(table.split('\n').slice(1, 5)).toEqual(['t5,,sensor,y,ON,run', 't10,t50,not seen,Ada,,run', 't10,t40,not seen,x,983 firings,run', 't45,,sensor,x,ON,run']);
  const lines = (draw: (ink: SvgInk) => void) => {
    const ink = new SvgInk(null);
    draw(ink);
    return [...ink.svg(1000, 100, '#fff').matchAll(/<path d="(M[^"]*L[^"]*)"[^>]*opacity="0.55"/g)].map(([, d]) => [...d!.matchAll(/[ML](\S+) /g)].map(([, x]) => Number(x)));
  };
  for (const [drawn, end] of [[lines((ink) => drawFirings(ink, 1000, 0, { sight, lanes }, light)), 40], [lines((ink) => drawHead(ink, 1000, { calendar: { days: daysFrom('2009-03-02', DAY) }, sight, bands }, light)), 50]] as const) {
    expect(drawn).toHaveLength(1);
    expect([Math.min(...drawn[0]!), Math.max(...drawn[0]!)].map((x, index) => Math.abs(x - xOf(0, 100, 1000, [10, end][index]!)) < 6)).toEqual([true, true]);
  }
});
