/** The page without a network: its files are kept by service_worker.js, once its first picture is there. */
import { effect } from '@preact/signals';
import { tell } from '../../notices';
import { activity } from '../../run/stages';
import { offered } from '../open_case';

/** A page that has been at rest for so long has its first picture. */
const restMs = 1000;

function atRest(): Promise<void> {
  return new Promise((rested) => {
    let timer: ReturnType<typeof setTimeout> | undefined;
    const stop = effect(() => {
      clearTimeout(timer);
      if (activity.value !== 'idle' || offered.value) return;
      timer = setTimeout(() => {
        stop();
        rested();
      }, restMs);
    });
  });
}

function tellOfVersion(): void {
  const text = 'This page goes on as it is. Reload it when you like: your case is kept.';
  tell('news', 'A new version is there', text, { name: 'Reload', go: () => location.reload() });
}

/**
 * Keeps the files of the page that runs `script`, and says when there is a newer version. Where a browser has no service
 * workers, or allows none, the page works all the same.
 */
export async function keepOffline(script: string): Promise<void> {
  const { serviceWorker, locks } = navigator;
  if (!serviceWorker) return;
  // For as long as the page lives: files of its version stay.
  void locks.request(script, { mode: 'shared' }, () => new Promise<never>(() => undefined));
  await atRest();
  const saySo = () => serviceWorker.controller?.postMessage(script);
  serviceWorker.addEventListener('message', tellOfVersion);
  serviceWorker.addEventListener('controllerchange', saySo);
  try {
    await serviceWorker.register('sw.js');
  } catch {
    return;
  }
  const registration = await serviceWorker.ready;
  saySo();
  // A page may stay open for days.
  document.addEventListener('visibilitychange', () => {
    if (document.visibilityState === 'visible') registration.update().catch(() => undefined);
  });
}
