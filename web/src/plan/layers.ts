// The layers of a plan.

export type Layers = {
  beams: boolean;
  areas: boolean;
  sensorNames: boolean;
  furnitureNames: boolean;
  trails: boolean;
  cameras: boolean;
};

export const LAYERS: { id: keyof Layers; title: string }[] = [
  { id: 'beams', title: 'Sensor beams' },
  { id: 'areas', title: 'Sensor areas' },
  { id: 'cameras', title: 'Floor seen by cameras' },
  { id: 'sensorNames', title: 'Sensor names' },
  { id: 'furnitureNames', title: 'Furniture names' },
  { id: 'trails', title: 'Trails' },
];

/** Many names of sensors would cover the plan. */
export function usual(sensors: number): Layers {
  return { beams: true, areas: true, sensorNames: sensors <= 24, furnitureNames: true, trails: true, cameras: true };
}
