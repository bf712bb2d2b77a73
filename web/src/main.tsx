import { effect } from '@preact/signals';
import { render } from 'preact';
import { appSetup } from './engine/app_setup';
import { EngineClient } from './engine/client';
import { App } from './panels/app';
import { fetched } from './panels/controls/fetched';
import { followPageSize } from './panels/controls/page_shape';
import { keepCase, openAddress, startEngine } from './store/case/open_case';
import { keepSharedView } from './store/case/shared_view';
import { embedded } from './store/embedded';
import { keepForecast } from './store/run/forecast';
import { keepSizingShown } from './store/run/run_stages';
import { followLessons } from './store/case/keep/lesson_asked';
import { dark, largeType, theme, type ThemeChoice } from './store/view';
import { keepText, keptText } from './store/case/keep/web_storage';
import './styles/main.css';

const Embed = fetched(() => import('./panels/embed/embed').then((part) => part.Embed));

const themeKey = 'voxtet-theme';
const typeKey = 'voxtet-type';

function followTheme(): void {
  const system = window.matchMedia('(prefers-color-scheme: dark)');
  const stored = keptText('localStorage', themeKey);
  if (stored === 'light' || stored === 'dark') theme.value = stored satisfies ThemeChoice;
  const apply = () => {
    dark.value = theme.value === 'dark' || (theme.value === 'system' && system.matches);
    document.documentElement.dataset.theme = dark.value ? 'dark' : 'light';
  };
  system.addEventListener('change', apply);
  effect(() => {
    keepText('localStorage', themeKey, theme.value === 'system' ? null : theme.value);
    apply();
  });
}

function followType(): void {
  largeType.value = keptText('localStorage', typeKey) === 'large';
  effect(() => {
    keepText('localStorage', typeKey, largeType.value ? 'large' : null);
    document.documentElement.dataset.type = largeType.value ? 'large' : 'normal';
  });
}

followTheme();
followType();
followPageSize();
const root = document.getElementById('app');
if (root) render(embedded ? <Embed /> : <App />, root);
await startEngine(new EngineClient(appSetup()), (folder, files) => new EngineClient(appSetup(folder), files));
keepSharedView();
if (embedded) {
  const { serveHost } = await import('./store/embed/serve_host');
  await serveHost();
} else {
  await openAddress();
  followLessons();
  keepCase();
  keepSizingShown();
  keepForecast();
  if (import.meta.env.PROD)
    void import('./store/case/keep/offline').then(({ keepOffline }) => keepOffline(import.meta.url));
}
