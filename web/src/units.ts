// Lengths and shares for display. Files and messages are in metres; the display may be in feet.

export type Units = 'metric' | 'feet';

const FOOT_M = 0.3048;

const INCHES_A_FOOT = 12;

/** Sums of shares are off by less than this through rounding. */
const NOTHING = 1e-9;

/** Such as `1.25 m` or `4 ft 1 in`. */
export function length(metres: number, units: Units): string {
  if (units === 'metric') return `${metres.toFixed(2)} m`;
  const inches = Math.round((metres / FOOT_M) * INCHES_A_FOOT);
  const [feet, rest] = [Math.floor(inches / INCHES_A_FOOT), inches % INCHES_A_FOOT];
  if (feet === 0) return `${rest} in`;
  return rest === 0 ? `${feet} ft` : `${feet} ft ${rest} in`;
}

/** A round length for a scale bar of at most `widest` pixels, and its width in pixels. */
export function scaleBar(pixelsPerMetre: number, widest: number, units: Units): { label: string; pixels: number } {
  const unit = units === 'metric' ? 1 : FOOT_M;
  const most = widest / (pixelsPerMetre * unit);
  const tens = 10 ** Math.floor(Math.log10(most));
  const round = [5, 2, 1].map((step) => step * tens).find((step) => step <= most) ?? tens;
  return { label: `${Number(round.toPrecision(1))} ${units === 'metric' ? 'm' : 'ft'}`, pixels: round * unit * pixelsPerMetre };
}

/** A length as a number of the chosen unit, for fields. */
export function inUnits(metres: number, units: Units): number {
  return units === 'metric' ? metres : Number((metres / FOOT_M).toFixed(2));
}

export function inMetres(value: number, units: Units): number {
  return units === 'metric' ? value : value * FOOT_M;
}

/** A share in percent, to the nearest tenth; only 1 is 100 %, and only 0 is 0 %. */
export function percent(share: number): string {
  const tenths = Math.round(share * 1000);
  if (tenths === 0 && share > NOTHING) return '<0.1 %';
  return `${((tenths === 1000 && share < 1 - NOTHING ? 999 : tenths) / 10).toFixed(1)} %`;
}

/** Such as `12.5 m²` or `134.5 ft²`; small areas have one digit more. */
export function area(square_m: number, units: Units): string {
  const value = units === 'metric' ? square_m : square_m / FOOT_M ** 2;
  return `${value.toFixed(value < 1 ? 2 : 1)} ${units === 'metric' ? 'm²' : 'ft²'}`;
}
