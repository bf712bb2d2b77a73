import { render } from 'preact';
import { VerificationPage } from './verification/page';
import './verification/verification.css';

const dark = window.matchMedia('(prefers-color-scheme: dark)');
const apply = () => {
  document.documentElement.dataset.theme = dark.matches ? 'dark' : 'light';
};
dark.addEventListener('change', apply);
apply();
const root = document.getElementById('page');
if (root) render(<VerificationPage />, root);
