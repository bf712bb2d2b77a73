/** The JSON Schema that is published with the app: what editors and validators make of cases. */
import Ajv from 'ajv/dist/2020';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';

const root = fileURLToPath(new URL('../../', import.meta.url));
const read = (path: string) => JSON.parse(readFileSync(join(root, path), 'utf8'));
const valid = new Ajv({ strict: true, strictRequired: false, allowUnionTypes: true }).compile(
  read('web/public/recipe.schema.json'),
);
const faults = (value: unknown) => {
  valid(value);
  return (valid.errors ?? []).map(({ instancePath, keyword }) => `${instancePath} ${keyword}`);
};

describe('the published JSON Schema', () => {
  const cases = readdirSync(join(root, 'examples')).filter((name) =>
    existsSync(join(root, 'examples', name, 'case.json')),
  );

  it('accepts every example', () => {
    expect(cases.length).toBeGreaterThan(5);
    for (const name of cases) expect([name, faults(read(`examples/${name}/case.json`))]).toEqual([name, []]);
  });

  it.each([
    [{ version: 3 }, '/version maximum'],
    [{ sizing: { edge_mm: 'two' } }, '/sizing/edge_mm type'],
    [{ sizing: { edge: 2 } }, '/sizing additionalProperties'],
    [{ sizing: { regions: [{ shape: 'cone' }] } }, '/sizing/regions/0/shape enum'],
    [{ labels: [0] }, '/labels/0 minimum'],
    [{ source: { phantom: {}, file: {} } }, '/source not'],
    [{ view: { crosshair: [0, 0] } }, '/view/crosshair minItems'],
  ])('refuses %j', (value, fault) => expect(faults(value)).toEqual([fault]));
});
