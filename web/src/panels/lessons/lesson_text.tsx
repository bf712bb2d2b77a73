import type { ComponentChildren } from 'preact';

/** *emphasis* and `code`; all else as it stands. */
function inline(text: string): ComponentChildren[] {
  return text.split(/(\*[^*\n]+\*|`[^`\n]+`)/).map((part, i) => {
    if (i % 2 === 0) return part;
    const inner = part.slice(1, -1);
    return part.startsWith('*') ? <em key={i}>{inner}</em> : <code key={i}>{inner}</code>;
  });
}

/** Paragraphs and lists of a lesson. Never HTML: what a lesson says is text. */
export function LessonText({ text }: { text: string }) {
  return (
    <>
      {text.split(/\n\s*\n/).map((block, i) => {
        const lines = block.split('\n');
        return lines.every((line) => line.startsWith('- ')) ? (
          <ul key={i}>
            {lines.map((line, k) => (
              <li key={k}>{inline(line.slice(2))}</li>
            ))}
          </ul>
        ) : (
          <p key={i}>{inline(block)}</p>
        );
      })}
    </>
  );
}
