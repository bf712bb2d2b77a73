/** Numberings of labels that are in wide use, to name a file's labels by. */
import type { Recipe } from '../../../engine/contract';
import { meshIsGiven } from '../input';
import { changedLegend } from './legend';

export interface Scheme {
  title: string;
  names: ReadonlyMap<number, string>;
  /** Blood and other fluids: labels that are seldom meshed. */
  cavities: ReadonlySet<number>;
}

const numbered = (names: string, first = 1): [number, string][] =>
  names.split(' ').map((name, i) => [first + i, name]);

const vertebrae = (letter: string, count: number) =>
  Array.from({ length: count }, (_, i) => `vertebrae_${letter}${count - i}`).join(' ');
const ribs = (side: string) => Array.from({ length: 12 }, (_, i) => `rib_${side}_${i + 1}`).join(' ');
const bothSides = (names: string, first: 'left' | 'right' = 'left') => {
  const sides = first === 'left' ? ['left', 'right'] : ['right', 'left'];
  return names
    .split(' ')
    .flatMap((name) => sides.map((side) => `${name}_${side}`))
    .join(' ');
};

/** TotalSegmentator 2, task total: its class map. */
const totalSegmentator = [
  `spleen ${bothSides('kidney', 'right')} gallbladder liver stomach pancreas ${bothSides('adrenal_gland', 'right')}`,
  'lung_upper_lobe_left lung_lower_lobe_left lung_upper_lobe_right lung_middle_lobe_right lung_lower_lobe_right',
  'esophagus trachea thyroid_gland small_bowel duodenum colon urinary_bladder prostate',
  `${bothSides('kidney_cyst')} sacrum vertebrae_S1 ${vertebrae('L', 5)} ${vertebrae('T', 12)} ${vertebrae('C', 7)}`,
  `heart aorta pulmonary_vein brachiocephalic_trunk ${bothSides('subclavian_artery common_carotid_artery', 'right')}`,
  `${bothSides('brachiocephalic_vein')} atrial_appendage_left superior_vena_cava inferior_vena_cava`,
  `portal_vein_and_splenic_vein ${bothSides('iliac_artery iliac_vena humerus scapula clavicula femur hip')}`,
  `spinal_cord ${bothSides('gluteus_maximus gluteus_medius gluteus_minimus autochthon iliopsoas')}`,
  `brain skull ${ribs('left')} ${ribs('right')} sternum costal_cartilages`,
].join(' ');

/** FreeSurfer's subcortical segmentation (aseg): FreeSurferColorLUT.txt. */
const ofOneSide: readonly (readonly [number, string])[] = [
  [2, 'Cerebral-White-Matter'],
  [3, 'Cerebral-Cortex'],
  [4, 'Lateral-Ventricle'],
  [5, 'Inf-Lat-Vent'],
  [7, 'Cerebellum-White-Matter'],
  [8, 'Cerebellum-Cortex'],
  [10, 'Thalamus'],
  [11, 'Caudate'],
  [12, 'Putamen'],
  [13, 'Pallidum'],
  [17, 'Hippocampus'],
  [18, 'Amygdala'],
  [26, 'Accumbens-area'],
  [28, 'VentralDC'],
  [30, 'vessel'],
  [31, 'choroid-plexus'],
];
const rightNumber = (left: number) => left + (left <= 13 ? 39 : left <= 18 ? 36 : 32);
const freeSurfer: [number, string][] = [
  ...ofOneSide.flatMap(([label, name]): [number, string][] => [
    [label, `Left-${name}`],
    [rightNumber(label), `Right-${name}`],
  ]),
  ...numbered('3rd-Ventricle 4th-Ventricle Brain-Stem', 14),
  [24, 'CSF'],
  [72, '5th-Ventricle'],
  [77, 'WM-hypointensities'],
  [80, 'non-WM-hypointensities'],
  [85, 'Optic-Chiasm'],
  ...numbered('CC_Posterior CC_Mid_Posterior CC_Central CC_Mid_Anterior CC_Anterior', 251),
];

const scheme = (title: string, names: [number, string][], cavities: number[] = []): Scheme => ({
  title,
  names: new Map(names),
  cavities: new Set(cavities),
});

export const schemes: readonly Scheme[] = [
  scheme('Two ventricles with scar', numbered('LV_wall RV_wall LV_blood RV_blood scar border_zone'), [3, 4]),
  scheme('Short axis: RV, wall, LV (ACDC, M&Ms)', numbered('RV_blood LV_wall LV_blood'), [1, 3]),
  scheme(
    'Whole heart (MM-WHS)',
    [
      [205, 'LV_wall'],
      [420, 'LA_blood'],
      [500, 'LV_blood'],
      [550, 'RA_blood'],
      [600, 'RV_blood'],
      [820, 'aorta'],
      [850, 'pulmonary_artery'],
    ],
    [420, 500, 550, 600],
  ),
  scheme(
    'Heart chambers (TotalSegmentator)',
    numbered('myocardium atrium_left ventricle_left atrium_right ventricle_right aorta pulmonary_artery'),
    [2, 3, 4, 5],
  ),
  scheme('Whole body (TotalSegmentator)', numbered(totalSegmentator)),
  scheme('Brain (FreeSurfer)', freeSurfer, [4, 5, 14, 15, 24, 43, 44, 72]),
];

/** The schemes that have all of these labels; those first of which the most is there. */
export function schemesFor(labels: readonly number[]): Scheme[] {
  return schemes
    .filter(({ names }) => labels.length > 1 && labels.every((label) => names.has(label)))
    .sort((a, b) => a.names.size - b.names.size);
}

/** Names all labels, and leaves cavities out of a mesh that is to be made, where the user has not chosen labels yet. */
export function nameBy({ names, cavities }: Scheme, labels: readonly number[], draft: Recipe): void {
  draft.legend = changedLegend(
    draft.legend,
    labels.map((label) => ({ label, name: names.get(label) ?? '' })),
  );
  const solid = labels.filter((label) => !cavities.has(label));
  if (!meshIsGiven.value && draft.labels.length === 0 && solid.length > 0 && solid.length < labels.length)
    draft.labels = solid;
}
