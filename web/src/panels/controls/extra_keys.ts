/** Keys that a part of the page has only while it is there. */
export const extraKeys: Record<string, () => void> = {};
