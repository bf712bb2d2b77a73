const alarm = [
  '#e7e4dd',
  '#e1dcd5',
  '#d8d1c7',
  '#d0c3b5',
  '#cab39e',
  '#c7a085',
  '#c68969',
  '#c66e4c',
  '#c74b2d',
  '#c70009',
];

/** Colour maps that stay readable in every common colour vision; stops from the published tables of matplotlib and Crameri. */
const stops = {
  viridis: [
    '#440154',
    '#482878',
    '#3e4989',
    '#31688e',
    '#26828e',
    '#1f9e89',
    '#35b779',
    '#6ece58',
    '#b5de2b',
    '#fde725',
  ],
  cividis: [
    '#00224e',
    '#123570',
    '#3b496c',
    '#575d6d',
    '#707173',
    '#8a8678',
    '#a59c74',
    '#c3b369',
    '#e1cc55',
    '#fee838',
  ],
  /** Viridis without its darkest end, on which edges would not be seen: for few whole numbers. */
  layers: ['#3b528b', '#2c718e', '#21918c', '#5ec962', '#fde725'],
  /**
   * From a plain good end to a loud bad one: in OKLab (Ottosson 2020) from pale sand to red, ever darker, so that the bad
   * end is told from the rest without red and green; most of the chroma is at that end.
   */
  alarm: alarm,
  /** The same where what is small is bad. */
  alarm_low: alarm.toReversed(),
  /** Diverging: for what has a middle. */
  vik: [
    '#001261',
    '#033e7d',
    '#1e6f9d',
    '#71a8c4',
    '#c9dde7',
    '#eacebd',
    '#d39774',
    '#be6533',
    '#8b2706',
    '#590008',
  ],
  /**
   * Cyclic: dark, orange, light, blue, and dark again, even steps along an ellipse of lightness and chroma in OKLab
   * (Ottosson 2020), so that each of the four is told from the others without red and green. Dark stands at an eighth.
   */
  cycle: [
    '#43629d',
    '#3e5175',
    '#484848',
    '#6c482c',
    '#8e5321',
    '#ac6525',
    '#c77a38',
    '#de9256',
    '#eead7c',
    '#f4c9aa',
    '#dedede',
    '#bcd3fe',
    '#9abeff',
    '#7da6f1',
    '#648edb',
    '#5177bf',
    '#43629d',
  ],
} as const satisfies Record<string, readonly string[]>;
export type ColourMapName = keyof typeof stops;

/** Labels 1 to 8 follow the heart scheme: left and right wall, left and right pool, scar, border zone. */
const labelPalette = ['#d1605e', '#4c8dae', '#a33b45', '#2f5d8a', '#e9b44c', '#8e6bb0', '#6a9f58', '#c77d4f'];

export function rgbOf(hex: string): [number, number, number] {
  const value = Number.parseInt(hex.slice(1), 16);
  return [(value >> 16) & 255, (value >> 8) & 255, value & 255];
}

export function hexOf(rgb: readonly number[]): string {
  return `#${rgb.map((part) => Math.round(part).toString(16).padStart(2, '0')).join('')}`;
}

/** A steady colour for any label: the palette first, then hues a golden angle apart. */
export function labelColour(label: number): string {
  const own = labelPalette[label - 1];
  if (own) return own;
  const hue = (label * 137.508) % 360;
  const light = 0.5 + 0.12 * ((label % 3) - 1);
  const channel = (shift: number) => {
    const k = (shift + hue / 30) % 12;
    const reach = 0.45 * Math.min(light, 1 - light);
    return 255 * (light - reach * Math.max(-1, Math.min(k - 3, 9 - k, 1)));
  };
  return hexOf([channel(0), channel(8), channel(4)]);
}

/** 256 RGB triples of a colour map. */
export function colourTable(name: ColourMapName): Uint8Array {
  const points = stops[name].map(rgbOf);
  const table = new Uint8Array(256 * 3);
  for (let i = 0; i < 256; i++) {
    const x = (i / 255) * (points.length - 1);
    const left = Math.min(points.length - 2, Math.floor(x));
    for (let c = 0; c < 3; c++) {
      table[3 * i + c] = Math.round(points[left][c] + (x - left) * (points[left + 1][c] - points[left][c]));
    }
  }
  return table;
}

export function colourStops(name: ColourMapName): readonly string[] {
  return stops[name];
}

/** Unlike those of labels, which they lie over. */
const paintPalette = ['#ff4fa3', '#00c2d1', '#ffb000', '#7a5cff', '#5ad200', '#ff5a1f'];

/** A steady colour for what is painted with a size. */
export function paintColour(paint: number): string {
  return paintPalette[(paint - 1) % paintPalette.length];
}
