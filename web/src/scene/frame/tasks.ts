/** Resolves in a task of its own, so that the page can answer in between. */
export const nextTask = () => new Promise<void>((go) => setTimeout(go));
