/** Hears the page that embeds the app, and tells it what becomes of its case (link/embed_messages.ts). */
import { effect, untracked } from '@preact/signals';
import { EngineError, type ErrorCode } from '../../engine/contract';
import { isCaseFragment, LinkError } from '../../link/codec';
import {
  embedVersion,
  MessageError,
  readRequest,
  type EmbedRequest,
  type EmbedView,
} from '../../link/embed_messages';
import { notices } from '../notices';
import { tellError } from '../run/engine';
import { report, verdict } from '../run/report';
import { schema, stages } from '../run/stages';
import { colourBy, command, cut, showEdges } from '../view';
import { embeddedRecipe, mayRun, openEmbedded, runEmbedded } from './embedded_case';
import { isHost, tellHost } from './host';

/** What was asked for of the view; a case that is run begins with a view of its own. */
let view: EmbedView = {};

function show({ colour, edges, cut: plane, look }: EmbedView): void {
  if (colour !== undefined) colourBy.value = colour;
  if (edges !== undefined) showEdges.value = edges;
  if (plane === false) cut.value = { ...cut.peek(), on: false };
  else if (plane) cut.value = { on: true, flat: false, ...plane };
  if (look) command.value = { kind: 'look', from: look };
}

function tellHostOf(error: unknown): void {
  const known = error instanceof EngineError;
  const code: ErrorCode = known ? error.code : 'usage';
  const message = error instanceof Error ? error.message : String(error);
  tellHost({ type: 'voxtet:error', code, stage: known ? error.stage : 'embed', message });
}

async function serve(request: EmbedRequest): Promise<void> {
  switch (request.type) {
    case 'voxtet:open':
      await openEmbedded(request.case);
      if (!mayRun()) throw new LinkError('The case needs a file. An embedded app takes none.');
      view = {};
      return;
    case 'voxtet:view':
      view = { ...view, ...request };
      return show(request);
    case 'voxtet:run':
      if (!embeddedRecipe()) throw new MessageError('voxtet:run: there is no case; voxtet:open gives one');
      // The next message is heard while it runs.
      void runEmbedded();
  }
}

/** Requests are served in their order; none of them ends in an exception. */
function hear(): void {
  let last: Promise<unknown> = Promise.resolve();
  addEventListener('message', (event) => {
    if (!isHost(event)) return;
    try {
      const request = readRequest(event.data);
      if (request) last = last.then(() => serve(request)).catch(tellHostOf);
    } catch (error) {
      tellHostOf(error);
    }
  });
}

function tellWhatComes(): void {
  effect(() => {
    for (const [stage, { state, fraction }] of Object.entries(stages.value))
      if (state === 'running') tellHost({ type: 'voxtet:progress', stage, fraction });
  });
  effect(() => {
    if (!report.value) return;
    const { engine, digest, tets, points, quality } = report.value;
    const { passed } = quality;
    const kind = untracked(() => verdict.value?.kind ?? null);
    tellHost({ type: 'voxtet:done', report: { engine, digest, tets, points, passed }, verdict: kind });
    untracked(() => show(view));
  });
  let told = 0;
  effect(() => {
    for (const { id, tone, text, error } of notices.value) {
      if (id <= told || tone !== 'error') continue;
      told = id;
      tellHostOf(error ?? text);
    }
  });
}

/** The case of the address, checked and shown; then whatever the page says. */
export async function serveHost(): Promise<void> {
  const openAddress = async () => {
    if (isCaseFragment(location.hash)) await openEmbedded(location.hash).catch(tellError);
  };
  tellWhatComes();
  await openAddress();
  addEventListener('hashchange', openAddress);
  hear();
  tellHost({ type: 'voxtet:ready', version: embedVersion, engine: schema.value?.version ?? '' });
}
