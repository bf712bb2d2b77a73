import { defineConfig } from '@playwright/test';
import { browserUse, port } from './e2e/browser';

export default defineConfig({
  testDir: 'e2e',
  testMatch: '*.spec.ts',
  outputDir: 'test-results',
  // The mesher and the software renderer each take a core.
  workers: 1,
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
