// Fake stored runs, for tests and for looking at the page without a server.

import { encode } from '@msgpack/msgpack';
import type { Fetch } from '../server';
import type { DayView, PersonDay, PlaybackView, StoredView } from '../wire';
import { daysFrom } from './dates';
import { madeUpHome, spotIn } from './home';

const HOUR_US = 3_600_000_000;
const DAY_US = 24 * HOUR_US;

/** A run of some days from 2 March on, with a number of sensors. */
export function storedRun(name: string, days = 3, with_: Partial<PlaybackView> = {}): PlaybackView {
  const home = madeUpHome(12);
  return {
    name,
    scenario: 'Made-up cottage',
    home,
    residents: [{ name: 'Agnes', radius_m: 0.22 }, { name: 'Bertram', radius_m: 0.22 }],
    start: '2009-03-02 00:00:00',
    zone: 'America/Chicago',
    length_us: days * DAY_US,
    sensors: home.sensors.map((_, index) => `S${index}`),
    values: ['ON', 'OFF'],
    days: daysFrom('2009-03-02', days * DAY_US),
    hours: Array.from({ length: days }, (_, day) => Array.from({ length: 24 }, (_, hour) => (hour < 6 ? 2 : 30 + ((hour * 7 + day * 13) % 40)))),
    nights: Array.from({ length: days + 1 }, (_, day): [number, number] => [Math.max(day * DAY_US - 6 * HOUR_US, 0), Math.min(day * DAY_US + 6 * HOUR_US, days * DAY_US)]),
    has_truth: true,
    activities: ['sleeping', 'cooking'],
    spans: [[], []].map(() => Array.from({ length: days }, (_, day): [number, number, number][] => [
      [day * DAY_US, day * DAY_US + 7 * HOUR_US, 0],
      [day * DAY_US + 12 * HOUR_US, day * DAY_US + 13 * HOUR_US, 1],
    ]).flat()),
    walk: null,
    has_silhouettes: false,
    remarks: [],
    read_us: null,
    ...with_,
  };
}

/** A day with a person who moves from seven on, and firings of sensors. */
export function storedDay(run: PlaybackView, number: number): DayView {
  const { begin_us } = run.days[number]!;
  const rows: DayView['rows'] = [];
  const lives = run.residents.map((_, who): PersonDay => {
    let random = who * 7 + number * 13 + 1;
    const chance = () => (random = (random * 16_807) % 2_147_483_647) / 2_147_483_647;
    const bed: [number, number] = [1.2, 6.4];
    const movements: PersonDay['movements'] = [[begin_us, begin_us + 7 * HOUR_US, 'rest', 'lying', bed, bed]];
    let [at, now] = [bed, begin_us + 7 * HOUR_US];
    for (let minute = 0; minute < 16 * 60; minute += 10) {
      const to = spotIn(Math.floor(chance() * 7), chance);
      movements.push([now, now + 10e6, 'stride', 'standing', at, to], [now + 10e6, now + 600e6, 'rest', 'sitting', to, to]);
      if (who === 0) rows.push([now + 5e6, Math.floor(chance() * run.home.sensors.length), 0]);
      [at, now] = [to, now + 600e6];
    }
    movements.push([now, begin_us + DAY_US, 'away', 'standing', null, null]);
    return { movements, chances: [], rooms: [[begin_us, begin_us + 7 * HOUR_US, 4]], activities: run.spans[who]!.filter(([begin]) => begin >= begin_us && begin < begin_us + DAY_US) };
  });
  return { rows, lives: run.has_truth ? lives : [], until_us: run.days[number]!.end_us };
}

/** A log of some days with located people. */
export function walkedRun(name: string, days = 3, with_: Partial<PlaybackView> = {}): PlaybackView {
  const stays = [0, 1].map(() => Array.from({ length: days }, (_, day): [number, number, number][] => [
    [day * DAY_US, day * DAY_US + 7 * HOUR_US, 4],
    [day * DAY_US + 7 * HOUR_US, (day + 1) * DAY_US, 2],
  ]).flat());
  return storedRun(name, days, { activities: [], spans: [[], []], walk: { log: `${name}.csv`, stays }, ...with_ });
}

/** A day of it, which is uncertain around seven. */
export function walkedDay(run: PlaybackView, number: number): DayView {
  const day = storedDay(run, number);
  const { begin_us } = run.days[number]!;
  const seven = begin_us + 7 * HOUR_US;
  const chances: PersonDay['chances'] = [[begin_us, 4, 1], [seven - 600e6, 4, 0.6], [seven - 600e6, 2, 0.3], [seven - 600e6, -1, 0.1], [seven, 4, 0], [seven, -1, 0], [seven, 2, 1]];
  return { ...day, lives: day.lives.map((life) => ({ ...life, chances })) };
}

/** A run in the list of runs. */
export function listedRun(name: string, days = 30): StoredView {
  return { name, walked_back: null, scenario: name, start: '2009-03-02 00:00:00', days, has_truth: false, problem: null, made_ms: null, seed: null, without: [], about: { title: '', note: '' } };
}

/** Answers like the server, for runs with these names. */
export function fakeRuns(names: string[], make: (name: string) => PlaybackView = storedRun, listed: Record<string, Partial<StoredView>> = {}): Fetch {
  const runs = new Map(names.map((name) => [name, make(name)]));
  return async (path) => {
    if (path === '/api/walk') return Response.json(null);
    const told = /^\/api\/runs\/([^/]+)\/(look|realism\/.*)$/.exec(path);
    if (told !== null) return new Response(`<!doctype html><style>body{color:#123}</style><h1>${told[2]} of ${decodeURIComponent(told[1]!)}</h1><script>globalThis.broken=1</script>`);
    const asked = /^\/api\/runs\/([^/]+)\/(find|lanes)$/.exec(path);
    if (asked !== null) {
      const run = runs.get(decodeURIComponent(asked[1]!))!;
      const counts = run.sensors.map((_, sensor) => Array.from({ length: run.days.length * 24 }, (_, hour) => (hour % 24 < 6 ? 0 : (hour * 7 + sensor * 3) % 11)));
      if (asked[2] === 'lanes') return new Response(encode({ bucket_us: HOUR_US, counts }) as BodyInit);
      const hits = run.days.map(({ begin_us }) => ({ begin_us: begin_us + 2 * HOUR_US, end_us: begin_us + 2 * HOUR_US + 240e6, is_fall: false, words: run.residents[0]!.name }));
      return Response.json({ hits, all: hits.length, remarks: [] });
    }
    const [, name, day] = /^\/api\/runs\/([^/]+)(?:\/days\/(\d+))?$/.exec(path) ?? [];
    if (name === undefined) {
      const list: StoredView[] = [...runs.values()].map(({ name, scenario, start, days, has_truth, walk }) => ({ name, scenario, start, days: days.length, has_truth, walked_back: walk?.log ?? null, problem: null, made_ms: null, seed: 7, without: [], about: { title: '', note: '' }, ...listed[name] }));
      return Response.json(list);
    }
    const run = runs.get(decodeURIComponent(name));
    if (run === undefined || Number(day ?? 0) >= run.days.length) return new Response(`There is no run ${decodeURIComponent(name)}.`, { status: 404 });
    return day === undefined ? Response.json(run) : new Response(encode((run.walk === null ? storedDay : walkedDay)(run, Number(day))) as BodyInit);
  };
}
