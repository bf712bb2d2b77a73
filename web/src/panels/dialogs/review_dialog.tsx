/** The reviewer's page: the evidence of the run, to be read, printed, kept as a page or as a research object. */
import { useEffect, useRef, useState } from 'preact/hooks';
import { exportZip } from '../../store/case/exchange';
import { downloadReview, review } from '../../store/case/review';
import { upToDate } from '../../store/run/report';
import type { ReviewPage } from '../../report/review_page';
import { Dialog } from '../controls/dialog';
import { Icon } from '../controls/icons';

/** The page within a root of its own, so that its style and the app's stay apart. */
function Page({ body, style }: ReviewPage) {
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const element = host.current;
    if (!element) return;
    const root = element.shadowRoot ?? element.attachShadow({ mode: 'open' });
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(style);
    root.adoptedStyleSheets = [sheet];
    root.innerHTML = body;
  }, [body, style]);
  return (
    <div ref={host} class="review-page" tabIndex={0} role="document" aria-label="Evidence of this run" />
  );
}

export function ReviewDialog({ close }: { close(): void }) {
  const [page, setPage] = useState<ReviewPage | null>(null);
  const [trouble, setTrouble] = useState('');
  useEffect(() => {
    review().then(setPage, (error: Error) => setTrouble(error.message));
  }, []);
  return (
    <Dialog title="Reviewer's page" class="review" onClose={close}>
      {trouble && <p class="stale">{trouble}</p>}
      {!page && !trouble && <p class="muted">Taking pictures…</p>}
      {page && <Page {...page} />}
      <div class="dialog-actions">
        <button type="button" class="button" disabled={!page} onClick={() => window.print()}>
          Print
        </button>
        <button
          type="button"
          class="button"
          disabled={!page}
          onClick={() => page && void downloadReview(page)}
        >
          <Icon name="download" /> Page (HTML)
        </button>
        <button
          type="button"
          class="button primary"
          title="RO-Crate: case, mesh, report and digests in one zip, described for archives such as Zenodo"
          disabled={!page || !upToDate.value}
          onClick={() => {
            close();
            void exportZip('vtu', 'ras');
          }}
        >
          <Icon name="download" /> Research object (zip)
        </button>
      </div>
    </Dialog>
  );
}
