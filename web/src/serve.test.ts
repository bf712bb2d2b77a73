import { describe, expect, it } from 'vitest';
import { fileOf } from '../serve.mjs';

describe('the static server', () => {
  it('names files inside its folder', () => {
    expect(fileOf('/srv/app', '/')).toBe('/srv/app/index.html');
    expect(fileOf('/srv/app', '/assets/a.js?x=1')).toBe('/srv/app/assets/a.js');
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
