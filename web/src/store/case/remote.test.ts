import { afterEach, describe, expect, it, vi } from 'vitest';
import { addressFault, fetchRemote, remoteInAddress } from './remote';

const page = 'https://voxtet.example/app/';

describe('an address', () => {
  it('is public and by https, or of the page itself', () => {
    for (const good of [
      'https://zenodo.org/records/1/files/heart.nii.gz',
      'https://voxtet.example/heart.nii',
      './heart.nii',
    ])
      expect(addressFault(good, page)).toBe('');
  });

  it('is refused with its fault', () => {
    const faults: [string, RegExp][] = [
      ['http://zenodo.org/heart.nii', /begins with http:/],
      ['ftp://zenodo.org/heart.nii', /begins with ftp:/],
      ['javascript:alert(1)', /begins with javascript:/],
      ['data:text/plain,x', /begins with data:/],
      ['https://me:secret@zenodo.org/heart.nii', /user name or a password/],
      ['https://localhost/heart.nii', /public host/],
      ['https://a.localhost/heart.nii', /public host/],
      ['https://127.0.0.1/heart.nii', /public host/],
      ['https://2130706433/heart.nii', /public host/],
      ['https://0x7f.1/heart.nii', /public host/],
      ['https://192.168.0.1/heart.nii', /public host/],
      ['https://10.1.2.3:8443/heart.nii', /public host/],
      ['https://[::1]/heart.nii', /public host/],
      ['https://nas.local/heart.nii', /public host/],
    ];
    for (const [bad, fault] of faults) expect(addressFault(bad, page), bad).toMatch(fault);
  });

  it('stands in the parameters of the page', () => {
    expect(remoteInAddress('?case=https%3A%2F%2Fa.org%2Fx.case.json')).toEqual({
      kind: 'case',
      url: 'https://a.org/x.case.json',
    });
    expect(remoteInAddress('?volume=https://a.org/x.nii.gz&developer')?.kind).toBe('volume');
    expect(remoteInAddress('?study=hearts/table.jsonl')).toEqual({
      kind: 'study',
      url: 'hearts/table.jsonl',
    });
    expect(remoteInAddress('?developer')).toBeNull();
  });
});

describe('a fetch', () => {
  afterEach(() => vi.unstubAllGlobals());
  const asked = { kind: 'volume' as const, url: 'https://data.example/a/heart%20one.nii' };
  const go = (answer: () => Promise<Response> | Response) => {
    const called = vi.fn(async () => answer());
    vi.stubGlobal('fetch', called);
    return { called, done: fetchRemote(asked, page, () => undefined, new AbortController().signal) };
  };

  it('gives the file by the name in its address, without credentials', async () => {
    const { called, done } = go(() => new Response('abc'));
    const file = await done;
    expect([file.name, await file.text()]).toEqual(['heart one.nii', 'abc']);
    expect(called.mock.calls[0]?.at(1)).toMatchObject({ credentials: 'omit', referrerPolicy: 'no-referrer' });
  });

  it('says what went wrong, and what the host can do', async () => {
    await expect(go(() => Promise.reject(new TypeError('Failed to fetch'))).done).rejects.toThrow(
      /Access-Control-Allow-Origin/,
    );
    await expect(go(() => new Response('', { status: 404 })).done).rejects.toThrow(
      /404: there is no such file/,
    );
    await expect(go(() => new Response('', { status: 503 })).done).rejects.toThrow(/answers 503\./);
    await expect(
      go(() => new Response('', { headers: { 'Content-Length': '5000000000' } })).done,
    ).rejects.toThrow(/5,000 MB, more than 1,000 MB/);
  });

  it('asks nobody for an address that is refused', async () => {
    const called = vi.fn();
    vi.stubGlobal('fetch', called);
    const bad = { kind: 'volume' as const, url: 'https://10.0.0.1/x.nii' };
    await expect(fetchRemote(bad, page, () => undefined, new AbortController().signal)).rejects.toThrow(
      /public/,
    );
    expect(called).not.toHaveBeenCalled();
  });
});
