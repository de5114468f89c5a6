import { expect, test } from 'vitest';
import { note, notedOf } from './noted';

function keeper(): () => Storage {
  const kept = new Map<string, string>();
  const storage = {
    getItem: (name: string) => kept.get(name) ?? null,
    setItem: (name: string, value: string) => void kept.set(name, value),
    removeItem: (name: string) => void kept.delete(name),
  };
  return () => storage as unknown as Storage;
}

const ALERT = { day: '2009-04-20', rule: 'sleep' };

test('what is noted about an alert is kept by run, and gone when it is taken back', () => {
  const kept = keeper();
  note(kept, 'a', ALERT, { seen: true, note: 'she had a cold' });
  expect(notedOf(kept, 'a')).toEqual({ '2009-04-20 sleep': { seen: true, note: 'she had a cold' } });
  expect(notedOf(kept, 'b')).toEqual({});
  note(kept, 'a', ALERT, { seen: false, note: '' });
  expect(notedOf(kept, 'a')).toEqual({});
});

test('what is no note of ours is none', () => {
  const kept = keeper();
  kept().setItem('homebody-care', '[broken');
  expect(notedOf(kept, 'a')).toEqual({});
  kept().setItem('homebody-care', 'null');
  expect(notedOf(kept, '__proto__')).toEqual({});
});
