// What can be shown on a plan or left away.

export type Layers = {
  beams: boolean;
  areas: boolean;
  sensorNames: boolean;
  furnitureNames: boolean;
  trails: boolean;
  cameras: boolean;
};

export const LAYERS: { id: keyof Layers; title: string }[] = [
  { id: 'beams', title: 'Beams of sensors' },
  { id: 'areas', title: 'Areas of sensors' },
  { id: 'cameras', title: 'What cameras see of the floor' },
  { id: 'sensorNames', title: 'Names of sensors' },
  { id: 'furnitureNames', title: 'Names of furniture' },
  { id: 'trails', title: 'Trails' },
];

/** Names of sensors would cover a plan that has many. */
export function usual(sensors: number): Layers {
  return { beams: true, areas: true, sensorNames: sensors <= 24, furnitureNames: true, trails: true, cameras: true };
}
