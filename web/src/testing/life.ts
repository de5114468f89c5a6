// Made-up files of a scenario, the interpretation of its routines, and its days: for tests, and for looking at the page
// without a server. The interpretation is much simpler than that of the program.

import { encode } from '@msgpack/msgpack';
import { Refused, type Fetch } from '../server';
import type { CheckView, Completion, Draft, Explain, ExplainView, FilesView, Month, MonthView, ProblemView, Save, SavedView, StatementsView, WriteStatement, WrittenStatementView } from '../wire';
import { date } from './dates';

const HOUR_US = 3_600_000_000;
const DAY_US = 24 * HOUR_US;

export const ROUTINE = `# Agnes lives alone.
Agnes is 82.

Every day
  she gets up at about 06:45
  she prepares breakfast at about 07:40 for 15 minutes, then eats for 20 minutes

From week 2, over 1 week, she shows moderate depression.
`;

export const WORDS: Completion[] = [
  { text: 'She gets up at about 06:45.', kind: 'sentence', about: 'when' },
  { text: 'She watches television in the evening for about 2 hours.', kind: 'sentence', about: 'how long' },
  { text: 'watches television', kind: 'activity', about: 'activity' },
  { text: 'goes to bed', kind: 'activity', about: 'activity' },
  { text: 'goes to the bathroom', kind: 'activity', about: 'activity' },
  { text: 'in the morning', kind: 'time', about: 'part of the day' },
  { text: 'in the evening', kind: 'time', about: 'part of the day' },
  { text: 'for about 1 hour', kind: 'time', about: 'how long' },
  { text: 'often', kind: 'time', about: 'how often' },
  { text: 'living room', kind: 'place', about: 'room' },
  { text: 'armchair', kind: 'place', about: 'place' },
  ...['depression', 'grief'].flatMap((name) => ['mild', 'moderate', 'severe'].map((how): Completion => ({ text: `${how} ${name}`, kind: 'condition', about: 'condition' }))),
];

/** A problem for each word `wtches`. */
function problemsOf(file: string, text: string): ProblemView[] {
  return text.split('\n').flatMap((line, index) => {
    const at = line.indexOf('wtches');
    if (at === -1) return [];
    return [{ file, line: index + 1, column: [...line.slice(0, at)].length + 1, width: 6, what: '"wtches" is nothing that can be done', hint: 'did you mean "watches television"?', fix: { kind: 'replace', with: 'watches television' } }];
  });
}

function explained(file: string, text: string): ExplainView {
  const sentences = text.split('\n').flatMap((line, index): ExplainView['sentences'] => {
    const said = line.replace(/#.*/, '').trim();
    if (said === '' || said === 'Every day') return [];
    return [{ line: index + 1, said, kind: 'habit', what: said.slice(0, 40), days: 'p 1', when: '06:30-07:00', start_s: [23_400, 24_300, 25_200], lasts_s: [600, 900, 1200], in_words: `In words: ${said}` }];
  });
  const shows = /shows moderate (\w+)/.exec(text)?.[1];
  return {
    problems: problemsOf(file, text),
    first: '2009-03-02',
    days: 30,
    is_foreign: /^Sprache:/.test(text),
    sentences,
    unsaid: [{ line: 1, said: 'she gets dressed', kind: 'habit', what: 'gets dressed', days: 'p 1', when: 'after: gets up', start_s: null, lasts_s: null, in_words: 'Gets dressed after getting up.' }],
    conditions: shows === undefined ? [] : [{ name: shows, severity: Array.from({ length: 30 }, (_, day) => Math.min(Math.max((day - 7) / 7, 0), 1)), sentences: sentences.slice(0, 1) }],
    words: WORDS,
  };
}

const LINE = /^( *)(she )(\w+) (.*)$/;

/** A statement for each line such as `she reads …`. */
function stated(text: string): StatementsView {
  const statements = text.split('\n').flatMap((line, index): StatementsView['statements'] => {
    const found = LINE.exec(line);
    if (found === null) return [];
    const [, indent, , activity] = found;
    return [{ places: [{ line: index + 1, column: indent!.length + 1, length: line.length - indent!.length }], statement: { kind: 'habit', activity, when: {} }, sentences: [`She ${activity}.`] }];
  });
  return { problems: [], statements };
}

/** A statement as `She reads in the bed.`; nobody juggles. */
function written({ statement, instead, line }: WriteStatement, file: string, text: string): WrittenStatementView {
  const { activity, place } = statement as { activity?: string; place?: string };
  const sentence = `She ${activity}${place ? ` in the ${place}` : ''}.`;
  const of = instead === null ? null : stated(text).statements[instead.number]!.places[0]!;
  const end = (text.split('\n')[line - 1] ?? '').length + 1;
  const edit = of ? { line: of.line, column: of.column, to_line: of.line, to_column: of.column + of.length, insert: sentence } : { line, column: end, to_line: line, to_column: end, insert: `\n${sentence}` };
  const problems: ProblemView[] = activity === 'juggles' ? [{ file, line, column: 1, width: 1, what: 'nobody juggles', hint: 'choose another activity' }] : [];
  return { sentences: [sentence], meaning: explained(file, sentence).sentences, faults: [], problems, warnings: [], edits: problems.length > 0 ? [] : [edit] };
}

/** Two weeks or more from 2 March on; the 8th has 23 hours; with a condition she gets up later. */
function lived({ from, days, without }: Month, shows: boolean, names: string[]): MonthView {
  const later = shows && !without.includes('depression') ? 1.5 * HOUR_US : 0;
  const dates = Array.from({ length: Math.min(from + days, 30) }, (_, day) => {
    const begin_us = day * DAY_US - (day > 6 ? HOUR_US : 0);
    return date(`2009-03-${String(day + 2).padStart(2, '0')}`, begin_us, day === 6 ? 23 : 24, day === 6 ? { turn: [begin_us + 2 * HOUR_US, HOUR_US] } : {});
  }).slice(from);
  const spans = dates.flatMap(({ begin_us }): [number, number, number][] => [
    [begin_us, begin_us + 6.5 * HOUR_US + later, 0],
    [begin_us + 8 * HOUR_US, begin_us + 9 * HOUR_US, 1],
    [begin_us + 10 * HOUR_US, begin_us + 12 * HOUR_US, 2],
    [begin_us + 19 * HOUR_US, begin_us + 21 * HOUR_US, 3],
  ]);
  return {
    problems: [],
    days: dates,
    residents: names,
    activities: ['sleeping', 'preparing_breakfast', 'away', 'watching_television'],
    spans: names.map(() => spans),
    rooms: ['bedroom', 'living room'],
    stays: names.map(() => dates.flatMap(({ begin_us }): [number, number, number][] => [[begin_us, begin_us + 7 * HOUR_US, 0], [begin_us + 12 * HOUR_US, begin_us + 23 * HOUR_US, 1]])),
    hours: dates.map((_, day) => Array.from({ length: 24 }, (_, hour) => (hour < 7 ? 1 : 20 + ((hour * 5 + day) % 30) - later / HOUR_US))),
    cut: null,
  };
}

/** Answers like the server, for residents with these names; saved texts are in `files`. */
export function fakeLives(names: string[] = ['Agnes'], files: Map<string, string> = new Map(names.map((name, index) => [`${index}.routine`, ROUTINE.replaceAll('Agnes', name)]))): Fetch {
  const version = (text: string) => `${text.length}-${[...text].reduce((sum, letter) => (sum * 31 + letter.codePointAt(0)!) % 1e9, 7)}`;
  const list = (): FilesView => ({
    entry: 'scenario.json', home: null, logger: null,
    lives: names.map((name, index) => ({ name, routine: `${index}.routine` })),
    files: [...files].map(([name, text]) => ({ name, text, version: version(text) })),
  });
  const laid = ({ texts }: Draft) => new Map([...files, ...Object.entries(texts)]);
  const wrong = (draft: Draft) => [...laid(draft)].flatMap(([file, text]) => problemsOf(file, text));
  return async (path, init) => {
    const body: unknown = typeof init.body === 'string' ? JSON.parse(init.body) : null;
    switch (path) {
      case '/api/files':
        if (body === null) return Response.json(list());
        for (const { name, text } of (body as Save).files) files.set(name, text);
        return Response.json({ saved: Object.fromEntries((body as Save).files.map(({ name, text }) => [name, version(text)])), changed: [] } satisfies SavedView);
      case '/api/files/versions':
        return Response.json(Object.fromEntries(list().files.map(({ name, version }) => [name, version])));
      case '/api/check':
        return Response.json({ problems: wrong(body as Draft), warnings: [] } satisfies CheckView);
      case '/api/explain': {
        const { draft, file } = body as Explain;
        return Response.json(explained(file, laid(draft).get(file) ?? ''));
      }
      case '/api/statements': {
        const { draft, file } = body as Explain;
        return Response.json(stated(laid(draft).get(file) ?? ''));
      }
      case '/api/statement': {
        const asked = body as WriteStatement;
        return Response.json(written(asked, asked.file, laid(asked.draft).get(asked.file) ?? ''));
      }
      case '/api/month': {
        const month = body as Month;
        const problems = wrong(month.draft);
        const view = lived(month, [...laid(month.draft).values()].some((text) => text.includes('shows moderate depression')), names);
        return new Response(encode(problems.length > 0 ? { ...view, problems, days: [], spans: [], stays: [], hours: [] } : view) as BodyInit);
      }
      default:
        throw new Refused(404, `There is no ${path}.`);
    }
  };
}
