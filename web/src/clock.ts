// Times on the home's clock, such as `2009-03-02 07:12:03`. The page knows no time zone: it reads a clock as UTC, and
// writes it the same way.

/** Milliseconds of a clock; NaN for other texts. */
export function read(clock: string): number {
  return Date.parse(`${clock.slice(0, 19).replace(' ', 'T')}Z`);
}

const spoken = new Intl.DateTimeFormat('en-GB', {
  timeZone: 'UTC', day: 'numeric', month: 'long', hour: '2-digit', minute: '2-digit', second: '2-digit', hourCycle: 'h23',
});

const dated = new Intl.DateTimeFormat('en-GB', { timeZone: 'UTC', weekday: 'short', day: 'numeric', month: 'long', year: 'numeric' });

/** `2 March, 07:12:03`. */
export function words(ms: number): string {
  if (!Number.isFinite(ms)) return '';
  const part = Object.fromEntries(spoken.formatToParts(ms).map(({ type, value }) => [type, value]));
  return `${part.day} ${part.month}, ${part.hour}:${part.minute}:${part.second}`;
}

/** `Mon, 2 March 2009`. */
export function date(ms: number): string {
  return Number.isFinite(ms) ? dated.format(ms) : '';
}

const short = new Intl.DateTimeFormat('en-GB', { timeZone: 'UTC', day: 'numeric', month: 'short' });

/** `2 Mar`. */
export function dayMonth(ms: number): string {
  return Number.isFinite(ms) ? short.format(ms) : '';
}

/** `2009`. */
export function year(ms: number): string {
  return Number.isFinite(ms) ? String(new Date(ms).getUTCFullYear()) : '';
}

/** `07:12:03`. */
export function time(ms: number): string {
  return Number.isFinite(ms) ? new Date(ms).toISOString().slice(11, 19) : '';
}

/** `07`, for an hour or a minute. */
export function twoDigits(number: number): string {
  return String(number).padStart(2, '0');
}

/** In the form of a field for date and time: `2009-03-02T07:12:03`. */
export function field(ms: number): string {
  return Number.isFinite(ms) ? new Date(ms).toISOString().slice(0, 19) : '';
}
