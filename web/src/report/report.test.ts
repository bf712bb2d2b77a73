import { describe, expect, it } from 'vitest';
import type { Recipe, Report } from '../engine/contract';
import createVoxtet from '../engine/testing/mock_engine.mjs';
import { seriesOf } from './charts';
import { changedFields, differencesOf } from './differences';
import { escaped, histogramSvg } from './markup';
import { htmlFile, reviewPage } from './review_page';

async function mockReport(edge: number): Promise<Report> {
  const engine = await createVoxtet();
  const session = new engine.Session();
  session.setRecipe(JSON.stringify({ source: { phantom: {} }, sizing: { edge_mm: edge } }));
  session.begin('quality');
  session.advance(Infinity, () => undefined);
  return JSON.parse(session.report()) as Report;
}

const found = await mockReport(2);
const other = { ...(await mockReport(3)), tets: 12 };

describe('the report as a page', () => {
  const title = 'Heart <1> & "co"';
  const context = {
    title,
    link: 'https://example.org/#c1=abc',
    pictures: [{ title: 'The view', source: 'data:image/png;base64,AAAA' }],
    nameOf: (label: number) => `label <${label}>`,
    verdict: null,
    citation: '@software{voxtet}',
  };
  const page = htmlFile(title, reviewPage(found, context));

  it('holds what the report says', () => {
    for (const part of [
      found.digest,
      'min dihedral',
      '12.1 deg',
      'data:image/png;base64,AAAA',
      '"edge_mm": 2',
    ])
      expect(page).toContain(escaped(part));
    expect(page.match(/<svg/g)).toHaveLength(4);
  });

  it('says how sure its distances are', () => {
    const words = page.replace(/<[^>]*>/g, ' ').replace(/\s+/g, ' ');
    expect(words).toContain('Distance, mm Mean RMS 95 % Largest found None above Sample spacing');
    expect(words).toContain('mesh to surface 0.1 0.1 0.2 0.3 0.31 0.5');
  });

  it('lets no text become markup, and needs nothing from elsewhere', () => {
    expect(page).toContain('Heart &lt;1&gt; &amp; &quot;co&quot;');
    expect(page).not.toMatch(/<script|<link|src="http/);
  });

  it('says whether what was promised was found', () => {
    expect(page).toContain('No link has promised this run');
    const rows = [{ name: 'Digest', expected: 'aa', found: 'bb', same: false }];
    const verdict = { mesh: 'differs', simulation: 'awaited', rows } as const;
    const { body } = reviewPage(found, { ...context, verdict: { ...verdict, rows } });
    expect(body).toContain('The mesh: differs from what the link promises.');
    expect(body).toContain('The simulation: promised by the link, not run yet.');
    expect(body).toContain('<td>aa</td><td>bb</td><td>no</td>');
  });

  it('keeps the promises of the pages that show it: no style of a single element, no script', () => {
    expect(reviewPage(found, context).body).not.toMatch(/ style=| on\w+=|javascript:/);
  });

  it('draws each series from the floor of the chart back to it', () => {
    const svg = histogramSvg('Angles', '°', seriesOf(found).angles);
    expect(svg.match(/M0 120L/g)).toHaveLength(1);
    expect(svg).not.toContain('NaN');
  });
});

describe('two runs', () => {
  it('differ in numbers that both have', () => {
    const rows = differencesOf(found, other);
    expect(rows.find((row) => row.name === 'Tetrahedra')).toMatchObject({ pinned: found.tets, now: 12 });
    expect(rows.some((row) => row.name === 'Size ratio')).toBe(false);
  });

  it('differ in the fields that were changed', () => {
    expect(changedFields(found.recipe, other.recipe)).toEqual([
      { path: 'sizing.edge_mm', pinned: '2', now: '3' },
    ]);
    expect(changedFields(found.recipe, found.recipe)).toEqual([]);
    const kinds = (...speeds: number[]) =>
      ({ kinds: speeds.map((speed) => ({ labels: [1], speed })) }) as unknown as Recipe;
    expect(changedFields(kinds(1, 2), kinds(1, 3))).toEqual([
      { path: 'kinds.2.speed', pinned: '2', now: '3' },
    ]);
    expect(changedFields(kinds(1), kinds(1, 3))).toMatchObject([{ path: 'kinds' }]);
  });

  it('have one chart, the pinned run first', () => {
    expect(seriesOf(found, other).edges.map(({ tone }) => tone)).toEqual(['pinned', 'now']);
    expect(seriesOf(found, other)).toBe(seriesOf(found, other));
    expect(seriesOf(found).edges.map(({ tone }) => tone)).toEqual(['before', 'now']);
  });
});
