import { failure } from './generation';
import type { RecipeReply } from './handlers';
import type { Recipe } from './contract';

/**
 * A case without the digest of its file, and what puts it back into the engine's answer: with its digest, the engine
 * would hold the case against the volume that is loaded now.
 */
export function withoutFileDigest(value: object): [object, (reply: RecipeReply) => RecipeReply] {
  const source = (value as { source?: { file?: object } }).source;
  const digest = (source?.file as { sha256?: unknown } | undefined)?.sha256;
  if (digest === undefined) return [value, (reply) => reply];
  if (typeof digest !== 'string' || !/^([0-9a-f]{64})?$/.test(digest)) {
    throw failure('usage', 'source.file.sha256: expected 64 hexadecimal digits', 'recipe');
  }
  const loose = { ...value, source: { ...source, file: { ...source?.file, sha256: '' } } };
  const putBack = (reply: RecipeReply) => {
    for (const half of [reply.recipe, reply.minimal] as { source: Recipe['source'] }[]) {
      const file = { ...half.source.file, sha256: digest } as Recipe['source']['file'];
      half.source = { ...half.source, file };
    }
    return reply;
  };
  return [loose, putBack];
}
