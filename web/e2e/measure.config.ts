import { defineConfig } from '@playwright/test';
import base from '../playwright.config';
import { browserUse } from './browser';

const { launchOptions } = browserUse;
/**
 * For V8. What it compiles of what is called often grows for hundreds of jobs:
 * JS_FLAGS='--no-opt --no-maglev --no-sparkplug' leaves that out of the measurement of memory.
 */
const flags = process.env.JS_FLAGS;

export default defineConfig({
  ...base,
  testDir: '.',
  outputDir: '../test-results',
  testMatch: 'measure.ts',
  timeout: 3_600_000,
  use: {
    ...base.use,
    launchOptions: {
      ...launchOptions,
      args: flags ? [...launchOptions.args, `--js-flags=${flags}`] : launchOptions.args,
    },
  },
  webServer: { ...base.webServer, cwd: '..' } as never,
});
