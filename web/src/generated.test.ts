import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { committedSchema, generate, generatedFile } from '../generate_contract.mjs';

describe('the generated contract', () => {
  it('is what the generator makes of the schema, which the engine compares with its own', () => {
    expect(readFileSync(generatedFile, 'utf8')).toBe(generate(committedSchema()));
  });
});
