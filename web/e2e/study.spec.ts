/** The results of a study: opened, sorted, plotted; a case of it opened, run, and found to be reproduced. */
import AxeBuilder from '@axe-core/playwright';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Page, TestInfo } from '@playwright/test';
import { dropFile, expect, idle, link, meshed, openAndRun, test } from './support';

const ball = { source: { phantom: { kind: 'sphere', radius_mm: 20 } }, sizing: { edge_mm: 8 } };
const fragment = link(ball).slice(2);

/** Thirty cases: the 7th failed, the last is missing, the 12th is an outlier; the 3rd promises what `proven` does. */
function studyFiles(info: TestInfo, proven = fragment): string[] {
  const rows = Array.from({ length: 30 }, (_, i) => {
    const number = i + 1;
    const status = number === 7 ? 'failed' : number === 30 ? 'missing' : 'done';
    const done = status === 'done';
    return {
      case: number,
      key: number.toString(16).padStart(64, '0'),
      name: `ball ${number}`,
      'source.phantom.radius_mm': 18 + number / 10,
      status,
      stage: status === 'failed' ? 'tetra' : null,
      reason: status === 'failed' ? 'The boundary meets itself.' : null,
      tets: done ? 1000 + 10 * number : null,
      smallest_dihedral_deg: done ? (number === 12 ? 3 : 14 + (number % 5) / 10) : null,
      passed: done ? number !== 12 : null,
      link: number === 3 ? proven : number === 30 ? null : fragment,
    };
  });
  const costs = ['case,seconds,peak_mb,forecast_seconds,forecast_mb', '3,2.5,80,2,76'];
  const write = (name: string, lines: string[]) => {
    const path = info.outputPath(name);
    writeFileSync(path, `${lines.join('\n')}\n`);
    return path;
  };
  return [
    write(
      'table.jsonl',
      rows.map((row) => JSON.stringify(row)),
    ),
    write('costs.csv', costs),
  ];
}

const rowNames = (page: Page) => page.locator('.study-table tbody th').allInnerTexts();
const card = (page: Page) => page.getByRole('region', { name: 'Selected case' });

async function serious(page: Page): Promise<string[]> {
  const { violations } = await new AxeBuilder({ page }).analyze();
  return violations
    .filter(({ impact }) => impact === 'serious' || impact === 'critical')
    .map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(' ')).join(', ')}`);
}

test('a case of a study is found, opened and reproduced, and the study is there again', async ({ page }) => {
  await openAndRun(page, ball);
  await page.getByRole('button', { name: 'Share' }).click();
  await expect(page.getByTestId('share-link')).toHaveValue(/#c1=/);
  const proven = new URL(await page.getByTestId('share-link').inputValue()).hash;
  await page.keyboard.press('Escape');

  await dropFile(page, ...studyFiles(test.info(), proven));
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('30 cases: 28 done, 1 failed, 1 missing');
  await page.getByRole('button', { name: 'Smallest dihedral angle' }).click();
  expect((await rowNames(page))[0]).toBe('ball 12');
  await expect(page.getByRole('columnheader', { name: 'Smallest dihedral' })).toHaveAttribute(
    'aria-sort',
    'ascending',
  );
  await page.getByLabel('X axis').selectOption('Source: radius, mm');
  await expect(page.getByRole('img', { name: 'over source: radius of 28 cases, 1 of them' })).toBeVisible();
  const outlier = page.locator('.scatter path.outlier');
  await outlier.click();
  await expect(card(page)).toContainText('Smallest dihedral angle 3°');
  await expect(page.getByRole('row', { selected: true })).toContainText('ball 12');

  await page.getByRole('button', { name: 'Failed 1' }).click();
  await page.getByRole('row', { name: /ball 7/ }).click();
  await expect(card(page)).toContainText('tetra: The boundary meets itself.');
  await page.getByRole('button', { name: 'All 30' }).click();
  await page.getByRole('button', { name: 'Columns' }).click();
  await page.getByRole('checkbox', { name: 'Number' }).check();
  await page.keyboard.press('Escape');
  await page.getByRole('button', { name: 'Number' }).click();
  await page.getByRole('grid').focus();
  await page.keyboard.press('Home');
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('ArrowDown');
  await expect(card(page)).toContainText('ball 3');
  expect(await serious(page)).toEqual([]);
  await page.keyboard.press('Enter');
  await expect(page.getByRole('dialog')).toContainText('Promised');
  await page.getByRole('button', { name: 'Open and run' }).click();
  await expect(page.getByRole('grid')).toBeHidden();
  await meshed(page);
  await expect(page.getByTestId('verdict')).toContainText('Reproduced');
  await page.getByRole('button', { name: 'Study', exact: true }).click();
  await expect(card(page)).toContainText('ball 3');
  await page.getByRole('button', { name: 'Close the study' }).click();
  await expect(page.getByTestId('verdict')).toBeVisible();
});

test('a study opens in a phone and in the dark; one that cannot be read says which line', async ({
  page,
}) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.emulateMedia({ colorScheme: 'dark' });
  await page.goto('./');
  await idle(page);
  const [table, costs] = studyFiles(test.info());
  const broken = join(table, '../broken.jsonl');
  writeFileSync(broken, '{"case": 1}\n');
  await dropFile(page, broken);
  await expect(page.getByRole('alert')).toContainText('broken.jsonl, line 1: found no field "key"');
  await dropFile(page, table, costs);
  await page.getByRole('row', { name: /ball 7/ }).click();
  await expect(card(page)).toContainText('The boundary meets itself.');
  // The table scrolls by itself, the page does not.
  const { scrollWidth, scrollHeight } = await page.evaluate(() => {
    const { scrollWidth, scrollHeight } = document.documentElement;
    return { scrollWidth, scrollHeight };
  });
  expect([scrollWidth, scrollHeight]).toEqual([390, 844]);
  await page.getByRole('button', { name: 'Plots' }).click();
  await page.getByRole('button', { name: 'ball 12', exact: true }).click();
  await expect(card(page)).toContainText('ball 12');
  expect(await serious(page)).toEqual([]);
  await card(page).getByRole('button', { name: 'Open this case' }).click();
  await page.getByRole('dialog').getByRole('button', { name: 'Open', exact: true }).click();
  await expect(page.getByRole('tab', { name: 'View' })).toBeVisible();
  await idle(page);
  await page.getByRole('button', { name: 'Study', exact: true }).click();
  await expect(page.getByRole('img', { name: /^Smallest dihedral angle over tetrahedra/ })).toBeVisible();
});

test('the table of a study is fetched once the user says so', async ({ page }) => {
  const [table] = studyFiles(test.info());
  let asked = 0;
  await page.route('**/hearts/table.jsonl', (route) => {
    asked++;
    return route.fulfill({ path: table });
  });
  await page.goto('./?study=hearts/table.jsonl');
  await idle(page);
  const fetch = page.getByRole('dialog').getByRole('button', { name: /^Fetch it from/ });
  await expect(fetch).toBeVisible();
  expect(asked).toBe(0);
  await fetch.click();
  await expect(page.getByRole('heading', { level: 1 })).toContainText('30 cases');
  expect(asked).toBe(1);
});

test('a study that is dropped before the engine is up stays in front', async ({ page }) => {
  await page.route('**/*.wasm', async (route) => {
    await new Promise((later) => setTimeout(later, 2000));
    await route.continue();
  });
  await page.goto('./');
  await dropFile(page, ...studyFiles(test.info()));
  await expect(page.getByRole('heading', { level: 1 })).toContainText('30 cases');
  await idle(page);
  await expect(page.getByRole('heading', { level: 1 })).toContainText('30 cases');
});
