import { signal } from '@preact/signals';

export const dialogShown = signal<
  | 'export'
  | 'share'
  | 'examples'
  | 'keys'
  | 'sizes'
  | 'reading'
  | 'about'
  | 'memory'
  | 'glossary'
  | 'lessons'
  | 'sheet'
  | 'review'
  | null
>(null);
