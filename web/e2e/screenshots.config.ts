import { defineConfig } from '@playwright/test';
import base from '../playwright.config';

export default defineConfig({
  ...base,
  testDir: '.',
  outputDir: '../test-results',
  testMatch: ['screenshots.ts', 'docs_pictures.ts'],
  webServer: { ...base.webServer, cwd: '..' } as never,
});
