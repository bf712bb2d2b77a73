import { defineConfig } from '@playwright/test';
import base from '../playwright.config';

export default defineConfig({
  ...base,
  testDir: '.',
  outputDir: '../test-results',
  testMatch: 'measure.ts',
  timeout: 3_600_000,
  webServer: { ...base.webServer, cwd: '..' } as never,
});
