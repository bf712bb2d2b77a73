/**
 * The address bar holds the case as its link, so that a reload, a bookmark and the back button find it. An entry of the
 * browser's history carries the name of the case that the page has put there; a link from elsewhere has no name.
 */
import { effect } from '@preact/signals';
import { EngineError } from '../../engine/contract';
import { encodeFragment, isCaseFragment } from '../../link/codec';
import { engine } from '../run/engine';
import { caseId, hasSource, recipe } from './recipe';
import { expectation } from '../run/report';
import { sameMesh } from '../run/stage_inputs';

/** Edits within this time are written as one. */
const delayMs = 300;

/** The link in the address bar, and the name of its case where the page itself has put it there. */
export function caseInAddress(): { link: string | null; own: string | undefined } {
  const own = (history.state as { case?: string } | null)?.case;
  return isCaseFragment(location.hash) ? { link: location.hash, own } : { link: null, own: undefined };
}

/** The link in the address bar has been opened, and stands for the case that is open now. */
export function nameEntry(): void {
  history.replaceState({ case: caseId.value }, '');
}

/** The case as a link, with what the link that brought it promises of this recipe. */
async function currentLink(): Promise<string | null> {
  const current = recipe.value;
  if (!current) return null;
  const { minimal } = await engine.checkRecipe(current);
  const promise = expectation.value;
  const expected = promise && sameMesh(promise.recipe, current) ? promise.expected : undefined;
  return encodeFragment({ ...minimal, expected });
}

/** An edit changes the entry that the case has; a case without one gets its own, so that the one before stays. */
function put(fragment: string): void {
  const { link, own } = caseInAddress();
  const entry = { case: caseId.value };
  if (link && own !== caseId.value) history.pushState(entry, '', fragment);
  else if (link !== fragment) history.replaceState(entry, '', fragment);
}

/**
 * Keeps the address up to date with every change of the case. While a link is `asked` about, the link stays; a link
 * that the user goes to meanwhile is handed to `open`.
 */
export function keepAddress(asked: () => boolean, open: (link: string) => Promise<void>): void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let turn = 0;
  const write = async (mine: number) => {
    try {
      const fragment = await currentLink();
      if (mine === turn && fragment) put(fragment);
    } catch (error) {
      // A recipe that the engine refuses has no link; one whose check was cut off is checked again.
      if (mine === turn && error instanceof EngineError && error.code === 'cancelled') writeSoon();
    }
  };
  const writeSoon = () => {
    const mine = ++turn;
    clearTimeout(timer);
    if (asked() || !recipe.value || !hasSource(recipe.value)) return;
    timer = setTimeout(() => void write(mine), delayMs);
  };
  effect(() => {
    void [caseId.value, expectation.value];
    writeSoon();
  });
  addEventListener('hashchange', () => {
    const { link } = caseInAddress();
    void (link ? open(link) : Promise.resolve()).then(writeSoon);
  });
}
