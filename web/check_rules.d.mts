/** What of a file of src/, by its path there and its text, breaks the rules. */
export function faultsOf(path: string, text: string): string[];
