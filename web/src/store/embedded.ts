/**
 * Whether the app is a part of another page: view, one button, nothing that fetches or opens files. In a frame it is
 * never more than that, whatever its address says: what is clicked there may be what another page has put there.
 */
export const embedded =
  new URLSearchParams(globalThis.location?.search).has('embed') || globalThis.parent !== globalThis.self;
