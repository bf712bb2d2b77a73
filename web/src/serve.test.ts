import { mkdtemp, rm, writeFile } from 'node:fs/promises';
import { request, type IncomingHttpHeaders, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { brotliDecompressSync, gunzipSync } from 'node:zlib';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { compressFolder } from '../compress.mjs';
import { encodingsFor, fileOf, serve } from '../serve.mjs';

describe('the static server', () => {
  it('names files inside its folder', () => {
    expect(fileOf('/srv/app', '/')).toBe('/srv/app/index.html');
    expect(fileOf('/srv/app', '/assets/a.js?x=1')).toBe('/srv/app/assets/a.js');
  });

  it('names them below a path, and nothing beside it', () => {
    expect(fileOf('/srv/app', '/some/path/', '/some/path/')).toBe('/srv/app/index.html');
    expect(fileOf('/srv/app', '/some/path/assets/a.js', '/some/path/')).toBe('/srv/app/assets/a.js');
    expect(fileOf('/srv/app', '/some/path/../../../secret', '/some/path/')).toBeNull();
    for (const path of ['/', '/index.html', '/some/pathological'])
      expect(fileOf('/srv/app', path, '/some/path/')).toBeNull();
  });

  it.each([
    '/../secret',
    '/..%2f..%2fsecret',
    '/%2e%2e/secret',
    '/a/../../secret',
    '/%00',
    '/..\\secret',
    '/%',
  ])('never names a file outside of it: %s', (path) => {
    const file = fileOf('/srv/app', path);
    expect(file === null || file.startsWith('/srv/app/')).toBe(true);
  });
});

describe('what a browser takes', () => {
  it.each([
    [undefined, []],
    ['', []],
    ['gzip, deflate, br', ['br', 'gzip']],
    ['gzip;q=1.0, br;q=0', ['gzip']],
    ['br ; q=0.5', ['br']],
    ['brotli, gzipped', []],
  ])('%s', (accepted, encodings) => {
    expect(encodingsFor(accepted)).toEqual(encodings);
  });
});

// fetch() decompresses by itself, and does not say so.
const getFrom = (server: Server, path: string, headers: Record<string, string> = {}, method = 'GET') =>
  new Promise<{ status: number; headers: IncomingHttpHeaders; body: Buffer }>((done, failed) => {
    const { port } = server.address() as AddressInfo;
    request({ port, host: '127.0.0.1', path, method, headers }, (response) => {
      const parts: Buffer[] = [];
      response.on('data', (part) => parts.push(part));
      response.on('end', () =>
        done({ status: response.statusCode ?? 0, headers: response.headers, body: Buffer.concat(parts) }),
      );
    })
      .on('error', failed)
      .end();
  });

describe('the barest of hosts', () => {
  it('says how long a file is, and of what type as far as old hosts know it', async () => {
    const root = await mkdtemp(join(tmpdir(), 'voxtet-'));
    for (const name of ['a.js', 'a.js.br', 'a.wasm']) await writeFile(join(root, name), 'text');
    const server = await serve({ root, port: 0, base: '/some/path/', plain: true });
    const said = async (path: string) => {
      const { status, headers } = await getFrom(server, path, { 'accept-encoding': 'br' });
      const { date, connection, 'keep-alive': alive, ...rest } = headers;
      return [status, rest];
    };
    const length = { 'content-length': '4' };
    expect(await said('/some/path/a.js')).toEqual([
      200,
      { ...length, 'content-type': 'text/javascript; charset=utf-8' },
    ]);
    expect(await said('/some/path/a.wasm')).toEqual([
      200,
      { ...length, 'content-type': 'application/octet-stream' },
    ]);
    expect((await said('/a.js'))[0]).toBe(404);
    server.close();
    await rm(root, { recursive: true });
  });
});

describe('compressed files', () => {
  const text = 'export const answer = 42;\n'.repeat(200);
  let root: string;
  let server: Server;

  beforeAll(async () => {
    root = await mkdtemp(join(tmpdir(), 'voxtet-'));
    await writeFile(join(root, 'long.js'), text);
    await writeFile(join(root, 'short.js'), 'export {};');
    await writeFile(join(root, 'picture.png'), text);
    await compressFolder(root);
    server = await serve({ root, port: 0 });
  });

  afterAll(async () => {
    server.close();
    await rm(root, { recursive: true });
  });

  const get = (...asked: [path: string, headers?: Record<string, string>, method?: string]) =>
    getFrom(server, ...asked);

  it.each([
    ['gzip, deflate, br', 'br', brotliDecompressSync],
    ['gzip', 'gzip', gunzipSync],
    ['identity', undefined, (bytes: Buffer) => bytes],
  ])('are sent to whoever takes %s', async (accepted, encoding, decode) => {
    const { status, headers, body } = await get('/long.js', { 'accept-encoding': accepted });
    expect(status).toBe(200);
    expect(headers['content-encoding']).toBe(encoding);
    expect(headers['content-type']).toBe('text/javascript; charset=utf-8');
    expect(headers.vary).toBe('Accept-Encoding');
    expect(Number(headers['content-length'])).toBe(body.length);
    expect(decode(body).toString()).toBe(text);
  });

  it('are none of what is small, or compressed already', async () => {
    for (const path of ['/short.js', '/picture.png'])
      expect(
        (await get(path, { 'accept-encoding': 'br, gzip' })).headers['content-encoding'],
      ).toBeUndefined();
  });

  it('are sent anew only where they have changed', async () => {
    const accepted = { 'accept-encoding': 'br' };
    const { etag = '' } = (await get('/long.js', accepted)).headers;
    const again = await get('/long.js', { ...accepted, 'if-none-match': etag });
    expect([again.status, again.body.length]).toEqual([304, 0]);
    expect((await get('/long.js', { 'if-none-match': etag })).status).toBe(200);
  });

  it('are described without a body by HEAD', async () => {
    const { headers, body } = await get('/long.js', { 'accept-encoding': 'br' }, 'HEAD');
    expect([headers['content-encoding'], body.length]).toEqual(['br', 0]);
  });
});
