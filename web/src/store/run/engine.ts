/** The engine of this page, and who may speak for it. */
import type { EngineClient } from '../../engine/client';
import { EngineError } from '../../engine/contract';
import { LinkError } from '../../link/codec';
import { tell, tellFailure } from '../notices';

/** There is none before the page has started it. */
export let engine: EngineClient;
/** Actions that were overtaken by newer ones leave the store alone. */
let turn = 0;

export function useEngine(client: EngineClient): void {
  engine = client;
}

/** Begins an action: whether it is still the newest is asked of what this returns. */
export function takeTurn(): () => boolean {
  const mine = ++turn;
  return () => mine === turn;
}

export function tellError(error: unknown): void {
  if (error instanceof EngineError) {
    if (error.code !== 'cancelled') tellFailure(error);
  } else if (error instanceof LinkError) {
    tell('error', 'This link cannot be opened', error.message);
  } else {
    tell('error', 'Something went wrong', error instanceof Error ? error.message : String(error));
  }
}
