/** Hears the page that embeds the app, and tells it what becomes of its case (link/embed_messages.ts). */
import { effect } from '@preact/signals';
import { EngineError, type ErrorCode, type Report } from '../../engine/contract';
import { isCaseFragment, LinkError } from '../../link/codec';
import {
  embedVersion,
  MessageError,
  readRequest,
  type EmbedEvent,
  type EmbedRequest,
} from '../../link/embed_messages';
import { notices } from '../notices';
import { tellError } from '../run/engine';
import { report, verdict } from '../run/report';
import { activity, schema, stages } from '../run/stages';
import { mayRun, openEmbedded, runEmbedded, showEmbedded } from './embedded_case';
import { isHost, tellHost } from './host';

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
      return;
    case 'voxtet:view':
      return showEmbedded(request.view);
    case 'voxtet:run':
      if (!mayRun()) throw new MessageError('voxtet:run: there is no case, or it needs a file');
      if (activity.value !== 'idle') throw new MessageError('voxtet:run: a run is under way');
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
  let last: [Report | null, string] = [null, ''];
  effect(() => {
    if (!report.value) return;
    const { engine, digest, tets, points, quality } = report.value;
    const found = verdict.value && { mesh: verdict.value.mesh, simulation: verdict.value.simulation };
    const event: EmbedEvent = {
      type: 'voxtet:done',
      report: { engine, digest, tets, points, passed: quality.passed },
      verdict: found,
    };
    // A mesh is told of again where its simulation has got a verdict.
    const text = JSON.stringify(event);
    if (last[0] !== report.value || last[1] !== text) tellHost(event);
    last = [report.value, text];
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
