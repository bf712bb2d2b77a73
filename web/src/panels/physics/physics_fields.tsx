/** What the fields of the physics have in common. */
import type { Physics } from '../../engine/contract';
import { editRecipe } from '../../store/case/recipe';
import { NumberField } from '../controls/fields';

/** Changes what is there already. */
export function editPhysics(label: string, key: string, change: (physics: Physics) => void): void {
  editRecipe(label, (draft) => void (draft.physics && change(draft.physics)), `physics ${key}`);
}

/** Keys of a type's numbers. */
type NumberKey<T> = { [K in keyof T]-?: T[K] extends number ? K & string : never }[keyof T];

/** Number fields of one object of the recipe. */
export function numbersOf<T extends object>(
  path: string,
  owner: string,
  value: T,
  set: (label: string, change: Partial<T>) => void,
) {
  return (label: string, key: NumberKey<T>, unit: string, step: number) => (
    <NumberField
      label={label}
      owner={owner}
      unit={unit}
      path={`${path}.${key}`}
      step={step}
      value={value[key] as number}
      onChange={(next) => set(label, { [key]: next } as Partial<T>)}
    />
  );
}
