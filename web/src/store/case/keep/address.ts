/**
 * The address bar holds the case as its link, so that a reload, a bookmark and the back button find it. An entry of the
 * browser's history carries the name of the case that the page has put there; a link from elsewhere has no name.
 */
import { effect } from '@preact/signals';
import { EngineError } from '../../../engine/contract';
import { encodeFragment, isCaseFragment } from '../../../link/codec';
import { engine } from '../../run/engine';
import { caseId, changedAt, hasSource, recipe } from '../recipe';
import { expectation } from '../../run/report';
import { sameMesh } from '../../run/stage_inputs';

/** Edits within this time are written as one. */
const delayMs = 300;

/** What an entry of the browser's history says of the link that the page has put there. */
interface Entry {
  case?: string;
  changedAt?: number;
}

const thisEntry = (): Entry => ({ case: caseId.value, changedAt: changedAt.value });

/** The link in the address bar; where the page itself has put it there, the name of its case and its `changedAt`. */
export function caseInAddress(): { link: string | null; own?: string; changedAt?: number } {
  if (!isCaseFragment(location.hash)) return { link: null };
  const { case: own, changedAt } = (history.state as Entry | null) ?? {};
  return { link: location.hash, own, changedAt };
}

/** The link in the address bar has been opened, and stands for the case that is open now. */
export function nameEntry(): void {
  history.replaceState(thisEntry(), '');
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
  const entry = thisEntry();
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
