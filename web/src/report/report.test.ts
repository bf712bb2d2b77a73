import { describe, expect, it } from 'vitest';
import type { Recipe, Report } from '../engine/contract';
import createVoxtet from '../engine/testing/mock_engine.mjs';
import { seriesOf } from './charts';
import { changedFields, differencesOf } from './differences';
import { escaped, histogramSvg, reportPage } from './report_page';

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
  const page = reportPage(found, {
    title: 'Heart <1> & "co"',
    link: 'https://example.org/#c1=abc',
    pictures: [{ title: 'The view', source: 'data:image/png;base64,AAAA' }],
    nameOf: (label) => `label ${label}`,
  });

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
