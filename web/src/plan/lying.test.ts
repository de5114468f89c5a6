import { expect, test } from 'vitest';
import { madeUpHome } from '../testing/home';
import type { BodyView, HomeView } from '../wire';
import { type At, distance, inside, middle } from './geometry';
import { laid, lainIn } from './lying';
import { drawPeople } from './moving';
import { light } from './palette';
import type { Pen } from './pen';
import { frameOf, strokesOf } from './symbols';
import { toPlan } from './transform';

const view = { scale: 50, x: 0, y: 0 };

/** The wall at the head of a bed, the axis of its length, and its turn. */
const WALLS: Record<string, { wall: At[]; long: 'x' | 'y'; turn_deg: number }> = {
  north: { wall: [[-3, 1], [3, 1], [3, 1.2], [-3, 1.2]], long: 'y', turn_deg: 0 },
  south: { wall: [[-3, -1.2], [3, -1.2], [3, -1], [-3, -1]], long: 'y', turn_deg: 0 },
  east: { wall: [[1, -3], [1.2, -3], [1.2, 3], [1, 3]], long: 'x', turn_deg: 0 },
  west: { wall: [[-1.2, -3], [-1, -3], [-1, 3], [-1.2, 3]], long: 'x', turn_deg: 0 },
  none: { wall: [[8, 8], [9, 8], [9, 9], [8, 9]], long: 'y', turn_deg: 30 },
};

function turned(points: At[], deg: number): At[] {
  const [cos, sin] = [Math.cos((deg * Math.PI) / 180), Math.sin((deg * Math.PI) / 180)];
  return points.map(([x, y]) => [x * cos - y * sin, x * sin + y * cos]);
}

function homeWith(name: string, wall: At[], outline: At[]): HomeView {
  return { ...madeUpHome(0), solids: [{ kind: 'wall', name: null, outline: wall, enterable: false }, { kind: 'furniture', name, outline, enterable: true }] };
}

const lying = (at: At, heading_deg: number): BodyView => ({ at, heading_deg, posture: 'lying', room: 0, activity: null });

/** The drawn head and feet of a body, in metres. */
function drawn(body: BodyView): { head: At; feet: At } {
  let [centre, turn] = [[0, 0] as At, 0];
  let [head, feet] = [0, 0];
  const pen = new Proxy({}, {
    get: (_, name: string) => (...args: number[]) => {
      if (name === 'translate') centre = [args[0]!, args[1]!];
      if (name === 'rotate') turn = args[0]!;
      if (name === 'roundRect' && feet === 0) feet = args[0]!;
      if (name === 'arc') head = args[0]!;
      return name === 'measureText' ? { width: 10 } : undefined;
    },
    set: () => true,
  }) as unknown as Pen;
  drawPeople(pen, view, light, [{ resident: { name: 'Agnes', radius_m: 0.22 }, body, index: 0, driven: false, sure: 1 }], { width: 500, height: 500 });
  const place = (along: number) => toPlan(view, [centre[0] + Math.cos(turn) * along, centre[1] + Math.sin(turn) * along]);
  return { head: place(head), feet: place(feet) };
}

for (const [where, { wall, long, turn_deg }] of Object.entries(WALLS)) {
  test(`who lies in a bed has the head on the pillow that is drawn: ${where}`, () => {
    for (const [name, wide] of [['bed', 0.9], ["ruth's double bed", 1.8]] as const) {
      const [x, y] = long === 'x' ? [1, wide / 2] : [wide / 2, 1];
      const outline = turned([[-x, -y], [x, -y], [x, y], [-x, y]], turn_deg);
      const home = homeWith(name, wall, outline);
      const pillows = strokesOf(name, frameOf(name, outline, [wall])!).filter(({ closed }) => closed).map(({ points }) => points);
      expect(pillows).toHaveLength(name === 'bed' ? 1 : 2);
      // In the middle of their half, or of the bed.
      const [spot] = turned([name === 'bed' ? [0, 0] : long === 'x' ? [0, wide / 4] : [wide / 4, 0]], turn_deg);
      for (const heading_deg of [-90, 0, 33, 90, 180, 270]) {
        const { head, feet } = drawn(laid(lying(spot!, heading_deg), lainIn(home)));
        expect(pillows.some((pillow) => inside(pillow, head))).toBe(true);
        expect(inside(outline, feet)).toBe(true);
        const far = (at: At) => Math.min(...pillows.map((pillow) => distance(middle(pillow), at)));
        expect(far(head)).toBeLessThan(far(feet) - 1);
        // Negative control: with their heading on arrival, most do not.
        if (heading_deg === 180) expect(pillows.some((pillow) => inside(pillow, drawn(lying(spot!, heading_deg)).head))).toBe(where === 'west');
      }
    }
  });
}

test('who lies on a sofa lies along it, with the head at the end that is nearer to how they are known to be', () => {
  const outline: At[] = [[-0.4, -1], [0.4, -1], [0.4, 1], [-0.4, 1]];
  const pieces = lainIn(homeWith('sofa', [[-0.6, -3], [-0.4, -3], [-0.4, 3], [-0.6, 3]], outline));
  for (const [known, heading_deg] of [[80, 90], [100, 90], [10, 90], [-10, -90], [-100, -90]] as const) {
    expect(laid(lying([0, 0.2], known), pieces).heading_deg).toBeCloseTo(heading_deg);
  }
});

test('on the floor and on a rug, and of who does not lie, the known direction stays', () => {
  const outline: At[] = [[-1, -1], [1, -1], [1, 1], [-1, 1]];
  const wall = WALLS.north!.wall;
  for (const [name, body] of [['bed', lying([1.3, 0], 20)], ['rug', lying([0, 0], 20)], ['bed', { ...lying([0, 0], 20), posture: 'sitting' as const }]] as const) {
    expect(laid(body, lainIn(homeWith(name, wall, outline)))).toBe(body);
  }
});
