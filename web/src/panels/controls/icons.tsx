const paths = {
  undo: 'M7.5 4 3.5 8l4 4M4 8h7.5a5 5 0 0 1 0 10H9',
  redo: 'm12.5 4 4 4-4 4M16 8H8.5a5 5 0 0 0 0 10H11',
  sun: 'M10 6.5a3.5 3.5 0 1 0 0 7 3.5 3.5 0 0 0 0-7M10 1.5v2M10 16.5v2M1.5 10h2M16.5 10h2M4 4l1.4 1.4M14.6 14.6 16 16M4 16l1.4-1.4M14.6 5.4 16 4',
  moon: 'M16.5 12A7 7 0 0 1 8 3.5a7 7 0 1 0 8.5 8.5',
  share:
    'M8.5 11.5a3.5 3.5 0 0 0 5 0l3-3a3.5 3.5 0 0 0-5-5l-1 1M11.5 8.5a3.5 3.5 0 0 0-5 0l-3 3a3.5 3.5 0 0 0 5 5l1-1',
  download: 'M10 3v9.5M6 9l4 4 4-4M3.5 16.5h13',
  play: 'M6 3.8v12.4L16 10z',
  pause: 'M5 4h3.5v12H5zM11.5 4H15v12h-3.5z',
  step_back: 'M15 4v12L7 10zM4.5 4H7v12H4.5z',
  step_on: 'M5 4v12l8-6zM13 4h2.5v12H13z',
  stop: 'M5 5h10v10H5z',
  up: 'm4 12.5 6-6 6 6',
  down: 'm4 7.5 6 6 6-6',
  copy: 'M7 7h9.5v9.5H7zM13 7V3.5H3.5V13H7',
  plus: 'M10 4v12M4 10h12',
  trash: 'M3.5 5.5h13M8 5.5v-2h4v2M5.5 5.5l.8 11h7.4l.8-11',
  eye: 'M1.8 10S4.8 4.5 10 4.5 18.2 10 18.2 10 15.2 15.5 10 15.5 1.8 10 1.8 10M10 7.5a2.5 2.5 0 1 0 0 5 2.5 2.5 0 0 0 0-5',
  eye_off:
    'M3 3l14 14M8 5a8 8 0 0 1 2-.3c5 0 8.2 5.3 8.2 5.3a14 14 0 0 1-2.4 2.9M5 6.3A14 14 0 0 0 1.8 10s3.2 5.3 8.2 5.3a8 8 0 0 0 3.3-.7',
  check: 'm4 10.5 4 4 8-9',
  cross: 'M5 5l10 10M15 5 5 15',
  warn: 'M10 3 18 17H2zM10 8v4M10 14.3v.4',
  target:
    'M10 3a7 7 0 1 0 0 14 7 7 0 0 0 0-14M10 7.5a2.5 2.5 0 1 0 0 5 2.5 2.5 0 0 0 0-5M10 1v3M10 16v3M1 10h3M16 10h3',
  fit: 'M3 7V3h4M13 3h4v4M17 13v4h-4M7 17H3v-4',
  picture: 'M2.5 4.5h15v11h-15zM2.5 13l4-4 3.5 3.5 2.5-2.5 5 4.5M13.2 7.6v.1',
  keys: 'M2 5.5h16v9H2zM5 8.5h.1M8.3 8.5h.1M11.6 8.5h.1M15 8.5h.1M6.5 11.7h7',
  pin: 'M7 2.5h6M8 2.5v5l-3 4h10l-3-4v-5M10 11.5v6',
  brush: 'M16.5 2.5 8.5 10.5l2 2 7-9zM8 11c-2.5 0-3 1.5-3.2 3-.2 1.3-.8 2-2.3 2.5 3.5 1.5 7.5.5 7.5-3z',
  lesson: 'M10 5.5C8.5 4 6 3.5 2.5 3.5v11.5c3.5 0 6 .5 7.5 2 1.5-1.5 4-2 7.5-2V3.5c-3.5 0-6 .5-7.5 2v11.5',
  table: 'M2.5 3.5h15v13h-15zM2.5 7.8h15M2.5 12.1h15M8 3.5v13',
  columns: 'M3 3.5h14v13H3zM7.7 3.5v13M12.3 3.5v13',
  clock: 'M10 2.5a7.5 7.5 0 1 0 0 15 7.5 7.5 0 0 0 0-15M10 6v4.3l2.8 1.7',
  file: 'M5 2.5h6.5L16 7v10.5H5zM11 2.5V7.5h5',
  move: 'M10 2v16M2 10h16M7.5 4.5 10 2l2.5 2.5M7.5 15.5 10 18l2.5-2.5M4.5 7.5 2 10l2.5 2.5M15.5 7.5 18 10l-2.5 2.5',
} as const;

export type IconName = keyof typeof paths;

const filledIcons: ReadonlySet<IconName> = new Set(['play', 'pause', 'stop', 'step_back', 'step_on']);

export function Icon({ name, size = 16 }: { name: IconName; size?: number }) {
  const filled = filledIcons.has(name);
  return (
    <svg
      class={filled ? 'icon filled' : 'icon'}
      width={size}
      height={size}
      viewBox="0 0 20 20"
      aria-hidden="true"
    >
      <path d={paths[name]} />
    </svg>
  );
}
