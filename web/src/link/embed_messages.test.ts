import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { MessageError, readRequest } from './embed_messages';

describe('messages of the page around', () => {
  it.each([
    [{ type: 'voxtet:run' }, { type: 'voxtet:run' }],
    [
      { type: 'voxtet:open', case: { labels: [1] }, version: 1 },
      { type: 'voxtet:open', case: { labels: [1] } },
    ],
    [
      { type: 'voxtet:view', view: { colour: 'label' } },
      { type: 'voxtet:view', view: { colour: 'label' } },
    ],
  ])('are read: %j', (message, request) => {
    expect(JSON.parse(JSON.stringify(readRequest(message)))).toEqual(request);
  });

  it.each([
    [{ type: 'voxtet:run', version: 2 }, 'version'],
    [{ type: 'voxtet:open', case: 7 }, 'recipe'],
    [{ type: 'voxtet:view', view: 'R' }, 'view'],
    [{ type: 'voxtet:view' }, 'view'],
    [{ type: 'voxtet:other' }, 'voxtet:other'],
  ])('are refused with what is wrong: %j', (message, word) => {
    expect(() => readRequest(message)).toThrow(word);
  });

  it('end in a request, in nothing or in a MessageError, whatever they are', () => {
    const types = fc.constantFrom('voxtet:open', 'voxtet:view', 'voxtet:run', 'voxtet:x', 'x');
    const fields = fc.dictionary(fc.constantFrom('case', 'view', 'version'), fc.anything());
    const messages = fc.tuple(types, fields).map(([type, rest]) => ({ ...rest, type }));
    fc.assert(
      fc.property(fc.oneof(fc.anything(), messages), (message) => {
        try {
          readRequest(message);
        } catch (error) {
          expect(error).toBeInstanceOf(MessageError);
        }
      }),
    );
  });
});
