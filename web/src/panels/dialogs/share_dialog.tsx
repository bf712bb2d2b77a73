/** Share: a link of the case, its length, its QR code, its file. */
import { useEffect, useRef, useState } from 'preact/hooks';
import { downloadCase, downloadPainted, shareCase, type SharedCase } from '../../store/case/exchange';
import { filesOf, meshIsGiven } from '../../store/case/input';
import { paintedEdges, paintedName } from '../../store/case/painting';
import { caseName, recipe } from '../../store/case/recipe';
import { report } from '../../store/run/report';
import { CopyButton } from '../controls/copy_button';
import { Dialog } from '../controls/dialog';
import { CheckField } from '../controls/fields';
import { lengthNote, longLink, whole } from '../controls/format';

/** What a long link can be replaced by: the case file on any server, and this app with its address. */
function ByAddress() {
  const here = new URL(location.href);
  here.hash = '';
  here.search = `?case=https://example.org/${encodeURIComponent(caseName())}.case.json`;
  return (
    <p class="muted">
      A short link: put the case file on a web server of yours that allows other pages to read it (CORS), and
      share <code class="address">{here.href}</code> with its address.
    </p>
  );
}

const modulePixels = 6;

function QrCode({ text }: { text: string }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [trouble, setTrouble] = useState('');
  useEffect(() => {
    let newest = true;
    setTrouble('');
    void import('lean-qr').then(({ generate }) => {
      const shown = canvas.current;
      if (!newest || !shown) return;
      try {
        const small = document.createElement('canvas');
        generate(text).toCanvas(small, { off: [255, 255, 255, 255] });
        shown.width = shown.height = modulePixels * small.width;
        const context = shown.getContext('2d');
        if (!context) return;
        context.imageSmoothingEnabled = false;
        context.drawImage(small, 0, 0, shown.width, shown.height);
      } catch {
        setTrouble(`${whole(text.length)} characters are too many for a QR code, which holds some 2,900.`);
      }
    });
    return () => {
      newest = false;
    };
  }, [text]);
  return (
    <>
      <canvas
        ref={canvas}
        class="qr"
        role="img"
        aria-label="QR code of the link"
        hidden={trouble !== ''}
        data-testid="qr"
      />
      {trouble && <p class="stale">{trouble}</p>}
    </>
  );
}

/** The case as a part of another page. */
const frameOf = (url: string): string =>
  `<iframe src="${url.replace('#', '?embed#')}" width="720" height="480" title="A mesh in voxtet" ` +
  'allow="cross-origin-isolated"></iframe>';

export function ShareDialog({ close }: { close(): void }) {
  const [shared, setShared] = useState<SharedCase | null>(null);
  const [trouble, setTrouble] = useState('');
  const [withVolume, setWithVolume] = useState(false);
  const [withView, setWithView] = useState(false);
  const [asQr, setAsQr] = useState(false);
  useEffect(() => {
    let newest = true;
    setTrouble('');
    shareCase({ withVolume, withView }).then(
      (made) => newest && setShared(made),
      (error: Error) => newest && setTrouble(error.message),
    );
    return () => {
      newest = false;
    };
  }, [withVolume, withView]);
  const length = shared?.url.length ?? 0;
  const volumeFile = meshIsGiven.value ? undefined : recipe.value?.source.file;
  const all = recipe.value ? filesOf(recipe.value) : [];
  const files = withVolume ? all.filter((name) => name !== volumeFile?.name) : all;
  const promised = shared?.promises;
  return (
    <Dialog title="Share this case" onClose={close}>
      <p>
        {promised
          ? `The link holds the recipe and the digest of this mesh (${whole(report.value?.tets ?? 0)} tetrahedra)${
              promised.stages ? ', and of what was simulated on it' : ''
            }. Whoever opens it and runs sees whether it is reproduced.`
          : 'The link holds the recipe only: run first, and it will also hold the digest of the mesh.'}
      </p>
      {volumeFile && (
        <CheckField
          label="With the volume itself"
          hint="The label of every voxel becomes a part of the link: whoever opens it needs no file"
          checked={withVolume}
          onChange={setWithVolume}
        />
      )}
      <CheckField
        label="With this view"
        hint="Look at this: the camera, cut, colour, chosen element and time as they are now"
        checked={withView}
        onChange={setWithView}
      />
      {files.length > 0 && (
        <p>
          {files.join(', ')} {files.length === 1 ? 'is' : 'are'} not in the link. The receiver drops the same{' '}
          {files.length === 1 ? 'file' : 'files'} in, and digests are checked.
        </p>
      )}
      <textarea
        class="link"
        readOnly
        rows={4}
        aria-label="Link"
        value={shared?.url ?? ''}
        onFocus={(event) => event.currentTarget.select()}
        data-testid="share-link"
      />
      {shared && (
        <p class="muted">
          {whole(length)} characters. {lengthNote(length, 'case')}
        </p>
      )}
      {length > longLink && <ByAddress />}
      {trouble && <p class="stale">{trouble}</p>}
      {asQr && shared && <QrCode text={shared.url} />}
      <div class="dialog-actions">
        <button
          type="button"
          class="button"
          disabled={!shared}
          aria-pressed={asQr}
          onClick={() => setAsQr(!asQr)}
        >
          QR code
        </button>
        <button
          type="button"
          class="button"
          disabled={!shared}
          onClick={() => shared && downloadCase(shared.minimal)}
        >
          Case file (JSON)
        </button>
        {paintedEdges().length > 0 && (
          <button
            type="button"
            class="button"
            title="The painted sizes, which the receiver has to drop in"
            onClick={() => downloadPainted()}
          >
            {paintedName}
          </button>
        )}
        <CopyButton class="button" text={frameOf(shared?.url ?? '')} disabled={!shared || files.length > 0}>
          Copy embed code
        </CopyButton>
        <CopyButton class="button primary" text={shared?.url ?? ''} disabled={!shared}>
          Copy link
        </CopyButton>
      </div>
    </Dialog>
  );
}
