import { defineConfig } from 'vitest/config';

// A timeout is for tests that hang, not for machines that are busy.
export default defineConfig({
  test: { include: ['src/**/*.test.ts'], environment: 'node', testTimeout: 60_000 },
});
