import type { ComponentChildren } from 'preact';
import { useState } from 'preact/hooks';
import type { Recipe } from '../../engine/contract';
import { bodyShown, type BodyKind } from '../../store/view';
import { editRecipe } from '../../store/case/recipe';
import { FoldedItem } from './folded_item';
import { Icon } from './icons';

/** A list of rules for the target edge length, of which one shows its fields. */
export function SizeList<T>(props: {
  title: string;
  /** What one of them is called, as "Wall". */
  kind: string;
  hint: string;
  /** The list, in a recipe. */
  of(recipe: Recipe): T[];
  current: Recipe;
  fresh(current: Recipe): T;
  nameOf(size: T): string;
  noteOf(size: T): string;
  /** They have a place in the patient: the one that is open has handles in the views. */
  body?: BodyKind;
  fields(size: T, index: number, name: string): ComponentChildren;
}) {
  const { kind, current, body } = props;
  const [ownShown, setOwnShown] = useState<number | null>(null);
  const placed = bodyShown.value?.kind === body ? (bodyShown.value?.index ?? null) : null;
  const shown = body ? placed : ownShown;
  const setShown = (index: number | null) => {
    if (body) bodyShown.value = index === null ? null : { kind: body, index };
    else setOwnShown(index);
  };
  const sizes = props.of(current);
  const add = () => {
    editRecipe(`Add ${kind.toLowerCase()}`, (draft) => void props.of(draft).push(props.fresh(current)));
    setShown(sizes.length);
  };
  const remove = (index: number) => {
    setShown(null);
    editRecipe(`Remove ${kind.toLowerCase()}`, (draft) => void props.of(draft).splice(index, 1));
  };
  return (
    <div class="regions">
      <div class="regions-head">
        <h3>{props.title}</h3>
        <button type="button" class="button small" onClick={add}>
          <Icon name="plus" size={13} /> {kind}
        </button>
      </div>
      {sizes.length === 0 && <p class="hint">{props.hint}</p>}
      {sizes.map((size, index) => {
        const name = props.nameOf(size);
        return (
          <FoldedItem
            key={index}
            name={name}
            note={props.noteOf(size)}
            open={shown === index}
            onToggle={() => setShown(shown === index ? null : index)}
            onRemove={() => remove(index)}
          >
            {props.fields(size, index, name)}
          </FoldedItem>
        );
      })}
    </div>
  );
}
