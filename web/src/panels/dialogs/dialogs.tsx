import { acceptOffer, offered, closeOffer } from '../../store/case/open_case';
import { filesOf } from '../../store/case/input';
import { droppedFiles, imageAsked, unread } from '../../store/case/open_files';
import { needsNoFile } from '../../store/case/recipe';
import { remoteAsked } from '../../store/case/remote';
import { Dialog } from '../controls/dialog';
import { dialogShown } from '../controls/dialog_shown';
import { whole } from '../controls/format';
import { fetched } from '../controls/fetched';
import { Icon } from '../controls/icons';

const DropDialog = fetched(() => import('./drop_dialog').then((part) => part.DropDialog));
const ImageDialog = fetched(() => import('./image_dialog').then((part) => part.ImageDialog));
const RemoteDialog = fetched(() => import('./remote_dialog').then((part) => part.RemoteDialog));
const ToolDialogs = fetched(() => import('./tool_dialogs').then((part) => part.ToolDialogs));

/** Which engine will work on a case that was made with `promised`. */
function engineNote(promised: string, found: string): string {
  if (promised === found) return `${promised}, the one that made it`;
  return `made with ${promised}, which is not here; this page has ${found}, and what differs will be shown`;
}

function OfferDialog() {
  const offer = offered.value;
  if (!offer) return null;
  const { source, sizing, labels } = offer.recipe;
  const ready = needsNoFile(offer.recipe);
  const rows: [string, string][] = [
    [
      'Volume',
      source.phantom
        ? `generated: ${source.phantom.kind.replaceAll('_', ' ')}, ${source.phantom.spacing_mm.join(' × ')} mm`
        : source.inline
          ? `${source.inline.name}, in the ${offer.origin === 'link' ? 'link' : 'case'} itself`
          : source.file
            ? `${source.file.name}${offer.origin !== 'interrupted' ? ', which you are asked to drop in' : ''}`
            : 'none',
    ],
    ['Labels', labels.length > 0 ? labels.join(', ') : 'all'],
    [
      'Edge length',
      `${sizing.edge_mm} mm${sizing.labels.map((entry) => `, ${entry.edge_mm} mm in label ${entry.label}`).join('')}`,
    ],
    [
      'Regions',
      sizing.regions.length === 0
        ? 'none'
        : sizing.regions
            .map((region) => `${region.name || region.shape} ${region.edge_mm} mm`)
            .slice(0, 6)
            .join(', '),
    ],
  ];
  if (sizing.thickness.length > 0)
    rows.push(['Walls', sizing.thickness.map(({ wall }) => `labels ${wall.join(', ')}`).join('; ')]);
  if (sizing.curvature.length > 0)
    rows.push([
      'Curvature',
      sizing.curvature.map(({ edges_per_turn }) => `${edges_per_turn} edges to a turn`).join('; '),
    ]);
  const sideFiles = filesOf({ ...offer.recipe, source: { ...source, file: undefined } });
  if (sideFiles.length > 0)
    rows.push([
      'Size files',
      `${sideFiles.join(', ')}${offer.origin !== 'interrupted' ? ', to be dropped in' : ''}`,
    ]);
  if (offer.promise) {
    const { tets, digest, engine } = offer.promise.expected;
    rows.push(['Promised', `${whole(tets)} tetrahedra, digest ${digest.slice(0, 12)}…`]);
    rows.push(['Engine', engineNote(engine, offer.engine.info.schema.version)]);
  }
  return (
    <Dialog
      title={offer.origin === 'interrupted' ? 'Go on with the last case?' : 'Open this case?'}
      onClose={closeOffer}
    >
      <p>
        {offer.origin === 'interrupted'
          ? 'The page was left while the engine was at work on it. Nothing has been run.'
          : `A ${offer.origin} brought this recipe. Nothing has been run or fetched.`}
      </p>
      <dl class="offer">
        {rows.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
      <div class="dialog-actions">
        <button type="button" class="button" onClick={closeOffer}>
          Not now
        </button>
        <button type="button" class={ready ? 'button' : 'button primary'} onClick={() => acceptOffer(false)}>
          Open
        </button>
        {ready && (
          <button type="button" class="button primary" onClick={() => acceptOffer(true)}>
            <Icon name="play" /> Open and run
          </button>
        )}
      </div>
    </Dialog>
  );
}

export function Dialogs() {
  return (
    <>
      <OfferDialog />
      {droppedFiles.value && <DropDialog />}
      {remoteAsked.value && <RemoteDialog asked={remoteAsked.value} />}
      {imageAsked.value && <ImageDialog asked={imageAsked.value} />}
      {(dialogShown.value !== null || unread.value) && <ToolDialogs />}
    </>
  );
}
