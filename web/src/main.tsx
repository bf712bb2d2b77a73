import { effect } from '@preact/signals';
import { render } from 'preact';
import { appSetup } from './engine/app_setup';
import { EngineClient } from './engine/client';
import { App } from './panels/app';
import { followPageSize } from './panels/controls/page_shape';
import { keepCase, openAddress, startEngine } from './store/case/open_case';
import { keepForecast } from './store/run/forecast';
import { keepSizingShown } from './store/run/run_stages';
import { dark, largeType, theme, type ThemeChoice } from './store/view';
import { keepText, keptText } from './store/case/keep/web_storage';
import './styles/main.css';

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
if (root) render(<App />, root);
await startEngine(new EngineClient(appSetup()));
await openAddress();
keepCase();
keepSizingShown();
keepForecast();
