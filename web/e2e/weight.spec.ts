/** What comes over the wire, from a server that has compressed files. */
import { cp, mkdtemp, rm } from 'node:fs/promises';
import type { IncomingMessage, Server, ServerResponse } from 'node:http';
import type { AddressInfo } from 'node:net';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { expect, test as base } from '@playwright/test';
import { compressFolder } from '../compress.mjs';
import { serve } from '../serve.mjs';

interface Answer {
  status: number;
  path: string;
  kind: string;
  encoding: string;
  bytes: number;
}

/** The built app, compressed, served from a folder of its own, and all that was asked of it. */
const test = base.extend<object, { served: { url: string; answers: Answer[] } }>({
  served: [
    // biome-ignore lint/correctness/noEmptyPattern: Playwright asks for it.
    async ({}, use) => {
      const root = await mkdtemp(join(tmpdir(), 'voxtet-'));
      await cp(resolve('dist'), root, { recursive: true });
      await compressFolder(root);
      const server: Server = await serve({ root, port: 0 });
      const answers: Answer[] = [];
      server.on('request', (request: IncomingMessage, response: ServerResponse) => {
        const { writeHead } = response;
        response.writeHead = ((status: number, headers: Record<string, string | number>) => {
          answers.push({
            status,
            path: request.url ?? '',
            kind: String(headers['Content-Type'] ?? ''),
            encoding: String(headers['Content-Encoding'] ?? ''),
            bytes: Number(headers['Content-Length'] ?? 0),
          });
          return writeHead.call(response, status, headers);
        }) as typeof writeHead;
      });
      await use({ url: `http://127.0.0.1:${(server.address() as AddressInfo).port}/`, answers });
      server.closeAllConnections();
      await rm(root, { recursive: true });
    },
    // Compressing an engine for the first time takes half a minute of one core.
    { scope: 'worker', timeout: 300_000 },
  ],
});

test('the app comes compressed, each file once, and a second visit asks for next to nothing', async ({
  page,
  served,
}) => {
  const { url, answers } = served;
  // The server knows what was asked of it. The browser is no witness: of threads that it starts from its cache it does
  // not always say that their script has come.
  const quiet = async () => {
    let before = -1;
    while (answers.length !== before) {
      before = answers.length;
      await page.waitForTimeout(1500);
    }
  };
  const load = async () => {
    answers.length = 0;
    await page.goto(url);
    await expect(page.locator('.gallery button').first()).toBeEnabled();
    await expect(page.locator('.view-canvas')).toHaveCount(1);
    await quiet();
  };
  await load();
  const paths = answers.map(({ path }) => path);
  expect(paths.filter((path, i) => paths.indexOf(path) !== i)).toEqual([]);
  expect(paths.filter((path) => path.endsWith('.wasm'))).toHaveLength(1);
  const uncompressed = answers.filter(
    ({ kind, encoding, bytes }) => /^text|json|svg|wasm/.test(kind) && bytes >= 1000 && encoding !== 'br',
  );
  expect(uncompressed).toEqual([]);
  const wasm = answers.find(({ path }) => path.endsWith('.wasm'));
  expect(wasm?.kind).toBe('application/wasm');
  const cold = answers.reduce((sum, { bytes }) => sum + bytes, 0);
  test.info().annotations.push({ type: 'Cold load', description: `${cold} bytes on the wire` });
  expect(cold).toBeLessThanOrEqual(2_000_000);

  await load();
  expect(answers.filter(({ path, status }) => path.startsWith('/assets/') || status !== 304)).toEqual([]);
});
