/** Lessons: what happens to wrong answers, damaged links and reloads; a teacher who writes one; paper; axe. */
import AxeBuilder from '@axe-core/playwright';
import { readFile } from 'node:fs/promises';
import type { Page } from '@playwright/test';
import { dropFile, expect, idle, meshed, stage, test } from './support';

const panel = (page: Page) => page.locator('.panel.lesson');
async function next(page: Page): Promise<void> {
  await panel(page).getByRole('button', { name: 'Next', exact: true }).click();
  await expect(page.getByTestId('lesson-step')).toHaveAttribute('aria-busy', 'false');
  await idle(page);
}
const question = (page: Page) => page.getByTestId('question');
const check = (page: Page) => question(page).getByRole('button', { name: 'Check' }).click();

async function seriousFaults(page: Page): Promise<string[]> {
  const { violations } = await new AxeBuilder({ page }).analyze();
  return violations
    .filter(({ impact }) => impact === 'serious' || impact === 'critical')
    .map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.target.join(' ')).join(', ')}`);
}

test('a wrong answer is told so, hints help, and a reload goes on with the step', async ({ page }) => {
  await page.goto('./?lesson=surface');
  await panel(page).getByRole('button', { name: 'Start' }).click();
  await idle(page);
  await next(page);
  const answer = question(page).getByLabel('Answer');
  await answer.fill('two');
  await check(page);
  await expect(question(page).getByRole('status')).toContainText('Expected a number');
  await answer.fill('1256.6');
  await check(page);
  await expect(question(page).getByRole('status')).toContainText('Use 4 π r²');
  await expect(question(page)).toHaveAttribute('data-done', 'false');
  await expect(panel(page).getByRole('button', { name: 'Next', exact: true })).toHaveCount(0);
  await panel(page).getByRole('button', { name: 'Hint', exact: true }).click();
  await expect(page.getByRole('region', { name: 'Hints' })).toContainText('4 · 3.1416');
  await expect(panel(page).getByRole('button', { name: 'Hint', exact: true })).toHaveCount(0);
  await answer.fill('5026.5');
  await check(page);
  await expect(question(page)).toHaveAttribute('data-done', 'true');
  await next(page);
  await question(page)
    .getByLabel(/smaller/)
    .check();
  await check(page);
  await expect(question(page).getByRole('status')).toContainText('Divide one area by the other');

  await page.reload();
  await expect(panel(page).getByRole('heading', { name: 'The staircase' })).toBeVisible();
  await expect(panel(page).getByRole('button', { name: /^Step 2: .*, done$/ })).toBeVisible();
  await expect(page.getByRole('button', { name: 'Open and run' })).toHaveCount(0);
  await expect(panel(page).locator('.findings')).toContainText('mm²');

  await panel(page).getByRole('button', { name: 'Leave the lesson' }).click();
  expect(new URL(page.url()).search).toBe('');
  await page.reload();
  await expect(panel(page)).toHaveCount(0);
  // A page that is left while the engine is at work asks next time whether to go on.
  await expect(stage(page, 'smooth')).toHaveAttribute('data-state', 'done');
  await idle(page);
  await page.goto('./?lesson=surface');
  await panel(page).getByRole('button', { name: 'Go on at step 3' }).click();
  await expect(panel(page).getByRole('heading', { name: 'The staircase' })).toBeVisible();
});

test('a question of the app’s numbers waits for a run', async ({ page }) => {
  await page.goto('./?lesson=topology');
  await panel(page).getByRole('button', { name: 'Start' }).click();
  await idle(page);
  await next(page);
  await question(page).getByLabel('Answer').fill('1');
  await check(page);
  await expect(question(page).getByRole('status')).toHaveText('The app cannot tell yet: run first.');
  await expect(question(page)).toHaveAttribute('data-done', 'false');
});

test('links of lessons that are damaged, unknown or false say why, and open nothing', async ({ page }) => {
  const refused = async (address: string, words: string | RegExp) => {
    await page.goto('about:blank');
    await page.goto(address);
    await expect(panel(page).getByRole('alert')).toContainText(words);
    await expect(
      page.getByRole('heading', { name: 'From a segmented volume to a tetrahedral mesh' }),
    ).toBeVisible();
  };
  await refused('./#l1=fY_BCsIwDIZfpeQ8', /cut short or damaged/);
  await refused('./?lesson=../secret', 'no lesson "../secret"');
});

test('a teacher writes a lesson, and a pupil takes it from its link to its end', async ({
  page,
  browser,
  baseURL,
}) => {
  await page.goto('./');
  await idle(page);
  await page.getByRole('button', { name: /^Torus/ }).click();
  await idle(page);
  await page.getByLabel('Edge length', { exact: true }).fill('6');
  await page.getByRole('button', { name: 'Lessons' }).click();
  await page.getByRole('button', { name: 'Write a lesson…' }).click();
  const editor = page.getByTestId('lesson-editor');
  await expect(page.getByTestId('draft-fault')).toContainText('title');
  await editor.getByLabel('Title of the lesson').fill('Rings');
  await editor.getByLabel('What there is to learn').fill('Why a ring is no ball.');

  await editor.getByLabel('Title of the step').fill('Make a mesh');
  await editor
    .getByLabel('Text', { exact: true })
    .fill('This is a *ring*.\n\n- Press `Run`.\n- <b>Wait.</b>');
  await editor.getByLabel('Opens the case that is open now').check();
  await editor.getByText('What may be used').click();
  await editor.getByLabel('Everything may be used').uncheck();
  await editor.getByLabel('Question').selectOption('do');
  await editor.getByLabel('What is to be done').fill('Mesh the ring.');
  await expect(editor.getByTestId('holds-now')).toContainText('Does not hold now: 0');
  await page.getByTestId('run').click();
  await meshed(page);
  await expect(editor.getByTestId('holds-now')).toContainText('Holds now: 1');
  await editor.getByText('Picture', { exact: true }).click();
  await editor.getByRole('button', { name: 'Picture of the view' }).click();
  await editor.getByLabel(/^What the picture shows/).fill('A ring');

  await editor.getByRole('button', { name: 'Step', exact: true }).click();
  await editor.getByLabel('Title of the step').fill('Count');
  await editor.getByLabel('Text', { exact: true }).fill('Look at the table of topology.');
  await editor.getByLabel('Question').selectOption('number');
  await editor.getByLabel('What is asked').fill('How many handles has it?');
  await editor.getByLabel('Value of the answer', { exact: true }).selectOption('label.handles');
  await expect(editor.getByText('Now: 1', { exact: true })).toBeVisible();
  await editor.getByLabel('Right within').fill('0');
  await editor.getByLabel('Hints, one a line').fill('More than none.\nFewer than two.');
  await editor.getByLabel('Said when right').fill('That is the tunnel.');

  await page.reload();
  await expect(editor.getByLabel('Title of the lesson')).toHaveValue('Rings');
  await expect(editor.getByTestId('lesson-link')).toHaveValue(/#l1=[\w-]+$/);
  const address = await editor.getByTestId('lesson-link').inputValue();
  await expect(editor.getByText(/^[\d,]+ characters/)).toBeVisible();
  const saved = page.waitForEvent('download');
  await editor.getByRole('button', { name: 'File' }).click();
  const file = await saved;
  expect(file.suggestedFilename()).toBe('rings.lesson.json');
  const path = test.info().outputPath('rings.lesson.json');
  await file.saveAs(path);
  const written = JSON.parse(await readFile(path, 'utf8')) as { steps: object[] };
  expect(written.steps).toHaveLength(2);
  await editor.getByRole('button', { name: 'Try it' }).click();
  await expect(panel(page).getByRole('heading', { name: 'Rings' })).toBeVisible();
  await panel(page).getByRole('button', { name: 'Back to writing' }).click();
  await expect(editor.getByLabel('Title of the lesson')).toHaveValue('Rings');

  const other = await browser.newContext({ baseURL, viewport: { width: 1280, height: 720 } });
  const pupil = await other.newPage();
  await pupil.goto(address);
  await expect(panel(pupil).getByRole('heading', { name: 'Rings' })).toBeVisible();
  await expect(pupil.getByRole('heading', { name: /^From a segmented volume/ })).toBeVisible();
  await panel(pupil).getByRole('button', { name: 'Start' }).click();
  await expect(panel(pupil).getByRole('listitem').filter({ hasText: '<b>Wait.</b>' })).toBeVisible();
  await expect(panel(pupil).getByRole('img', { name: 'A ring' })).toBeVisible();
  await expect(pupil.getByRole('heading', { name: 'Element size' })).toHaveCount(0);
  await idle(pupil);
  await pupil.keyboard.press('Control+Enter');
  await expect(question(pupil)).toHaveAttribute('data-done', 'true');
  await next(pupil);
  await expect(pupil.getByLabel('Edge length', { exact: true })).toHaveValue('6');
  await question(pupil).getByLabel('Answer').fill('2');
  await check(pupil);
  await panel(pupil).getByRole('button', { name: 'Hint', exact: true }).click();
  await panel(pupil).getByRole('button', { name: 'Another hint' }).click();
  await expect(pupil.getByRole('region', { name: 'Hints' })).toContainText('Fewer than two.');
  await question(pupil).getByLabel('Answer').fill('1');
  await check(pupil);
  await expect(question(pupil).getByRole('status')).toHaveText('That is the tunnel.');
  await panel(pupil).getByRole('button', { name: 'Finish' }).click();
  await expect(pupil.getByTestId('lesson-end')).toContainText('2 of 2 questions answered');
  await other.close();

  await dropFile(page, path);
  await expect(panel(page).getByRole('button', { name: 'Start' })).toBeVisible();
  await panel(page).getByRole('button', { name: 'Edit a copy' }).click();
  await editor.getByLabel('Title of the lesson').fill('Rings and balls');
  await page.getByRole('button', { name: 'Go back to it' }).click();
  await expect(editor.getByLabel('Title of the lesson')).toHaveValue('Rings');
});

test('the sheet has questions and lines, and solutions only where they are asked for', async ({ page }) => {
  await page.goto('./?lesson=adaptive');
  await panel(page).getByRole('button', { name: 'Sheet to print' }).click();
  const sheet = page.getByTestId('sheet');
  await expect(sheet).toContainText('?lesson=adaptive');
  await expect(sheet.getByRole('heading', { level: 2 })).toHaveCount(7);
  await expect(sheet.locator('.sheet-line')).not.toHaveCount(0);
  await expect(sheet.locator('.solution, .sheet-solution')).toHaveCount(0);
  await page.emulateMedia({ media: 'print' });
  await expect(page.locator('.header')).toBeHidden();
  await expect(page.getByRole('button', { name: 'Print' })).toBeHidden();
  await expect(sheet.getByRole('heading', { name: /^7\. / })).toBeVisible();
  const { height } = (await sheet.boundingBox())!;
  expect(height).toBeGreaterThan(900);
  await page.emulateMedia({ media: 'screen' });
  await page.getByLabel('With the solutions').check();
  await expect(sheet.locator('li.solution')).toHaveText([/^8/]);
  await expect(sheet.locator('.sheet-solution').first()).toContainText('Edge length is at least 3.4');
  await expect(sheet.locator('.sheet-line')).toHaveCount(0);
});

test('a lesson is taken by the keyboard, on a phone too', async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.goto('./?lesson=layers');
  await expect(page.getByRole('tab', { name: 'Lesson' })).toHaveAttribute('aria-selected', 'true');
  const reach = async (name: string) => {
    const wanted = panel(page).getByRole('button', { name, exact: true });
    await expect(wanted).toBeVisible();
    for (let i = 0; i < 60; i++) {
      if (await wanted.evaluate((element) => element === document.activeElement)) return;
      await page.keyboard.press('Tab');
    }
    throw new Error(`Tab does not reach ${name}`);
  };
  await reach('Start');
  await page.keyboard.press('Enter');
  await expect(panel(page).getByRole('heading', { name: 'Free play' })).toBeFocused();
  await reach('Next');
  await page.keyboard.press('Enter');
  await expect(panel(page).getByRole('heading', { name: 'One edge across' })).toBeFocused();
  await page.getByRole('tab', { name: 'View' }).click();
  await page.getByTestId('run').click();
  await page.getByRole('button', { name: 'Cut', exact: true }).click();
  await page.getByRole('tab', { name: 'Lesson' }).click();
  await expect(question(page)).toHaveAttribute('data-done', 'true');
  await panel(page).getByRole('button', { name: 'Leave the lesson' }).click();
  await expect(page.getByRole('tab', { name: 'Lesson' })).toHaveCount(0);
  await expect(page.getByRole('tab', { name: 'View' })).toHaveAttribute('aria-selected', 'true');
});

for (const colorScheme of ['light', 'dark'] as const) {
  test(`no serious accessibility finding in lessons (${colorScheme})`, async ({ page }) => {
    await page.emulateMedia({ colorScheme, reducedMotion: 'reduce' });
    await page.goto('./');
    await idle(page);
    await page.getByRole('button', { name: 'Lessons' }).click();
    await expect(page.getByRole('dialog')).toContainText('Why slivers hurt');
    expect(await seriousFaults(page)).toEqual([]);
    await page.getByRole('button', { name: /^Why slivers hurt/ }).click();
    await expect(panel(page).getByRole('button', { name: 'Start' })).toBeVisible();
    expect(await seriousFaults(page)).toEqual([]);
    await panel(page).getByRole('button', { name: 'Sheet to print' }).click();
    await page.getByLabel('With the solutions').check();
    expect(await seriousFaults(page)).toEqual([]);
    await page.keyboard.press('Escape');
    await panel(page).getByRole('button', { name: 'Start' }).click();
    await idle(page);
    await next(page);
    await question(page)
      .getByLabel(/needle/)
      .check();
    await check(page);
    await panel(page).getByRole('button', { name: 'Hint', exact: true }).click();
    expect(await seriousFaults(page)).toEqual([]);
    await question(page)
      .getByLabel(/slightly bent/)
      .check();
    await check(page);
    await next(page);
    await page.getByTestId('run').click();
    await meshed(page);
    expect(await seriousFaults(page)).toEqual([]);
    await panel(page).getByRole('button', { name: 'Leave the lesson' }).click();
    await page.getByRole('button', { name: 'Lessons' }).click();
    await page.getByRole('button', { name: 'Write a lesson…' }).click();
    const editor = page.getByTestId('lesson-editor');
    for (const kind of ['choice', 'number', 'do']) {
      await editor.getByLabel('Question').selectOption(kind);
      for (const part of ['What may be used', 'Values beside the text'])
        await editor.getByText(part, { exact: true }).click();
      expect(await seriousFaults(page)).toEqual([]);
    }
  });
}
