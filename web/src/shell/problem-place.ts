// The subject of a problem, in words: the thing in its file, not the file and its line.

import { type Node, findNodeAtLocation, findNodeAtOffset, getNodePath } from 'jsonc-parser';
import { isFault, tree } from '../json';
import { offsetOf } from '../places';
import type { FilesView, ProblemView } from '../wire';

/** The noun for an element of a list. */
const ONE: Record<string, string> = {
  sensors: 'sensor', rooms: 'room', doors: 'door', furniture: 'furniture', places: 'place', walls: 'wall', faults: 'fault', residents: 'resident', windows: 'window', steps: 'step', rules: 'rule',
};

const LONGEST = 60;
/** A name in quotes, cut if it is long. */
export const quoted = (name: string) => `“${name.length > LONGEST ? `${name.slice(0, LONGEST)}…` : name}”`;

/** The name of a file for people. */
function fileInWords(file: string, files: FilesView): string {
  if (file === files.home) return 'Home';
  if (file === files.logger) return 'Logger';
  if (file === files.entry) return 'Scenario';
  const life = files.lives.find(({ routine }) => routine === file);
  return life === undefined ? file : `${life.name.slice(0, LONGEST)}’s routine`;
}

/** The thing of a JSON file at a position in its text. */
function thingAt(text: string, line: number, column: number): string | null {
  const root = tree(text);
  const node = isFault(root) ? undefined : findNodeAtOffset(root, offsetOf(text, line, column), true);
  if (isFault(root) || node === undefined) return null;
  const path = getNodePath(node);
  const [list, which] = path;
  if (typeof list !== 'string') return null;
  if (typeof which === 'number') {
    const thing: Node | undefined = findNodeAtLocation(root, [list, which]);
    const name: unknown = (thing && (findNodeAtLocation(thing, ['name']) ?? findNodeAtLocation(thing, ['sensor'])))?.value;
    return `${ONE[list] ?? list} ${typeof name === 'string' ? quoted(name) : which + 1}`;
  }
  if ((list === 'ids' || list === 'sensors') && typeof which === 'string') return `${list === 'ids' ? 'id of' : 'sensor'} ${quoted(which)}`;
  return list.replaceAll('_', ' ');
}

/** A place in words: `Sensor “hall motion”`, `Logger, id of “old chair”`, `margaret’s routine, line 4`. */
export function placeOf({ file, line, column }: ProblemView, files: FilesView | null, text: string | undefined): string {
  if (files === null) return line > 0 ? `${file} ${line}` : file;
  const whose = fileInWords(file, files);
  if (line <= 0) return whose;
  const thing = text !== undefined && file.endsWith('.json') ? thingAt(text, line, column) : null;
  if (thing === null) return `${whose}, line ${line}`;
  return file === files.home ? thing[0]!.toUpperCase() + thing.slice(1) : `${whose}, ${thing}`;
}
