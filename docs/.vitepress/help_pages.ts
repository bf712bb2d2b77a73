/** What the command line says of itself, as Markdown: a section for each command, a table of its options. */

export interface Command {
  name: string;
  purpose: string;
  usage: string;
  options: { name: string; meaning: string }[];
}

/** Where meanings begin; in a line of their own where the name is longer. */
const column = 30;

/** `scripts/print_help` puts "=== NAME" before the help of each command. */
export function parseHelp(text: string): Command[] {
  return text
    .split(/^=== /m)
    .slice(1)
    .map((part) => {
      const [name, purpose, usage, ...rest] = part.split('\n');
      const options: Command['options'] = [];
      for (const line of rest.filter((one) => one.startsWith('  '))) {
        const left = line.slice(0, column);
        const inOneLine = left.endsWith(' ');
        if (left.trim() === '') options[options.length - 1].meaning += line.trim();
        else if (inOneLine) options.push({ name: left.trim(), meaning: line.slice(column) });
        else options.push({ name: line.trim(), meaning: '' });
      }
      return { name, purpose, usage: usage.replace(/^Usage: /, ''), options };
    });
}

const cell = (text: string) => text.replaceAll('|', '\\|').replaceAll('<', '&lt;');
const capital = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

/** Options that several commands have alike stand with the first of them. */
export function helpPages(text: string): string {
  const seen = new Map<string, string>();
  return parseHelp(text)
    .map(({ name, purpose, usage, options }) => {
      const own = options.filter(({ name: option }) => !option.startsWith('-h,'));
      const key = (option: Command['options'][number]) => `${option.name}: ${option.meaning}`;
      const first = own.filter((option) => !seen.has(key(option)));
      const again = own.filter((option) => seen.has(key(option)));
      for (const option of first) seen.set(key(option), name);
      const rows = first.map(
        ({ name: option, meaning }) =>
          `| \`${cell(option.replace(/ TEXT REQUIRED$/, ''))}\` | ${cell(capital(meaning))} |`,
      );
      const homes = [...new Set(again.map((option) => seen.get(key(option))!))];
      const others = homes.map((home) => {
        const names = again.filter((option) => seen.get(key(option)) === home);
        const list = names.map((option) => `\`${option.name.split(' ')[0].split(',').at(-1)}\``).join(', ');
        return `As for [\`${home}\`](#${home}): ${list}.\n`;
      });
      const table =
        rows.length > 0 ? `| argument or option | what it does |\n|---|---|\n${rows.join('\n')}\n` : '';
      return [`## ${name}\n`, `${capital(purpose)}.\n`, `\`\`\`\n${usage}\n\`\`\`\n`, table, ...others].join(
        '\n',
      );
    })
    .join('\n');
}
