// The parts of JSON Schema that the program's schemas have.

export type Schema = {
  $ref?: string;
  type?: string | string[];
  properties?: Record<string, Schema>;
  required?: string[];
  /** Of a list; of a list of a fixed length, one for each item. */
  items?: Schema;
  oneOf?: Schema[];
  allOf?: Schema[];
  anyOf?: Schema[];
  enum?: string[];
  const?: string;
  default?: unknown;
  description?: string;
  format?: string;
  minimum?: number;
  maximum?: number;
  exclusiveMinimum?: number;
  minItems?: number;
  maxItems?: number;
  maxLength?: number;
};

export type RootSchema = Schema & { definitions: Record<string, Schema> };

/** The name of the definition that a schema refers to, also if it may be null. */
export function definitionOf({ $ref, allOf, anyOf }: Schema): string | undefined {
  const ref = $ref ?? allOf?.[0]?.$ref ?? anyOf?.find(({ $ref }) => $ref !== undefined)?.$ref;
  return ref?.split('/').at(-1);
}

/** A schema with the definition that it refers to; its own words win. */
export function resolved(root: RootSchema, of: Schema): Schema {
  const name = definitionOf(of);
  return name === undefined ? of : { ...root.definitions[name]!, ...of };
}

/** The description of a schema as plain text. */
export function aboutOf({ description }: Schema): string {
  return (description ?? '').replaceAll('\n', ' ').replaceAll('`', '');
}
