/** Failures of the engine as replies. */
import type { ErrorInfo, Reply } from './contract';

function describeFailure(failure: unknown, stage: string): ErrorInfo {
  const text = failure instanceof Error ? `${failure.name}: ${failure.message}` : String(failure);
  const memory =
    /out of memory|\bOOM\b|bad_alloc|enlarge memory|allocation failed|Invalid typed array length/i;
  const exhausted = memory.test(text);
  return {
    code: exhausted ? 'out_of_memory' : 'internal',
    stage,
    message: exhausted
      ? 'The engine ran out of memory. Larger edge lengths or fewer labels need less.'
      : `The engine stopped unexpectedly (${text}).`,
    fatal: true,
  };
}

/** What `body` gives; an engine that it throws out of cannot go on. */
export function guarded<T>(stage: string, body: () => Reply<T>): Reply<T> {
  try {
    return body();
  } catch (failure) {
    return { ok: false, error: describeFailure(failure, stage) };
  }
}
