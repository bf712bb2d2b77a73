/** The evidence of the run that is shown, as a page for whoever reviews it. */
import { citation } from '../../report/citation';
import type { ReportPicture, ReviewPage } from '../../report/review_page';
import { tellError } from '../run/engine';
import { fullReport, verdict } from '../run/report';
import { announcement } from '../notices';
import { chooseLayout, layout, sceneMounted, type Layout } from '../view';
import { download, shareCase, viewPicture } from './exchange';
import { nameOf } from './legend/legend';
import { caseName } from './recipe';

function dataUrl(blob: Blob): Promise<string> {
  return new Promise((read, failed) => {
    const reader = new FileReader();
    reader.onload = () => read(String(reader.result));
    reader.onerror = () => failed(reader.error);
    reader.readAsDataURL(blob);
  });
}

/** The view in each of these layouts, then as it was; none where there is no view. */
async function picturesOf(layouts: readonly [Layout, string][]): Promise<ReportPicture[]> {
  if (!sceneMounted.value) return [];
  const before = layout.value;
  const pictures: ReportPicture[] = [];
  try {
    for (const [next, title] of layouts) {
      chooseLayout(next);
      await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
      pictures.push({ title, source: await dataUrl(await viewPicture()) });
    }
  } finally {
    chooseLayout(before);
  }
  return pictures;
}

/** The page with pictures of the view as it stands. */
export async function review(): Promise<ReviewPage> {
  const found = fullReport.value;
  if (!found) throw new Error('There is no report yet.');
  const [{ reviewPage }, pictures, { url: link }] = await Promise.all([
    import('../../report/review_page'),
    picturesOf([
      ['model', 'The mesh'],
      ['slices', 'Slices of the image with the mesh'],
    ]),
    shareCase(),
  ]);
  return reviewPage(found, {
    title: caseName(),
    link,
    pictures,
    nameOf,
    verdict: verdict.value,
    citation: citation(found.engine),
  });
}

export async function downloadReview(page: ReviewPage): Promise<void> {
  try {
    const { htmlFile } = await import('../../report/review_page');
    const name = caseName();
    download(`${name}.report.html`, new Blob([htmlFile(name, page)], { type: 'text/html' }));
    announcement.value = 'Report written';
  } catch (error) {
    tellError(error);
  }
}
