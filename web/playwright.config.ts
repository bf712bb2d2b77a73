import { defineConfig } from '@playwright/test';
import { browserUse, port } from './e2e/browser';

export default defineConfig({
  testDir: 'e2e',
  testMatch: '*.spec.ts',
  outputDir: 'test-results',
  // One for each core of CI, though the mesher and the software renderer take a core each: 17 tests on two idle cores
  // take 1.7 minutes instead of 2.2.
  workers: 2,
  timeout: 180_000,
  expect: { timeout: 90_000 },
  reporter: [['list']],
  use: browserUse,
  webServer: {
    command: `node serve.mjs --port ${port}`,
    url: `http://127.0.0.1:${port}/`,
    reuseExistingServer: false,
  },
});
