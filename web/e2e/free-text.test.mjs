// A text becomes a routine: by a played model and by hand, with nothing written before it is saved.

import assert from 'node:assert/strict';
import { mkdirSync, readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { looked, serve } from './served.mjs';

const TEXT = 'Walter gets up at seven. After lunch he has a nap. He misses his wife.';
const WRONG = 'He gets up sevenish.';
const RIGHT = 'He gets up at 07:00.';
const NAP = 'He naps after lunch for 40 minutes.';
const folder = process.env.PICTURES;

const line = (source, statements, more = {}) => ({ source, statements, assumed: [], cannot_be_said: [], ...more });

function answer(first) {
  return JSON.stringify({
    lines: [
      line('Walter gets up at seven.', [first]),
      line('After lunch he has a nap.', [NAP], { assumed: ['the length'] }),
      line('He misses his wife.', [], { cannot_be_said: ['a feeling'] }),
    ],
  });
}

/** A server that plays the part of a model. A reply is a content, or null for none at all. */
async function playedModel(replies) {
  const requests = [];
  const server = createServer(async (request, response) => {
    let body = '';
    for await (const part of request) body += part;
    const give = (value) => response.writeHead(200, { 'content-type': 'application/json' }).end(JSON.stringify(value));
    if (request.method === 'GET') return give({ data: [{ id: 'small' }] });
    requests.push({ key: request.headers.authorization, body: JSON.parse(body) });
    const content = replies.length > 1 ? replies.shift() : replies[0];
    if (content !== null) give({ choices: [{ message: { role: 'assistant', content } }] });
    else response.on('close', () => requests.at(-1).isGone = true);
  });
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  return { url: `http://127.0.0.1:${server.address().port}/v1`, requests, close: () => (server.closeAllConnections(), server.close()) };
}

let served;
let written;
const onDisk = () => readFileSync(join(served.folder, 'studio', 'walter.routine'), 'utf8');
before(async () => {
  served = await serve('studio');
  written = onDisk();
  if (folder) mkdirSync(folder, { recursive: true });
  const { page, address } = served;
  await page.goto(`${address.split('#')[0]}#/life`);
  await page.getByText('Every sentence is understood.').waitFor();
  await page.getByRole('button', { name: 'From text' }).click();
  await page.getByRole('textbox', { name: 'Text', exact: true }).fill(TEXT);
});
after(() => served.close());

test('a model is asked, and accepted rows go into the draft', { timeout: 240_000 }, async () => {
  const { page } = served;
  const model = await playedModel([answer(WRONG), answer(RIGHT)]);
  try {
    await page.getByLabel('Address').fill(model.url);
    await page.getByLabel('Key').fill('sk-of-a-test');
    await page.getByRole('button', { name: 'Make sentences' }).click();
    const rows = page.getByRole('region', { name: 'Text and sentences' });
    await rows.getByText('a feeling').waitFor();
    assert.deepEqual(model.requests.map(({ key }) => key), ['Bearer sk-of-a-test', 'Bearer sk-of-a-test']);
    assert.match(model.requests[1].body.messages.at(-1).content, /"He gets up sevenish." is refused/);
    await page.getByText('Round 2: everything is understood').waitFor();
    await rows.getByText('40 min', { exact: false }).first().waitFor();
    assert.equal(await rows.getByRole('checkbox', { name: 'Accept: He misses his wife.' }).isDisabled(), true);
    await rows.getByRole('checkbox', { name: 'Accept: Walter gets up at seven.' }).check();
    assert.equal(onDisk(), written, 'nothing is written before it is saved');
    await looked(page, 'free-text', folder);
    await rows.getByRole('button', { name: 'Replace the routine' }).click();
    await page.getByText('walter.routine is not saved.').waitFor();
    assert.equal(onDisk(), written, 'nothing is written before it is saved');
    await rows.getByRole('button', { name: 'Undo' }).click();
    await page.getByText('walter.routine is not saved.').waitFor({ state: 'hidden' });
    await rows.getByRole('checkbox', { name: 'Accept all rows' }).check();
    await rows.getByRole('button', { name: 'Replace the routine' }).click();
    await page.getByRole('button', { name: 'Save', exact: true }).click();
    await page.getByText('All changes saved.').waitFor();
    const routine = onDisk();
    assert.ok(routine.includes(`# Walter gets up at seven.\n${RIGHT}\n`) && routine.includes(`${NAP}\n`), routine);
    assert.ok(routine.includes('#   cannot be said: a feeling'), routine);
    assert.doesNotMatch(served.homebody('routine', 'explain', 'studio'), /sevenish/);
  } finally {
    model.close();
  }
});

test('a model that writes too long is cancelled, and its connection ends', { timeout: 240_000 }, async () => {
  const { page } = served;
  const model = await playedModel([null]);
  try {
    await page.getByLabel('Address').fill(model.url);
    await page.getByRole('button', { name: 'Make sentences' }).click();
    await page.getByText('Round 1 of at most 4: the model writes').waitFor();
    while (model.requests.length === 0) await page.waitForTimeout(50);
    await page.getByRole('button', { name: 'Cancel' }).click();
    await page.getByText('Cancelled.').waitFor();
    while (!model.requests[0].isGone) await page.waitForTimeout(50);
  } finally {
    model.close();
  }
});

test('an assistant is asked by copy and paste', { timeout: 240_000 }, async () => {
  const { page } = served;
  await page.getByLabel('Any assistant, by copy and paste').check();
  await page.getByRole('button', { name: 'Make the prompt' }).click();
  const prompt = page.getByRole('textbox', { name: 'Prompt: paste it into an assistant' });
  await prompt.waitFor();
  assert.match(await prompt.inputValue(), /1\. Walter gets up at seven\./);
  const give = async (text) => {
    await page.getByRole('textbox', { name: 'Answer of the assistant' }).fill(text);
    await page.getByRole('button', { name: 'Read the answer' }).click();
  };
  await give(`Here you are:\n\`\`\`json\n${answer(WRONG)}\n\`\`\``);
  const next = page.getByRole('textbox', { name: 'Next prompt: paste it into the same chat' });
  await next.waitFor();
  assert.match(await next.inputValue(), /"He gets up sevenish." is refused/);
  await page.getByText(/^Refused: /).waitFor();
  await looked(page, 'free-text-by-hand', folder);
  await give(answer(RIGHT));
  await page.getByText('Round 2: everything is understood').waitFor();
  await next.waitFor({ state: 'hidden' });
});
