/** What the page asks of an engine. To be raised when it can no longer drive the engines of earlier releases. */
export const engineInterface = 2;
