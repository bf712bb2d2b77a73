const keys: [string, string][] = [
  ['Ctrl Enter', 'Run'],
  ['Esc', 'Cancel a run; else show all elements again'],
  ['Ctrl Z, Ctrl Shift Z', 'Undo, redo'],
  ['1, 2, 3', '3‑D view, slices, pinned run beside this one'],
  ['[ and ]', 'The stage before, the stage after'],
  ['C', 'Cut'],
  ['E', 'Element edges'],
  ['F', 'Fit to view'],
  ['P', 'Save a picture'],
  ['?', 'This list'],
];

const byPointer: [string, string][] = [
  ['Click', 'Numbers of the element; the crosshair goes there'],
  ['Double click', 'A region of its own edge length there: a sphere'],
];

const inTime: [string, string][] = [
  ['S', 'While a wave is computed: clicks on the mesh excite it'],
  ['K', 'Play, pause'],
  [', and .', 'The frame before, the next frame'],
];

const inViews: [string, string][] = [
  ['Arrows', 'Turn the 3‑D view; move the crosshair in a slice'],
  ['+ and −', 'Zoom'],
  ['Enter', 'Numbers of the element in the middle of the 3‑D view; a dab of the brush in a slice'],
  ['Page up, page down, wheel', 'The next slice, the slice before'],
  ['Ctrl wheel, pinch', 'Zoom a slice; Shift drag or two fingers shift it'],
  ['0', 'The whole slice'],
];

function List({ title, rows }: { title: string; rows: [string, string][] }) {
  return (
    <>
      <h3>{title}</h3>
      <dl class="keys">
        {rows.map(([key, meaning]) => (
          <div key={key}>
            <dt>{key}</dt>
            <dd>{meaning}</dd>
          </div>
        ))}
      </dl>
    </>
  );
}

export function KeyList() {
  return (
    <>
      <List title="Everywhere" rows={keys} />
      <List title="On the body or a slice" rows={byPointer} />
      <List title="While something is played" rows={inTime} />
      <List title="In a view that has the focus" rows={inViews} />
    </>
  );
}
