/** A file that the address of the page, or a case, asks for from somewhere else. */
import { useEffect, useState } from 'preact/hooks';
import { dropFiles, openFiles } from '../../store/case/open_files';
import { amendRecipe, recipe } from '../../store/case/recipe';
import {
  addressFault,
  fetchRemote,
  remoteAsked,
  remoteKinds,
  type RemoteFile,
} from '../../store/case/remote';
import { volume } from '../../store/case/input';
import { openStudy } from '../../store/study/study';
import { Dialog } from '../controls/dialog';
import { short } from '../controls/format';

/** The page's address asks no more for what has been opened. */
function forgetParameters(): void {
  const url = new URL(location.href);
  for (const name of remoteKinds) url.searchParams.delete(name);
  if (url.href !== location.href) history.replaceState(history.state, '', url);
}

async function open(asked: RemoteFile, file: File): Promise<void> {
  forgetParameters();
  if (asked.kind === 'case') {
    await openFiles([new File([file], file.name.endsWith('.json') ? file.name : `${file.name}.json`)]);
    return;
  }
  if (asked.kind === 'study') return openStudy({ table: file, costs: undefined, rest: [] });
  const before = volume.value;
  await (asked.name ? dropFiles([file]) : openFiles([file]));
  // Whoever gets a link of this case can fetch it as well.
  if (volume.value !== before && recipe.value?.source.file?.name === file.name)
    amendRecipe(
      (draft) => draft.source.file && (draft.source.file.url = new URL(asked.url, location.href).href),
    );
}

export function RemoteDialog({ asked }: { asked: RemoteFile }) {
  const [bytes, setBytes] = useState<[number, number | null] | null>(null);
  const fault = addressFault(asked.url, location.href);
  const [trouble, setTrouble] = useState('');
  const [abort] = useState(() => new AbortController());
  useEffect(() => () => abort.abort(), []);
  const close = () => {
    remoteAsked.value = null;
  };
  const go = async () => {
    setTrouble('');
    setBytes([0, null]);
    try {
      const file = await fetchRemote(asked, location.href, (...now) => setBytes(now), abort.signal);
      close();
      await open(asked, file);
    } catch (error) {
      setBytes(null);
      if (!abort.signal.aborted) setTrouble((error as Error).message);
    }
  };
  const host = fault ? '' : new URL(asked.url, location.href).host;
  return (
    <Dialog title={`Fetch a ${asked.kind} from elsewhere?`} onClose={close}>
      <p>
        {fault
          ? 'The link of this page asks for a file that is not fetched:'
          : `Nothing has been fetched yet. ${host} will see that this computer asks for the file, and nothing else.`}
      </p>
      <p class="remote-url">{asked.url}</p>
      {(fault || trouble) && (
        <p class="stale" role="alert">
          {fault || trouble}
        </p>
      )}
      {bytes && (
        <p role="status">
          {short(bytes[0] / 1e6)} MB{bytes[1] ? ` of ${short(bytes[1] / 1e6)} MB` : ''}…
        </p>
      )}
      <div class="dialog-actions">
        <button type="button" class="button" onClick={close}>
          {bytes ? 'Cancel' : 'Not now'}
        </button>
        {!fault && (
          <button type="button" class="button primary" disabled={bytes !== null} onClick={() => void go()}>
            Fetch it from {host}
          </button>
        )}
      </div>
    </Dialog>
  );
}
