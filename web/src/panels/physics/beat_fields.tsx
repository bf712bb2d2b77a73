/** What is asked of a heart that beats: its muscle, what makes it contract, what it works against. */
import type { BeatParams, MuscleMaterial, Recipe } from '../../engine/contract';
import { nameOf } from '../../store/case/legend/legend';
import { groupDefaults, itemDefaults } from '../../store/run/schema_defaults';
import { CheckField, SelectField } from '../controls/fields';
import { short } from '../controls/format';
import { LabelChips } from '../controls/label_chips';
import { SizeList } from '../controls/size_list';
import { editPhysics, numbersOf } from './physics_fields';

const path = 'physics.mechanics';

/** Changes what is there of the heartbeat. */
export function editBeat(label: string, change: (beat: BeatParams) => void): void {
  editPhysics(label, `beat ${label}`, ({ mechanics }) => void (mechanics && change(mechanics)));
}

/** Number fields of the heartbeat itself, or of one object within it, which `of` finds in a draft. */
export function beatNumbers<T extends object>(
  group: string,
  owner: string,
  value: T,
  of: (beat: BeatParams) => T | undefined,
) {
  const field = numbersOf(group ? `${path}.${group}` : path, owner, value, (label, change) =>
    editBeat(`${owner}: ${label}`, (beat) => void Object.assign(of(beat) ?? {}, change)),
  );
  // There is no room for a long unit behind the number.
  return (...[label, key, unit, step]: Parameters<typeof field>) =>
    unit.length > 4 ? field(`${label}, ${unit}`, key, '', step) : field(label, key, unit, step);
}

type MaterialName = keyof MuscleMaterial;

const materials: readonly (readonly [MaterialName, string])[] = [
  ['transversely_isotropic', 'Transversely isotropic'],
  ['holzapfel_ogden', 'Holzapfel–Ogden 2009'],
  ['guccione', 'Guccione 1991'],
  ['mooney_rivlin', 'Mooney–Rivlin, isotropic'],
  ['corotational', 'Corotational, linear'],
];

/** None given is the first. */
const materialOf = (material: MuscleMaterial): MaterialName =>
  materials.find(([name]) => material[name])?.[0] ?? 'transversely_isotropic';

export function MaterialField({ params }: { params: BeatParams }) {
  return (
    <SelectField
      label="Muscle"
      value={materialOf(params.material)}
      options={materials}
      hint="How the muscle resists stretch"
      onChange={(name) =>
        editBeat('Muscle', (beat) => {
          beat.material = { [name]: groupDefaults(`${path}.material.${name}`) };
        })
      }
    />
  );
}

/** A material's numbers as papers write them. */
const signs: Record<string, string> = {
  c1_kpa: 'c₁',
  c2_kpa: 'c₂',
  c_kpa: 'C',
  a_kpa: 'a',
  b: 'b',
  a_f_kpa: 'a, fibres',
  b_f: 'b, fibres',
  a_s_kpa: 'a, sheets',
  b_s: 'b, sheets',
  a_fs_kpa: 'a, shear',
  b_fs: 'b, shear',
  b_t: 'b, across',
  k: 'k, slackening',
  shear_across_kpa: 'Shear across',
  shear_along_kpa: 'Shear along',
  fibre_kpa: 'Fibres',
};

function MaterialNumbers({ params }: { params: BeatParams }) {
  const name = materialOf(params.material);
  type Numbers = Record<string, number>;
  const known = params.material[name] as Numbers | undefined;
  const value = known ?? groupDefaults<Numbers>(`${path}.material.${name}`);
  const number = beatNumbers(`material.${name}`, 'Muscle', value, (beat) => {
    const material = beat.material as Partial<Record<MaterialName, Numbers>>;
    material[name] ??= { ...value };
    return material[name];
  });
  return (
    <>
      {Object.keys(value).map((key) =>
        number(signs[key] ?? key, key, key.endsWith('_kpa') ? 'kPa' : '', 0.1),
      )}
    </>
  );
}

type MuscleLabels = BeatParams['labels'][number];

function MuscleLabelFields({
  index,
  muscle,
  taken,
}: {
  index: number;
  muscle: MuscleLabels;
  taken: number[];
}) {
  const number = beatNumbers('labels', `Muscle ${index + 1}`, muscle, (beat) => beat.labels[index]);
  return (
    <>
      <LabelChips
        legend="Labels"
        hint="Labels of the wall that are another muscle"
        chosen={muscle.labels}
        taken={taken}
        onChange={(labels) =>
          editBeat('Labels of muscle', (beat) => void (beat.labels[index].labels = labels))
        }
      />
      {number('Stiffness', 'stiffness', '×', 0.5)}
      {number('Contractility', 'contractility', '×', 0.1)}
    </>
  );
}

export function MuscleFields({ params, current }: { params: BeatParams; current: Recipe }) {
  const number = beatNumbers('', 'Muscle', params, (beat) => beat);
  const used = params.labels.flatMap(({ labels }) => labels);
  return (
    <details class="more">
      <summary>Muscle</summary>
      <MaterialNumbers params={params} />
      <CheckField
        label="Fine fibres"
        hint="Fibres by rule at four places of each tetrahedron, not at its centroid alone"
        checked={params.fine_fibres}
        onChange={(on) => editBeat('Fine fibres', (beat) => void (beat.fine_fibres = on))}
      />
      {number('Bulk modulus', 'bulk_kpa', 'kPa', 100)}
      {number('Viscosity', 'viscosity_kpa_s', 'kPa s', 0.05)}
      {number('Density', 'density_kg_per_m3', 'kg/m³', 10)}
      <SizeList<MuscleLabels>
        title="Scar, weak muscle"
        kind="Muscle"
        hint="Labels that are stiffer or contract less than the rest."
        of={(recipe) => recipe.physics?.mechanics?.labels ?? []}
        current={current}
        fresh={() => ({ ...itemDefaults<MuscleLabels>(`${path}.labels`), labels: [] })}
        nameOf={({ labels }) => labels.map(nameOf).join(', ') || 'No label'}
        noteOf={({ stiffness, contractility }) => `× ${short(stiffness)}, × ${short(contractility)}`}
        fields={(muscle, index) => (
          <MuscleLabelFields
            index={index}
            muscle={muscle}
            taken={used.filter((label) => !muscle.labels.includes(label))}
          />
        )}
      />
    </details>
  );
}

type Law = NonNullable<BeatParams['contraction']['lv']>;

function LawFields({ name, title, law }: { name: 'lv' | 'rv'; title: string; law: Law | undefined }) {
  const group = `contraction.${name}`;
  const number = law && beatNumbers(group, title, law, ({ contraction }) => contraction[name]);
  return (
    <>
      <CheckField
        label={`${title}: own active stress`}
        hint="Instead of the preset's"
        checked={law !== undefined}
        onChange={(on) =>
          editBeat(`${title}: active stress`, ({ contraction }) => {
            if (on) contraction[name] = groupDefaults<Law>(`${path}.${group}`);
            else delete contraction[name];
          })
        }
      />
      {number?.('Peak', 'peak_kpa', 'kPa', 5)}
      {number?.('Rise', 'rise_per_s', '1/s', 1)}
      {number?.('Fall', 'fall_per_s', '1/s', 1)}
      {number?.('Switching', 'switch_ms', 'ms', 1)}
    </>
  );
}

export function ContractionFields({ params }: { params: BeatParams }) {
  const { contraction } = params;
  const number = beatNumbers('contraction', 'Contraction', contraction, (beat) => beat.contraction);
  return (
    <details class="more">
      <summary>Contraction</summary>
      {number('Begins at', 'start_ms', 'ms', 10)}
      {number('Lasts', 'duration_ms', 'ms', 10)}
      <LawFields name="lv" title="Left ventricle" law={contraction.lv} />
      <LawFields name="rv" title="Right ventricle" law={contraction.rv} />
    </details>
  );
}

function LoadFields({
  name,
  title,
  params,
}: {
  name: 'systemic' | 'pulmonary';
  title: string;
  params: BeatParams;
}) {
  const number = beatNumbers(
    `windkessel.${name}`,
    title,
    params.windkessel[name],
    ({ windkessel }) => windkessel[name],
  );
  const start = beatNumbers('windkessel', title, params.windkessel, ({ windkessel }) => windkessel);
  return (
    <>
      <h3>{title}</h3>
      {number('Resistance', 'resistance_kpa_s_per_ml', 'kPa s/ml', 0.01)}
      {number('Compliance', 'compliance_ml_per_kpa', 'ml/kPa', 1)}
      {number('Impedance', 'impedance_kpa_s_per_ml', 'kPa s/ml', 0.001)}
      {number('Atrium at rest', 'atrium_kpa', 'kPa', 0.1)}
      {number('Atrium, highest', 'kick_kpa', 'kPa', 0.1)}
      {number('Veins', 'venous_kpa', 'kPa', 0.1)}
      {start(
        'Arteries at first',
        name === 'systemic' ? 'systemic_start_kpa' : 'pulmonary_start_kpa',
        'kPa',
        0.5,
      )}
    </>
  );
}

/** The share of what has passed the pulmonary valve that comes back; of the circulation that is chosen. */
export function RegurgitationField({ params }: { params: BeatParams }) {
  const closed = params.closed_loop;
  const number = closed
    ? beatNumbers('closed_loop', 'Heartbeat', closed, (beat) => beat.closed_loop)
    : beatNumbers('windkessel', 'Heartbeat', params.windkessel, (beat) => beat.windkessel);
  return number('Pulmonary leak', 'regurgitation', '', 0.05);
}

export function CirculationFields({ params }: { params: BeatParams }) {
  return (
    <details class="more">
      <summary>Circulation</summary>
      <CheckField
        label="Closed loop"
        hint="Both circulations with all four chambers, instead of atria of given pressure and Windkessels; the case file has its numbers"
        checked={params.closed_loop !== undefined}
        onChange={(on) =>
          editBeat('Closed loop', (beat) => {
            if (on) beat.closed_loop = groupDefaults(`${path}.closed_loop`);
            else delete beat.closed_loop;
          })
        }
      />
      {!params.closed_loop && (
        <>
          <LoadFields name="systemic" title="Systemic" params={params} />
          <LoadFields name="pulmonary" title="Pulmonary" params={params} />
        </>
      )}
    </details>
  );
}

export function SupportFields({ params }: { params: BeatParams }) {
  const number = beatNumbers('', 'Heartbeat', params, (beat) => beat);
  const support = beatNumbers('support', 'Support', params.support, (beat) => beat.support);
  return (
    <details class="more">
      <summary>Support and time</summary>
      {support('Epicardium', 'epicardium_kpa_per_mm', 'kPa/mm', 0.005)}
      {support('Base', 'base_kpa_per_mm', 'kPa/mm', 0.1)}
      {support('Damping', 'damping_kpa_s_per_mm', 'kPa s/mm', 0.001)}
      {number('Filling takes', 'fill_ms', 'ms', 50)}
      {number('Frame every', 'frame_ms', 'ms', 5)}
      {number('Limit cycle within', 'cycle_percent', '%', 0.5)}
    </details>
  );
}
