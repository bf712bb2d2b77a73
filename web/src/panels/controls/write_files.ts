import { tellError } from '../../store/run/engine';

type Exchange = typeof import('../../store/case/exchange');

/** Writes files by code that is fetched when the first one is asked for. */
export function writeFiles(by: (exchange: Exchange) => unknown): void {
  import('../../store/case/exchange').then(by).catch(tellError);
}
