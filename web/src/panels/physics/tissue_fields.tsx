import type { TissueKind } from '../../engine/contract';
import { tissuePresetOf, tissuePresets, type TissuePresetName } from '../../store/case/tissue_presets';
import { SelectField } from '../controls/fields';
import { LabelChips } from '../controls/label_chips';
import { editPhysics, numbersOf } from './physics_fields';

const options = (Object.keys(tissuePresets) as TissuePresetName[]).map(
  (name) => [name, tissuePresets[name].title] as const,
);

/** A kind by its name; scar is no kind at all. */
function PresetField({ kind, index, fibres }: { kind: TissueKind; index: number; fibres: boolean }) {
  const preset = tissuePresetOf(kind, fibres);
  return (
    <SelectField
      label="Tissue"
      value={preset ?? 'own'}
      hint={preset ? tissuePresets[preset].hint : undefined}
      options={[
        ...(preset ? [] : [['own', 'Own values'] as const]),
        ...options,
        ['scar', 'Scar: conducts nothing'] as const,
      ]}
      onChange={(name) =>
        editPhysics(name === 'scar' ? 'Scar' : 'Kind of tissue', `tissue ${index} preset`, ({ tissue }) => {
          // Labels without a kind do not conduct.
          if (name === 'scar') tissue.kinds.splice(index, 1);
          else if (name !== 'own') Object.assign(tissue.kinds[index], tissuePresets[name].fields);
        })
      }
    />
  );
}

export function TissueFields(props: {
  kind: TissueKind;
  index: number;
  name: string;
  taken: number[];
  fibres: boolean;
}) {
  const { kind, index, name } = props;
  const set = (label: string, change: Partial<TissueKind>) =>
    editPhysics(
      label,
      `tissue ${index} ${label}`,
      ({ tissue }) => void Object.assign(tissue.kinds[index], change),
    );
  const number = numbersOf('physics.tissue.kinds', name, kind, set);
  return (
    <>
      <LabelChips
        legend="Labels"
        hint="Labels that are this kind of tissue"
        chosen={kind.labels}
        taken={props.taken}
        onChange={(labels) => set('Labels of tissue', { labels })}
      />
      <PresetField kind={kind} index={index} fibres={props.fibres} />
      {number(props.fibres ? 'Speed along fibres' : 'Speed', 'along_mm_per_ms', 'm/s', 0.05)}
      {props.fibres && number('Speed across', 'across_mm_per_ms', 'm/s', 0.05)}
      <details class="more">
        <summary>Cells</summary>
        <SelectField
          label="Model"
          value={kind.cell}
          options={[
            ['ms', 'Mitchell–Schaeffer'],
            ['mms', 'Corrado–Niederer'],
          ]}
          onChange={(cell) => set('Cell', { cell })}
        />
        {number('Inward current', 'tau_in_ms', 'ms', 0.05)}
        {number('Outward current', 'tau_out_ms', 'ms', 0.5)}
        {number('Gate opens in', 'tau_open_ms', 'ms', 10)}
        {number('Gate closes in', 'tau_close_ms', 'ms', 10)}
      </details>
    </>
  );
}
