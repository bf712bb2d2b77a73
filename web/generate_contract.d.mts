export function committedSchema(): object;
export function generate(schema: object): string;
export const generatedFile: URL;
