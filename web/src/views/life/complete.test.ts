import { describe, expect, test } from 'vitest';
import { WORDS } from '../../testing/life';
import { replacements, offers } from './completions';

const texts = (before: string, asked = false, names: string[] = ['Agnes']) => offers(before, WORDS, names, asked).map(({ word }) => word.text);

describe('what is offered goes by what stands before', () => {
  test('after who it is about, what can be done', () => {
    expect(texts('She ').slice(0, 3)).toEqual(['watches television', 'goes to bed', 'goes to the bathroom']);
    expect(texts('Agnes ')).toContain('goes to bed');
    expect(texts('Every day she ')).toContain('watches television');
    expect(texts('Bertha ')).toEqual([]);
  });

  test('several words are completed from where they began', () => {
    const [offer] = offers('  she watches tel', WORDS, [], false);
    expect(offer).toEqual({ word: WORDS[2], from: 6 });
    expect(texts('She goes to ')).toEqual(['goes to bed', 'goes to the bathroom', 'living room', 'armchair']);
    expect(texts('She goes to the b')[0]).toBe('goes to the bathroom');
  });

  test('what is whole is not offered again, and any word of it leads to it', () => {
    expect(texts('She watches television')).not.toContain('watches television');
    expect(texts('She tele')).toEqual(['watches television']);
  });

  test('a name with signs of its own is only a name', () => {
    expect(texts('A(*+ ', false, ['A(*+'])).toContain('goes to bed');
  });

  test('places after where, conditions after shows, times anywhere else', () => {
    expect(texts('She reads in the ')).toEqual(['in the morning', 'in the evening', 'living room', 'armchair']);
    expect(texts('She reads in the liv')).toEqual(['living room']);
    expect(texts('She reads in the mo')).toEqual(['in the morning']);
    expect(texts('From week 6 she shows ')).toEqual(WORDS.filter(({ kind }) => kind === 'condition').map(({ text }) => text));
    expect(texts('From week 6 she shows moderate gr')).toEqual(['moderate grief']);
    expect(texts('She reads fo')).toEqual(['for about 1 hour']);
    expect(texts('She reads ')).toEqual([]);
    expect(texts('She reads ', true)).toEqual(['in the morning', 'in the evening', 'for about 1 hour', 'often']);
  });

  test('sentences at the beginning, and after a full stop', () => {
    expect(texts('', true)).toContain('She gets up at about 06:45.');
    expect(texts('')).toEqual([]);
    expect(texts('She reads. She g')).toEqual(['goes to bed', 'goes to the bathroom', 'She gets up at about 06:45.']);
    expect(offers('She reads. She gets', WORDS, [], false)[0]).toEqual({ word: WORDS[0], from: 11 });
  });

  test('nothing in a comment', () => expect(texts('# She ', true)).toEqual([]));
});

test('instead of what was not understood stands what is most alike and fits', () => {
  expect(replacements('wtches television', '  she ', WORDS, [])[0]!.text).toBe('watches television');
  expect(replacements('livng rom', 'She reads in the ', WORDS, [])[0]!.text).toBe('living room');
  expect(replacements('depresion', 'She shows ', WORDS, [])[0]!.kind).toBe('condition');
  expect(replacements('x', '# she ', WORDS, [])).toEqual([]);
});
