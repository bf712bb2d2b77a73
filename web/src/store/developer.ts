/** Whether the page was opened with `?developer`: it then shows what is not ready for everybody. */
export const developer = new URLSearchParams(globalThis.location?.search).has('developer');
