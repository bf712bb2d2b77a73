/** What of a file of src/, by its path there and its text, breaks the rules. */
export function faultsOf(path: string, text: string): string[];

/** Which folders hold too many source files, by the paths of all files of src/. */
export function crowdedFolders(paths: string[]): string[];
