import type { Recipe } from './contract';
import { failure } from './generation';
import type { RecipeReply } from './handlers';

/** Checks a case without the digest of its file: by it the engine would hold the case against the volume that is loaded now. */
export async function withoutDigest(
  value: object,
  check: (loose: object) => Promise<RecipeReply>,
): Promise<RecipeReply> {
  const { file } = (value as { source?: { file?: unknown } }).source ?? {};
  const digest = (file as { sha256?: unknown } | undefined)?.sha256;
  if (digest === undefined) return check(value);
  if (typeof digest !== 'string' || !/^([0-9a-f]{64})?$/.test(digest)) {
    throw failure('usage', 'source.file.sha256: expected 64 hexadecimal digits', 'recipe');
  }
  const source = { ...(value as Recipe).source, file: { ...(file as object), sha256: '' } };
  const reply = await check({ ...value, source });
  for (const half of [reply.recipe, reply.minimal] as { source: { file: object } }[]) {
    half.source = { ...half.source, file: { ...half.source.file, sha256: digest } };
  }
  return reply;
}
