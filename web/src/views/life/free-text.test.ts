import { flushSync, mount, unmount } from 'svelte';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Drafts } from '../../drafts.svelte';
import { type Fetch, Server } from '../../server';
import { fakeLives, ROUTINE } from '../../testing/life';
import { button, EVIL, expectText, fieldOf, write } from '../../testing/page';
import type { FreeTextRequest, FreeTextView } from '../../wire';
import { below } from './free-text.svelte';
import FromText from './FromText.svelte';

const MADE = '# She naps.\nShe naps after lunch for 40 minutes.\n';

const line = (source: string, text: string, refused: string | null = null): FreeTextView['lines'][number] => ({
  source, is_in_text: true, assumed: [], cannot_be_said: [],
  statements: [{ text, refused, difference: null, sentences: refused === null ? [{ line: 1, said: text, kind: 'habit', what: 'naps', days: 'p 0.5', when: 'after: lunch', start_s: null, lasts_s: [2160, 2400, 2640], in_words: `Canonically, ${text}` }] : [] }],
});

const VIEW: FreeTextView = { number: 1, file: '0.routine', state: 'done', round: 1, model: null, warning: null, rounds: [], prompt: null, lines: [], left_out: [], run_stops: null, problem: null };

const LINES = { ...VIEW, lines: [line('She naps.', 'she naps after lunch.'), line('She frobs.', 'she frobs.', 'unknown verb')], left_out: ['She sings.'], rounds: [{ problems: ['"she frobs." is refused'], differences: [] }] };

let view: Record<string, unknown> | null = null;
let drafts: Drafts;
let asked: { method: string; path: string; body: unknown }[];
/** The answers about the text, the last one again. */
let answers: (FreeTextView | null)[];

async function settle(ms = 50): Promise<void> {
  for (let turn = 0; turn < 6; turn++) await vi.advanceTimersByTimeAsync(ms);
  flushSync();
}

async function begin(first: FreeTextView | null, ...later: FreeTextView[]): Promise<void> {
  asked = [];
  answers = [first, ...later];
  const lives = fakeLives();
  const fetch: Fetch = async (path, init) => {
    if (!path.startsWith('/api/free-text')) return lives(path, init);
    asked.push({ method: init.method!, path, body: typeof init.body === 'string' ? JSON.parse(init.body) : null });
    if (path.endsWith('/routine')) return Response.json({ text: MADE, lost: ['"She knits.": it needs "She naps."'] });
    return Response.json(answers.length > 1 ? answers.shift() : answers[0]);
  };
  drafts = new Drafts(new Server('token', () => {}, fetch), () => {});
  const stop = drafts.open();
  await settle();
  stop();
  view = mount(FromText, { target: document.body, props: { drafts, file: '0.routine' } });
  await settle();
}

const area = (id: string) => document.querySelector<HTMLTextAreaElement>(`#${id}`)!;
const boxes = () => [...document.querySelectorAll<HTMLInputElement>('li input[type="checkbox"]')];

beforeEach(() => {
  vi.useFakeTimers();
});

afterEach(async () => {
  if (view) await unmount(view);
  view = null;
  vi.useRealTimers();
});

test('a model is asked, its rounds are shown, and nothing is written before rows are put', async () => {
  await begin(null, { ...VIEW, state: 'beginning' }, { ...VIEW, state: 'asking', model: 'small at http://a/v1', warning: 'The key is sent without encryption.' }, { ...VIEW, state: 'checking', round: 2, model: 'small at http://a/v1' }, LINES);
  expect(button('Make sentences').disabled).toBe(true);
  write(area('free-text') as unknown as HTMLInputElement, 'She naps. She frobs. She sings.');
  expect(fieldOf('Key').disabled).toBe(true);
  expect(document.body.textContent).toContain('The text goes nowhere else.');
  write(fieldOf('Address'), ' http://a/v1 ');
  write(fieldOf('Key'), 'secret');
  button('Make sentences').click();
  await vi.advanceTimersByTimeAsync(0);
  flushSync();
  expect(document.body.textContent).toContain('Reading the scenario');
  const sent = asked.at(-1)!.body as FreeTextRequest;
  expect(sent.by).toEqual({ kind: 'model', url: 'http://a/v1', name: null, key: 'secret' });
  await vi.advanceTimersByTimeAsync(450);
  flushSync();
  expect(document.body.textContent).toContain('Round 1 of at most 4: the model writes');
  expect(document.body.textContent).toContain('without encryption');
  await vi.advanceTimersByTimeAsync(450);
  flushSync();
  expect(document.body.textContent).toContain('Round 2 of at most 4: checking');
  await settle(100);
  expect(document.body.textContent).toContain('Round 1: 1 problem.');
  const rows = document.querySelector('[aria-label="Text and sentences"]')!;
  expect(rows.textContent).toContain('Canonically, she naps after lunch.');
  expect(rows.textContent).toContain('50 % · after: lunch · 40 min');
  expect(rows.textContent).toContain('Refused: unknown verb');
  expect(rows.textContent).toContain('She sings.');
  expect(boxes().map(({ checked, disabled }) => [checked, disabled])).toEqual([[false, false], [false, true]]);
  expect([button('Put below').disabled, button('Replace').disabled, drafts.unsaved]).toEqual([true, true, []]);

  boxes()[0]!.click();
  flushSync();
  button('Put below').click();
  await settle();
  expect(asked.at(-1)!.body).toEqual({ number: 1, accepted: [true, false] });
  expect(drafts.text('0.routine')).toBe(`${ROUTINE.trimEnd()}\n\n${MADE}`);
  expect(document.body.textContent).toContain('which is not saved');
  expect(document.body.textContent).toContain('it needs "She naps."');
  button('Undo').click();
  flushSync();
  expect(drafts.unsaved).toEqual([]);
  button('Replace').click();
  await settle();
  expect(drafts.text('0.routine')).toBe(MADE);
});

test('an assistant is asked by hand, round by round', async () => {
  await begin(null, { ...VIEW, prompt: 'the prompt' }, { ...LINES, number: 2, prompt: 'the next prompt' });
  write(area('free-text') as unknown as HTMLInputElement, 'She naps.');
  fieldOf('Any assistant, by copy and paste').click();
  flushSync();
  button('Make the prompt').click();
  await settle();
  expect((asked.at(-1)!.body as FreeTextRequest).by).toEqual({ kind: 'assistant', answers: [] });
  expect(area('free-text-prompt').value).toBe('the prompt');
  write(area('free-text-answer') as unknown as HTMLInputElement, '{"lines": []}');
  button('Read the answer').click();
  await settle();
  expect((asked.at(-1)!.body as FreeTextRequest).by).toEqual({ kind: 'assistant', answers: ['{"lines": []}'] });
  expect([area('free-text-prompt').value, area('free-text-answer').value]).toEqual(['the next prompt', '']);
  expect(boxes()).toHaveLength(2);
  // An answer is about the text of its prompt, and a model has no prompt to paste.
  write(area('free-text') as unknown as HTMLInputElement, 'Another text.');
  write(area('free-text-answer') as unknown as HTMLInputElement, '[]');
  button('Read the answer').click();
  await settle();
  expect(asked.at(-1)!.body).toMatchObject({ text: 'She naps.', by: { answers: ['{"lines": []}', '[]'] } });
  fieldOf('A language model').click();
  flushSync();
  expect(area('free-text-prompt')).toBeNull();
});

test('a page that was loaded anew takes no answer to a prompt that it has not shown', async () => {
  await begin({ ...LINES, prompt: 'the next prompt' });
  fieldOf('Any assistant, by copy and paste').click();
  flushSync();
  expect([area('free-text-prompt'), boxes().length]).toEqual([null, 2]);
});

test('a text on its way is cancelled, and one of an earlier page is shown', async () => {
  await begin({ ...VIEW, state: 'asking', model: 'small' }, { ...VIEW, state: 'stopped' });
  expect(document.body.textContent).toContain('Round 1 of at most 4: the model writes');
  button('Cancel').click();
  await settle(100);
  expect(asked.some(({ method }) => method === 'DELETE')).toBe(true);
  expect(document.body.textContent).toContain('Cancelled.');
});

test('failures, long texts and hostile answers are told as text', async () => {
  const hostile = { ...LINES, state: 'failed' as const, problem: `No model. ${EVIL}`, lines: [{ ...line(EVIL, EVIL), assumed: [EVIL], cannot_be_said: [EVIL], is_in_text: false }], left_out: [EVIL] };
  await begin(hostile);
  expect(document.querySelector('[role="alert"]')!.textContent).toContain('No model.');
  expect(document.body.textContent).toContain('The text has no such sentence.');
  expectText(EVIL);
  write(area('free-text') as unknown as HTMLInputElement, 'x'.repeat(20_001));
  expect([area('free-text').getAttribute('aria-invalid'), button('Make sentences').disabled]).toEqual(['true', true]);
});

test('a text of another resident is not shown', async () => {
  await begin({ ...LINES, file: 'another.routine' });
  expect(boxes()).toHaveLength(0);
});

test('a routine comes below the present text, or alone', () => {
  expect(below(' \n', 'b\n')).toBe('b\n');
  expect(below('a\n\n\n', 'b\n')).toBe('a\n\nb\n');
});
