import { defineConfig } from '@playwright/test';
import { browserUse, port } from './e2e/browser';

export default defineConfig({
  testDir: 'e2e',
  testMatch: '*.spec.ts',
  outputDir: 'test-results',
  // One for each core of CI, though the mesher and the software renderer take a core each: measured on two cores,
  // 7.3 minutes instead of 10.2.
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
